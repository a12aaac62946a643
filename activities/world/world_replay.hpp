// SPDX-License-Identifier: MIT
// Does a recorded exploration again, and feels a recorded motion in another world.
//
// Data flow: device samples and mapping from the recording's columns (record/motion.hpp) -> haptic loop, by repeat()
// -> scene's service -> haptic loop. Nothing is simulated: the hand was pushed when it was recorded, and is not now.
//   repeat_world()  updates the scene after the ticks that the recording's lines name, with the recorded settings;
//                   every tick must then be the recorded one, bit for bit, given the same world and the same build
//   feel_through()  updates it every 10 ms, in whatever world; computes proxies, forces and how far both are from the
//                   recorded ones. The same recording, world and build give the same bits.
// A proxy begins at the hand in the first tick. One that begins outside a surface never touches it from inside.
// Failure: a recording without what is needed, ticks missing or damaged, an update that fails. Memory: one block, and
// 16 bytes for each update. One thread.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "activities/world/world_settings.hpp"
#include "record/compare.hpp"
#include "record/motion.hpp"
#include "scene/mesh_part.hpp"

namespace burin::activities {

// Compares the ticks in the range; all before them are done again too, since each tick depends on the one before. In a
// difference the first value is the recorded one.
[[nodiscard]] Result<record::Comparison> repeat_world(record::RecordReader& reader, scene::MeshPart& part,
                                                      const scene::MaterialTable& materials,
                                                      const record::TickRange& range);

struct ThroughFigures {
    std::uint64_t ticks = 0, ticks_in_contact = 0, ticks_pushed_out = 0;
    std::int64_t first_tick = 0;
    Vec3 begins_scene_m{0.0};                        // where the proxy begins
    std::string nearest;                             // object there; empty: there is none
    double nearest_m = 0.0;                          // how far its surface is from the ball that touches
    bool begins_inside = false;                      // in material, and is moved out by the shortest path
    std::optional<std::int64_t> first_contact_tick = {};  // none: nothing was touched
    std::string first_contact;                       // the object
    double force_max_N = 0.0, force_deviation_max_N = 0.0, proxy_deviation_max_m = 0.0;
};

// The columns of the derived table: tick, time, proxy, force, penetration, triangle and object of the point, desired
// and commanded force, flags, cause, and the deviations from the recorded proxy and commanded force.
[[nodiscard]] std::vector<record::Column> through_columns();

using TakeRow = std::function<Result<void>(const record::RecordedTick& tick, const std::vector<record::Word>& row)>;

// Feels the motion of a hand of the recording with a ball of the settings' radius; the mapping is the recorded one, in
// each tick. Rows are handed on in the order of the ticks in the range.
[[nodiscard]] Result<ThroughFigures> feel_through(record::RecordReader& reader, scene::MeshPart& part,
                                                  std::span<const scene::ObjectId> ids,
                                                  const scene::MaterialTable& materials, double tool_radius_m,
                                                  const record::TickRange& range, const TakeRow& take);

}  // namespace burin::activities
