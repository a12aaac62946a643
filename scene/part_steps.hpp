// SPDX-License-Identifier: MIT
// What a part of a scene says of its steps: each is what one undo takes back. A part numbers its own, one after the
// other, and goes back and forward by itself; in which order the steps of several parts go is the history's
// (document/history.hpp). Plain data.
#pragma once

#include <cstdint>

namespace burin::scene {

// Those numbered first to done lead back, the last of them first; those behind, up to last, lead forward. One that has
// begun and not ended is the last of done.
struct PartSteps {
    std::int64_t first = 1, done = 0, last = 0;
    std::uint64_t made = 0;    // how many have been begun
    std::uint64_t walked = 0;  // how many orders to go have been carried out

    bool operator==(const PartSteps&) const = default;
};

// forget: what was taken back will not be repeated.
enum class StepWay : std::uint8_t { back, forward, forget };

}  // namespace burin::scene
