// SPDX-License-Identifier: MIT
// Opens the session of an exploration, and runs it in simulated time. One thread.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "activities/world/exploration.hpp"
#include "activities/world/explored_world.hpp"
#include "base/clock.hpp"
#include "session/live/session.hpp"

namespace burin::activities {

// A session in which the hand of an activity explores a world, before its first tick. begins_ns: on its clock.
struct OpenedExploration {
    SimulatedClock clock;
    std::shared_ptr<Exploration> activity;
    std::unique_ptr<session::Session> session;

    // Runs it for so long. facts: of the program and the files, for a recording.
    [[nodiscard]] Result<void> run(double lasts_s, std::vector<std::pair<std::string, std::string>> facts);
};
[[nodiscard]] Result<std::unique_ptr<OpenedExploration>> open_exploration(const ExploredWorld& world,
                                                                          const ExplorationSettings& settings,
                                                                          session::BroughtHand hand, FeltBy felt_by,
                                                                          Nanoseconds begins_ns = 0);

}  // namespace burin::activities
