// SPDX-License-Identifier: MIT
#include <unistd.h>
#include <memory>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <vector>

#include "app/cli/output_files.hpp"
#include "app/study/study_command.hpp"
#include "app/study/study_trials.hpp"
#include "base/file_io.hpp"
#include "base/places.hpp"
#include "base/try.hpp"
#include "study/analysis/analysis.hpp"
#include "study/folder/study_folder.hpp"
#include "study/published/published.hpp"
#include "study/report/analysis_tables.hpp"
#include "study/report/analysis_text.hpp"
#include "study/report/html_report.hpp"
#include "study/report/published_text.hpp"
#include "study/table/trial_table.hpp"

namespace burin::app {
namespace {

namespace fs = std::filesystem;

// Prints every fault of a file; fails where there is one.
Result<void> list_faults(const std::vector<study::TableFault>& faults, const std::string& file) {
    if (faults.empty()) return {};
    for (const study::TableFault& fault : faults) std::printf("%s\n", line_of(fault, file).c_str());
    std::fflush(stdout);
    return fail(file, std::to_string(faults.size()) + (faults.size() == 1 ? " fault" : " faults"),
                "correct what is listed and try again");
}

// Puts the table's groups into the protocol's order where there is one. Returns a sentence that says the order.
std::string order_groups(study::TrialTable& table, const std::vector<std::string>& wanted) {
    std::ranges::stable_sort(
        table.groups, {}, [&](const std::string& group) { return std::ranges::find(wanted, group) - wanted.begin(); });
    std::string names;
    for (const std::string& group : table.groups) names += (names.empty() ? "" : ", ") + group;
    return "Groups in the order of the " + std::string(wanted.empty() ? "table's rows" : "protocol") + ": " + names +
           "; signs are the first one's.";
}

// Adds to the notes what is to be said of a choice of trials.
Result<study::TrialTable> read_table(StudyAnalyseOptions& options) {
    const bool chosen = options.chosen.day || !options.chosen.stage.empty();
    Result<std::string> text;
    if (chosen) {
        BURIN_TRY(some, chosen_trials(options.study, options.chosen));
        text = some.table;
        if (!some.simulated.empty()) options.notes.push_back(some.simulated);
    } else {
        text = read_text_file(options.data, study::kMostTableBytes);
        if (!text) return std::unexpected(text.error());
    }
    study::ParsedTable parsed = study::parse_trials(*text);
    BURIN_TRY_DO(list_faults(parsed.faults, options.data));
    return std::move(parsed.table);
}

// Returns the printed figures to check: by the file that the user names, else by those that Burin knows.
Result<std::vector<study::PublishedComparison>> comparisons(const std::string& file, const study::TrialTable& table) {
    std::vector<study::PublishedComparison> found;
    if (!file.empty()) {
        BURIN_TRY(text, read_text_file(file, study::kMostTableBytes));
        const study::ParsedPublished parsed = study::parse_published(text);
        BURIN_TRY_DO(list_faults(parsed.faults, file));
        found.push_back(study::compare_published(parsed.study, table));
        return found;
    }
    for (const std::string_view text : study::known_published_texts()) {
        const study::ParsedPublished known = study::parse_published(text);
        if (study::is_data_of(table, known.study)) found.push_back(study::compare_published(known.study, table));
    }
    return found;
}

// Returns whether a file is one that a study consists of, whether it is there yet or not.
bool is_of_study(const fs::path& file, const std::string& study) {
    const auto folder = resolved_path(study), place = resolved_path(file);
    const fs::path name = folder && place ? place->lexically_relative(*folder) : fs::path();
    if (name.empty()) return false;
    if (*name.begin() == "data") return true;
    return std::ranges::find(study::kFilesOfStudy, name.string()) != study::kFilesOfStudy.end();
}

Result<void> check_json(const StudyAnalyseOptions& options) {
    BURIN_TRY_DO(check_places(std::array{options.json}, std::array{options.data, options.published}));
    if (options.study.empty() || options.json.empty() || options.json == kStandardOutput) return {};
    if (!is_of_study(options.json, options.study)) return {};
    return fail(options.json, "is a file of the study, and would be overwritten", "choose another place");
}

Result<void> check_new_folder(const std::string& folder) {
    if (folder.empty()) return {};
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(folder, ignored)))
        return fail(folder, "exists already", "name a folder that does not, so that nothing is overwritten");
    return check_writable(folder);
}

// Everything goes into a folder beside the wanted one, which then takes its name.
Result<void> write_folder(const std::string& folder, const std::vector<study::NamedText>& files) {
    if (folder.empty()) return {};
    fs::path part = folder;
    part += "." + std::to_string(::getpid()) + ".part";
    std::error_code error;
    if (!fs::create_directory(part, error))
        return fail(part.string(), "cannot be made: " + error.message(), "choose another place");
    Result<void> written;
    for (const study::NamedText& file : files) {
        if (written) written = write_text((part / file.name).string(), file.text);
    }
    if (written) {
        fs::rename(part, folder, error);
        if (!error) return {};
        written = fail(folder, "cannot be made: " + error.message(), "choose another place");
    }
    fs::remove_all(part, error);
    return written;
}

}  // namespace

Result<void> study_analyse(const StudyAnalyseOptions& asked) {
    StudyAnalyseOptions options = asked;
    if (options.data.empty() == options.study.empty())
        return fail("analyse", "needs a study's folder or --data, and not both", "give one of them");
    const bool chosen = options.chosen.day || !options.chosen.stage.empty();
    if (chosen && options.study.empty())
        return fail("--day, --stage", "choose among a study's trials, and --data is one table",
                    "name the study's folder, or leave out rows of the table");
    if (!options.study.empty()) {
        options.data = (fs::path(options.study) / "trials.csv").string();
    }
    BURIN_TRY_DO(check_json(options));
    if (!options.study.empty()) {
        BURIN_TRY(made, make_trials(options.study));
        options.groups = made.groups;
        if (!chosen && !made.simulated.empty()) options.notes.push_back(made.simulated);
        if (!chosen && !made.pooled.empty()) options.notes.push_back(made.pooled);
    }
    std::string out = options.out;
    while (out.size() > 1 && out.ends_with('/')) out.pop_back();
    BURIN_TRY_DO(check_new_folder(out));
    BURIN_TRY(table, read_table(options));
    BURIN_TRY(published, comparisons(options.published, table));

    const std::string order = order_groups(table, options.groups);
    study::Analysis analysis = study::analyse(std::move(table), options.seed);
    if (analysis.table.groups.size() > 1) options.notes.push_back(order);
    analysis.notes.insert(analysis.notes.begin(), options.notes.begin(), options.notes.end());
    Json json = study::analysis_json(analysis);
    for (const study::PublishedComparison& one : published) json["published"].push_back(study::published_json(one));
    if (options.json != kStandardOutput) {
        std::fputs(study::analysis_text(analysis).c_str(), stdout);
        for (const study::PublishedComparison& one : published) std::printf("\n%s", study::published_text(one).c_str());
    }
    if (!out.empty()) {
        std::vector<study::NamedText> files = study::analysis_tables(analysis);
        files.push_back({"results.json", json_text(json)});
        files.push_back({"report.html", study::html_report(analysis, published,
                                                           {.data = fs::path(options.data).filename().string(),
                                                            .program = std::string("Burin ") + BURIN_VERSION,
                                                            .facts = options.facts,
                                                            .sections = options.sections,
                                                            .title = options.title})});
        BURIN_TRY_DO(write_folder(out, files));
    }
    return write_output(options.json, json_text(json));
}

namespace {

CommandAction add_study_analyse(Command command) {
    const auto options = std::make_shared<StudyAnalyseOptions>();
    command.option("STUDY", options->study, "The study's folder, instead of --data");
    command.option("--data", options->data,
                   "CSV with participant, group, trial, deviation, time_s; see docs/formats.md");
    command.option("--day", options->chosen.day,
                   "With STUDY: trials of this day alone, such as a later one's (retention)");
    command.option("--stage", options->chosen.stage, "With STUDY: trials of this stage alone, such as another path's");
    command.option("--published", options->published,
                   "CSV of figures that were published of these data, to be checked");
    command.option("--json", options->json, "A file for every figure; - for standard output");
    command.option("--out", options->out, "A new folder for report.html, results.json and tables as CSV");
    command.option("--seed", options->seed, "Of random permutations, where there are too many to count all")
        .show_default();
    return action([options] { return study_analyse(*options); });
}

}  // namespace

CommandRow study_analyse_row() {
    return {"analyse", "Correlations, comparisons and effect sizes of a table of trials", add_study_analyse};
}

}  // namespace burin::app
