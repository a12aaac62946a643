// SPDX-License-Identifier: MIT
// Whether two screens share room. Screens that meet at an edge do not. World frame, metres; pure, any thread.
#pragma once

#include <cstdint>

#include "renderer/scene.hpp"

namespace burin {

enum class Overlap : std::uint8_t {
    none,
    lying_on,  // in one plane, as projectors' pictures that are blended
    crossing,  // one passes through the other
};

// Within 1 cm counts as touching: a side may be that much longer than measured.
[[nodiscard]] Overlap overlap_of(const Screen& a, const Screen& b);

}  // namespace burin
