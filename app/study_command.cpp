// SPDX-License-Identifier: MIT
#include "app/study_command.hpp"

namespace burin::app {

struct StudyCommand::Options {
    StudyAnalyseOptions analyse;
    StudyPowerOptions power;
};

StudyCommand::StudyCommand(Command app)
    : options_(std::make_unique<Options>()), command_(app.subcommand("study", "The figures of a study")) {
    command_.require_subcommand();
    StudyAnalyseOptions& a = options_->analyse;
    analyse_ = command_.subcommand("analyse", "Correlations, comparisons and effect sizes of a table of trials");
    analyse_.option("--data", a.data, "CSV with participant, group, trial, deviation, time_s; see docs/formats.md")
        .required();
    analyse_.option("--published", a.published, "CSV of figures that were published of these data, to be checked");
    analyse_.option("--json", a.json, "A file for every figure; - for standard output");
    analyse_.option("--out", a.out, "A new folder for report.html, results.json and tables as CSV");
    analyse_.option("--seed", a.seed, "Of random permutations, where there are too many to count all").show_default();

    StudyPowerOptions& p = options_->power;
    Command power = command_.subcommand("power", "How many participants a study needs, by simulation");
    power.option("--effect", p.effect, "Difference of the groups in standard deviations of a participant's value")
        .within(-100.0, 100.0)
        .required();
    power.option("--participants", p.participants, "Of both groups together: print their power")
        .within(std::uint64_t{2}, std::uint64_t{4000});
    power.option("--target", p.target, "Print the fewest participants that reach this power (0.8)")
        .within(0.01, 0.9999);
    power.option("--alpha", p.alpha, "Significance level").within(1e-6, 0.5).show_default();
    power.option("--studies", p.studies, "How many are simulated (10000; 1000 without an effect)")
        .within(std::uint64_t{100}, std::uint64_t{10'000'000});
    power.option("--seed", p.seed, "Of the simulation").show_default();
    power.option("--threads", p.threads, "How many threads work; 0: one per core; the result is the same")
        .within(0, 1024);
    power.option("--json", p.json, "A file for the result; - for standard output");
}

StudyCommand::~StudyCommand() = default;

bool StudyCommand::parsed() const { return command_.parsed(); }

Result<void> StudyCommand::run() const {
    return analyse_.parsed() ? study_analyse(options_->analyse) : study_power(options_->power);
}

}  // namespace burin::app
