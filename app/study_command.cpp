// SPDX-License-Identifier: MIT
#include "app/study_command.hpp"

#include <cstdio>
#include <string>

#include "app/output_files.hpp"
#include "study/analysis/analysis.hpp"
#include "study/report/analysis_text.hpp"
#include "study/table/trial_table.hpp"

namespace burin::app {

struct StudyCommand::Options {
    std::string data;
    std::uint64_t seed = 1;

    [[nodiscard]] Result<void> analyse() const;
};

Result<void> StudyCommand::Options::analyse() const {
    const auto parsed = study::read_trials(data);
    if (!parsed) return std::unexpected(parsed.error());
    for (const study::TableFault& fault : parsed->faults) std::printf("%s\n", line_of(fault, data).c_str());
    if (const std::size_t faults = parsed->faults.size(); faults > 0) {
        std::fflush(stdout);
        return fail(data, std::to_string(faults) + (faults == 1 ? " fault" : " faults"), "correct them and try again");
    }
    std::fputs(study::analysis_text(study::analyse(parsed->table, seed)).c_str(), stdout);
    return {};
}

StudyCommand::StudyCommand(Command app)
    : options_(std::make_unique<Options>()), command_(app.subcommand("study", "The figures of a study")) {
    command_.require_subcommand();
    Options& o = *options_;
    analyse_ = command_.subcommand("analyse", "Correlations, comparisons and effect sizes of a table of trials");
    analyse_.option("--data", o.data, "CSV with participant, group, trial, deviation, time_s; see docs/formats.md")
        .required();
    analyse_.option("--seed", o.seed, "Of random permutations, where there are too many to count all").show_default();
}

StudyCommand::~StudyCommand() = default;

bool StudyCommand::parsed() const { return command_.parsed(); }

Result<void> StudyCommand::run() const { return options_->analyse(); }

}  // namespace burin::app
