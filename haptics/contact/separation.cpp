// SPDX-License-Identifier: MIT
#include "haptics/contact/separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace burin::haptics {
namespace {

// Enough for round pieces at the tolerances used; where it is not, the best plane found so far is returned.
constexpr std::uint32_t kMostSupports = 40;
// The origin lies in the difference where it is nearer to it than this share of the difference's extent.
constexpr double kTogether = 1e-12;

// The place of the piece farthest along a direction.
Vec3 farthest(const ToolShape& shape, const ConvexPiece& piece, const Vec3& along) {
    const std::span<const Vec3> corners = shape.corners_of(piece);
    if (piece.turned) {
        const double across = std::sqrt(along.x * along.x + along.z * along.z);
        std::size_t best = 0;
        double most = -HUGE_VAL;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const double d = corners[i].x * across + corners[i].y * along.y;
            if (d > most) most = d, best = i;
        }
        const double share = across > 0.0 ? corners[best].x / across : 0.0;
        return {share * along.x, corners[best].y, share * along.z};
    }
    std::size_t best = 0;
    double most = -HUGE_VAL;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double d = glm::dot(corners[i], along);
        if (d > most) most = d, best = i;
    }
    return corners[best];
}

const Vec3& farthest(const geometry::Triangle& t, const Vec3& along) {
    const double a = glm::dot(t.a, along), b = glm::dot(t.b, along), c = glm::dot(t.c, along);
    return a >= b ? (a >= c ? t.a : t.c) : (b >= c ? t.b : t.c);
}

// A corner of the difference, and the place of the triangle that it comes from.
struct Corner {
    Vec3 w{0.0}, on_triangle{0.0};
};

// Up to three corners of the difference, and the weights of their place nearest to the origin.
class Simplex {
public:
    explicit Simplex(const Corner& a) { keep(a); }

    [[nodiscard]] Vec3 nearest() const {
        Vec3 sum = weights_[0] * corners_[0].w;
        for (std::size_t i = 1; i < count_; ++i) sum += weights_[i] * corners_[i].w;
        return sum;
    }
    [[nodiscard]] Vec3 on_triangle() const {
        Vec3 sum = weights_[0] * corners_[0].on_triangle;
        for (std::size_t i = 1; i < count_; ++i) sum += weights_[i] * corners_[i].on_triangle;
        return sum;
    }
    [[nodiscard]] bool holds(const Vec3& w) const {
        for (std::size_t i = 0; i < count_; ++i)
            if (corners_[i].w == w) return true;
        return false;
    }
    // Takes in one more corner, and keeps those that bear the nearest place. False: the origin lies inside.
    [[nodiscard]] bool add(const Corner& d) {
        const std::array<Corner, 3> c = corners_;
        switch (count_) {
            case 1: to_nearest_of(c[0], d); return true;
            case 2: to_nearest_of(c[0], c[1], d); return true;
            default: return add_fourth(c, d);
        }
    }

private:
    void keep(const Corner& a) { corners_[0] = a, weights_[0] = 1.0, count_ = 1; }

    void to_nearest_of(const Corner& a, const Corner& b) {
        const Vec3 ab = b.w - a.w;
        const double length2 = glm::dot(ab, ab), t = -glm::dot(a.w, ab);
        if (!(t > 0.0)) return keep(a);
        if (t >= length2) return keep(b);
        corners_[0] = a, corners_[1] = b, count_ = 2;
        weights_[1] = t / length2;
        weights_[0] = 1.0 - weights_[1];
    }

    // After Ericson, Real-Time Collision Detection, 5.1.5.
    void to_nearest_of(const Corner& a, const Corner& b, const Corner& c) {
        const Vec3 ab = b.w - a.w, ac = c.w - a.w;
        const double d1 = -glm::dot(ab, a.w), d2 = -glm::dot(ac, a.w);
        if (d1 <= 0.0 && d2 <= 0.0) return keep(a);
        const double d3 = -glm::dot(ab, b.w), d4 = -glm::dot(ac, b.w);
        if (d3 >= 0.0 && d4 <= d3) return keep(b);
        const double vc = d1 * d4 - d3 * d2;
        if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return to_nearest_of(a, b);
        const double d5 = -glm::dot(ab, c.w), d6 = -glm::dot(ac, c.w);
        if (d6 >= 0.0 && d5 <= d6) return keep(c);
        const double vb = d5 * d2 - d1 * d6;
        if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return to_nearest_of(a, c);
        const double va = d3 * d6 - d5 * d4;
        if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return to_nearest_of(b, c);
        const double sum = va + vb + vc;
        if (!(sum > 0.0)) return to_nearest_side_of(a, b, c);
        corners_ = {a, b, c};
        weights_ = {va / sum, vb / sum, vc / sum};
        count_ = 3;
    }

    // Of three corners on one line.
    void to_nearest_side_of(const Corner& a, const Corner& b, const Corner& c) {
        Simplex best = *this;
        double least2 = HUGE_VAL;
        for (const auto& [from, to] : {std::pair{&a, &b}, {&a, &c}, {&b, &c}}) {
            to_nearest_of(*from, *to);
            const Vec3 v = nearest();
            if (glm::dot(v, v) < least2) least2 = glm::dot(v, v), best = *this;
        }
        *this = best;
    }

    // The nearest of the tetrahedron's faces beyond which the origin lies.
    bool add_fourth(const std::array<Corner, 3>& c, const Corner& d) {
        Simplex best = *this;
        double least2 = HUGE_VAL;
        const auto look = [&](const Corner& p, const Corner& q, const Corner& r, const Corner& opposite) {
            const Vec3 n = glm::cross(q.w - p.w, r.w - p.w);
            if (-glm::dot(p.w, n) * glm::dot(opposite.w - p.w, n) > 0.0) return;
            to_nearest_of(p, q, r);
            const Vec3 v = nearest();
            if (glm::dot(v, v) < least2) least2 = glm::dot(v, v), best = *this;
        };
        look(c[0], c[1], d, c[2]);
        look(c[0], c[2], d, c[1]);
        look(c[1], c[2], d, c[0]);
        look(c[0], c[1], c[2], d);
        *this = best;
        return least2 < HUGE_VAL;
    }

    std::array<Corner, 3> corners_;
    std::array<double, 3> weights_{};
    std::size_t count_ = 0;
};

}  // namespace

double lowest(const ToolShape& shape, const ConvexPiece& piece, const Vec3& normal) noexcept {
    return glm::dot(farthest(shape, piece, -normal), normal);
}

Vec3 lowest_place(const ToolShape& shape, const ConvexPiece& piece, const Vec3& normal) noexcept {
    return farthest(shape, piece, -normal);
}

Separation separation(const ToolShape& shape, const ConvexPiece& piece, const geometry::Triangle& t,
                      const SeparationQuery& query) noexcept {
    Separation result;
    result.gap_m = -HUGE_VAL;
    const auto corner_against = [&](const Vec3& v) {
        ++result.supports;
        const Vec3& on_triangle = farthest(t, v);
        return Corner{query.at + farthest(shape, piece, -v) - on_triangle, on_triangle};
    };
    Simplex simplex(corner_against(query.guess));
    Vec3 v = simplex.nearest();
    const double extent2 = glm::dot(v, v);
    while (result.supports < kMostSupports) {
        const double length2 = glm::dot(v, v);
        if (!(length2 > kTogether * kTogether * extent2)) break;
        const double length = std::sqrt(length2);
        const Corner corner = corner_against(v);
        const double gap = glm::dot(v, corner.w) / length;
        if (gap > result.gap_m) {
            result.gap_m = gap;
            result.normal = v / length;
            result.on_triangle = simplex.on_triangle();
        }
        result.exact = length - gap <= query.tolerance_m;
        // Rounding alone keeps a search going that meets a corner again.
        if (result.exact || gap > query.matters_m) return result;
        if (simplex.holds(corner.w)) break;
        if (!simplex.add(corner)) break;
        v = simplex.nearest();
    }
    result.overlaps = !(result.gap_m > 0.0);
    return result;
}

}  // namespace burin::haptics
