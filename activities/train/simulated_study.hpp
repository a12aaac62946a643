// SPDX-License-Identifier: MIT
// Takes simulated learners through a study, several at a time: each thread takes one person through all stages, in
// order, and then the next that nobody has taken.
//
// The random numbers of a stage depend on the study's seed, the person and the stage alone. So what is measured and
// every recorded tick are the same bits on any number of threads, and a run that was interrupted goes on as it would
// have done. The order of lines in the journal and the places of blocks in a recording are not.
// Time is simulated: each person has a clock, on which the delays between days are drawn within the protocol's bounds.
#pragma once

#include <functional>
#include <string>

#include "base/error.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::activities {

struct SimulationOptions {
    double effect = 0.0;        // study::LearnerPopulation
    unsigned threads = 0;       // 0: one for each core
    bool records = true;        // the motion of stages that the protocol has recorded
    bool resumes_late = false;  // as VisitLeave; the journal names the deviation
    // Facts for each recording: program, version, compiler, settings.
    std::vector<std::pair<std::string, std::string>> provenance = {};
    std::function<void(const std::string& line)> tell;  // one person has gone through; null: nobody is told
};

struct SimulationFigures {
    std::size_t stages = 0;
    std::uint64_t ticks = 0;  // with a world
    double simulated_s = 0.0;
};

// Enrols learners until all places are taken, and takes all through what they have not ended yet. The folder must be
// open for writing.
[[nodiscard]] Result<SimulationFigures> run_simulated(study::StudyFolder& study, const SimulationOptions& options);

}  // namespace burin::activities
