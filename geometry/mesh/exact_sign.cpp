// SPDX-License-Identifier: MIT
#include "geometry/mesh/exact_sign.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace burin::geometry {
namespace {

struct Pair {
    double high, low;  // an exact value: the rounded one and the rounding error
};

Pair exact_sum(double a, double b) {
    const double sum = a + b, of_b = sum - a, of_a = sum - of_b;
    return {sum, (a - of_a) + (b - of_b)};
}

Pair exact_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

// A number as the exact sum of doubles that do not overlap, the smallest first.
class Expansion {
public:
    Expansion() = default;
    explicit Expansion(const Pair& value) { *this += value.low, *this += value.high; }

    Expansion& operator+=(double b) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const Pair s = exact_sum(b, parts_[i]);
            b = s.high;
            if (s.low != 0.0) parts_[kept++] = s.low;
        }
        if (b != 0.0) parts_[kept++] = b;
        count_ = kept;
        return *this;
    }
    // Adds e * factor * sign.
    void add_product(const Expansion& e, double factor, double sign) {
        for (std::size_t i = 0; i < e.count_; ++i) {
            const Pair p = exact_product(e.parts_[i], sign * factor);
            *this += p.low;
            *this += p.high;
        }
    }
    [[nodiscard]] int sign() const {
        if (count_ == 0) return 0;
        return parts_[count_ - 1] > 0.0 ? 1 : -1;
    }

private:
    static constexpr std::size_t kMost = 192;  // three products of three differences: 3 * 2 * (2 * 2 * 2) * 2 * 2
    std::array<double, kMost> parts_;
    std::size_t count_ = 0;
};

// Returns the exact difference of two numbers.
Pair exact_difference(double a, double b) { return exact_sum(a, -b); }

// Returns a1 * b2 - a2 * b1 exactly.
Expansion exact_cross(const Pair& a1, const Pair& a2, const Pair& b1, const Pair& b2) {
    Expansion result;
    const Expansion first(a1), second(a2);
    for (const double b : {b2.low, b2.high}) result.add_product(first, b, 1.0);
    for (const double b : {b1.low, b1.high}) result.add_product(second, b, -1.0);
    return result;
}

struct ExactVector {
    std::array<Pair, 3> v;
};

ExactVector exact_difference(const Vec3& a, const Vec3& b) {
    return {{exact_difference(a.x, b.x), exact_difference(a.y, b.y), exact_difference(a.z, b.z)}};
}

int exact_side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const ExactVector u = exact_difference(b, a), v = exact_difference(c, a), w = exact_difference(d, a);
    Expansion determinant;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        const Expansion cross = exact_cross(u.v[i], u.v[j], v.v[i], v.v[j]);
        determinant.add_product(cross, w.v[k].low, 1.0);
        determinant.add_product(cross, w.v[k].high, 1.0);
    }
    return determinant.sign();
}

int sign_of(double x) { return (x > 0.0 ? 1 : 0) - (x < 0.0 ? 1 : 0); }

// Shewchuk's error bounds for a determinant of rounded differences, relative to the sum of its products' magnitudes.
constexpr double kHalfUlp = 0x1p-53;
constexpr double kSpaceBound = (7.0 + 56.0 * kHalfUlp) * kHalfUlp;
constexpr double kPlaneBound = (3.0 + 16.0 * kHalfUlp) * kHalfUlp;

}  // namespace

int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - a, v = c - a, w = d - a;
    const double uy_vz = u.y * v.z, uz_vy = u.z * v.y, uz_vx = u.z * v.x, ux_vz = u.x * v.z, ux_vy = u.x * v.y,
                 uy_vx = u.y * v.x;
    const double estimate = w.x * (uy_vz - uz_vy) + w.y * (uz_vx - ux_vz) + w.z * (ux_vy - uy_vx);
    const double size = std::abs(w.x) * (std::abs(uy_vz) + std::abs(uz_vy)) +
                        std::abs(w.y) * (std::abs(uz_vx) + std::abs(ux_vz)) +
                        std::abs(w.z) * (std::abs(ux_vy) + std::abs(uy_vx));
    if (std::abs(estimate) > kSpaceBound * size) return sign_of(estimate);
    if (size == 0.0) return 0;  // a plane perpendicular to an axis: every product has a factor that is 0
    return exact_side(a, b, c, d);
}

int turn_in_plane(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double first = (b.x - a.x) * (c.y - a.y), second = (b.y - a.y) * (c.x - a.x);
    const double estimate = first - second, size = std::abs(first) + std::abs(second);
    if (std::abs(estimate) > kPlaneBound * size) return sign_of(estimate);
    if (size == 0.0) return 0;
    return exact_cross(exact_difference(b.x, a.x), exact_difference(b.y, a.y), exact_difference(c.x, a.x),
                       exact_difference(c.y, a.y))
        .sign();
}

int turn_seen_along(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
    const int right = (axis + 1) % 3, up = (axis + 2) % 3;
    return turn_in_plane({a[right], a[up]}, {b[right], b[up]}, {c[right], c[up]});
}

}  // namespace burin::geometry
