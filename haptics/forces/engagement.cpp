// SPDX-License-Identifier: MIT
#include "haptics/forces/engagement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/local_surface_search.hpp"

namespace burin {
namespace {

constexpr double kReach = 1.1;           // of the radius
constexpr double kSurroundings = 1.6;    // likewise
constexpr double kPiece = 1.0 / 3.0;     // of the radius: the longest edge of a piece
constexpr std::uint32_t kMostCuts = 24;  // of an edge; coarser than a third of the radius where a triangle is huge

// What of the view from the centre is taken up by surface within reach.
class View {
public:
    View(const Vec3& center, double radius_m, const Vec3& ahead)
        : center_(center),
          ahead_(ahead),
          bias_(std::sqrt(glm::dot(ahead, ahead))),
          reach_m_(kReach * radius_m),
          surroundings_m_(kSurroundings * radius_m),
          piece_m_(kPiece * radius_m) {}

    // False when enough has been looked at.
    bool add(const Triangle& t) {
        const Vec3 u = t.b - t.a, v = t.c - t.a;
        const Vec3 area = 0.5 * glm::cross(u, v);
        if (!(glm::dot(area, center_ - t.a) > 0.0)) return true;  // turned away
        const std::uint32_t cuts = cuts_of(t);
        if (cuts == 1) {
            add_piece((t.a + t.b + t.c) / 3.0, area);
            return ++pieces_ < kMostEngagementPieces;
        }
        const double n = cuts;
        for (std::uint32_t j = 0; j < cuts; ++j)
            for (std::uint32_t i = 0; i + j < cuts; ++i) {  // an upright piece, and the one upside down beside it
                add_piece(t.a + ((i + 1.0 / 3.0) / n) * u + ((j + 1.0 / 3.0) / n) * v, area / (n * n));
                if (i + j + 1 < cuts)
                    add_piece(t.a + ((i + 2.0 / 3.0) / n) * u + ((j + 2.0 / 3.0) / n) * v, area / (n * n));
            }
        pieces_ += cuts * cuts;
        return pieces_ < kMostEngagementPieces;
    }

    [[nodiscard]] double solid_angle() const { return solid_angle_; }
    [[nodiscard]] Vec3 into() const {
        const double l = std::sqrt(glm::dot(area_, area_));
        return l > 1e-9 * piece_m_ * piece_m_ ? -area_ / l : Vec3(0.0);
    }

private:
    [[nodiscard]] std::uint32_t cuts_of(const Triangle& t) const {
        const Vec3 u = t.b - t.a, v = t.c - t.a, w = t.c - t.b;
        const double longest = std::sqrt(std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)}));
        if (longest <= piece_m_) return 1;
        return static_cast<std::uint32_t>(std::min(std::ceil(longest / piece_m_), double{kMostCuts}));
    }
    void add_piece(const Vec3& middle, const Vec3& area) {
        const Vec3 to = middle - center_;
        const double r2 = glm::dot(to, to);
        if (!(r2 <= surroundings_m_ * surroundings_m_) || !(r2 > 0.0)) return;
        area_ += area;
        if (r2 > reach_m_ * reach_m_) return;
        const double weight = glm::dot(to, ahead_) > 0.0 ? 1.0 + bias_ : 1.0 - bias_;
        solid_angle_ -= weight * glm::dot(area, to) / (r2 * std::sqrt(r2));
    }

    Vec3 center_, ahead_;
    double bias_, reach_m_, surroundings_m_, piece_m_;
    double solid_angle_ = 0.0;
    Vec3 area_{0.0};
    std::uint32_t pieces_ = 0;
};

}  // namespace

EngagementLook engagement(const LocalSurface& surface, const Vec3& center_object_m, double radius_m,
                          const Vec3& ahead_object) noexcept {
    EngagementLook look;
    if (!(radius_m > 0.0)) return look;
    const Vec3 center = center_object_m - surface.origin_object;
    const Vec3 around(kSurroundings * radius_m);
    View view(center, radius_m, ahead_object);
    for_each_triangle_near(surface, center - around, center + around, [&](std::uint32_t, const Triangle& t) {
        ++look.triangles_seen;
        return view.add(t);
    });
    const double depth_m =
        kReach * radius_m * view.solid_angle() / (2.0 * std::numbers::pi) - (kReach - 1.0) * radius_m;
    look.engagement = {std::clamp(depth_m, 0.0, 2.0 * radius_m), view.into()};
    return look;
}

}  // namespace burin
