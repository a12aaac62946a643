// SPDX-License-Identifier: MIT
// Pictures of a world that is explored with a wand: where an object is first pressed, and at the end. Whoever wants
// them draws them. One thread.
#pragma once

#include <cstddef>

#include "activities/wand/felt_wand.hpp"
#include "activities/wand/wand_view.hpp"
#include "activities/world/touch_pictures.hpp"
#include "base/error.hpp"

namespace burin::activities {

class WandPictures {
public:
    // Without a drawer there are no pictures.
    WandPictures(const scene::World& world, const WandOptions& feel, PictureDrawer draw);

    [[nodiscard]] Result<void> at(const WandMoment& moment);
    [[nodiscard]] Result<void> finish();

private:
    [[nodiscard]] Result<void> draw(const std::string& file) const;

    WorldView view_;
    WandView avatar_;
    WandCamera camera_;
    PictureDrawer draw_;
    WandPose last_;
    std::size_t touched_ = 0;
};

}  // namespace burin::activities
