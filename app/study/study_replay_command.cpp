// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "app/study/study_command.hpp"
#include "app/study/study_trials.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/record_reader.hpp"
#include "study/folder/study_folder.hpp"
#include "study/people/recorded_trial.hpp"
#include "study/replay/stage_replay.hpp"

namespace burin::app {
namespace {

struct Recording {
    const study::Participant* person = nullptr;
    const study::StageVisit* visit = nullptr;
};

// Threads take recordings one by one and say of each what came out.
class Replays {
public:
    Replays(const study::StudyFolder& study, std::vector<Recording> recordings)
        : study_(study), recordings_(std::move(recordings)) {}

    Result<void> make_worlds() {
        for (const study::StudyWorld& world : study_.protocol().worlds) {
            BURIN_TRY(felt, study::FeltWorld::create(world));
            worlds_[world.name] = std::move(felt);
        }
        return {};
    }
    void work() {
        for (std::size_t i = next_.fetch_add(1); i < recordings_.size(); i = next_.fetch_add(1)) {
            const std::string fault = replay(recordings_[i]);
            if (fault.empty()) continue;
            const std::lock_guard lock(mutex_);
            ++faults_;
            std::fprintf(stderr, "%s\n", fault.c_str());
        }
    }
    [[nodiscard]] std::size_t faults() const { return faults_; }
    [[nodiscard]] std::uint64_t ticks() const { return ticks_; }
    [[nodiscard]] std::size_t interrupted() const { return interrupted_; }
    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] std::size_t of_session() const { return of_session_; }

private:
    // Empty where all is as it was stored.
    std::string replay(const Recording& recording) {
        const study::StageVisit& visit = *recording.visit;
        const std::filesystem::path file = study_.path() / visit.recording;
        const bool ended = visit.status == study::StageStatus::ended;
        if (ended) {
            if (const auto ok = study_.check_recording(visit); !ok) return ok.error().line();
        }
        const study::Stage* stage = study_.protocol().stage(visit.stage);
        const auto world = stage != nullptr ? worlds_.find(stage->world) : worlds_.end();
        if (world == worlds_.end()) return file.string() + ": its stage is not in the protocol";
        const auto replay =
            study::replay_stage(file, study_.protocol(), study_.facts().protocol_digest, *world->second);
        if (!replay) return replay.error().line();
        {
            const std::lock_guard lock(mutex_);
            ticks_ += replay->ticks;
            columns_ = replay->columns;
            interrupted_ += ended ? 0 : 1;
        }
        if (replay->difference) return file.string() + ": " + replay->difference->line();
        if (!ended) return {};
        if (name_of(replay->end.result) != visit.result)
            return formatted("%s: ends with \"%s\", the journal says \"%s\"", file.c_str(), name_of(replay->end.result),
                             visit.result.c_str());
        if (replay->of_session) ++of_session_;
        return measured_differs(visit, replay->record);
    }

    std::string measured_differs(const study::StageVisit& visit, const Json& again) {
        if (visit.file.empty()) return again.is_null() ? "" : visit.recording + ": gives figures, and none were kept";
        const auto kept = study_.recorded(visit);
        if (!kept) return kept.error().line();
        // Compares the texts: both were written as JSON, in which what is not a number is null.
        const Json same = study::as_kept_before(again, *kept);
        if (json_text(*kept) == json_text(same)) return {};
        return visit.file + ": the recording gives other figures than were kept";
    }

    const study::StudyFolder& study_;
    const std::vector<Recording> recordings_;
    std::map<std::string, std::unique_ptr<const study::FeltWorld>> worlds_;
    std::atomic<std::size_t> next_{0}, of_session_{0};
    std::mutex mutex_;  // guards what follows
    std::size_t faults_ = 0, interrupted_ = 0, columns_ = 0;
    std::uint64_t ticks_ = 0;
};

void tell_replays(const Replays& replays, std::size_t count, std::size_t without) {
    std::printf("%zu recordings, %llu ticks of %zu columns through the haptic tick again", count,
                static_cast<unsigned long long>(replays.ticks()), replays.columns());
    if (replays.interrupted() > 0) std::printf("; %zu of them end where they were interrupted", replays.interrupted());
    if (replays.of_session() > 0)
        std::printf(
            "; %zu of them are of a live session: their stages, trials and figures were computed again from the ticks "
            "as stored",
            replays.of_session());
    if (without > 0) std::printf("; %zu were erased or hold nothing yet", without);
    std::printf("\n");
}

}  // namespace

Result<void> study_replay(const StudyReplayOptions& options) {
    BURIN_TRY(study, study::StudyFolder::open(options.study, study::StudyAccess::read));
    warn_of_journal(study);
    const std::vector<study::Participant> people = study.participants();
    std::vector<Recording> recordings;
    std::size_t erased = 0;
    for (const study::Participant& person : people) {
        if (!options.participant.empty() && person.id != options.participant) continue;
        for (const study::StageVisit& visit : person.visits) {
            if (visit.recording.empty()) continue;
            std::error_code error;
            const std::filesystem::path file = study.path() / visit.recording;
            const bool gone = !std::filesystem::exists(file, error);
            const bool aborted = visit.status == study::StageStatus::aborted;
            // Killed before the first transaction: there is nothing yet, or the beginning of a file.
            const bool holds_nothing = gone || (aborted && !record::RecordReader::open(file.string()));
            if (holds_nothing && (person.erased || aborted)) {
                ++erased;
                continue;
            }
            recordings.push_back({&person, &visit});
        }
    }
    if (recordings.empty()) return fail(options.study, "has no recorded motion", "run it first: burin study run");
    const std::size_t count = recordings.size();
    Replays replays(study, std::move(recordings));
    BURIN_TRY_DO(replays.make_worlds());
    {
        const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
        const std::size_t threads = std::min<std::size_t>(options.threads > 0 ? options.threads : cores, count);
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < threads; ++i) others.emplace_back([&] { replays.work(); });
        replays.work();
    }
    if (!options.quiet) tell_replays(replays, count, erased);
    if (replays.faults() > 0)
        return fail(options.study, formatted("%zu recordings do not give what was stored", replays.faults()),
                    "see above; the others do, to the bit");
    if (!options.quiet) std::printf("All equal what was stored, to the bit.\n");
    return {};
}

namespace {

CommandAction add_study_replay(Command command) {
    const auto options = std::make_shared<StudyReplayOptions>();
    command.option("STUDY", options->study, kStudyHelp).required();
    command.option("--participant", options->participant, "Of this participant only");
    command.option("--threads", options->threads, "Recordings at a time; 0: one for each core").within(0, 1024);
    return action([options] { return study_replay(*options); });
}

}  // namespace

CommandRow study_replay_row() {
    return {"replay", "Recorded motion through the haptic tick again, compared to the bit", add_study_replay};
}

}  // namespace burin::app
