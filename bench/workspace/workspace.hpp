// SPDX-License-Identifier: MIT
// Measures reaching across a wall of metres with a device of centimetres, by each workspace technique: what the
// PowerWall paper describes in words, in numbers. A simulated hand (bench/workspace/workspace_hand.hpp) that uses each
// technique by its strategy (bench/workspace/workspace_strategy.hpp) takes the tool from target to target; every
// millisecond goes through step_workspace itself, with positions in the encoder's steps and the velocity as the tick
// estimates it.
//
// The task: targets lie anywhere on the wall, up to 50 mm before or behind its plane. A target is reached when the tool
// has been within 10 mm of it for 0.3 s while it can work (not paused); the time counts up to the beginning of that.
// Then the hand holds the tool as near to the target's middle as it can for a second; the last half of that gives the
// precision. A target that takes longer than 180 s (fixed: 5 s) is a failure, and the hand goes on to the next.
//
// For the assumptions and what they mean for the figures see assumptions(). The figures compare techniques for one
// simulated hand; they are no measurement of people. The same seed gives the same figures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "bench/workspace/workspace_hand.hpp"
#include "bench/workspace/workspace_strategy.hpp"

namespace burin::bench {

struct WorkspaceTask {
    int targets = 100;
    std::uint64_t seed = 1;
    Vec3 wall_m{3.048, 2.286, 0.1};  // extent of the targets: 0.1 m from the wall's sides, and anywhere in its depth
    double target_radius_m = 0.010;
    double dwell_s = 0.3, hold_s = 1.0, give_up_s = 180.0;
    double vision_s = 0.12;  // delay from the scene to the hand (100 to 150 ms)
    double finger_s = 0.1;   // to press or to release; a press takes 0.2 s
    HandModel hand;
};

// One target; time and precision are absent where it was not reached.
struct Reach {
    bool reached = false;
    double time_s = 0.0, distance_m = 0.0;  // of the tool from the target when it appeared
    double hand_path_m = 0.0, tool_path_m = 0.0;
    int presses = 0;
    double overshoot_m = 0.0;  // how far beyond the target on the straight line from the start, 0 if never
    double precision_m = 0.0;  // rms distance from the target's middle
};

struct WorkspaceFigures {
    Approach approach;
    std::vector<Reach> reaches;
};

// Returns the settings that an approach is measured with: 1:1, or for scaling the gain that covers the wall.
[[nodiscard]] haptics::WorkspaceSettings settings_of(const Approach& approach, const WorkspaceTask& task);

[[nodiscard]] WorkspaceFigures reach_targets(const Approach& approach, const WorkspaceTask& task);
// Measures targets of the caller's choice, in the object frame, whose origin is the wall's middle.
[[nodiscard]] WorkspaceFigures reach_targets(const Approach& approach, const WorkspaceTask& task,
                                             const std::vector<Vec3>& targets_object);

[[nodiscard]] std::string assumptions(const WorkspaceTask& task);
[[nodiscard]] std::string workspace_table(const std::vector<WorkspaceFigures>& figures);
[[nodiscard]] std::string workspace_csv(const std::vector<WorkspaceFigures>& figures);
[[nodiscard]] Json workspace_json(const std::vector<WorkspaceFigures>& figures, const WorkspaceTask& task);
[[nodiscard]] std::string workspace_svg(const std::vector<WorkspaceFigures>& figures, const WorkspaceTask& task);

}  // namespace burin::bench
