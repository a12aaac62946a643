// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdio>

#include "activities/train/simulated_study.hpp"
#include "app/study_command.hpp"
#include "app/study_pictures.hpp"
#include "app/study_trials.hpp"
#include "study/folder/interruption.hpp"

namespace burin::app {

Result<void> study_run(const StudyRunOptions& options) {
    if (!options.simulated)
        return fail("burin study run", "takes only simulated learners through a study so far", "add --simulated");
    if (options.pictures && options.without_motion)
        return fail("burin study run", "--pictures are drawn from the motion that --without-motion leaves out",
                    "give one of the two");
    auto study = study::StudyFolder::open(options.study, study::StudyAccess::write);
    if (!study) return std::unexpected(study.error());
    warn_of_journal(*study);
    if (!options.resume) {
        if (const auto ok = study::check_resumption(*study, study::now_utc_ns()); !ok) return ok;
    }
    std::printf("Simulated learners: no person and no device; hand and wand are simulated; effect %g SD.\n",
                options.effect);
    activities::SimulationOptions simulation;
    simulation.effect = options.effect;
    simulation.threads = options.threads;
    simulation.records = !options.without_motion;
    simulation.tell = [](const std::string& line) {
        std::printf("%s\n", line.c_str());
        std::fflush(stdout);
    };
    const auto begun = std::chrono::steady_clock::now();
    const auto went = activities::run_simulated(*study, simulation);
    if (!went) return std::unexpected(went.error());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    const auto made = make_trials(options.study);
    if (!made) return std::unexpected(made.error());
    std::printf("%zu stages, %.0f s of simulated time in %.1f s, %.0f times real time; %s/trials.csv: %zu trials\n",
                went->stages, went->simulated_s, took.count(), went->simulated_s / took.count(), options.study.c_str(),
                made->trials);
    return options.pictures ? draw_stages(*study) : Result<void>();
}

}  // namespace burin::app
