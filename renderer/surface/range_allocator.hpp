// SPDX-License-Identifier: MIT
// Allocates ranges of elements within a large buffer: first fit, free neighbours merged. Pure bookkeeping, any unit;
// one thread. Cost: O(free ranges) to allocate, O(log) to release.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace burin::renderer {

class RangeAllocator {
public:
    explicit RangeAllocator(std::uint32_t capacity = 0) { grow(capacity); }

    // Takes a free range of this size and returns its first element; nullopt when none is large enough.
    [[nodiscard]] std::optional<std::uint32_t> allocate(std::uint32_t size);
    // Releases a range exactly as allocate returned it.
    void release(std::uint32_t first, std::uint32_t size);
    // Adds free elements at the end; a smaller capacity changes nothing.
    void grow(std::uint32_t capacity);

    [[nodiscard]] std::uint32_t capacity() const { return capacity_; }
    [[nodiscard]] std::uint32_t free_elements() const { return free_elements_; }

private:
    std::map<std::uint32_t, std::uint32_t> free_;  // first -> size; no two are adjacent
    std::uint32_t capacity_ = 0;
    std::uint32_t free_elements_ = 0;
};

}  // namespace burin::renderer
