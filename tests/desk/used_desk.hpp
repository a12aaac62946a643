// SPDX-License-Identifier: MIT
// A desk that is used step by step.
#pragma once

#include <vector>

#include "desk/input/desk_input.hpp"

namespace burin::session {

inline constexpr double kFrame_s = 1.0 / 60.0;

class UsedDesk {
public:
    DeskSettings settings;
    DeskView view;
    DeskState state = desk_at_home(settings);
    Similarity world_from_scene;

    // Has the mouse lead the tool along a surface, of which nothing is known.
    void follow_surface() {
        static const SeenSurface kNone;
        view.surface.emplace();
        view.surface->seen = &kNone;
    }

    DeskStep step(const std::vector<Input>& inputs = {}, double dt_s = kFrame_s) {
        std::vector<InputEvent> events;
        for (const Input& input : inputs) events.push_back({0, input});
        view.scene_scale = world_from_scene.scale;
        DeskStep done = step_desk(state, events, dt_s, view, settings);
        state = done.state;
        world_from_scene = done.scene_change * world_from_scene;
        return done;
    }
};

inline double apart(const Vec3& a, const Vec3& b) { return glm::length(a - b); }

}  // namespace burin::session
