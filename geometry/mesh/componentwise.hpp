// SPDX-License-Identifier: MIT
// The smaller and the larger of two vectors, component by component. Replaces glm::min and glm::max, which call through
// a function pointer that GCC does not inline: that took half the time of a search.
#pragma once

#include "base/space.hpp"

namespace burin::geometry {

template <typename T>
[[nodiscard]] constexpr glm::vec<3, T> lower_of(const glm::vec<3, T>& a, const glm::vec<3, T>& b) noexcept {
    return {b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z};
}
template <typename T>
[[nodiscard]] constexpr glm::vec<3, T> upper_of(const glm::vec<3, T>& a, const glm::vec<3, T>& b) noexcept {
    return {a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z};
}

}  // namespace burin::geometry
