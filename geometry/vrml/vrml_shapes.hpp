// SPDX-License-Identifier: MIT
// Makes triangles of a VRML world (vrml_file.hpp): what can be touched and seen of it, each with its name, colour and
// pose.
//
// Made into triangles: Box, Cone, Cylinder, Sphere, ElevationGrid, Extrusion, IndexedFaceSet. Gone through: Transform,
// Group, Anchor, Billboard (as it stands, without turning), Collision (its children), Switch (the chosen child), LOD
// (its first level), Inline, and instances of a PROTO (the first node of its body, with IS). All other nodes are
// counted and skipped, instances of an EXTERNPROTO too. Nothing moves: routes, sensors and scripts have no effect.
//
// Units and frames: metres and radians, right-handed, +Y up, as VRML has them. Triangles are in the shape's own frame
// and wind counter-clockwise seen from outside, whatever `ccw` said; `world_from_shape` may scale, shear and mirror.
// Failure: all faults of the file, in its order, each with file, line, column and remedy; no world is returned beside
// faults, since an object would be missing unnoticed.
// Memory: nodes named by USE share their triangles. Bounds: kMostVrmlNodes after expansion, kMostVrmlTriangles.
// Threads: any. Cost: linear in the nodes after expansion and in the triangles, but for concave faces (polygon.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"
#include "geometry/mesh/triangle_mesh.hpp"
#include "geometry/vrml/vrml_file.hpp"

namespace burin::geometry {

inline constexpr std::size_t kMostVrmlTriangles = 10'000'000;  // of all shapes, those named by USE each time

// Round shapes are cut into so many sides, as many as keep the flat sides within 0.5 % of the radius (1 - cos(pi / n)).
inline constexpr int kVrmlSlices = 32;

using VrmlColour = std::array<std::uint8_t, 3>;  // sRGB

// The geometry of a shape, in its own frame.
struct VrmlSurface {
    TriangleMesh mesh;                                      // positions and triangles alone
    std::vector<std::array<VrmlColour, 3>> corner_colours;  // one for each triangle; empty: the shape's colour
    std::vector<std::array<Vec2, 3>> corner_texture;        // where in a picture; empty where none was asked for
    double crease_angle_rad = 0.0;  // edges of faces that meet at a smaller angle are to look smooth
    bool two_sided = false;         // solid FALSE: seen and felt from both sides
};

struct VrmlShape {
    // The name of the object that the shape belongs to: the DEF of the shape, or of the nearest node around it
    // that has one, or else of its geometry. DEFs inside a PROTO count only where its instance has none. Shapes of one
    // named node share its name; where the node is used again, the further ones are Name-2, Name-3... Empty: no DEF.
    std::string name;
    std::shared_ptr<const VrmlSurface> surface;  // never null
    Mat4 world_from_shape{1.0};                  // affine; its determinant is not 0
    // The centre of the named Transform that the object is or stands in, else of the nearest one around the shape, in
    // the world: what it turns about. None: there is no Transform.
    std::optional<Vec3> pivot_world = {};
    VrmlColour colour{204, 204, 204};  // diffuseColor, by default 0.8, and emissiveColor
    double transparency = 0.0;         // 0 opaque, 1 invisible
    // The numbers of a PROTO HapticMaterial in place of the shape's Material or Appearance: its fields of one number,
    // by name ("stiffness"). What they mean is for others to say.
    std::map<std::string, double> haptics;
    VrmlPlace place;  // of the Shape node; VrmlFile::where() tells line and column

    [[nodiscard]] bool mirrored() const { return glm::determinant(glm::dmat3(world_from_shape)) < 0.0; }
};

struct VrmlSkipped {
    std::string type;
    std::size_t count = 0;
    VrmlPlace first_place;
};

struct VrmlWorld {
    std::vector<VrmlShape> shapes;     // in the order of the file
    std::vector<VrmlSkipped> skipped;  // by type; those beyond kMostVrmlFaults types together
    std::vector<Error> remarks;        // what was left out or may be meant otherwise, in the order of the file
    std::size_t nodes = 0;             // after expansion
    std::size_t triangles = 0;         // of all shapes
};

using VrmlWorldOrFaults = std::expected<VrmlWorld, std::vector<Error>>;

[[nodiscard]] VrmlWorldOrFaults shapes_of(const VrmlFile& file);

// Returns a shape's triangles in the world's frame, counter-clockwise seen from outside also where the pose mirrors.
[[nodiscard]] TriangleMesh mesh_in_world(const VrmlShape& shape);

}  // namespace burin::geometry
