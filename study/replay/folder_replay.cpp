// SPDX-License-Identifier: MIT
#include "study/replay/folder_replay.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/record_reader.hpp"
#include "study/felt/felt_world.hpp"
#include "study/people/recorded_trial.hpp"
#include "study/replay/stage_replay.hpp"

namespace burin::study {
namespace {

// Returns whether the recording of a visit is not to be had: it was erased, or its stage was interrupted before
// anything was kept.
bool is_without_motion(const StudyFolder& study, const Participant& person, const StageVisit& visit) {
    std::error_code error;
    const std::filesystem::path file = study.path() / visit.recording;
    const bool gone = !std::filesystem::exists(file, error);
    const bool aborted = visit.status == StageStatus::aborted;
    // Killed before the first transaction: there is nothing yet, or the beginning of a file.
    const bool holds_nothing = gone || (aborted && !record::RecordReader::open(file.string()));
    return holds_nothing && (person.erased || aborted);
}

// Threads take recordings one by one and say of each what came out.
class Replays {
public:
    Replays(const StudyFolder& study, std::vector<const StageVisit*> recordings,
            const std::function<void(const std::string&)>& tell)
        : study_(study), recordings_(std::move(recordings)), tell_(tell) {}

    Result<void> make_worlds() {
        for (const StudyWorld& world : study_.protocol().worlds) {
            BURIN_TRY(felt, FeltWorld::create(world));
            worlds_[world.name] = std::move(felt);
        }
        return {};
    }
    void work() {
        for (std::size_t i = next_.fetch_add(1); i < recordings_.size(); i = next_.fetch_add(1)) {
            const std::string fault = replay(*recordings_[i]);
            if (fault.empty()) continue;
            const std::lock_guard lock(mutex_);
            ++found_.faults;
            if (tell_) tell_(fault);
        }
    }
    // Needs all threads to have ended.
    [[nodiscard]] const FolderReplay& found() const { return found_; }

private:
    // Empty where all is as it was stored.
    std::string replay(const StageVisit& visit) {
        const std::filesystem::path file = study_.path() / visit.recording;
        const bool ended = visit.status == StageStatus::ended;
        if (ended) {
            if (const auto ok = study_.check_recording(visit); !ok) return ok.error().line();
        }
        const Stage* stage = study_.protocol().stage(visit.stage);
        const auto world = stage != nullptr ? worlds_.find(stage->world) : worlds_.end();
        if (world == worlds_.end()) return file.string() + ": its stage is not in the protocol";
        const auto replay = replay_stage(file, study_.protocol(), study_.facts().protocol_digest, *world->second);
        if (!replay) return replay.error().line();
        {
            const std::lock_guard lock(mutex_);
            found_.ticks += replay->ticks;
            found_.columns = replay->columns;
            found_.interrupted += ended ? 0 : 1;
        }
        if (replay->difference) return file.string() + ": " + replay->difference->line();
        if (!ended) return {};
        if (name_of(replay->end.result) != visit.result)
            return formatted("%s: ends with \"%s\", the journal says \"%s\"", file.c_str(), name_of(replay->end.result),
                             visit.result.c_str());
        if (replay->of_session) {
            const std::lock_guard lock(mutex_);
            ++found_.of_session;
        }
        return measured_differs(visit, replay->record);
    }

    std::string measured_differs(const StageVisit& visit, const Json& again) {
        if (visit.file.empty()) return again.is_null() ? "" : visit.recording + ": gives figures, and none were kept";
        const auto kept = study_.recorded(visit);
        if (!kept) return kept.error().line();
        // Compares the texts: both were written as JSON, in which what is not a number is null.
        const Json same = as_kept_before(again, *kept);
        if (json_text(*kept) == json_text(same)) return {};
        return visit.file + ": the recording gives other figures than were kept";
    }

    const StudyFolder& study_;
    const std::vector<const StageVisit*> recordings_;
    const std::function<void(const std::string&)>& tell_;
    std::map<std::string, std::unique_ptr<const FeltWorld>> worlds_;
    std::atomic<std::size_t> next_{0};
    std::mutex mutex_;  // guards what follows
    FolderReplay found_;
};

}  // namespace

Result<FolderReplay> replay_folder(const StudyFolder& study, const FolderReplayOptions& options) {
    const std::vector<Participant> people = study.participants();
    std::vector<const StageVisit*> recordings;
    std::size_t without = 0;
    for (const Participant& person : people) {
        if (!options.participant.empty() && person.id != options.participant) continue;
        for (const StageVisit& visit : person.visits) {
            if (visit.recording.empty()) continue;
            if (is_without_motion(study, person, visit))
                ++without;
            else
                recordings.push_back(&visit);
        }
    }
    const std::size_t count = recordings.size();
    FolderReplay found;
    if (count > 0) {
        Replays replays(study, std::move(recordings), options.tell);
        BURIN_TRY_DO(replays.make_worlds());
        {
            const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
            const std::size_t threads = std::min<std::size_t>(options.threads > 0 ? options.threads : cores, count);
            std::vector<std::jthread> others;
            for (std::size_t i = 1; i < threads; ++i) others.emplace_back([&] { replays.work(); });
            replays.work();
        }
        found = replays.found();
    }
    found.recordings = count;
    found.without = without;
    return found;
}

}  // namespace burin::study
