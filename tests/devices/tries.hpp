// SPDX-License-Identifier: MIT
// What a busy machine may need several tries for, as it keeps an emulated device from its steps.
#pragma once

#include <chrono>
#include <thread>
#include <utility>

#include "base/clock.hpp"

namespace burin::devices {

// What a busy machine never keeps a thread from its steps for; an emulator that is as silent has ended.
inline constexpr Nanoseconds kEnded_ns = 60'000'000'000;

// Tries until it comes out, for a minute at most, and returns what the last try gave.
template <typename Try>
[[nodiscard]] auto tried(Try try_once) {
    auto given = try_once();
    for (int i = 0; i < 6000 && !given; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        given = try_once();
    }
    return given;
}

}  // namespace burin::devices
