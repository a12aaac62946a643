// SPDX-License-Identifier: MIT
// Numbers positions so that equal ones get one number. Equal means bit for bit, -0 counting as 0, with no tolerance.
// Amortised constant time for each position; numbers do not depend on the hash.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/space.hpp"

namespace burin::geometry {

class VertexWeld {
public:
    explicit VertexWeld(std::vector<Vec3>& positions) : positions_(positions), slots_(1024, kEmpty) {}

    // Returns the number of the position, which is appended when it is new. Requires finite coordinates.
    std::uint32_t index_of(Vec3 p) {
        p += 0.0;  // -0 + 0 is 0
        if (2 * positions_.size() >= slots_.size()) grow();
        std::size_t slot = hash(p) & (slots_.size() - 1);
        while (slots_[slot] != kEmpty) {
            if (positions_[slots_[slot]] == p) return slots_[slot];
            slot = (slot + 1) & (slots_.size() - 1);
        }
        slots_[slot] = static_cast<std::uint32_t>(positions_.size());
        positions_.push_back(p);
        return slots_[slot];
    }

private:
    static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();

    // Hashes by multiplying and folding; the odd constants are arbitrary bits (the fractions of sqrt 2, sqrt 3 and sqrt
    // 5).
    static std::size_t hash(const Vec3& p) {
        std::uint64_t h = std::bit_cast<std::uint64_t>(p.x) * 0x6A09E667F3BCC909u;
        h = (h ^ h >> 32 ^ std::bit_cast<std::uint64_t>(p.y)) * 0xBB67AE8584CAA73Bu;
        h = (h ^ h >> 32 ^ std::bit_cast<std::uint64_t>(p.z)) * 0x3C6EF372FE94F82Bu;
        return static_cast<std::size_t>(h ^ h >> 32);
    }

    void grow() {
        slots_.assign(2 * slots_.size(), kEmpty);
        for (std::uint32_t i = 0; i < positions_.size(); ++i) {
            std::size_t slot = hash(positions_[i]) & (slots_.size() - 1);
            while (slots_[slot] != kEmpty) slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = i;
        }
    }

    std::vector<Vec3>& positions_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace burin::geometry
