// SPDX-License-Identifier: MIT
#include "bench/engines/random_work.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/try.hpp"
#include "compute/tools/mesh_tool.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {
namespace {

using compute::ToolShape;
using compute::ToolSweep;

// Says how often each kind comes, in hundredths; the last two are undo and redo.
constexpr std::array<int, kRandomKinds> kKindShares{30, 13, 13, 13, 13, 4, 3, 9, 2};
constexpr std::array<const char*, kRandomKinds> kKindNames{"ball", "cylinder",          "cone", "bullnose", "box",
                                                           "mesh", "ball that smooths", "undo", "redo"};
// Radii of tools up to this share of the longest side: a session's are smaller.
constexpr double kLargestTool = 0.12;
// A turn costs the processor a move for each step of it.
constexpr double kMostTurn_rad = 0.4;

// An octahedron, turned outwards, with another length to each side.
geometry::TriangleMesh octahedron_of(const std::array<double, 6>& lengths_m) {
    geometry::TriangleMesh mesh;
    mesh.positions_m = {{lengths_m[0], 0, 0},  {-lengths_m[1], 0, 0}, {0, lengths_m[2], 0},
                        {0, -lengths_m[3], 0}, {0, 0, lengths_m[4]},  {0, 0, -lengths_m[5]}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return mesh;
}

}  // namespace

std::string name_of(RandomKind kind) { return kKindNames.at(static_cast<std::size_t>(kind)); }

Result<compute::Solid> RandomWork::solid(int resolution) {
    const Vec3 size_m{1.0, between(0.3, 1.0), between(0.3, 1.0)};  // in braces: drawn from left to right
    BURIN_TRY(made, chance(0.3) ? compute::make_ball(0.5, resolution, {"ball", {200, 200, 200}})
                                : compute::make_block(size_m, resolution, {"block", {200, 200, 200}}));
    for (const char* name : {"cut", "filled", "painted"}) made.materials.push_back({name, {90, 60, 30}});
    return std::move(made);
}

Result<RandomStep> RandomWork::step(const compute::Lattice& lattice) {
    last_ = kind();
    RandomStep step{.kind = last_, .updates = {}, .ends_stroke = chance(0.3)};
    if (step.kind == RandomKind::undo || step.kind == RandomKind::redo) return step;
    for (int updates = chance(0.25) ? whole(2, 4) : 1; updates > 0; --updates) {
        std::vector<ToolSweep>& update = step.updates.emplace_back();
        for (int sweeps = chance(0.2) ? whole(2, 3) : 1; sweeps > 0; --sweeps) {
            BURIN_TRY(next, sweep(step.kind, lattice));
            update.push_back(std::move(next));
        }
    }
    return step;
}

RandomKind RandomWork::kind() {
    // Redo has something to do only where nothing was carved since the undo.
    const bool walks = last_ == RandomKind::undo || last_ == RandomKind::redo;
    if (walks && chance(0.4)) return RandomKind::redo;
    int drawn = whole(0, 99);
    for (std::size_t i = 0; i < kRandomKinds; ++i) {
        drawn -= kKindShares.at(i);
        if (drawn < 0) return static_cast<RandomKind>(i);
    }
    return RandomKind::ball;
}

// From a hundredth of a cell to the largest tool; often a whole number of cells.
double RandomWork::size_m(const compute::Lattice& lattice) {
    const double h = lattice.spacing_m, cells = *std::ranges::max_element(lattice.cells);
    if (chance(0.15)) return h * between(0.01, 1.0);
    if (chance(0.2)) return h * whole(1, 6);
    return h * between(0.5, kLargestTool * cells);
}

Vec3 RandomWork::place(const compute::Lattice& lattice) {
    Vec3 units;
    for (int axis = 0; axis < 3; ++axis) {
        double at_cell = between(-0.1, 1.1) * lattice.cells.at(static_cast<std::size_t>(axis));
        if (chance(0.3)) at_cell = std::round(2.0 * at_cell) / 2.0;
        units[axis] = at_cell * shared::kUnitsPerCell;
    }
    return lattice.object_from_units(units);
}

Quat RandomWork::orientation() {
    if (chance(0.3)) return {1, 0, 0, 0};
    const Vec3 axis{numbers_.signed_unit(), numbers_.signed_unit(), numbers_.signed_unit()};
    const double length = glm::length(axis);
    if (length < 1e-3) return {1, 0, 0, 0};
    return glm::angleAxis(between(0.0, 6.2), axis / length);
}

Result<ToolShape> RandomWork::shape(RandomKind kind, double size_m) {
    const auto part_m = [&] { return size_m * between(0.3, 1.0); };
    switch (kind) {
        case RandomKind::cylinder: return compute::CylinderTool{size_m, 2.0 * part_m()};
        case RandomKind::cone: {
            const double tip_m = chance(0.3) ? 0.0 : part_m();
            return compute::ConeTool{tip_m, chance(0.2) && tip_m > 0.0 ? 0.0 : size_m, 2.0 * part_m()};
        }
        case RandomKind::bullnose: {
            const double length_m = 2.0 * part_m(), most_m = std::min(size_m, length_m);
            return compute::BullNoseTool{size_m, chance(0.2) ? most_m : most_m * between(0.1, 1.0), length_m};
        }
        case RandomKind::box: return compute::BoxTool{{size_m, part_m(), part_m()}};
        case RandomKind::mesh: {
            std::array<double, 6> lengths_m{};
            for (double& length_m : lengths_m) length_m = part_m();
            BURIN_TRY(tool, compute::prepare_mesh_tool(
                                std::make_shared<const geometry::TriangleMesh>(octahedron_of(lengths_m))));
            return ToolShape(std::move(tool));
        }
        default: return compute::BallTool{size_m};
    }
}

Result<ToolSweep> RandomWork::sweep(RandomKind kind, const compute::Lattice& lattice) {
    const double h = lattice.spacing_m;
    // Smoothing costs the processor the cube of its radius.
    const double size = kind == RandomKind::smoothing ? h * between(1.5, 6.0) : size_m(lattice);
    BURIN_TRY(tool, shape(kind, size));
    ToolSweep sweep{.shape = std::move(tool), .start = {place(lattice), orientation()}, .end = {}};
    sweep.end = sweep.start;
    if (chance(0.6)) {  // it moves: often as far as a tool in a session, now and then right across
        const Vec3 elsewhere = place(lattice) - sweep.start.position_m;
        sweep.end.position_m += chance(0.1) ? elsewhere : 0.05 * elsewhere;
    }
    if (chance(0.25)) {
        const Vec3 about{numbers_.signed_unit(), numbers_.signed_unit(), 1.0};
        sweep.end.orientation =
            glm::angleAxis(between(0.01, kMostTurn_rad), glm::normalize(about)) * sweep.start.orientation;
    }
    const double drawn = between(0.0, 1.0);
    sweep.operation = kind == RandomKind::smoothing ? compute::Operation::smooth
                      : drawn < 0.55                ? compute::Operation::cut
                      : drawn < 0.85                ? compute::Operation::fill
                                                    : compute::Operation::paint;
    sweep.material = static_cast<std::uint8_t>(whole(0, 3));
    return sweep;
}

}  // namespace burin::bench
