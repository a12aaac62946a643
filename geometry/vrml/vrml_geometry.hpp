// SPDX-License-Identifier: MIT
// Triangles of the geometry nodes of VRML, each in the node's own frame (ISO/IEC 14772-1:1997, clause 6). Internal to
// geometry/vrml/. Triangles wind counter-clockwise seen from outside. What is wrong with a node goes to the list of
// faults. Cost: linear in the triangles, but for faces of more than three corners (polygon.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "geometry/vrml/vrml_fields.hpp"
#include "geometry/vrml/vrml_shapes.hpp"

namespace burin::geometry {

struct VrmlGeometryRequest {
    VrmlFields& fields;
    VrmlPlaced node;
    std::size_t most_triangles = 0;  // more are a fault, before they take memory
    bool textured = false;           // corner_texture is wanted
};

using VrmlGeometryMaker = VrmlSurface (*)(const VrmlGeometryRequest&);

// Returns what makes triangles of a node of this type; null for a type without.
[[nodiscard]] VrmlGeometryMaker vrml_geometry_maker(std::string_view type);

[[nodiscard]] VrmlSurface vrml_box(const VrmlGeometryRequest& request);
[[nodiscard]] VrmlSurface vrml_cone(const VrmlGeometryRequest& request);
[[nodiscard]] VrmlSurface vrml_cylinder(const VrmlGeometryRequest& request);
[[nodiscard]] VrmlSurface vrml_sphere(const VrmlGeometryRequest& request);
[[nodiscard]] VrmlSurface vrml_elevation_grid(const VrmlGeometryRequest& request);
[[nodiscard]] VrmlSurface vrml_face_set(const VrmlGeometryRequest& request);
[[nodiscard]] VrmlSurface vrml_extrusion(const VrmlGeometryRequest& request);

// Reads solid and creaseAngle, and turns the triangles where ccw is FALSE.
void apply_vrml_sides(const VrmlGeometryRequest& request, VrmlSurface& surface);

// Returns the colours of a node's field `color`; empty where it has none.
[[nodiscard]] std::vector<VrmlColour> vrml_colours(const VrmlGeometryRequest& request);
[[nodiscard]] VrmlColour vrml_colour(double red, double green, double blue);

// Says whether so many triangles may be made; if not, that is a fault.
[[nodiscard]] bool may_make(const VrmlGeometryRequest& request, double triangles);

}  // namespace burin::geometry
