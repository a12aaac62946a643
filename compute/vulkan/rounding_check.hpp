// SPDX-License-Identifier: MIT
// Whether a device rounds doubles as IEEE 754 asks for and the processor does.
//
// Vulkan lets a quotient and a root of doubles be as inexact as those of floats, and says nothing of how sums and
// products are rounded. Cards that have doubles do it right all the same, and kernels whose results have to equal the
// processor's to the bit (covered_rays.hpp) need that. So each device is asked once, with numbers for which an error of
// a millionth of a unit in the last place shows.
#pragma once

#include <span>
#include <vector>

#include "gpu/device.hpp"
#include "shaders/shared/rounding_case.h"

namespace burin::compute {

// Numbers and what the processor makes of them.
struct CheckedRounding {
    shared::RoundingCase numbers;
    shared::RoundedDoubles rounded;
};

// Returns 4096 cases. Their quotients and roots lie next to half-way between two doubles: at most one part in 2^40 of
// the distance of these doubles away from it.
[[nodiscard]] std::vector<CheckedRounding> hard_roundings();

// Fails where the device computes any of these otherwise, naming the first. Needs doubles in shaders. Cost: one
// pipeline, one submission and a wait for it.
[[nodiscard]] Result<void> check_rounding(const gpu::Device& device, std::span<const CheckedRounding> cases);

}  // namespace burin::compute
