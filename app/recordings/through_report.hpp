// SPDX-License-Identifier: MIT
// burin replay FILE --through WORLD: what the motion was felt with, and what was felt, as text and JSON
// (activities/replay/through_table.hpp).
#pragma once

#include <optional>
#include <string>

#include "activities/world/opened_world.hpp"
#include "base/error.hpp"
#include "record/record_reader.hpp"
#include "record/row_walk.hpp"

namespace burin::app {

struct ThroughReplay {
    std::string file, world;
    std::optional<double> radius_m;  // of the balls that touch; none: as recorded
    activities::MaterialOverride materials;
    record::TickRange range;
    std::string json;  // a file for the figures, "-" for standard output; empty: none
};
[[nodiscard]] Result<void> replay_through(const ThroughReplay& options);

}  // namespace burin::app
