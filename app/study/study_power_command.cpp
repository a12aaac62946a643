// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include "app/cli/output_files.hpp"
#include "app/study/study_command.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/report/power_report.hpp"

namespace burin::app {
namespace {

// The study simulated where there is no effect, so that no number of participants reaches a target: a small study, a
// thousand times.
constexpr unsigned kNullParticipants = 10;
constexpr std::size_t kNullStudies = 1000, kStudies = 10'000;

Result<void> show_power(const StudyPowerOptions& options, const study::PowerOptions& simulated,
                        const study::Power& power) {
    if (options.json != kStandardOutput) std::fputs(study::power_text(simulated, power).c_str(), stdout);
    return write_output(options.json, json_text(study::power_json(simulated, power)));
}

}  // namespace

Result<void> study_power(const StudyPowerOptions& options) {
    BURIN_TRY_DO(check_place(options.json));
    if (options.participants && options.target)
        return fail("--target", "cannot be asked for together with --participants", "give one of the two");
    const bool null = options.effect == 0.0;
    study::PowerOptions simulated{.effect = options.effect,
                                  .first = 0,
                                  .second = 0,
                                  .alpha = options.alpha,
                                  .studies = options.studies.value_or(null ? kNullStudies : kStudies),
                                  .seed = options.seed,
                                  .threads = options.threads};
    if (options.participants || (null && !options.target)) {
        const unsigned participants = options.participants.value_or(kNullParticipants);
        simulated.first = participants - participants / 2;
        simulated.second = participants / 2;
        return show_power(options, simulated, study::simulate_power(simulated));
    }
    const double target = options.target.value_or(0.8);
    const auto sizes = study::sizes_for_power(simulated, target);
    if (!sizes) {
        return fail("--effect",
                    formatted("of %g does not reach a power of %g with %zu participants", options.effect, target,
                              2 * study::kMostPerGroup),
                    "ask for a larger effect, a lower --target or a larger --alpha");
    }
    simulated.first = simulated.second = sizes->per_group;
    return show_power(options, simulated, sizes->power);
}

namespace {

CommandAction add_study_power(Command command) {
    const auto options = std::make_shared<StudyPowerOptions>();
    command
        .option("--effect", options->effect, "Difference of the groups in standard deviations of a participant's value")
        .within(-100.0, 100.0)
        .required();
    command.option("--participants", options->participants, "Of both groups together: print their power")
        .within(std::uint64_t{2}, std::uint64_t{4000});
    command.option("--target", options->target, "Print the fewest participants that reach this power (0.8)")
        .within(0.01, 0.9999);
    command.option("--alpha", options->alpha, "Significance level").within(1e-6, 0.5).show_default();
    command.option("--studies", options->studies, "How many are simulated (10000; 1000 without an effect)")
        .within(std::uint64_t{100}, std::uint64_t{10'000'000});
    command.option("--seed", options->seed, "Of the simulation").show_default();
    command.option("--threads", options->threads, "How many threads work; 0: one per core; the result is the same")
        .within(0, 1024);
    command.option("--json", options->json, "A file for the result; - for standard output");
    return action([options] { return study_power(*options); });
}

}  // namespace

CommandRow study_power_row() {
    return {"power", "How many participants a study needs, by simulation", add_study_power};
}

}  // namespace burin::app
