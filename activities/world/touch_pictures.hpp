// SPDX-License-Identifier: MIT
// Pictures of a world that is explored by touch: how it stands at first, each object as it is first pressed, and in the
// end the whole on the wall. Whoever wants them draws them. One thread.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "activities/world/felt_world.hpp"
#include "activities/world/world_view.hpp"
#include "base/error.hpp"

namespace burin::activities {

// Takes a picture and its file's name.
using PictureDrawer = std::function<Result<void>(const picture::Picture&, const std::string& file)>;

// The beginning of an object's name as a file's name may have it: letters, digits, dashes.
[[nodiscard]] std::string file_word(const std::string& name);

class TouchPictures {
public:
    // `radius_m`: of the ball that touches. Without a drawer there are no pictures.
    TouchPictures(const scene::World& world, double radius_m, PictureDrawer draw);

    // Draws the first moment, and those with an object newly touched as long as they are not too many.
    [[nodiscard]] Result<void> at(const WorldMoment& moment);
    // Returns the world on the wall as it is now, for a viewer with two eyes.
    [[nodiscard]] picture::Picture on_wall(const haptics::ToolState& tool) const { return view_.wall_scene(tool); }

private:
    WorldView view_;
    PictureDrawer draw_;
    std::size_t touched_ = 0;
    bool has_begun_ = false;
};

}  // namespace burin::activities
