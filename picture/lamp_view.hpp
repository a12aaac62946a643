// SPDX-License-Identifier: MIT
// The objects that cast shadows, as the lamp sees them: where its picture of them, the shadow map, lies in the world.
// Its size and place change in steps, so that the shadows' edges hold still while one object of many moves.
// Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "picture/picture.hpp"

namespace burin::picture {

inline constexpr std::uint32_t kShadowMapSide = 1024;  // texels

struct LampView {
    Mat4 map_from_world{1.0};  // x and y -1 to 1 in the map, z 0 to 1 away from the lamp
    double side_m = 0.0;       // of the map
    double deep_m = 0.0;       // from z = 0 to 1
    Box casters_world;         // around all that casts a shadow
    std::vector<const DrawnObject*> casters;
};

// Returns none where no object casts a shadow, and where capsules cast them in closed form (Picture::capsules): each of
// an activity's objects would have two. What lies beyond the map is lit.
[[nodiscard]] std::optional<LampView> lamp_view(const Picture& picture);

}  // namespace burin::picture
