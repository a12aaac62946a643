// SPDX-License-Identifier: MIT
// What has changed in a window's picture since each of its images was shown last, so that only that is drawn into them again. One thread.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "renderer/image.hpp"

namespace burin {

class PresentedParts {
public:
    // The picture is another one now: in this part, or anywhere.
    void change(const PixelRect& part);
    void change_all();

    // What to draw into an image that was shown so many presentations ago (1: the last one; 0: never).
    struct Parts {
        bool whole = true;
        std::vector<PixelRect> parts;  // none overlaps another
    };
    [[nodiscard]] Parts since(std::uint64_t age) const;

    // The picture was shown as it is now.
    void presented();

private:
    Parts pending_;                // since the last presentation
    std::deque<Parts> presented_;  // what came with each, newest first
};

}  // namespace burin
