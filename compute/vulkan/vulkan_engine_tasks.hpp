// SPDX-License-Identifier: MIT
// The rays that a cut visits, as work groups for shaders/cut_rays.comp.
//
// Each axis is covered in the cheaper of two ways: as one rectangle around all capsules, in which every ray tests every
// capsule (best for a step of a stroke), or as tiles of 8 x 8 rays that each test only the capsules above them (best
// for a long stroke at once). Every ray in a capsule's footprint is in exactly one task, whose list names that capsule;
// lists are in order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compute/rays/lattice.hpp"
#include "compute/tools/sweep_units.hpp"
#include "shaders/shared/cut_job.h"

namespace burin::compute {

// Work groups that take so many rays.
[[nodiscard]] constexpr std::uint32_t groups_of(std::uint32_t rays) {
    return (rays + shared::kCutGroup - 1) / shared::kCutGroup;
}

constexpr std::uint32_t kMostTaskGroups = 1024;

struct CutTasks {
    std::vector<shared::CutTask> tasks;
    std::vector<std::uint32_t> order;  // indices of capsules; begins with a list of all of them in order
};

// Makes the tasks of a cut, each of no more work groups than this and kMostTaskGroups, or of one row. Their first_group
// is left to whoever puts them into a pass. Takes time and memory O(capsules + rays visited) and, while its lists stay
// below 4 million entries, O(capsules x tiles).
[[nodiscard]] CutTasks cut_tasks(const Lattice& lattice, std::span<const shared::Capsule> capsules,
                                 std::uint32_t most_groups);

// Appends the tasks of one pass, and returns how many work groups they are.
std::uint32_t append_pass(std::span<const shared::CutTask> of_pass, std::vector<shared::CutTask>& tasks);

}  // namespace burin::compute
