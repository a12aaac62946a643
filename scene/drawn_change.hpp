// SPDX-License-Identifier: MIT
// A change of a scene's part on its way from the scene to whoever draws it, which knows its kind. Shared, immutable.
#pragma once

#include <memory>

namespace burin::scene {

// A change of a kind that this folder does not know, such as tiles of a carved surface: who draws it does.
class DrawnChange {
public:
    DrawnChange() = default;
    virtual ~DrawnChange() = default;
    DrawnChange(const DrawnChange&) = delete;
    DrawnChange& operator=(const DrawnChange&) = delete;
};

// Such a change on its way to whoever draws it.
using DrawnShare = std::shared_ptr<const DrawnChange>;

}  // namespace burin::scene
