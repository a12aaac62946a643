// SPDX-License-Identifier: MIT
#include "compute/tools/tool_spans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "base/try.hpp"
#include "compute/tools/mesh_tool.hpp"
#include "compute/tools/move_bounds.hpp"
#include "compute/tools/ray_union.hpp"
#include "compute/tools/sweep_units.hpp"

namespace burin::compute {
namespace {

using shared::DexelEnd;
using shared::kUnitsPerCell;

// One row of rays of one axis, the pieces that may cover a part of it, and the resulting spans.
struct RowSpans {
    int axis = 0, v = 0;
    std::vector<std::uint32_t> pieces;
    RayBatch spans;
};

std::vector<RowSpans> rows_under(const Lattice& lattice, const std::vector<std::vector<Footprint>>& footprints) {
    std::vector<RowSpans> rows;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<Footprint>& of_axis = footprints[static_cast<std::size_t>(axis)];
        std::vector<std::vector<std::uint32_t>> pieces_at(static_cast<std::size_t>(lattice.rays_v(axis)));
        for (std::uint32_t i = 0; i < of_axis.size(); ++i) {
            if (of_axis[i].empty()) continue;
            for (int v = of_axis[i].v_lo; v <= of_axis[i].v_hi; ++v)
                pieces_at[static_cast<std::size_t>(v)].push_back(i);
        }
        for (int v = 0; v < lattice.rays_v(axis); ++v) {
            std::vector<std::uint32_t>& pieces = pieces_at[static_cast<std::size_t>(v)];
            if (!pieces.empty()) rows.push_back({axis, v, std::move(pieces), {}});
        }
    }
    return rows;
}

RayBatch joined(const std::vector<RowSpans>& rows) {
    RayBatch batch;
    std::size_t rays = 0, ends = 0;
    for (const RowSpans& row : rows) rays += row.spans.rays.size(), ends += row.spans.ends.size();
    batch.rays.reserve(rays);
    batch.ends.reserve(ends);
    for (const RowSpans& row : rows) {
        for (const RayBatch::Ray& ray : row.spans.rays) batch.add(ray.code, row.spans.ends_of(ray));
    }
    return batch;
}

// Returns the rays that the moves may meet, as one rectangle for each move and axis.
std::vector<std::vector<Footprint>> footprints_of(const Lattice& lattice, const ConvexPieces& sweep) {
    std::vector<std::vector<Footprint>> footprints(3);
    for (std::size_t first = 0; first < sweep.pieces.size(); first += sweep.a_move) {
        Box bounds;
        for (std::size_t i = first; i < first + sweep.a_move; ++i) {
            const Box piece = bounds_of(sweep.pieces[i]);
            bounds.include(piece.lo);
            bounds.include(piece.hi);
        }
        for (int axis = 0; axis < 3; ++axis) {
            footprints[static_cast<std::size_t>(axis)].push_back(footprint(lattice, bounds, axis));
        }
    }
    return footprints;
}

// Computes the spans of one row of rays.
void fill_row(const Lattice& lattice, const MoveBounds& bounds, std::uint8_t material, RayUnion& ray, RowSpans& row) {
    const double v = row.v * kUnitsPerCell;
    std::vector<MoveBounds::RowPart> parts;
    double lo = lattice.rays_u(row.axis) * kUnitsPerCell, hi = -1.0;
    for (const std::uint32_t move : row.pieces) {
        parts.push_back(bounds.part_of_row(move, row.axis, v, parts.empty() ? MoveBounds::RowPart{} : parts.back()));
        lo = std::min(lo, parts.back().lo);
        hi = std::max(hi, parts.back().hi);
    }
    ray.start_row();
    const int deepest = lattice.cells[static_cast<std::size_t>(row.axis)] * kUnitsPerCell;
    const auto last = static_cast<double>(lattice.rays_u(row.axis) - 1);
    std::vector<std::uint32_t> moves;
    std::vector<DexelEnd> ends;
    for (double place = std::max(0.0, std::ceil(lo / kUnitsPerCell)); place <= last; place += 1.0) {
        const double u = place * kUnitsPerCell;
        if (u > hi) break;
        moves.clear();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (u >= parts[i].lo && u <= parts[i].hi) moves.push_back(row.pieces[i]);
        }
        ray.gather(row.axis, u, v, moves);
        ends.clear();
        ray.append(deepest, material, ends);
        if (!ends.empty()) row.spans.add(shared::ray_code(row.axis, static_cast<int>(place), row.v), ends);
    }
}

Result<void> check_material(const Solid& solid, const ToolSweep& sweep) {
    if (sweep.material < solid.materials.size()) return {};
    return fail("tool", "leaves material " + std::to_string(sweep.material) + ", which the workpiece lacks",
                "add the material to the workpiece first");
}

// Returns the share of the tolerance that is left for turning: the slices of a bull-nose take a quarter.
template <typename Tool>
double turning_share() {
    return std::is_same_v<Tool, BullNoseTool> ? 0.75 : 1.0;
}

Result<std::vector<shared::Capsule>> ball_capsules(const Solid& solid, const BallTool& tool, const ToolSweep& sweep) {
    const BallSweep ball{sweep.start.position_m, sweep.end.position_m, tool.radius_m, sweep.material, Operation::cut};
    return capsules_in_units(solid, {&ball, 1});
}

template <typename Tool>
Result<std::vector<StraightMove>> moves_of(const Lattice& lattice, const Tool& tool, ToolSweep sweep) {
    BURIN_TRY(extent, extent_of(tool, lattice.unit_m()));
    sweep.tolerance_cells *= turning_share<Tool>();
    return straight_moves(lattice, sweep, extent);
}

template <typename Tool>
Result<ConvexPieces> pieces_of_tool(const Lattice& lattice, const Tool& tool, const ToolSweep& sweep) {
    BURIN_TRY(moves, moves_of(lattice, tool, sweep));
    ConvexPieces all;
    for (const StraightMove& move : moves) {
        append_pieces(tool, move, lattice.unit_m(), sweep.tolerance_cells * kUnitsPerCell, all.pieces);
    }
    if (!moves.empty()) all.a_move = all.pieces.size() / moves.size();
    return all;
}
Result<ConvexPieces> pieces_of_tool(const Lattice& /*lattice*/, const BallTool& /*tool*/, const ToolSweep& /*sweep*/) {
    return ConvexPieces{};
}
Result<ConvexPieces> pieces_of_tool(const Lattice& /*lattice*/, const MeshTool& /*tool*/, const ToolSweep& /*sweep*/) {
    return ConvexPieces{};
}

template <typename Tool>
Result<RayBatch> spans_of_tool(const Solid& solid, const Tool& tool, const ToolSweep& sweep, WorkerPool& pool) {
    BURIN_TRY(pieces, pieces_of_tool(solid.lattice, tool, sweep));
    return convex_spans(solid.lattice, pieces, sweep.material, pool).batch;
}

Result<RayBatch> spans_of_tool(const Solid& solid, const MeshTool& tool, const ToolSweep& sweep, WorkerPool& pool) {
    BURIN_TRY(prepared, tool.edges == nullptr ? prepare_mesh_tool(tool.mesh) : Result<MeshTool>(tool));
    BURIN_TRY(moves, moves_of(solid.lattice, prepared, sweep));
    return mesh_spans(solid.lattice, prepared, moves, sweep.material, pool);
}

// Evaluates the exact predicate of a ball ray by ray. The engines have faster methods.
Result<RayBatch> spans_of_tool(const Solid& solid, const BallTool& tool, const ToolSweep& sweep, WorkerPool& pool) {
    BURIN_TRY(capsules, ball_capsules(solid, tool, sweep));
    RayBatch batch;
    if (capsules.empty()) return batch;
    const shared::Capsule& capsule = capsules.front();
    std::vector<std::vector<Footprint>> footprints(3);
    for (int axis = 0; axis < 3; ++axis) {
        footprints[static_cast<std::size_t>(axis)].push_back(footprint(solid.lattice, capsule, axis));
    }
    std::vector<RowSpans> rows = rows_under(solid.lattice, footprints);
    pool.run(rows.size(), [&](std::size_t i) {
        RowSpans& row = rows[i];
        const Footprint& f = footprints[static_cast<std::size_t>(row.axis)].front();
        const int deepest = solid.lattice.cells[static_cast<std::size_t>(row.axis)] * kUnitsPerCell;
        for (int u = f.u_lo; u <= f.u_hi; ++u) {
            const auto k = shared::capsule_from_ray(capsule, row.axis, u * kUnitsPerCell, row.v * kUnitsPerCell);
            const shared::RaySpan span = shared::capsule_span(k);
            const int lo = std::max(span.lo, 0), hi = std::min(span.hi, deepest);
            if (lo >= hi) continue;
            const auto end = [&](int depth) {
                return shared::make_end(depth, sweep.material, shared::capsule_normal(k, row.axis, depth, true));
            };
            row.spans.add(shared::ray_code(row.axis, u, row.v), std::array{end(lo), end(hi)});
        }
    });
    return joined(rows);
}

template <typename Tool>
Result<std::vector<StraightMove>> check_tool(const Solid& solid, const Tool& tool, const ToolSweep& sweep) {
    return moves_of(solid.lattice, tool, sweep);
}
Result<std::vector<StraightMove>> check_tool(const Solid& solid, const MeshTool& tool, const ToolSweep& sweep) {
    BURIN_TRY(prepared, tool.edges == nullptr ? prepare_mesh_tool(tool.mesh) : Result<MeshTool>(tool));
    auto moves = moves_of(solid.lattice, prepared, sweep);
    if (!moves) return moves;
    BURIN_TRY_DO(check_effort(prepared, *moves));
    return moves;
}
Result<std::vector<shared::Capsule>> check_tool(const Solid& solid, const BallTool& tool, const ToolSweep& sweep) {
    return ball_capsules(solid, tool, sweep);
}

}  // namespace

Result<void> check_sweep(const Solid& solid, const ToolSweep& sweep) {
    BURIN_TRY_DO(check_material(solid, sweep));
    return std::visit(
        [&](const auto& tool) -> Result<void> {
            BURIN_TRY_DO(check_tool(solid, tool, sweep));
            return {};
        },
        sweep.shape);
}

Result<ConvexPieces> convex_pieces(const Lattice& lattice, const ToolSweep& sweep) {
    return std::visit([&](const auto& tool) { return pieces_of_tool(lattice, tool, sweep); }, sweep.shape);
}

ConvexSpans convex_spans(const Lattice& lattice, const ConvexPieces& sweep, std::uint8_t material, WorkerPool& pool) {
    if (sweep.pieces.empty()) return {};
    const MoveBounds bounds(sweep.pieces, sweep.a_move);
    std::vector<RowSpans> rows = rows_under(lattice, footprints_of(lattice, sweep));
    // A few rows together, since the pieces at the ends of a row's first ray are found next to those of the row before.
    constexpr std::size_t kRowsTogether = 8;
    std::vector<std::uint64_t> sections((rows.size() + kRowsTogether - 1) / kRowsTogether);
    pool.run(sections.size(), [&](std::size_t i) {
        RayUnion ray(sweep.pieces, sweep.a_move, bounds);
        const std::size_t last = std::min(rows.size(), (i + 1) * kRowsTogether);
        for (std::size_t r = i * kRowsTogether; r < last; ++r) fill_row(lattice, bounds, material, ray, rows[r]);
        sections[i] = ray.sections();
    });
    return {joined(rows), std::accumulate(sections.begin(), sections.end(), std::uint64_t{0})};
}

Result<RayBatch> tool_spans(const Solid& solid, const ToolSweep& sweep, WorkerPool& pool) {
    BURIN_TRY_DO(check_material(solid, sweep));
    return std::visit([&](const auto& tool) { return spans_of_tool(solid, tool, sweep, pool); }, sweep.shape);
}

}  // namespace burin::compute
