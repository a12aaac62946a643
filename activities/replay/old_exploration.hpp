// SPDX-License-Identifier: MIT
// Does an exploration again that was recorded before explorations were sessions: along a stroke, with a stylus
// ("world") or with a wand ("wand stroke"). Recordings of today are replayed as every session is.
//
// Data flow: device samples and mapping from the recording's columns (record/motion.hpp) -> the haptic loop of a
// session with the recorded settings, by repeat() -> scene's service, updated after the ticks that lines "update TICK"
// name, or where there are none, after the tick before the one that first saw the update's surface. Nothing is
// simulated. Every tick must be the recorded one, bit for bit, given the same world, settings and build.
// Failure: a recording without what is needed, ticks missing or damaged, an update that fails. Memory: one block, and
// 16 bytes for each update. One thread.
#pragma once

#include <string>

#include "activities/wand/wand_stroke.hpp"
#include "activities/world/exploration_settings.hpp"
#include "activities/world/explored_world.hpp"
#include "record/compare.hpp"

namespace burin::activities {

// Returns whether a recording is of that kind, by its fact "activity".
[[nodiscard]] bool is_old_exploration(const std::string& activity);

// Returns the radius of the balls that touched.
[[nodiscard]] Result<double> radius_of_old_exploration(const record::RecordReader& reader);

// Compares the ticks in the range; all before them are done again too, since each tick depends on the one before. In a
// difference the first value is the recorded one.
[[nodiscard]] Result<record::Comparison> repeat_exploration(record::RecordReader& reader, const ExploredWorld& world,
                                                            const record::TickRange& range);

// Opens the recording's world and compares likewise. `given`: where the world is now; empty: where it was. Fails where
// it is another world than was recorded.
[[nodiscard]] Result<record::Comparison> replay_old_exploration(record::RecordReader& reader, const std::string& given,
                                                                const record::TickRange& range);

}  // namespace burin::activities
