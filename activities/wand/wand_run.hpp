// SPDX-License-Identifier: MIT
// A simulated hand leads a simulated wand through a world, which both ends, or any points of it, touch: a session that
// nobody sees (activities/world/exploration.hpp), in simulated time on the caller's thread, so that every run gives the
// same bits. Frames: the script's is the device's; figures are in the scene's axes where a name says so.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "activities/world/exploration_settings.hpp"
#include "activities/world/explored_world.hpp"
#include "devices/haptic/simulated_wand.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::session {
class DrawnWorld;  // session/objects/drawn_world.hpp
}  // namespace burin::session

namespace burin::activities {

struct WandOptions {
    devices::WandDescription wand;
    std::vector<devices::WandPoint> points;  // those that touch, in the handle's axes; 1 to haptics::kMostProbePoints
    double radius_m = 0.004;                 // of the ball at each, in the scene
    Similarity scene_from_device;
    devices::HandGrip grip;
    std::vector<std::pair<std::string, std::string>> facts = {};  // for a recording
};

// Returns what the ticks of the wand are told, whose hand begins there.
[[nodiscard]] ExplorationSettings settings_of(const WandOptions& options, const Pose& start_device);

// Takes a script from the scene into the device's frame.
[[nodiscard]] std::vector<devices::HandPose> script_in_device(std::vector<devices::HandPose> script,
                                                              const Similarity& scene_from_device);

// Called with each tick, and at each update of the scene with the last one, whose number is 0 before the first.
using OnWandTick = std::function<void(double time_s, const haptics::TickRecord& tick)>;
using OnWandUpdate =
    std::function<Result<void>(double time_s, const haptics::TickRecord& last, const session::DrawnWorld& drawn)>;

struct WandRun {
    std::uint64_t ticks = 0, surfaces_published = 0, trips = 0;
    double period_s = 0.001;
    devices::WandSaturation saturation;
};

// Leads the wand along the script, to its last pose. Fails on a script that is none, and when an update, what is called
// at one, or the recording does.
[[nodiscard]] Result<WandRun> run_wand(const ExploredWorld& world, std::vector<devices::HandPose> script,
                                       const WandOptions& options, const OnWandTick& on_tick,
                                       const OnWandUpdate& on_update);

}  // namespace burin::activities
