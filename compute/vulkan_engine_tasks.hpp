// SPDX-License-Identifier: MIT
// Which rays a cut has to visit, as work groups for shaders/cut_rays.comp.
//
// Each axis is covered in the cheaper of two ways: as one rectangle around all capsules, whose rays look at every capsule
// (best for a step of a stroke), or as tiles of 8 x 8 rays that each look only at the capsules above them (best for a
// long stroke at once). Every ray in a capsule's footprint is in exactly one task; its list names that capsule, in order.
#pragma once

#include <span>
#include <vector>

#include "compute/lattice.hpp"
#include "compute/sweep_units.hpp"
#include "shaders/shared/cut_job.h"

namespace burin {

struct CutTasks {
    std::vector<shared::CutTask> tasks;
    std::vector<std::uint32_t> order;  // indices of capsules; the first of them all capsules in order
};

// Cost: time and memory O(capsules + rays visited), and while its lists stay below 4 million entries O(capsules x tiles).
[[nodiscard]] CutTasks cut_tasks(const Lattice& lattice, std::span<const shared::Capsule> capsules);

}  // namespace burin
