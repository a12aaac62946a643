// SPDX-License-Identifier: MIT
#include "sculpt/unmet_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "compute/rays/scan_convert.hpp"
#include "geometry/mesh/mesh_placing.hpp"

namespace burin::sculpt {
namespace {

using compute::Lattice;

// Takes the ends of all rays along an axis.
void include_ends(Box& bounds, const compute::Solid& solid, int axis) {
    const auto& set = solid.sets[static_cast<std::size_t>(axis)];
    const auto rays_u = static_cast<std::size_t>(solid.lattice.rays_u(axis));
    for (std::size_t ray = 0; ray < solid.lattice.rays(axis); ++ray) {
        const auto ends = set.ends(ray);
        if (ends.empty()) continue;
        Vec3 units;
        units[(axis + 1) % 3] = static_cast<double>(ray % rays_u) * shared::kUnitsPerCell;
        units[(axis + 2) % 3] = static_cast<double>(ray / rays_u) * shared::kUnitsPerCell;
        for (const auto end : {ends.front(), ends.back()}) {
            units[axis] = shared::depth_of(end);
            bounds.include(solid.lattice.object_from_units(units));
        }
    }
}

// A half space, of which what lies beyond the plane counts.
struct BeyondPlane {
    int axis;
    double sign, at;
    [[nodiscard]] double height(const Vec3& p) const { return sign * (p[axis] - at); }
};

// Returns the part of a triangle that lies beyond the plane, with its orientation.
std::vector<Vec3> clipped(const std::array<Vec3, 3>& triangle, const BeyondPlane& plane) {
    std::vector<Vec3> part;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = triangle[k], &b = triangle[(k + 1) % 3];
        const double from = plane.height(a), to = plane.height(b);
        if (from > 0.0) part.push_back(a);
        if ((from > 0.0) != (to > 0.0)) part.push_back(a + (b - a) * (from / (from - to)));
    }
    return part;
}

// Returns 4 volume / area of what lies beyond the plane. The cut itself adds nothing to the volume, since the origin of
// the cones that are summed lies in it.
double width_beyond(const geometry::TriangleMesh& mesh, const BeyondPlane& plane) {
    Vec3 origin = mesh.positions_m.at(mesh.triangles.at(0)[0]);
    origin[plane.axis] = plane.at;
    double volume = 0.0, area = 0.0;
    for (const auto& t : mesh.triangles) {
        const std::array<Vec3, 3> corners{mesh.positions_m[t[0]], mesh.positions_m[t[1]], mesh.positions_m[t[2]]};
        const std::vector<Vec3> part = clipped(corners, plane);
        for (std::size_t k = 2; k < part.size(); ++k) {
            const Vec3 normal = glm::cross(part[k - 1] - part[0], part[k] - part[0]);
            volume += glm::dot(part[0] - origin, normal) / 6.0;
            area += glm::length(normal) / 2.0;
        }
    }
    return area > 0.0 ? std::max(0.0, 4.0 * volume / area) : 0.0;
}

}  // namespace

std::vector<UnmetPart> find_unmet_parts(const geometry::TriangleMesh& mesh, const compute::Solid& solid) {
    Box met;
    for (int axis = 0; axis < 3; ++axis) include_ends(met, solid, axis);
    const Box bounds = geometry::bounds_of(mesh);
    std::vector<UnmetPart> parts;
    if (met.empty() || bounds.empty()) return parts;
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool is_upper : {false, true}) {
            const double sign = is_upper ? 1.0 : -1.0, at = (is_upper ? met.hi : met.lo)[axis];
            const double length_m = sign * ((is_upper ? bounds.hi : bounds.lo)[axis] - at);
            if (length_m <= solid.lattice.spacing_m) continue;
            // A depth's unit beyond the solid's own side, which is rounded to such units.
            const BeyondPlane plane{axis, sign, at + sign * solid.lattice.unit_m()};
            parts.push_back({axis, is_upper, length_m, width_beyond(mesh, plane)});
        }
    }
    return parts;
}

std::optional<int> resolution_that_meets(const std::vector<UnmetPart>& parts, const Lattice& lattice) {
    const double longest_m = *std::ranges::max_element(lattice.cells) * lattice.spacing_m;
    double resolution = 0.0;
    // A square that is turned between the nodes holds one where its side is a cell's diagonal.
    for (const UnmetPart& part : parts)
        resolution = std::max(resolution, std::ceil(std::numbers::sqrt2 * longest_m / part.width_m));
    return resolution <= compute::kMaxResolution ? std::optional(static_cast<int>(resolution)) : std::nullopt;
}

std::string in_words(const std::vector<UnmetPart>& parts, const Lattice& lattice) {
    if (parts.empty()) return "";
    std::string text = "no ray met what reaches ";
    for (const UnmetPart& part : parts) {
        text += (&part == parts.data() ? "" : " and ") + in_millimetres(part.length_m) + " farther along " +
                (part.is_upper ? "+" : "-") + "xyz"[part.axis];
    }
    const auto resolution = resolution_that_meets(parts, lattice);
    return text + " (a cell is " + in_millimetres(lattice.spacing_m) + " wide), which " +
           (resolution ? formatted("--resolution %d keeps", *resolution)
                       : formatted("no --resolution up to %d keeps", compute::kMaxResolution));
}

Json describe(const std::vector<UnmetPart>& parts, const Lattice& lattice) {
    Json json = Json::array();
    const auto resolution = resolution_that_meets(parts, lattice);
    for (const UnmetPart& part : parts) {
        json.push_back({{"along", std::string(part.is_upper ? "+" : "-") + "xyz"[part.axis]},
                        {"length_m", part.length_m},
                        {"width_m", part.width_m}});
        if (resolution) json.back()["resolution"] = *resolution;
    }
    return json;
}

}  // namespace burin::sculpt
