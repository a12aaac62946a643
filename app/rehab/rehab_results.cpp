// SPDX-License-Identifier: MIT
#include "app/rehab/rehab_results.hpp"

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <utility>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/progress/patient_page.hpp"
#include "activities/rehab/progress/progress.hpp"
#include "app/rehab/rehab_pages.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/record_reader.hpp"
#include "session/record/session_recording.hpp"

namespace burin::app {
namespace {

using activities::KeptRun;

// The clock on the wall, as strftime writes it.
std::string time_as(const char* form, std::time_t at) {
    std::tm local{};
    if (::localtime_r(&at, &local) == nullptr) return "";
    char text[32];
    return {text, std::strftime(text, sizeof text, form, &local)};
}

std::string now_as(const char* form) { return time_as(form, std::time(nullptr)); }

// The fact of a session file that says whose run it is, by what hand and when; since there is a journal of runs.
constexpr const char* kRunFact = "rehab run";

struct RecordedRun {
    std::optional<unsigned> participant;
    std::string date, time, hand, name;  // name: of the files that it was kept as; empty: it was not
};

// Returns what a session file says of its run. One without that fact says when it began and with what device.
Result<RecordedRun> recorded_run(record::RecordReader& reader) {
    RecordedRun run;
    if (const auto fact = reader.facts().find(kRunFact); fact != reader.facts().end()) {
        const Json json = Json::parse(fact->second, nullptr, false);
        const auto text = [&](const char* key) {
            const Json* const value = json.is_object() ? find_value(json, std::string("/") + key) : nullptr;
            return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
        };
        run = {std::nullopt, text("date"), text("time"), text("hand"), text("name")};
        const Json* const participant = json.is_object() ? find_value(json, "/participant") : nullptr;
        if (participant != nullptr && participant->is_number_unsigned()) run.participant = participant->get<unsigned>();
        // It becomes the name of a file.
        if (run.name.contains('/') || run.name.starts_with('.')) run.name.clear();
        if (!run.date.empty() && !run.time.empty() && !run.hand.empty()) return run;
        return fail(reader.path(), "its fact \"" + std::string(kRunFact) + "\" is damaged", "restore it from a copy");
    }
    BURIN_TRY(clocks, reader.clocks());
    if (clocks.empty())
        return fail(reader.path(), "does not say when it was recorded", "do it again without --results");
    const auto at = static_cast<std::time_t>(clocks.front().utc_ns / 1'000'000'000);
    run.date = time_as("%Y-%m-%d", at);
    run.time = time_as("%H:%M:%S", at);
    const auto device = reader.facts().find(session::kDeviceFact);
    run.hand = device != reader.facts().end() ? device->second : "recorded, " + reader.path();
    return run;
}

// Says what was made of runs that were killed.
void tell_of(const activities::LeftRuns& left) {
    for (const std::filesystem::path& file : left.kept)
        std::printf("a run whose program was ended before it is kept as far as it came: %s\n", file.c_str());
    for (const Error& error : left.errors) std::fprintf(stderr, "burin: left as it is: %s\n", error.line().c_str());
}

// Returns what the folder holds; nothing where there is none yet. What a run that was killed has left counts.
Result<activities::KeptRuns> runs_until_now(const ResultsOptions& options) {
    std::error_code ignored;
    if (options.folder.empty() || !options.participant || !std::filesystem::is_directory(options.folder, ignored))
        return activities::KeptRuns{};
    tell_of(activities::take_up_left_runs(options.folder));
    return activities::read_runs(options.folder);
}

}  // namespace

std::vector<std::filesystem::path> ResultsOptions::folders() const {
    if (folder.empty()) return {};
    std::vector<std::filesystem::path> made{folder};
    if (participant) made.push_back(activities::participant_folder(folder, *participant));
    return made;
}

void add_results_options(Command command, ResultsOptions& options) {
    command.option("--results", options.folder,
                   "A folder that keeps this run, and a page of the participant's progress");
    command.option("--participant", options.participant, "By number, 1 to 999: no name is kept");
    command.option("--date", options.date, "Of a run by --hand scripted, such as 2026-11-03, if not today's");
}

Result<void> check_results(const ResultsOptions& options, bool scripted, const std::string& recording) {
    if (options.folder.empty() && options.participant)
        return fail("--participant", "is of nothing that is kept", "name a folder with --results");
    if (!options.date.empty()) {
        if (!scripted || options.folder.empty())
            return fail("--date",
                        "is for runs that are kept and that no person does: " +
                            std::string(scripted ? "there is no --results" : "there is no --hand scripted"),
                        "leave it out: a person's run has today's date");
        BURIN_TRY_DO(activities::check_date(options.date));
        if (options.date > now_as("%Y-%m-%d"))
            return fail("--date " + options.date, "is still to come", "name a day that has been");
    }
    if (options.folder.empty() || (!options.participant && !recording.empty())) return {};
    if (!options.participant)
        return fail("--results " + options.folder, "does not say whose run it keeps", "give --participant, a number");
    if (*options.participant < 1 || *options.participant > KeptRun::kMostParticipants)
        return fail("--participant", formatted("is %u", *options.participant), "give a number from 1 to 999");
    return check_stays(options.folder, *options.participant);
}

Result<std::optional<activities::Baseline>> baseline_in(const ResultsOptions& options) {
    BURIN_TRY(kept, runs_until_now(options));
    return activities::baseline_of(kept.runs, options.participant.value_or(0));
}

Result<std::optional<double>> adapted_target_in(const ResultsOptions& options, const std::string& exercise) {
    BURIN_TRY(kept, runs_until_now(options));
    return activities::adapted_target_N(kept.runs, options.participant.value_or(0), exercise);
}

Result<ResultsOfRun> ResultsOfRun::begin(const ResultsOptions& options, const std::string& hand,
                                         const std::shared_ptr<activities::Rehab>& exercise) {
    ResultsOfRun results;
    results.run_ = {options.participant.value_or(1), options.date.empty() ? now_as("%Y-%m-%d") : options.date,
                    now_as("%H:%M:%S"), hand, exercise->report()};
    Json fact{{"date", results.run_.date}, {"time", results.run_.time}, {"hand", hand}};
    if (!options.folder.empty()) {
        BURIN_TRY_DO(activities::prepare_results(options.folder, *options.participant));
        BURIN_TRY(journal, activities::RunJournal::begin(options.folder, results.run_));
        results.folder_ = options.folder;
        results.journal_ = std::move(journal);
        tell_of(results.journal_->left());
        exercise->keep_with([journal = results.journal_](const Json& report, const Json& new_events) {
            return journal->add(report, new_events);
        });
        fact["participant"] = *options.participant;
        fact["name"] = results.journal_->name();
    }
    exercise->add_fact(kRunFact, fact.dump());
    return results;
}

Result<ResultsOfRun> ResultsOfRun::again(const ResultsOptions& options, const std::string& recording) {
    ResultsOfRun results;
    if (options.folder.empty()) return results;
    BURIN_TRY(reader, record::RecordReader::open(recording));
    BURIN_TRY(recorded, recorded_run(reader));
    if (options.participant && recorded.participant && *options.participant != *recorded.participant)
        return fail("--participant",
                    formatted("is %u, and %s is of participant %u", *options.participant, recording.c_str(),
                              *recorded.participant),
                    "leave it out");
    const std::optional<unsigned> participant = recorded.participant ? recorded.participant : options.participant;
    if (!participant)
        return fail("--results " + options.folder, "does not say whose run it keeps, nor does " + recording,
                    "give --participant, a number");
    results.run_ = {*participant, recorded.date, recorded.time, recorded.hand, {}};
    results.folder_ = options.folder;
    results.name_ = recorded.name;
    BURIN_TRY_DO(check_stays(options.folder, *participant));
    BURIN_TRY_DO(activities::prepare_results(options.folder, *participant));
    return results;
}

Result<void> ResultsOfRun::keep(const Json& report) {
    if (folder_.empty()) return {};
    Result<std::filesystem::path> path;
    if (journal_) {
        path = journal_->keep(report);
    } else {
        run_.report = report;
        const Result<activities::KeptAgain> again = activities::keep_again(folder_, run_, name_);
        if (again && !again->is_new) std::printf("was kept already, as far or farther\n");
        if (again)
            path = again->file;
        else
            path = std::unexpected(again.error());
    }
    if (!path) {
        std::printf("the run could not be kept; this is all of it:\n%s", json_text(report).c_str());
        return std::unexpected(path.error());
    }
    std::printf("kept as %s\n", path->c_str());
    BURIN_TRY(kept, activities::read_runs(folder_));
    std::vector<const KeptRun*> own;
    for (const KeptRun& other : kept.runs)
        if (other.participant == run_.participant && other.report.at("exercise") == report.at("exercise"))
            own.push_back(&other);
    const Result<std::string> index =
        write_pages({.folder = folder_, .index = {}, .language = {}, .participant = run_.participant});
    if (!index) return std::unexpected(index.error());
    std::printf("progress: %s/participant-%03u/progress.html\n", folder_.c_str(), run_.participant);
    if (!own.empty() && activities::levels_of(report.at("exercise").get<std::string>()) > 0)
        std::printf(
            "%s\n",
            activities::proposed(own, activities::levels_of(report.at("exercise").get<std::string>())).reason.c_str());
    return {};
}

void ResultsOfRun::discard() {
    if (journal_) journal_->discard();
}

Result<void> rehab_report(const std::string& folder, const std::string& page, const std::string& language) {
    if (folder.empty()) return fail("FOLDER", "is empty", "name the folder that --results was given");
    tell_of(activities::take_up_left_runs(folder));
    BURIN_TRY(kept, activities::read_runs(folder));
    BURIN_TRY(withdrawn, activities::read_withdrawals(folder));
    if (kept.runs.empty() && kept.errors.empty() && withdrawn.empty())
        return fail(folder, "holds no runs", "name the folder that --results was given");
    BURIN_TRY(index, write_pages({.folder = folder, .index = page, .language = language}));
    std::printf("%zu %s: %s\n", kept.runs.size(), kept.runs.size() == 1 ? "run" : "runs", index.c_str());
    if (kept.errors.empty()) return {};
    for (std::size_t i = 1; i < kept.errors.size(); ++i)
        std::fprintf(stderr, "burin: left out: %s\n", kept.errors[i].line().c_str());
    return std::unexpected(kept.errors.front());
}

}  // namespace burin::app
