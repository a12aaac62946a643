// SPDX-License-Identifier: MIT
// A simulated hand leads a simulated wand through a scene of meshes, which both ends, or any points of it, touch.
//
// Data flow: hand -> wand -> haptic loop (at the wand's rate) -> ring of stroke samples -> the scene's service (100
// Hz), which takes objects along their paths and publishes what is near -> haptic loop. In simulated time, on the
// caller's thread: every run gives the same bits. Frames: the script's is the device's; figures are in the scene's axes
// where a name says so.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "devices/haptic/simulated_wand.hpp"
#include "scene/mesh_part.hpp"

namespace burin::activities {

struct WandOptions {
    devices::WandDescription wand;
    std::vector<devices::WandPoint> points;  // those that touch, in the handle's axes; 1 to haptics::kMostProbePoints
    double radius_m = 0.004;                 // of the ball at each, in the scene
    Similarity scene_from_device;
    devices::HandGrip grip;
    std::string record = {};                                      // a new session file for every tick; empty: none
    std::vector<std::pair<std::string, std::string>> facts = {};  // for it
};

// Takes a script from the scene into the device's frame.
[[nodiscard]] std::vector<devices::HandPose> script_in_device(std::vector<devices::HandPose> script,
                                                              const Similarity& scene_from_device);

// Called with each tick, and at each update of the scene with the last one, whose number is 0 before the first.
using OnWandTick = std::function<void(double time_s, const haptics::TickRecord& tick)>;
using OnWandUpdate = std::function<Result<void>(double time_s, const haptics::TickRecord& last)>;

struct WandRun {
    std::uint64_t ticks = 0, surfaces_published = 0, trips = 0;
    double period_s = 0.001;
    devices::WandSaturation saturation;
};

// Leads the wand along the script, to its last pose. Fails on a script that is none, and when an update, what is called
// at one, or the recording does.
[[nodiscard]] Result<WandRun> run_wand(scene::MeshPart& part, const scene::MaterialTable& materials,
                                       std::vector<devices::HandPose> script, const WandOptions& options,
                                       const OnWandTick& on_tick, const OnWandUpdate& on_update);

}  // namespace burin::activities
