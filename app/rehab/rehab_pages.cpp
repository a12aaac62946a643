// SPDX-License-Identifier: MIT
#include "app/rehab/rehab_pages.hpp"

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <system_error>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/progress/patient_page.hpp"
#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::app {
namespace {

namespace fs = std::filesystem;
using activities::KeptRun;
using activities::PageTexts;

constexpr const char* kPagesProgram = "Burin " BURIN_VERSION;
constexpr std::size_t kMostComment = 500;

std::string page_of_participant(unsigned participant) {
    return formatted("participant-%03u/progress.html", participant);
}

std::string date_today() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    char text[32];
    if (::localtime_r(&now, &local) == nullptr) return "";
    return {text, std::strftime(text, sizeof text, "%Y-%m-%d", &local)};
}

Result<void> write_of_participant(const fs::path& folder, const std::vector<const KeptRun*>& runs,
                                  const std::string& language) {
    BURIN_TRY(texts, PageTexts::in(language.empty() ? activities::language_of(runs) : language));
    const fs::path page = folder / page_of_participant(runs.front()->participant);
    const std::string html = activities::patient_page(runs, activities::levels_of, texts, kPagesProgram);
    BURIN_TRY_DO(activities::write_private(page, html));
    return activities::write_private(fs::path(page).replace_extension(".csv"), activities::patient_table(runs));
}

}  // namespace

void add_remark_options(Command command, RunRemarks& remarks) {
    command.option("--language", remarks.language,
                   "Of the participant's page: " + PageTexts::listed() + "; as before if not given, else English");
    command.option("--comment", remarks.comment, "On this run, for its page; it names nobody");
}

Result<void> check_remarks(const RunRemarks& remarks, bool kept) {
    if (!kept && !(remarks.language.empty() && remarks.comment.empty()))
        return fail(remarks.language.empty() ? "--comment" : "--language", "is of nothing that is kept",
                    "name a folder with --results");
    if (remarks.comment.size() > kMostComment)
        return fail("--comment", formatted("has %zu letters", remarks.comment.size()),
                    formatted("write %zu at most", kMostComment));
    if (remarks.language.empty()) return {};
    const Result<PageTexts> texts = PageTexts::in(remarks.language);
    return texts ? Result<void>{} : std::unexpected(texts.error());
}

Json json_of(const RunRemarks& remarks) {
    Json json = {{"side", "right"}};  // the one that is drawn
    if (!remarks.language.empty()) json["language"] = remarks.language;
    if (!remarks.comment.empty()) json["comment"] = remarks.comment;
    return json;
}

Result<void> check_stays(const std::string& folder, unsigned participant) {
    BURIN_TRY(withdrawn, activities::read_withdrawals(folder));
    if (!activities::has_withdrawn(withdrawn, participant)) return {};
    return fail(formatted("--participant %u", participant), "has withdrawn from " + folder,
                "give the number of somebody who takes part; a number is given to nobody else");
}

Result<std::string> write_pages(const PagesToWrite& pages) {
    BURIN_TRY(kept, activities::read_runs(pages.folder));
    BURIN_TRY(withdrawn, activities::read_withdrawals(pages.folder));
    std::map<unsigned, std::vector<const KeptRun*>> people;
    for (const KeptRun& run : kept.runs)
        if (!activities::has_withdrawn(withdrawn, run.participant) &&
            pages.participant.value_or(run.participant) == run.participant)
            people[run.participant].push_back(&run);
    for (const auto& [participant, runs] : people)
        BURIN_TRY_DO(write_of_participant(pages.folder, runs, pages.language));
    const std::string index = pages.index.empty() ? (fs::path(pages.folder) / "report.html").string() : pages.index;
    const std::string html = activities::index_page(kept, withdrawn, kPagesProgram, page_of_participant);
    BURIN_TRY_DO(activities::write_private(index, html));
    return index;
}

Result<void> rehab_withdraw(const RehabWithdrawOptions& options) {
    std::error_code error;
    if (options.folder.empty() || !fs::is_directory(options.folder, error))
        return fail(options.folder, "is no folder of results", "name the folder that --results was given");
    if (options.participant < 1 || options.participant > KeptRun::kMostParticipants)
        return fail("--participant", formatted("is %u", options.participant), "give a number from 1 to 999");
    const auto done = activities::withdraw(options.folder, options.participant, date_today(), options.erase);
    if (!done) return done;
    std::printf("participant %u: withdrawn%s\n", options.participant,
                options.erase ? ", all runs erased; that this number has withdrawn stays" : "; the runs stay");
    const Result<std::string> index = write_pages({.folder = options.folder, .index = {}, .language = {}});
    if (!index) return std::unexpected(index.error());
    std::printf("pages: %s\n", index->c_str());
    return {};
}

}  // namespace burin::app
