// SPDX-License-Identifier: MIT
#include "scene/scene_object.hpp"

#include <cmath>

#include "geometry/contact/mesh_motion.hpp"
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
    std::string operator()(const SetScale& e) const { return object.scale = e.scale, ""; }
    std::string operator()(const SetMaterial& e) const { return object.material = e.material, ""; }
    std::string operator()(const SetFelt& e) const { return object.felt = e.felt, ""; }
    std::string operator()(const SetSeen& e) const { return object.seen = e.seen, ""; }
    std::string operator()(const SetColour& e) const { return object.colour = e.colour, ""; }
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
};

}  // namespace

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
    return object;
}

}  // namespace burin::scene
