// SPDX-License-Identifier: MIT
// Numbers that are the same on every machine (splitmix64, Steele, Lea and Flood 2014).
#pragma once

#include <cstdint>

namespace burin::bench {

class SplitMix {
public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}
    // Returns a number from -1 to 1.
    [[nodiscard]] double signed_unit() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
        return static_cast<double>(z >> 11) * 0x1.0p-52 - 1.0;
    }

private:
    std::uint64_t state_;
};

}  // namespace burin::bench
