// SPDX-License-Identifier: MIT
// A step of undo: an object as it was before and after, which nobody changes. Plain data.
#pragma once

#include <memory>

namespace burin::scene {

struct SceneObject;  // scene/scene_object.hpp

struct ObjectStep {
    std::shared_ptr<const SceneObject> before, after;
};

}  // namespace burin::scene
