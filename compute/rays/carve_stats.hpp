// SPDX-License-Identifier: MIT
// Counts the rays that an update has touched and changed. Plain data.
#pragma once

#include <cstdint>

namespace burin::compute {

struct CarveStats {
    // Number of rays of which the tool covers a part; except when filling, only rays that hold material count.
    std::uint64_t rays_touched = 0;
    std::uint64_t rays_changed = 0;  // number of rays whose ends differ afterwards
    CarveStats& operator+=(const CarveStats& other) {
        rays_touched += other.rays_touched;
        rays_changed += other.rays_changed;
        return *this;
    }
};

}  // namespace burin::compute
