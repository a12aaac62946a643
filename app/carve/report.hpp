// SPDX-License-Identifier: MIT
// The figures of a session: as JSON for --report and as a short table for the terminal.
// All keys but those under "timing" and "machine" are the same whenever the same command runs.
#pragma once

#include <span>
#include <string>

#include "base/json.hpp"
#include "base/length_unit.hpp"

namespace burin::compute {
struct DeviceTraffic;  // compute/engine/engine.hpp
}  // namespace burin::compute
namespace burin::geometry {
struct TriangleMesh;  // geometry/mesh/triangle_mesh.hpp
}  // namespace burin::geometry
namespace burin::session {
struct FeltFigures;
}
namespace burin::sculpt {
class Sculpture;  // sculpt/sculpture.hpp
}  // namespace burin::sculpt

namespace burin::toolbox {
struct Feel;
}  // namespace burin::toolbox

namespace burin::app {

[[nodiscard]] Json describe_carving(const sculpt::Sculpture& carving);
// Counts what a mesh of numbers in the unit has; volume and area in metres.
[[nodiscard]] Json describe_mesh(const geometry::TriangleMesh& numbers, LengthUnit unit);
[[nodiscard]] Json describe_feel(const session::FeltFigures& felt, const toolbox::Feel& feel);
// Describes the submissions, waits and copies by which a device has carved.
[[nodiscard]] Json describe_traffic(const compute::DeviceTraffic& traffic);
// Wall-clock figures: these differ from run to run.
[[nodiscard]] Json describe_timing(const sculpt::Sculpture& carving, const session::FeltFigures* felt);

// The table of docs and demo, from a finished report.
void print_table(const Json& report);

}  // namespace burin::app
