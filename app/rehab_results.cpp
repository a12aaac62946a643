// SPDX-License-Identifier: MIT
#include "app/rehab_results.hpp"

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/progress/patient_page.hpp"
#include "activities/rehab/progress/progress.hpp"
#include "app/rehab_pages.hpp"
#include "base/text.hpp"

namespace burin::app {
namespace {

using activities::KeptRun;

// The clock on the wall, as strftime writes it.
std::string now_as(const char* form) {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    if (::localtime_r(&now, &local) == nullptr) return "";
    char text[32];
    return {text, std::strftime(text, sizeof text, form, &local)};
}

}  // namespace

void add_results_options(Command command, ResultsOptions& options) {
    command.option("--results", options.folder,
                   "A folder that keeps this run, and a page of the participant's progress");
    command.option("--participant", options.participant, "By number, 1 to 999: no name is kept");
    command.option("--date", options.date, "Of a run by --hand scripted, such as 2026-11-03, if not today's");
}

Result<void> check_results(const ResultsOptions& options, bool scripted) {
    if (options.folder.empty() && options.participant)
        return fail("--participant", "is of nothing that is kept", "name a folder with --results");
    if (!options.date.empty()) {
        if (!scripted || options.folder.empty())
            return fail("--date",
                        "is for runs that are kept and that no person does: " +
                            std::string(scripted ? "there is no --results" : "there is no --hand scripted"),
                        "leave it out: a person's run has today's date");
        if (const auto date = activities::check_date(options.date); !date) return date;
        if (options.date > now_as("%Y-%m-%d"))
            return fail("--date " + options.date, "is still to come", "name a day that has been");
    }
    if (options.folder.empty()) return {};
    if (!options.participant)
        return fail("--results " + options.folder, "does not say whose run it keeps", "give --participant, a number");
    if (*options.participant < 1 || *options.participant > KeptRun::kMostParticipants)
        return fail("--participant", formatted("is %u", *options.participant), "give a number from 1 to 999");
    return {};
}

Result<void> prepare_results(const ResultsOptions& options) {
    if (options.folder.empty()) return {};
    if (const auto stays = check_stays(options.folder, *options.participant); !stays) return stays;
    return activities::prepare_results(options.folder, *options.participant);
}

Result<void> keep_results(const ResultsOptions& options, const std::string& hand, const Json& report) {
    if (options.folder.empty()) return {};
    const KeptRun run{*options.participant, options.date.empty() ? now_as("%Y-%m-%d") : options.date,
                      now_as("%H:%M:%S"), hand, report};
    const auto path = activities::keep_run(options.folder, run);
    if (!path) {
        std::printf("the run could not be kept; this is all of it:\n%s", json_text(report).c_str());
        return std::unexpected(path.error());
    }
    std::printf("kept as %s\n", path->c_str());
    const Result<activities::KeptRuns> kept = activities::read_runs(options.folder);
    if (!kept) return std::unexpected(kept.error());
    std::vector<const KeptRun*> own;
    for (const KeptRun& other : kept->runs)
        if (other.participant == run.participant && other.report.at("exercise") == report.at("exercise"))
            own.push_back(&other);
    const Result<std::string> index =
        write_pages({.folder = options.folder, .index = {}, .language = {}, .participant = options.participant});
    if (!index) return std::unexpected(index.error());
    std::printf("progress: %s/participant-%03u/progress.html\n", options.folder.c_str(), *options.participant);
    if (!own.empty())
        std::printf(
            "%s\n",
            activities::proposed(own, activities::levels_of(report.at("exercise").get<std::string>())).reason.c_str());
    return {};
}

Result<void> rehab_report(const std::string& folder, const std::string& page, const std::string& language) {
    if (folder.empty()) return fail("FOLDER", "is empty", "name the folder that --results was given");
    const Result<activities::KeptRuns> kept = activities::read_runs(folder);
    if (!kept) return std::unexpected(kept.error());
    const Result<activities::Withdrawals> withdrawn = activities::read_withdrawals(folder);
    if (!withdrawn) return std::unexpected(withdrawn.error());
    if (kept->runs.empty() && kept->errors.empty() && withdrawn->empty())
        return fail(folder, "holds no runs", "name the folder that --results was given");
    const Result<std::string> index = write_pages({.folder = folder, .index = page, .language = language});
    if (!index) return std::unexpected(index.error());
    std::printf("%zu %s: %s\n", kept->runs.size(), kept->runs.size() == 1 ? "run" : "runs", index->c_str());
    if (kept->errors.empty()) return {};
    for (std::size_t i = 1; i < kept->errors.size(); ++i)
        std::fprintf(stderr, "burin: left out: %s\n", kept->errors[i].line().c_str());
    return std::unexpected(kept->errors.front());
}

}  // namespace burin::app
