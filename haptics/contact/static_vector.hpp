// SPDX-License-Identifier: MIT
// A vector of bounded size on the stack whose elements are uninitialized until they are put, so that construction costs
// nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

namespace burin::haptics {

template <typename T, std::uint32_t kMost>
class StaticVector {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    StaticVector() noexcept {}
    // Sets element i, i < kMost.
    void put(std::uint32_t i, const T& value) noexcept { std::construct_at(data() + i, value); }
    // Reads an element; it must have been put.
    [[nodiscard]] T& operator[](std::uint32_t i) noexcept { return data()[i]; }
    [[nodiscard]] const T& operator[](std::uint32_t i) const noexcept { return data()[i]; }
    [[nodiscard]] std::span<const T> first(std::uint32_t count) const noexcept { return {data(), count}; }

private:
    [[nodiscard]] T* data() noexcept { return reinterpret_cast<T*>(bytes_); }
    [[nodiscard]] const T* data() const noexcept { return reinterpret_cast<const T*>(bytes_); }
    alignas(T) std::byte bytes_[sizeof(T) * kMost];
};

}  // namespace burin::haptics
