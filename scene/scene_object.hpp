// SPDX-License-Identifier: MIT
// An object of a scene as plain data, and pure edits of it.
//
// Frame: the object's own is that of its mesh. A point of the mesh is in the scene at pose * (scale * point).
// Units: metres. Pure; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"
#include "geometry/mesh/triangle_mesh.hpp"
#include "scene/haptic_material.hpp"
#include "scene/object_id.hpp"
#include "scene/scene_motion.hpp"

namespace burin::scene {

using Colour = std::array<std::uint8_t, 3>;  // sRGB
// The colours of each triangle's corners.
using CornerColours = std::vector<std::array<Colour, 3>>;

struct SceneObject {
    ObjectId id = 0;
    std::string name;  // not empty, unique in a world
    std::shared_ptr<const geometry::TriangleMesh> mesh;
    Pose pose;           // scene_from_object; without the motion of a path, and not used while a hand holds it
    double scale = 1.0;  // kMinScale to kMaxScale
    // In the mesh's frame: what stays where it is when the object is turned or scaled.
    Vec3 pivot_m{0.0};
    bool seen = true, felt = true;
    Colour colour{200, 200, 200};
    // Those that its file has, one entry for each triangle of the mesh. Null: `colour` is everywhere.
    std::shared_ptr<const CornerColours> corner_colours = {};
    double opacity = 1.0;  // 0: clear as air, and yet seen at grazing angles; 1: hides what is behind
    HapticMaterial material;
    bool both_sides = false;  // a surface without thickness, felt from the side on which the tool is
    ObjectMotion motion;
};

inline constexpr double kMinScale = 1e-6, kMaxScale = 1e6;
// Farther from the scene's origin than this nothing is touched: float positions would be coarser than 0.1 mm.
inline constexpr double kMaxDistance_m = 1000.0;

// How far the pivot is from where the mesh has it: the object's position for people, whatever its turn and scale.
[[nodiscard]] Vec3 displacement_m(const SceneObject& object);
// Returns the pose in which the pivot is displaced so far and the object, at this scale, turned about it.
[[nodiscard]] Pose turned_about_pivot(const SceneObject& object, const Vec3& displacement_m, const Quat& orientation,
                                      double scale);

// Gives the object these colours; where they are all one, that is its colour. None: nothing changes.
void take_colours(SceneObject& object, CornerColours colours);

// Returns all that is wrong with an object's values, besides its mesh.
[[nodiscard]] std::vector<Problem> problems(const SceneObject& object);

// Sets the object's own pose. One on a path takes the path along; one that a hand holds is refused.
struct SetPose {
    Pose scene_from_object;
};
struct SetScale {
    double scale = 1.0;  // about the pivot
};
struct SetMaterial {
    HapticMaterial material;
};
struct SetFelt {
    bool felt = true;
};
struct SetSeen {
    bool seen = true;
};
struct SetColour {
    Colour colour{};  // everywhere
};
struct SetOpacity {
    double opacity = 1.0;
};
// Has the object move with parts of hands from now on: the fields of HeldMotion.
struct TakeHold {
    std::vector<std::size_t> parts;
    Pose hand_from_object;
    bool felt = false;
};
// Leaves the object fixed where it is.
struct LetGo {
    Pose scene_from_object;
};
// Gives the object all values of a state of itself: as undo does. One that a hand holds is refused.
struct Restore {
    std::shared_ptr<const SceneObject> object;
};
using ObjectEdit =
    std::variant<SetPose, SetScale, SetMaterial, SetFelt, SetSeen, SetColour, SetOpacity, TakeHold, LetGo, Restore>;

// Returns the object with the edit made. Fails where that would have a problem.
[[nodiscard]] Result<SceneObject> edited(SceneObject object, const ObjectEdit& edit);

}  // namespace burin::scene
