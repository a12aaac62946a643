// SPDX-License-Identifier: MIT
// What a busy machine may need several tries for, as it keeps an emulated device from its steps.
#pragma once

#include <chrono>
#include <thread>
#include <utility>

namespace burin::devices {

// Tries until it comes out, for ten seconds at most, and returns what the last try gave.
template <typename Try>
[[nodiscard]] auto tried(Try try_once) {
    auto given = try_once();
    for (int i = 0; i < 1000 && !given; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        given = try_once();
    }
    return given;
}

}  // namespace burin::devices
