// SPDX-License-Identifier: MIT
#include "compute/repair/slivers.hpp"

#include <algorithm>
#include <cmath>

namespace burin::compute {
namespace {

using shared::kUnitsPerCell;

// Findings of one row of rays: the report's fields, with thicknesses in lattice units.
struct RowFindings {
    std::uint64_t solid = 0, gaps = 0;
    std::vector<int> thicknesses;
    Box bounds_object_m;
    std::vector<Sliver> first;
};

// Nodes d with from <= d < to are inside a solid interval from..to, and outside in a gap; returns whether there is
// none.
bool holds_no_node(int from, int to) { return (from + kUnitsPerCell - 1) / kUnitsPerCell * kUnitsPerCell >= to; }

RowFindings broad_phase_row(const Solid& solid, int axis, int v) {
    const Lattice& lattice = solid.lattice;
    const DexelSet& set = solid.sets[static_cast<std::size_t>(axis)];
    RowFindings row;
    for (int u = 0; u < lattice.rays_u(axis); ++u) {
        const auto ends = set.ends(static_cast<std::size_t>(v) * static_cast<std::size_t>(lattice.rays_u(axis)) +
                                   static_cast<std::size_t>(u));
        for (std::size_t i = 1; i < ends.size(); ++i) {
            const int from = shared::depth_of(ends[i - 1]), to = shared::depth_of(ends[i]);
            if (!holds_no_node(from, to)) continue;
            const bool is_gap = i % 2 == 0;
            ++(is_gap ? row.gaps : row.solid);
            row.thicknesses.push_back(to - from);
            Vec3 units;
            units[axis] = 0.5 * (from + to);
            units[(axis + 1) % 3] = static_cast<double>(u) * kUnitsPerCell;
            units[(axis + 2) % 3] = static_cast<double>(v) * kUnitsPerCell;
            const Vec3 place_object_m = lattice.object_from_units(units);
            row.bounds_object_m.include(place_object_m);
            if (row.first.size() < kSliversNamed) {
                row.first.push_back({place_object_m, (to - from) * lattice.unit_m(), axis, is_gap});
            }
        }
    }
    return row;
}

}  // namespace

SliverReport find_slivers(const Solid& solid, WorkerPool& pool) {
    SliverReport report;
    std::vector<int> thicknesses;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<RowFindings> rows(static_cast<std::size_t>(solid.lattice.rays_v(axis)));
        pool.run(rows.size(), [&](std::size_t v) { rows[v] = broad_phase_row(solid, axis, static_cast<int>(v)); });
        for (const RowFindings& row : rows) {
            report.solid[static_cast<std::size_t>(axis)] += row.solid;
            report.gaps[static_cast<std::size_t>(axis)] += row.gaps;
            if (row.solid + row.gaps == 0) continue;
            thicknesses.insert(thicknesses.end(), row.thicknesses.begin(), row.thicknesses.end());
            report.bounds_object_m.include(row.bounds_object_m.lo);
            report.bounds_object_m.include(row.bounds_object_m.hi);
            const std::size_t room = std::min(row.first.size(), kSliversNamed - report.first.size());
            report.first.insert(report.first.end(), row.first.begin(), row.first.begin() + static_cast<long>(room));
        }
    }
    if (thicknesses.empty()) return report;
    report.thinnest_m = *std::ranges::min_element(thicknesses) * solid.lattice.unit_m();
    const auto middle = thicknesses.begin() + static_cast<std::ptrdiff_t>(thicknesses.size() / 2);
    std::ranges::nth_element(thicknesses, middle);
    report.median_m = *middle * solid.lattice.unit_m();
    return report;
}

std::optional<int> resolution_that_shows(const SliverReport& slivers, const Lattice& lattice) {
    if (!(slivers.median_m > 0.0)) return std::nullopt;
    // A lattice has at least two more cells along the longest side than its resolution (lattice_around).
    const double longest_m = (*std::ranges::max_element(lattice.cells) - 2) * lattice.spacing_m;
    const double resolution = std::ceil(longest_m / slivers.median_m);
    return resolution <= kMaxResolution ? std::optional(static_cast<int>(resolution)) : std::nullopt;
}

}  // namespace burin::compute
