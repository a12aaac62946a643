// SPDX-License-Identifier: MIT
// Times at which a polynomial of degree four or less falls through zero: when a ball on a parabola comes to a plane
// (degree two), to a round edge or corner, or to a moving hand (four). Between the roots of its derivative a polynomial
// is monotone, so each root is enclosed before it is looked for and none is passed over.
// Units: as the caller's. Pure; any thread; no heap.
#pragma once

#include <array>
#include <cstddef>

namespace burin::bodies {

// Coefficients by rising powers.
using Quartic = std::array<double, 5>;

[[nodiscard]] inline double value_at(const Quartic& f, double t) {
    return f[0] + t * (f[1] + t * (f[2] + t * (f[3] + t * f[4])));
}

struct FallingRoots {
    std::array<double, 3> times{};  // rising
    std::size_t count = 0;
};
// Returns where the polynomial comes to 0 or below from above, from 0 to `until`. A polynomial that is 0 or below at 0
// already and falls there has its first root at 0. One that touches zero and rises again has none there; nor has one
// that falls slower than kLeastFall, which is the rounding of something that goes along the surface.
inline constexpr double kLeastFall = 1e-12;
[[nodiscard]] FallingRoots falling_roots(const Quartic& f, double until);

}  // namespace burin::bodies
