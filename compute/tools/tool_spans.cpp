// SPDX-License-Identifier: MIT
#include "compute/tools/tool_spans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "compute/rays/normal_code.hpp"
#include "compute/tools/convex_pieces.hpp"
#include "compute/tools/mesh_tool.hpp"
#include "compute/tools/sweep_units.hpp"

namespace burin::compute {
namespace {

using shared::DexelEnd;
using shared::kUnitsPerCell;

// Returns the rays that may meet the bounds. Rays lie at multiples of the cell. Rounding outwards is safe, because the
// closed form decides.
Footprint footprint_of(const Lattice& lattice, const Box& bounds, int axis) {
    const auto cell = [](double units, int last) {
        return static_cast<int>(std::clamp(std::floor(units / kUnitsPerCell), -1.0, last + 1.0));
    };
    const int u = (axis + 1) % 3, v = (axis + 2) % 3, last_u = lattice.rays_u(axis) - 1,
              last_v = lattice.rays_v(axis) - 1;
    return {std::max(0, cell(bounds.lo[u], last_u)), std::min(last_u, cell(bounds.hi[u], last_u) + 1),
            std::max(0, cell(bounds.lo[v], last_v)), std::min(last_v, cell(bounds.hi[v], last_v) + 1)};
}

// One row of rays of one axis, the pieces that may cover a part of it, and the resulting spans.
struct RowSpans {
    int axis = 0, v = 0;
    std::vector<std::uint32_t> pieces;
    RayBatch spans;
};

// Collects the spans of a ray and appends their union as ends.
class RayUnion {
public:
    void clear() { spans_.clear(); }
    void add(const SweepSpan& span) {
        if (!span.empty()) spans_.push_back(span);
    }

    // `deepest` is the depth at which the lattice ends on this axis, in lattice units.
    void append(int axis, int deepest, std::uint8_t material, std::vector<DexelEnd>& ends) {
        std::ranges::stable_sort(spans_, {}, &SweepSpan::lo);
        for (std::size_t i = 0; i < spans_.size();) {
            SweepSpan whole = spans_[i++];
            while (i < spans_.size() && std::ceil(spans_[i].lo) <= std::floor(whole.hi) + 1.0) {
                if (spans_[i].hi > whole.hi) whole.hi = spans_[i].hi, whole.normal_hi = spans_[i].normal_hi;
                ++i;
            }
            append_clipped(whole, axis, deepest, material, ends);
        }
    }

private:
    static void append_clipped(SweepSpan span, int axis, int deepest, std::uint8_t material,
                               std::vector<DexelEnd>& ends) {
        Vec3 e(0.0);
        e[axis] = 1.0;
        if (span.lo < 0.0) span.lo = 0.0, span.normal_lo = -e;
        if (span.hi > deepest) span.hi = deepest, span.normal_hi = e;
        if (!(span.lo < span.hi)) return;
        const int lo = static_cast<int>(std::ceil(span.lo)), hi = static_cast<int>(std::floor(span.hi));
        if (lo >= hi) return;
        ends.push_back(shared::make_end(lo, material, normal_code(span.normal_lo)));
        ends.push_back(shared::make_end(hi, material, normal_code(span.normal_hi)));
    }

    std::vector<SweepSpan> spans_;
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

RayBatch spans_of(const Lattice& lattice, const std::vector<ConvexPiece>& pieces, std::uint8_t material,
                  WorkerPool& pool) {
    std::vector<std::vector<Footprint>> footprints(3);
    for (int axis = 0; axis < 3; ++axis) {
        for (const ConvexPiece& piece : pieces) {
            footprints[static_cast<std::size_t>(axis)].push_back(footprint_of(lattice, bounds_of(piece), axis));
        }
    }
    std::vector<RowSpans> rows = rows_under(lattice, footprints);
    pool.run(rows.size(), [&](std::size_t i) {
        RowSpans& row = rows[i];
        const std::vector<Footprint>& of_axis = footprints[static_cast<std::size_t>(row.axis)];
        const int deepest = lattice.cells[static_cast<std::size_t>(row.axis)] * kUnitsPerCell;
        int u_lo = lattice.rays_u(row.axis), u_hi = -1;
        for (const std::uint32_t p : row.pieces) {
            u_lo = std::min(u_lo, of_axis[p].u_lo);
            u_hi = std::max(u_hi, of_axis[p].u_hi);
        }
        RayUnion ray;
        std::vector<DexelEnd> ends;
        for (int u = u_lo; u <= u_hi; ++u) {
            ray.clear();
            for (const std::uint32_t p : row.pieces) {
                if (of_axis[p].holds(u, row.v))
                    ray.add(span_of(pieces[p], row.axis, u * kUnitsPerCell, row.v * kUnitsPerCell));
            }
            ends.clear();
            ray.append(row.axis, deepest, material, ends);
            if (!ends.empty()) row.spans.add(shared::ray_code(row.axis, u, row.v), ends);
        }
    });
    return joined(rows);
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
    const Result<Extent> extent = extent_of(tool, lattice.unit_m());
    if (!extent) return std::unexpected(extent.error());
    sweep.tolerance_cells *= turning_share<Tool>();
    return straight_moves(lattice, sweep, *extent);
}

template <typename Tool>
Result<RayBatch> spans_of_tool(const Solid& solid, const Tool& tool, const ToolSweep& sweep, WorkerPool& pool) {
    const Lattice& lattice = solid.lattice;
    const auto moves = moves_of(lattice, tool, sweep);
    if (!moves) return std::unexpected(moves.error());
    std::vector<ConvexPiece> pieces;
    for (const StraightMove& move : *moves) {
        append_pieces(tool, move, lattice.unit_m(), sweep.tolerance_cells * kUnitsPerCell, pieces);
    }
    return spans_of(lattice, pieces, sweep.material, pool);
}

Result<RayBatch> spans_of_tool(const Solid& solid, const MeshTool& tool, const ToolSweep& sweep, WorkerPool& pool) {
    const Result<MeshTool> prepared = tool.edges == nullptr ? prepare_mesh_tool(tool.mesh) : Result<MeshTool>(tool);
    if (!prepared) return std::unexpected(prepared.error());
    const auto moves = moves_of(solid.lattice, *prepared, sweep);
    if (!moves) return std::unexpected(moves.error());
    return mesh_spans(solid.lattice, *prepared, *moves, sweep.material, pool);
}

// Evaluates the exact predicate of a ball ray by ray. The engines have faster methods.
Result<RayBatch> spans_of_tool(const Solid& solid, const BallTool& tool, const ToolSweep& sweep, WorkerPool& pool) {
    const auto capsules = ball_capsules(solid, tool, sweep);
    if (!capsules) return std::unexpected(capsules.error());
    RayBatch batch;
    if (capsules->empty()) return batch;
    const shared::Capsule& capsule = capsules->front();
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
    const Result<MeshTool> prepared = tool.edges == nullptr ? prepare_mesh_tool(tool.mesh) : Result<MeshTool>(tool);
    if (!prepared) return std::unexpected(prepared.error());
    auto moves = moves_of(solid.lattice, *prepared, sweep);
    if (!moves) return moves;
    if (const auto good = check_effort(*prepared, *moves); !good) return std::unexpected(good.error());
    return moves;
}
Result<std::vector<shared::Capsule>> check_tool(const Solid& solid, const BallTool& tool, const ToolSweep& sweep) {
    return ball_capsules(solid, tool, sweep);
}

}  // namespace

Result<void> check_sweep(const Solid& solid, const ToolSweep& sweep) {
    if (const auto good = check_material(solid, sweep); !good) return good;
    return std::visit(
        [&](const auto& tool) -> Result<void> {
            const auto checked = check_tool(solid, tool, sweep);
            if (!checked) return std::unexpected(checked.error());
            return {};
        },
        sweep.shape);
}

Result<RayBatch> tool_spans(const Solid& solid, const ToolSweep& sweep, WorkerPool& pool) {
    if (const auto good = check_material(solid, sweep); !good) return std::unexpected(good.error());
    return std::visit([&](const auto& tool) { return spans_of_tool(solid, tool, sweep, pool); }, sweep.shape);
}

}  // namespace burin::compute
