// SPDX-License-Identifier: MIT
// What may be wrong with the stereo modes of a wall, beside its geometry (check() in renderer/stereo/wall.hpp): an unknown one, one that does
// not go with the way in which a display is driven. Pure; any thread.
#pragma once

#include <vector>

#include "renderer/stereo/wall.hpp"

namespace burin {

[[nodiscard]] std::vector<WallProblem> check_modes(const WallSetup& setup);

}  // namespace burin
