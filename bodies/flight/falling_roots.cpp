// SPDX-License-Identifier: MIT
#include "bodies/flight/falling_roots.hpp"

#include <algorithm>
#include <cmath>

namespace burin::bodies {
namespace {

struct AllRoots {
    std::array<double, 4> times{};
    std::size_t count = 0;
    void add(double t) {
        if (count < times.size()) times[count++] = t;
    }
};

Quartic derivative(const Quartic& f) { return {f[1], 2.0 * f[2], 3.0 * f[3], 4.0 * f[4], 0.0}; }

std::size_t degree_of(const Quartic& f) {
    std::size_t degree = 4;
    while (degree > 0 && f[degree] == 0.0) --degree;
    return degree;
}

// The one root between two places where the polynomial has different signs, to the last bit.
double enclosed_root(const Quartic& f, double above, double below) {
    for (;;) {
        const double middle = 0.5 * (above + below);
        if (middle == above || middle == below) return below;
        (value_at(f, middle) > 0.0 ? above : below) = middle;
    }
}

// All roots inside (0, until) at which the sign changes, rising.
AllRoots roots_within(const Quartic& f, std::size_t degree, double until) {
    AllRoots roots;
    if (degree == 0) return roots;
    if (degree == 1) {
        if (const double t = -f[0] / f[1]; t > 0.0 && t < until) roots.add(t);
        return roots;
    }
    if (degree == 2) {
        // Without cancellation: the sum of two numbers of one sign.
        const double square = f[1] * f[1] - 4.0 * f[2] * f[0];
        if (!(square > 0.0)) return roots;
        const double sum = -0.5 * (f[1] + std::copysign(std::sqrt(square), f[1]));
        double one = sum / f[2], other = f[0] / sum;
        if (other < one) std::swap(one, other);
        if (one > 0.0 && one < until) roots.add(one);
        if (other > 0.0 && other < until && other != one) roots.add(other);
        return roots;
    }
    const AllRoots turns = roots_within(derivative(f), degree - 1, until);
    double from = 0.0;
    for (std::size_t i = 0; i <= turns.count; ++i) {
        const double to = i < turns.count ? turns.times[i] : until;
        const bool above_from = value_at(f, from) > 0.0, above_to = value_at(f, to) > 0.0;
        if (above_from != above_to) roots.add(above_from ? enclosed_root(f, from, to) : enclosed_root(f, to, from));
        from = to;
    }
    return roots;
}

// Whether it goes down right behind 0: by the first derivative that is more than rounding.
bool falls_at_begin(const Quartic& f) {
    for (std::size_t i = 1; i < f.size(); ++i)
        if (std::abs(f[i]) > kLeastFall) return f[i] < 0.0;
    return false;
}

}  // namespace

FallingRoots falling_roots(const Quartic& f, double until) {
    FallingRoots falling;
    const auto add = [&](double t) {
        if (falling.count < falling.times.size()) falling.times[falling.count++] = t;
    };
    if (f[0] <= 0.0 && falls_at_begin(f)) add(0.0);
    const Quartic slope = derivative(f);
    const AllRoots roots = roots_within(f, degree_of(f), until);
    for (std::size_t i = 0; i < roots.count; ++i)
        if (value_at(slope, roots.times[i]) < -kLeastFall) add(roots.times[i]);
    return falling;
}

}  // namespace burin::bodies
