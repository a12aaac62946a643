// SPDX-License-Identifier: MIT
// Tracks the damage rectangles of a window's picture since each of its images was last shown, so that only these are
// drawn again. One thread.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "base/image.hpp"

namespace burin::session {

class PresentedParts {
public:
    // Marks a part of the picture, or all of it, as changed.
    void change(const PixelRect& part);
    void change_all();

    // Returns the parts to draw into an image that was shown so many presentations ago (1: the last one; 0: never).
    struct Parts {
        bool whole = true;
        std::vector<PixelRect> parts;  // disjoint
    };
    [[nodiscard]] Parts since(std::uint64_t age) const;

    // Records that the picture was shown as it is now.
    void presented();

private:
    Parts pending_;                // since the last presentation
    std::deque<Parts> presented_;  // parts of each presentation, newest first
};

}  // namespace burin::session
