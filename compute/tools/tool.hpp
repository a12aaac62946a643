// SPDX-License-Identifier: MIT
// Tools and what they do along a motion.
//
// Tool frame: metres, axis +Y; the tool's tip is at the origin and its body lies above it (y from 0 to the length),
// except that a ball, a box and a mesh keep their own origin (the ball's and the box's centre, the mesh file's origin).
#pragma once

#include <cstdint>
#include <memory>
#include <variant>

#include "base/space.hpp"
#include "compute/rays/operation.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::compute {

struct MeshToolEdges;

struct BallTool {
    double radius_m = 0.0;
};
struct CylinderTool {  // flat end mill
    double radius_m = 0.0, length_m = 0.0;
};
struct ConeTool {  // frustum; either radius may be zero
    double tip_radius_m = 0.0, top_radius_m = 0.0, length_m = 0.0;
};
struct BullNoseTool {  // cylinder whose lower rim is rounded; corner radius up to the radius
    double radius_m = 0.0, corner_radius_m = 0.0, length_m = 0.0;
};
struct BoxTool {
    Vec3 half_size_m{0.0};
};
struct MeshTool {  // closed, turned outwards
    std::shared_ptr<const geometry::TriangleMesh> mesh;
    // What prepare_mesh_tool (mesh_tool.hpp) found out about it; without, it is found out at every sweep.
    std::shared_ptr<const MeshToolEdges> edges = nullptr;
};
using ToolShape = std::variant<BallTool, CylinderTool, ConeTool, BullNoseTool, BoxTool, MeshTool>;

// A tool that moves from one pose to another, turning evenly about one axis on the way; equal poses are a stamp.
struct ToolSweep {
    ToolShape shape;
    Pose start, end;  // object_from_tool
    Operation operation = Operation::cut;
    std::uint8_t material = 0;     // what the cut, filled or painted surface is made of: an index into Solid::materials
    double tolerance_cells = 0.1;  // largest error of the swept surface where there is no closed form, in lattice cells
    double smooth_strength = 0.5;  // 0 to 1, for Operation::smooth
};

}  // namespace burin::compute
