// SPDX-License-Identifier: MIT
// The smaller and the larger of two vectors, component by component. As glm::min and glm::max, which go through a pointer to a
// function that GCC does not see through: that was half the time of a search.
#pragma once

#include "base/space.hpp"

namespace burin {

template <typename T>
[[nodiscard]] constexpr glm::vec<3, T> lower_of(const glm::vec<3, T>& a, const glm::vec<3, T>& b) noexcept {
    return {b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z};
}
template <typename T>
[[nodiscard]] constexpr glm::vec<3, T> upper_of(const glm::vec<3, T>& a, const glm::vec<3, T>& b) noexcept {
    return {a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z};
}

}  // namespace burin
