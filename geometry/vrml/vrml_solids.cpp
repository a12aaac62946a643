// SPDX-License-Identifier: MIT
// Box, Cone, Cylinder and Sphere (ISO/IEC 14772-1:1997, 6.6, 6.9, 6.13 and 6.42), and what all geometry shares.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "geometry/vrml/vrml_geometry.hpp"

namespace burin::geometry {
namespace {

using CornersOfTriangle = std::array<std::uint32_t, 3>;

constexpr std::uint32_t kSlices = kVrmlSlices;
constexpr std::uint32_t kStacks = kVrmlSlices / 2;  // from pole to pole

std::uint32_t add_vertex(TriangleMesh& mesh, const Vec3& p) {
    mesh.positions_m.push_back(p);
    return static_cast<std::uint32_t>(mesh.positions_m.size() - 1);
}

// Adds a ring about the Y axis, from +Z on counter-clockwise seen from +Y, and returns its first vertex. Quarters of
// the turn are exact, so that the ring's bounds are those of the circle.
std::uint32_t add_ring(TriangleMesh& mesh, double radius_m, double y_m) {
    const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
    constexpr std::uint32_t kQuarter = kSlices / 4;
    for (std::uint32_t i = 0; i < kSlices; ++i) {
        const double angle = 0.5 * std::numbers::pi * (i % kQuarter) / kQuarter;
        const double c = std::cos(angle), s = std::sin(angle);
        const std::array<Vec2, 4> quarters{Vec2{s, c}, Vec2{c, -s}, Vec2{-s, -c}, Vec2{-c, s}};
        const Vec2 zx = quarters[i / kQuarter];
        mesh.positions_m.emplace_back(radius_m * zx.x, y_m, radius_m * zx.y);
    }
    return first;
}

// Joins a ring with the one above it.
void add_band(TriangleMesh& mesh, std::uint32_t lower, std::uint32_t upper) {
    for (std::uint32_t i = 0; i < kSlices; ++i) {
        const std::uint32_t next = (i + 1) % kSlices;
        mesh.triangles.push_back({lower + i, lower + next, upper + next});
        mesh.triangles.push_back({lower + i, upper + next, upper + i});
    }
}

// Joins a ring with a point above it, or below it with `down`.
void add_fan(TriangleMesh& mesh, std::uint32_t ring, std::uint32_t point, bool down) {
    for (std::uint32_t i = 0; i < kSlices; ++i) {
        const std::uint32_t next = (i + 1) % kSlices;
        mesh.triangles.push_back(down ? CornersOfTriangle{point, ring + next, ring + i}
                                      : CornersOfTriangle{point, ring + i, ring + next});
    }
}

}  // namespace

VrmlGeometryMaker vrml_geometry_maker(std::string_view type) {
    static constexpr std::pair<std::string_view, VrmlGeometryMaker> kMakers[] = {{"Box", vrml_box},
                                                                                 {"Cone", vrml_cone},
                                                                                 {"Cylinder", vrml_cylinder},
                                                                                 {"Sphere", vrml_sphere},
                                                                                 {"Extrusion", vrml_extrusion},
                                                                                 {"ElevationGrid", vrml_elevation_grid},
                                                                                 {"IndexedFaceSet", vrml_face_set}};
    for (const auto& [name, maker] : kMakers) {
        if (name == type) return maker;
    }
    return nullptr;
}

VrmlSurface vrml_box(const VrmlGeometryRequest& request) {
    VrmlSurface surface;
    const Vec3 half = 0.5 * request.fields.vector(request.node, "size", Vec3(2.0));
    const auto flat_axes = [&] { return (half.x == 0.0 ? 1 : 0) + (half.y == 0.0 ? 1 : 0) + (half.z == 0.0 ? 1 : 0); };
    if (!(half.x >= 0.0 && half.y >= 0.0 && half.z >= 0.0) || flat_axes() > 1) {
        request.fields.remark(request.fields.place(request.node), "a Box has a size that is not above zero",
                              "it is left out; write three lengths in metres");
        return surface;
    }
    if (flat_axes() == 1) {
        surface.two_sided = true;
        request.fields.remark(request.fields.place(request.node), "a Box has no thickness",
                              "it is shown as a plate; write three lengths in metres");
    }
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
        surface.mesh.positions_m.push_back(sign * half);
    }
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kQuads{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (std::size_t side = 0; side < kQuads.size(); ++side) {
        // The sides lie across z, then y, then x. Of a plate one of the two large ones is there.
        const auto& q = kQuads[side];
        const int across = 2 - static_cast<int>(side / 2);
        if (flat_axes() == 1 && (half[across] != 0.0 || side % 2 == 0)) continue;
        surface.mesh.triangles.push_back({q[0], q[1], q[2]});
        surface.mesh.triangles.push_back({q[0], q[2], q[3]});
    }
    return surface;
}

VrmlSurface vrml_cone(const VrmlGeometryRequest& request) {
    VrmlSurface surface;
    VrmlFields& fields = request.fields;
    TriangleMesh& mesh = surface.mesh;
    const double radius = fields.positive(request.node, "bottomRadius", 1.0);
    const double half = 0.5 * fields.positive(request.node, "height", 2.0);
    const bool bottom = fields.flag(request.node, "bottom", true), side = fields.flag(request.node, "side", true);
    if (radius == 0.0 || half == 0.0) return surface;
    const std::uint32_t ring = add_ring(mesh, radius, -half);
    if (side) add_fan(mesh, ring, add_vertex(mesh, Vec3(0.0, half, 0.0)), false);
    if (bottom) add_fan(mesh, ring, add_vertex(mesh, Vec3(0.0, -half, 0.0)), true);
    return surface;
}

VrmlSurface vrml_cylinder(const VrmlGeometryRequest& request) {
    VrmlSurface surface;
    VrmlFields& fields = request.fields;
    TriangleMesh& mesh = surface.mesh;
    const double radius = fields.positive(request.node, "radius", 1.0);
    const double half = 0.5 * fields.positive(request.node, "height", 2.0);
    const bool side = fields.flag(request.node, "side", true);
    const bool top = fields.flag(request.node, "top", true), bottom = fields.flag(request.node, "bottom", true);
    if (radius == 0.0 || half == 0.0) return surface;
    const std::uint32_t lower = add_ring(mesh, radius, -half), upper = add_ring(mesh, radius, half);
    if (side) add_band(mesh, lower, upper);
    if (top) add_fan(mesh, upper, add_vertex(mesh, Vec3(0.0, half, 0.0)), false);
    if (bottom) add_fan(mesh, lower, add_vertex(mesh, Vec3(0.0, -half, 0.0)), true);
    return surface;
}

VrmlSurface vrml_sphere(const VrmlGeometryRequest& request) {
    VrmlSurface surface;
    TriangleMesh& mesh = surface.mesh;
    const double radius = request.fields.positive(request.node, "radius", 1.0);
    if (radius == 0.0) return surface;
    const std::uint32_t south = add_vertex(mesh, Vec3(0.0, -radius, 0.0));
    std::uint32_t below = 0;
    for (std::uint32_t stack = 1; stack < kStacks; ++stack) {
        // Counted from the equator, where the sine is exact.
        const double latitude = std::numbers::pi * (static_cast<double>(stack) / kStacks - 0.5);
        const std::uint32_t ring = add_ring(mesh, radius * std::cos(latitude), radius * std::sin(latitude));
        if (stack == 1) {
            add_fan(mesh, ring, south, true);
        } else {
            add_band(mesh, below, ring);
        }
        below = ring;
    }
    add_fan(mesh, below, add_vertex(mesh, Vec3(0.0, radius, 0.0)), false);
    return surface;
}

void apply_vrml_sides(const VrmlGeometryRequest& request, VrmlSurface& surface) {
    VrmlFields& fields = request.fields;
    surface.two_sided = !fields.flag(request.node, "solid", true);
    surface.crease_angle_rad = fields.number(request.node, "creaseAngle", 0.0);
    if (fields.flag(request.node, "ccw", true)) return;
    for (auto& t : surface.mesh.triangles) std::swap(t[1], t[2]);
    for (auto& c : surface.corner_colours) std::swap(c[1], c[2]);
    for (auto& c : surface.corner_texture) std::swap(c[1], c[2]);
}

VrmlColour vrml_colour(double red, double green, double blue) {
    const auto byte = [](double value) {
        return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
    };
    return {byte(red), byte(green), byte(blue)};
}

std::vector<VrmlColour> vrml_colours(const VrmlGeometryRequest& request) {
    VrmlFields& fields = request.fields;
    std::vector<VrmlColour> colours;
    for (const VrmlPlaced& given : fields.nodes(request.node, "color")) {
        const auto node = fields.resolved(given);
        if (!node || fields.type(*node) != "Color") continue;
        fields.check_names(*node);
        const VrmlNumbers numbers = fields.numbers(*node, "color", 3, kAnyVrmlNumber);
        for (std::size_t i = 0; i < numbers.values.size(); ++i) {
            if (numbers.values[i] >= 0.0 && numbers.values[i] <= 1.0) continue;
            const bool is_number = std::isfinite(numbers.values[i]);
            fields.remark_at_value(numbers.value, i,
                                   is_number
                                       ? formatted("a colour has the number %.9g, not from 0 to 1", numbers.values[i])
                                       : std::string("a colour is no number"),
                                   is_number ? "it is taken for the nearer of these" : "it is left out, for grey");
        }
        for (std::size_t i = 0; i < numbers.values.size(); i += 3) {
            const auto rgb = numbers.values.subspan(i, 3);
            const bool is_colour = std::ranges::all_of(rgb, [](double v) { return std::isfinite(v); });
            colours.push_back(is_colour ? vrml_colour(rgb[0], rgb[1], rgb[2]) : vrml_colour(0.8, 0.8, 0.8));
        }
    }
    return colours;
}

bool may_make(const VrmlGeometryRequest& request, double triangles) {
    if (triangles <= static_cast<double>(request.most_triangles)) return true;
    request.fields.fault(request.fields.place(request.node),
                         "the world has more than " + std::to_string(kMostVrmlTriangles) + " triangles",
                         "reduce or split it");
    return false;
}

}  // namespace burin::geometry
