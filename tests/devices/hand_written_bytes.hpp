// SPDX-License-Identifier: MIT
// Bytes of a wire as a test writes them out by hand, from the protocol's text and not from the code under test.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace burin::devices {

// Each number is one byte, below 256.
[[nodiscard]] inline std::vector<std::byte> hand_written(std::initializer_list<unsigned> numbers) {
    std::vector<std::byte> bytes;
    for (const unsigned number : numbers) bytes.push_back(static_cast<std::byte>(number));
    return bytes;
}

}  // namespace burin::devices
