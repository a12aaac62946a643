// SPDX-License-Identifier: MIT
// The tools with which a carving hand (bench/haptics/carving_hand.hpp) carves. Frame: tool, metres.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compute/tools/tool.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

// A bar of six sides about +Y, from the origin up.
[[nodiscard]] std::shared_ptr<const geometry::TriangleMesh> six_sided_bar(double radius_m, double length_m);

struct CarvingTool {
    std::string name;
    compute::ToolShape shape;
};

// The tools of the panel, each about 3 mm wide, the ball first.
[[nodiscard]] std::vector<CarvingTool> carving_tools();

}  // namespace burin::bench
