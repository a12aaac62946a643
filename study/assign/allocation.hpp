// SPDX-License-Identifier: MIT
// Random allocation to groups in permuted blocks within strata. A list depends on the seed, the stratum and the
// protocol's groups and blocks alone, and is the same on every machine: it is made with integers and with products of
// doubles that IEEE 754 rounds in one way. Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "study/protocol/protocol.hpp"

namespace burin::study {

struct AllocationPlace {
    std::size_t block = 0;  // counted from 1, within the stratum
    std::size_t group = 0;  // index into the groups
};

// The first `places` places of a stratum's list. A block of size b holds b ratio / (sum of ratios) places of each
// group, in random order; where there are several sizes, each block's is drawn. Every ratio is above 0 and every size a
// multiple of their sum.
[[nodiscard]] std::vector<AllocationPlace> allocate(std::span<const unsigned> ratios, std::span<const unsigned> blocks,
                                                    std::uint64_t seed, std::uint64_t stratum, std::size_t places);

// A combination of codes, one of each of the protocol's strata, in order; empty where there are none.
[[nodiscard]] std::vector<std::vector<std::string>> combinations(std::span<const Stratum> strata);
// "l/old"; "all" for the empty combination.
[[nodiscard]] std::string stratum_label(std::span<const std::string> codes);

}  // namespace burin::study
