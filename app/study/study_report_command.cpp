// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "app/study/study_command.hpp"
#include "app/study/study_trials.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/folder/study_access.hpp"
#include "study/report/study_sections.hpp"

namespace burin::app {

namespace fs = std::filesystem;

Result<void> study_report(const std::string& folder) {
    BURIN_TRY(made, make_trials(folder));
    const fs::path reports = fs::path(folder) / "reports";
    std::error_code error;
    fs::create_directory(reports, error);
    if (error) {
        BURIN_TRY_DO(study::check_may_write_results(folder));
        return fail(reports.string(), "cannot be made: " + error.message(), "see to its permissions");
    }
    BURIN_TRY_DO(study::check_may_write_results(reports));
    fs::path report;
    for (std::size_t n = 1; report.empty() || fs::exists(report, error); ++n) report = reports / formatted("%03zu", n);
    StudyAnalyseOptions options;
    options.data = (fs::path(folder) / "trials.csv").string();
    options.out = report.string();
    options.facts = made.facts;
    options.groups = made.groups;
    if (!made.simulated.empty()) options.notes.push_back(made.simulated);
    BURIN_TRY(study, study::StudyFolder::open(folder, study::StudyAccess::read));
    options.sections = study::report_sections(study);
    options.title = study.protocol().title.empty() ? study.protocol().name : study.protocol().title;
    for (const std::string& fact : made.facts) std::printf("%s\n", fact.c_str());
    std::printf("\n");
    BURIN_TRY_DO(study_analyse(options));
    std::printf("\n%s\n", (report / "report.html").c_str());
    return {};
}

namespace {

CommandAction add_study_report(Command command) {
    const auto study = std::make_shared<std::string>();
    command.option("STUDY", *study, kStudyHelp).required();
    return action([study] { return study_report(*study); });
}

}  // namespace

CommandRow study_report_row() {
    return {"report", "A new folder in reports/ with report.html, results.json and tables", add_study_report};
}

}  // namespace burin::app
