// SPDX-License-Identifier: MIT
#include "bodies/solver/dent_law.hpp"

#include <algorithm>
#include <cmath>

namespace burin::bodies {
namespace {

// Newton's steps to the root. Between its bounds the function is monotone, and they suffice to the last few bits.
constexpr int kRootSteps = 8;

// The u between low and high where u^2 - c u^3 = depth.
double root_of_dent(double c, double depth_m, double low, double high) {
    double u = std::min(high, low / std::sqrt(std::max(1.0 - c * low, 0.25)));
    for (int i = 0; i < kRootSteps; ++i) {
        const double over = u * u * (1.0 - c * u) - depth_m, slope = u * (2.0 - 3.0 * c * u);
        (over > 0.0 ? high : low) = u;
        const double next = u - over / slope;
        u = next >= low && next <= high ? next : 0.5 * (low + high);
    }
    return u;
}

}  // namespace

// With u^2 the way of ball and body together, F = H u^3 and depth = u^2 - c u^3, c = mesh_m_per_N * H.
DentForce DentLaw::at(double depth_m) const noexcept {
    if (!(depth_m > 0.0)) return {};
    const double h = hertz_N_per_m32, bound = stiffest_N_per_m;
    if (!(h > 0.0)) return {bound * depth_m, bound};
    const double c = mesh_m_per_N * h;
    // There the slope, 3 h u / (2 - 3 c u), is the bound.
    const double most = 2.0 * bound / (3.0 * (h + c * bound)), most_m = most * most * (1.0 - c * most);
    if (depth_m >= most_m) return {h * most * most * most + bound * (depth_m - most_m), bound};
    const double u = root_of_dent(c, depth_m, std::sqrt(depth_m), most);
    return {h * u * u * u, 3.0 * h * u / (2.0 - 3.0 * c * u)};
}

}  // namespace burin::bodies
