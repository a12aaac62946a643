// SPDX-License-Identifier: MIT
#include "renderer/surface/range_allocator.hpp"

#include <iterator>

#include "base/error.hpp"

namespace burin::renderer {

std::optional<std::uint32_t> RangeAllocator::allocate(std::uint32_t size) {
    BURIN_CHECK(size > 0);
    for (auto range = free_.begin(); range != free_.end(); ++range) {
        const auto [first, available] = *range;
        if (available < size) continue;
        free_.erase(range);
        if (available > size) free_.emplace(first + size, available - size);
        free_elements_ -= size;
        return first;
    }
    return std::nullopt;
}

void RangeAllocator::release(std::uint32_t first, std::uint32_t size) {
    BURIN_CHECK(size > 0 && first + size <= capacity_);
    free_elements_ += size;
    auto next = free_.lower_bound(first);
    BURIN_CHECK(next == free_.end() || first + size <= next->first);
    if (next != free_.end() && next->first == first + size) {
        size += next->second;
        next = free_.erase(next);
    }
    if (next != free_.begin()) {
        const auto previous = std::prev(next);
        BURIN_CHECK(previous->first + previous->second <= first);
        if (previous->first + previous->second == first) {
            previous->second += size;
            return;
        }
    }
    free_.emplace(first, size);
}

void RangeAllocator::grow(std::uint32_t capacity) {
    if (capacity <= capacity_) return;
    const std::uint32_t first = capacity_;
    capacity_ = capacity;
    release(first, capacity - first);
}

}  // namespace burin::renderer
