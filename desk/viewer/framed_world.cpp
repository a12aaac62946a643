// SPDX-License-Identifier: MIT
#include "desk/viewer/framed_world.hpp"

#include <algorithm>
#include <cmath>

#include "wall/projection.hpp"

namespace burin::session {
namespace {

// Around the object, of its own longest side.
constexpr double kRoomAround = 0.25;

Box bounds_in_scene(const scene::SceneObject& object) {
    Box bounds;
    for (const Vec3& place : object.mesh->positions_m) bounds.include(object.pose * (object.scale * place));
    return bounds;
}

}  // namespace

Box grown(const Box& box, double least_m) {
    const Vec3 half = 0.5 * glm::max(box.extent(), Vec3(least_m));
    return {box.center() - half, box.center() + half};
}

const scene::SceneObject* chosen_object(const SessionState& state, const Viewer& viewer) {
    if (!state.world || state.world->objects.empty()) return nullptr;
    const scene::SceneObject* chosen = state.world->find(viewer.selected);
    return chosen != nullptr ? chosen : state.world->objects.front().get();
}

bool moves_or_grows(scene::ObjectProperty property) {
    using scene::ObjectProperty;
    return property == ObjectProperty::position || property == ObjectProperty::orientation ||
           property == ObjectProperty::scale || property == ObjectProperty::seen;
}

Similarity fitted_to(const scene::SceneObject& object, const SeenFrom& from, const Quat& world_from_object) {
    SeenFrom of_object = from;
    of_object.bounds_object = bounds_in_scene(object);
    if (of_object.bounds_object.empty()) return fitted(from, world_from_object);
    const Vec3 size = of_object.bounds_object.extent(), around(kRoomAround * std::max({size.x, size.y, size.z}));
    of_object.bounds_object.lo -= around;
    of_object.bounds_object.hi += around;
    return fitted(of_object, world_from_object);
}

Similarity beside_panel(const scene::SceneObject& object, const SeenFrom& from, const Similarity& world_from_object) {
    const Box bounds = bounds_in_scene(object);
    const Vec3 across = from.screen.lower_right_world - from.screen.lower_left_world;
    const double width_m = glm::length(across), free_m = from.free_width * width_m;
    const Vec3 right = across / width_m;
    if (bounds.empty() || from.free_width >= 1.0) return world_from_object;
    Similarity moved = world_from_object;
    // What is nearer to the eye moves farther in the picture than the middle does, so that a few rounds are needed.
    for (int round = 0; round < 8; ++round) {
        double left_m = width_m, right_m = 0.0, farther = 1.0;
        for (int i = 0; i < 8; ++i) {
            const Vec3 corner =
                moved * Vec3((i & 1) != 0 ? bounds.hi.x : bounds.lo.x, (i & 2) != 0 ? bounds.hi.y : bounds.lo.y,
                             (i & 4) != 0 ? bounds.hi.z : bounds.lo.z);
            const double to_screen_m = wall::distance_in_front(from.screen, from.eye_world),
                         away_m = to_screen_m - wall::distance_in_front(from.screen, corner);
            if (away_m <= 0.0) return world_from_object;  // beside the eye: there is no picture of it
            const double x = wall::point_on_screen(from.screen, from.eye_world, corner).x;
            left_m = std::min(left_m, x);
            if (x > right_m) farther = away_m / to_screen_m;
            right_m = std::max(right_m, x);
        }
        double too_far_m = std::min(right_m - free_m, std::max(left_m, 0.0));
        if (left_m < 0.0 && right_m < free_m) too_far_m = std::max(left_m, right_m - free_m);  // to the left
        if (std::abs(too_far_m) <= 1e-6 * width_m) break;
        moved.position_m -= farther * too_far_m * right;
    }
    return moved;
}

CursorView cursor_of(const ViewedSession& seen, const StepView& view, const wall::OutputPlace& output) {
    const std::size_t main = seen.desk.wall.main;
    const View sight = seen.view_of(main);
    const HandState& hand = seen.state.led();
    Similarity world_from_device = hand.world_from_device;
    world_from_device.scale *= hand.workspace_gain;
    if (view.tool.tick > 0) world_from_device = seen.state.world_from_object * view.tool.workspace.object_from_device;
    return {seen.output_on(main), output, sight.screen, wall::middle_of(wall::eyes_of(sight.viewer)),
            inverse(world_from_device)};
}

}  // namespace burin::session
