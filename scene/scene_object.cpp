// SPDX-License-Identifier: MIT
#include "scene/scene_object.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/contact/mesh_motion.hpp"
#include "scene/touchable.hpp"
#include "scene/value_text.hpp"

namespace burin::scene {
namespace {

constexpr std::size_t kLongestName = 200;  // bytes: as wide as a large terminal

bool is_near_enough(const Vec3& position_m) { return finite(position_m) && glm::length(position_m) <= kMaxDistance_m; }

void append(std::vector<Problem>& to, std::vector<Problem> more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// Makes each kind of edit. Returns why it cannot be made, if so.
struct Editor {
    SceneObject& object;

    std::string operator()(const SetPose& e) const {
        if (std::holds_alternative<HeldMotion>(object.motion)) return "is held by a hand; let go of it first";
        object.pose = e.scene_from_object;
        return "";
    }
    std::string operator()(const SetScale& e) const {
        const Vec3 less_m = (object.scale - e.scale) * object.pivot_m;
        const auto about_pivot = [&](Pose pose) {
            return Pose{pose.position_m + pose.orientation * less_m, pose.orientation};
        };
        object.pose = about_pivot(object.pose);
        if (auto* const held = std::get_if<HeldMotion>(&object.motion))
            held->hand_from_object = about_pivot(held->hand_from_object);
        if (auto* const path = std::get_if<PathMotion>(&object.motion)) path->about_m = e.scale * object.pivot_m;
        return object.scale = e.scale, "";
    }
    std::string operator()(const SetMaterial& e) const { return object.material = e.material, ""; }
    std::string operator()(const SetFelt& e) const { return object.felt = e.felt, ""; }
    std::string operator()(const SetSeen& e) const { return object.seen = e.seen, ""; }
    std::string operator()(const SetColour& e) const {
        object.corner_colours = nullptr;
        return object.colour = e.colour, "";
    }
    std::string operator()(const SetOpacity& e) const { return object.opacity = e.opacity, ""; }
    std::string operator()(const TakeHold& e) const {
        if (e.parts.empty()) return "is to be held by nobody; name a hand";
        object.motion = HeldMotion{e.parts, e.hand_from_object, e.felt};
        return "";
    }
    std::string operator()(const LetGo& e) const {
        object.pose = e.scene_from_object;
        object.motion = FixedMotion{};
        return "";
    }
    std::string operator()(const Restore& e) const {
        if (std::holds_alternative<HeldMotion>(object.motion)) return "is held by a hand; let go of it first";
        if (e.object->id != object.id || e.object->mesh != object.mesh) return "is another object";
        const SceneObject now = std::exchange(object, *e.object);
        if (!std::holds_alternative<HeldMotion>(object.motion)) return "";
        // It was in a hand then, which has let go of it since: it stays where it is.
        object.pose = now.pose;
        object.motion = now.motion;
        return "";
    }
};

}  // namespace

Vec3 displacement_m(const SceneObject& object) {
    // Without a turn and a scale the difference is 0, and nothing is rounded.
    const Vec3 moved_m = object.pivot_m - object.pose.orientation * (object.scale * object.pivot_m);
    return object.pose.position_m - moved_m;
}

Pose turned_about_pivot(const SceneObject& object, const Vec3& displacement_m, const Quat& orientation, double scale) {
    return {displacement_m + (object.pivot_m - orientation * (scale * object.pivot_m)), orientation};
}

void take_colours(SceneObject& object, CornerColours colours) {
    if (colours.empty()) return;
    const Colour first = colours.front()[0];
    object.colour = first;
    const bool is_one = std::ranges::all_of(
        colours, [&](const auto& corners) { return std::ranges::count(corners, first) == std::ssize(corners); });
    object.corner_colours = is_one ? nullptr : std::make_shared<const CornerColours>(std::move(colours));
}

std::vector<Problem> problems(const SceneObject& object) {
    std::vector<Problem> found;
    if (object.name.find_first_not_of(' ') == std::string::npos)
        found.push_back({"name", "is empty", "give each object a name of its own"});
    if (has_control_characters(object.name))
        found.push_back({"name", "holds control characters", "write a name on one line"});
    if (object.name.size() > kLongestName)
        found.push_back({"name", "has " + std::to_string(object.name.size()) + " bytes",
                         "write at most " + std::to_string(kLongestName)});
    if (!is_near_enough(object.pose.position_m))
        found.push_back({"position", "is farther than 1000 m from the origin", "give metres"});
    if (!geometry::is_unit(object.pose.orientation))
        found.push_back({"orientation", "is not a unit quaternion", "write [0, 0, 0, 1] (x, y, z, w) for no rotation"});
    if (!(object.scale >= kMinScale && object.scale <= kMaxScale))
        found.push_back({"scale", "is " + number_text(object.scale), "give a factor from 1e-6 to 1e6"});
    if (!(object.opacity >= 0.0 && object.opacity <= 1.0))
        found.push_back({"opacity", "is " + number_text(object.opacity),
                         "give a number from 0, clear as glass, to 1, which hides what is behind"});
    append(found, problems(object.material));
    if (const auto* path = std::get_if<PathMotion>(&object.motion)) append(found, problems(*path));
    if (const auto* held = std::get_if<HeldMotion>(&object.motion))
        if (!finite(held->hand_from_object.position_m) || !geometry::is_unit(held->hand_from_object.orientation))
            found.push_back({"held", "has a pose that is not finite", "take hold of it anew"});
    return found;
}

Result<SceneObject> edited(SceneObject object, const ObjectEdit& edit) {
    const std::string name = object.name;
    if (const std::string refused = std::visit(Editor{object}, edit); !refused.empty()) return fail(name, refused);
    if (const std::vector<Problem> found = problems(object); !found.empty())
        return fail(name, found.front().key + " " + found.front().what, found.front().remedy);
    if (object.felt && object.mesh && object.mesh->triangles.empty())
        return fail(name, "has no triangles that could be felt", "leave it as it is");
    const bool may_not_be = std::holds_alternative<SetScale>(edit) || std::holds_alternative<SetFelt>(edit);
    if (may_not_be && object.felt && object.mesh && !can_be_touched(object))
        return fail(name, "would be larger than 1e8 m", "give a smaller scale");
    return object;
}

}  // namespace burin::scene
