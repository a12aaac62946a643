// SPDX-License-Identifier: MIT
// Feels a recorded motion in a world, whatever it was recorded in: the hand goes where it went, and is not pushed.
//
// Data flow: device samples and mapping from the recording's columns (record/motion.hpp) -> haptic loop with the probe
// of the recorded device, by repeat() -> scene's service, updated every 10 ms -> haptic loop -> a row for each tick:
// proxies, forces, and how far both are from the recorded ones. The same recording, world and build give the same bits.
// The proxy of each point begins where the point is in the first tick. One that begins outside a surface never touches
// it from inside.
// Frames: positions of points are the scene's, forces and torques the device's. One thread. Memory: one block.
// Failure: a recording without what is needed or with damaged ticks, an update that fails, a row that is not taken.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "activities/world/repeated_hand.hpp"
#include "scene/mesh_part.hpp"

namespace burin::activities {

// The probe that is led through the world: the device as it was recorded, with a ball at each of its points.
struct ThroughProbe {
    DeviceAsRecorded device;
    double radius_m = 0.004;  // of the balls, in the scene
};

// Figures of what one point has felt.
struct ThroughPoint {
    std::string name;            // of a wand's point; empty: the tool's only one
    Vec3 begins_scene_m{0.0};    // where its proxy begins
    bool begins_inside = false;  // in material, and is moved out by the shortest path
    std::string nearest;         // object there; empty: there is none
    double nearest_m = 0.0;      // how far its surface is from the ball; below 0: they overlap by so much
    // The object whose surface the ball came nearest to before its first contact, and how near; looked at every 10 ms
    // where objects move.
    std::string came_nearest;
    double came_nearest_m = 0.0;
    std::uint64_t ticks_in_contact = 0;
    std::optional<std::int64_t> first_contact_tick = {};  // none: it touched nothing
    std::string first_contact;                            // the object
    double force_max_N = 0.0, proxy_deviation_max_m = 0.0;
};

struct ThroughFigures {
    std::uint64_t ticks = 0, ticks_in_contact = 0, ticks_pushed_out = 0;  // of any point
    std::int64_t first_tick = 0;
    std::vector<ThroughPoint> points;
    // Largest values of the commanded wrench; torques are 0 for a device that has none.
    double force_max_N = 0.0, force_deviation_max_N = 0.0;
    double torque_max_Nm = 0.0, torque_deviation_max_Nm = 0.0;
};

// The columns of the derived table: tick and time; proxy, force, penetration, triangle and object of each point;
// desired and commanded force, for a wand also torque; flags, cause; and the deviations: of each proxy from the
// recorded one, of the commanded force, for a wand also of the torque. What a tick does not have of a point is not a
// number, and so is a deviation from what the recorded tick did not have.
[[nodiscard]] std::vector<record::Column> through_columns(const DeviceAsRecorded& device = {});

using TakeRow = std::function<Result<void>(const record::RecordedTick& tick, const std::vector<record::Word>& row)>;

// Feels the motion of the recording's hand; the mapping is the recorded one, in each tick. Rows are handed on in the
// order of the ticks in the range.
[[nodiscard]] Result<ThroughFigures> feel_through(record::RecordReader& reader, const ExploredWorld& world,
                                                  const ThroughProbe& probe, const record::TickRange& range,
                                                  const TakeRow& take);

}  // namespace burin::activities
