// SPDX-License-Identifier: MIT
// Does a recorded exploration again.
//
// Data flow: device samples and mapping from the recording's columns (record/motion.hpp) -> haptic loop, by repeat()
// -> scene's service, updated after the ticks that the recording's lines name -> haptic loop. Nothing is simulated: the
// hand was pushed when it was recorded, and is not now. Every tick must be the recorded one, bit for bit, given the
// same world, settings and build. activities/world/felt_through.hpp feels the motion in another world.
// Failure: a recording without what is needed, ticks missing or damaged, an update that fails. Memory: one block, and
// 16 bytes for each update. One thread.
#pragma once

#include <string>

#include "activities/world/exploration_settings.hpp"
#include "record/compare.hpp"
#include "scene/mesh_part.hpp"

namespace burin::activities {

// Returns the settings of a recorded exploration. Fails on a recording of anything else.
[[nodiscard]] Result<ExplorationSettings> recorded_settings(const record::RecordReader& reader);

// Compares the ticks in the range; all before them are done again too, since each tick depends on the one before. In a
// difference the first value is the recorded one.
[[nodiscard]] Result<record::Comparison> repeat_world(record::RecordReader& reader, scene::MeshPart& part,
                                                      const scene::MaterialTable& materials,
                                                      const record::TickRange& range);

// Opens the recording's world and compares likewise. `given`: where the world is now; empty: where it was. Fails where
// it is another world than was recorded.
[[nodiscard]] Result<record::Comparison> replay_world(record::RecordReader& reader, const std::string& given,
                                                      const record::TickRange& range);

}  // namespace burin::activities
