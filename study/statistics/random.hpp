// SPDX-License-Identifier: MIT
// Random numbers that are the same on every machine for the same seed, as long as its logarithm and cosine are: the
// standard library's distributions differ between its vendors. Each stream (a simulated study, a draw) has a generator
// of its own, so that results do not depend on which thread runs it. Not for secrets.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace burin::study {

// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
class Random {
public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_(seed) {
        // Scrambles the two apart, so that neighbouring streams do not run along each other.
        state_ = next() + stream;
        state_ = next();
    }

    [[nodiscard]] std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    // Uniform in (0, 1), with 53 bits.
    [[nodiscard]] double uniform() { return (static_cast<double>(next() >> 11) + 0.5) * 0x1p-53; }

    // Uniform in 0 .. count - 1. The bias is below count / 2^53.
    [[nodiscard]] std::size_t below(std::size_t count) {
        return static_cast<std::size_t>(uniform() * static_cast<double>(count));
    }

    // Standard normal (Box and Muller, "A note on the generation of random normal deviates", 1958).
    [[nodiscard]] double normal() {
        const double radius = std::sqrt(-2.0 * std::log(uniform()));
        return radius * std::cos(2.0 * std::numbers::pi * uniform());
    }

private:
    std::uint64_t state_;
};

}  // namespace burin::study
