// SPDX-License-Identifier: MIT
// Room for a bounded number of things on the stack, none of which is there until it is put: making room costs nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

namespace burin {

template <typename T, std::uint32_t kMost>
class Room {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    Room() noexcept {}
    // Index below kMost.
    void put(std::uint32_t i, const T& value) noexcept { std::construct_at(data() + i, value); }
    // Of what was put.
    [[nodiscard]] T& operator[](std::uint32_t i) noexcept { return data()[i]; }
    [[nodiscard]] const T& operator[](std::uint32_t i) const noexcept { return data()[i]; }
    [[nodiscard]] std::span<const T> first(std::uint32_t count) const noexcept { return {data(), count}; }

private:
    [[nodiscard]] T* data() noexcept { return reinterpret_cast<T*>(bytes_); }
    [[nodiscard]] const T* data() const noexcept { return reinterpret_cast<const T*>(bytes_); }
    alignas(T) std::byte bytes_[sizeof(T) * kMost];
};

}  // namespace burin
