// SPDX-License-Identifier: MIT
// A participant's visit in simulated time, without a person and a window: a script says what the operator says and
// where the hand means to be. It is the session of a live visit with the script as its hand, which nobody sees, so that
// a study's whole thread can be tried and tested. What is said acts with the next frame's first tick.
//
// The script, a line each, '#' begins a remark; times in seconds, rising:
//   burin-study-input 1
//   TIME start | next | pause | go on | stop | repeat | note TEXT
//   TIME hand X Y Z [QX QY QZ QW]     the wand's middle, metres, in the maker's frame (study/felt/stage_touch.hpp)
// A word that has no effect where it comes is told and counted. The hand moves straight and evenly between its places.
// After the last line the visit ends; a stage that is under way then is interrupted, as by a power cut, and is to be
// done again. One thread.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "activities/train/stage_on_disk.hpp"
#include "activities/train/training_run.hpp"
#include "devices/hand/simulated_hand.hpp"

namespace burin::activities {

struct VisitScript {
    struct Said {
        double time_s = 0.0;
        OperatorCommand command;
        std::string where{}, text{};  // "FILE:LINE", and what stands there
    };
    std::vector<Said> said;
    std::vector<devices::HandPose> hand;  // in the wand's scene frame; at least one
    double end_s = 0.0;
};
// Fails at the first line that is none, with its number and what may stand there.
[[nodiscard]] Result<VisitScript> parse_visit_script(const std::string& text, const std::string& name);

struct VisitOptions {
    bool records = true;  // the motion of stages that the protocol has recorded
    VisitLeave leave;
    Provenance provenance = {};
    std::function<Result<void>(double time_s, const TrainingShown& shown, const TrainingRun& run)> on_frame;
    // A whole line of each stage that has ended, and of each word that had no effect, with its line of the script.
    std::function<void(double time_s, const std::string& line)> tell;
};

struct VisitFigures {
    std::size_t stages = 0;  // ended
    std::uint64_t ticks = 0;
    double simulated_s = 0.0;
    bool interrupted = false;        // within a stage
    std::size_t without_effect = 0;  // words of the script
    std::size_t left = 0;            // stages of the day that are still to be done
};

// The folder must be open for writing.
[[nodiscard]] Result<VisitFigures> run_scripted_visit(study::StudyFolder& study, const std::string& participant,
                                                      const VisitScript& script, const VisitOptions& options);

}  // namespace burin::activities
