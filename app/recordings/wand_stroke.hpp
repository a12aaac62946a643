// SPDX-License-Identifier: MIT
// A stroke that explores a world by touch, and what its recording keeps of it so that it can be done again with a wand.
// One thread. Every Error names a file or an option and the remedy.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "activities/wand/felt_wand.hpp"
#include "base/error.hpp"
#include "record/compare.hpp"
#include "scene/mesh_part.hpp"

namespace burin::app {

struct WorldExploration {
    std::string world;                 // a world.toml or a .wrl (docs/formats.md)
    std::string stroke;                // a CSV file; its button has no meaning here
    double radius_m = 0.004;           // of the ball that touches
    std::string pictures;              // a folder; empty: none
    std::string report;                // a JSON file; empty: none
    std::string record;                // a new session file; empty: none
    std::string device = "simulated";  // or a wand (app/world/world_wand.hpp)
    std::string points;                // of a wand, that touch; empty: devices::usual_points()
};

// All that a stroke with a wand is felt with.
struct WandWorld {
    activities::WandOptions feel;
    sculpt::Stroke stroke;
    std::vector<scene::ObjectId> ids;
    scene::MaterialTable materials;
    std::unique_ptr<scene::MeshPart> part;
    std::string digest;
};

// Fails with all problems of the world printed, when it has some, and where the device has no handle with points.
[[nodiscard]] Result<std::unique_ptr<WandWorld>> open_wand_world(const WorldExploration& options);

// Returns what a recording of the stroke says of the program and of what was explored.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> facts_of_wand(const WorldExploration& options,
                                                                             const WandWorld& opened);

// The fact "activity" of a recording of such a stroke.
inline constexpr const char* kWandActivity = "wand stroke";

// Reads what was explored how from the settings of such a recording. Fails where they are unsound.
[[nodiscard]] Result<WorldExploration> recorded_wand_stroke(const record::RecordReader& reader);

// Leads the wand again as a recording's settings say, and compares the ticks in the range. In a difference the first
// value is the recorded one. Where the world or the stroke is another one than was recorded, says so on standard error
// and goes on; another wand is refused. world, stroke: where the files are now; empty: where they were.
[[nodiscard]] Result<record::Comparison> replay_wand(record::RecordReader& reader, const std::string& world,
                                                     const std::string& stroke, const record::TickRange& range);

}  // namespace burin::app
