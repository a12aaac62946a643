// SPDX-License-Identifier: MIT
// Where several windows stand on one monitor: side by side, in rows, all of them wholly on it. Pure; any thread.
#pragma once

#include <span>
#include <vector>

#include "base/image.hpp"

namespace burin::session {

struct PlacedWindow {
    int x = 0, y = 0;  // of the contents' upper left pixel, from the monitor's
    ImageSize size;
};

// Returns the windows as large as they are wanted where there is room for all of them, with space for their titles, and
// otherwise all smaller by one factor, down to a tenth.
[[nodiscard]] std::vector<PlacedWindow> side_by_side(std::span<const ImageSize> sizes, ImageSize monitor);

}  // namespace burin::session
