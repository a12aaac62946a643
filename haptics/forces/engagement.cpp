// SPDX-License-Identifier: MIT
#include "haptics/forces/engagement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/local_surface_search.hpp"

namespace burin {
namespace {

constexpr double kReach = 1.1;           // of the radius
constexpr double kPiece = 1.0 / 3.0;     // of the radius: the longest edge of a piece
constexpr std::uint32_t kMostCuts = 24;  // of an edge; coarser than a third of the radius where a triangle is huge

// What of the view from the centre is taken up by surface within reach.
class View {
public:
    View(const Vec3& center, double reach_m, double piece_m) : center_(center), reach_m_(reach_m), piece_m_(piece_m) {}

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
    [[nodiscard]] Vec3 direction() const {
        const double l = std::sqrt(glm::dot(direction_, direction_));
        return l > 1e-12 ? direction_ / l : Vec3(0.0);
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
        if (!(r2 <= reach_m_ * reach_m_) || !(r2 > 0.0)) return;
        const double r = std::sqrt(r2);
        const double share = -glm::dot(area, to) / (r2 * r);
        solid_angle_ += share;
        direction_ += (share / r) * to;
    }

    Vec3 center_;
    double reach_m_, piece_m_;
    double solid_angle_ = 0.0;
    Vec3 direction_{0.0};
    std::uint32_t pieces_ = 0;
};

}  // namespace

EngagementLook engagement(const LocalSurface& surface, const Vec3& center_object_m, double radius_m) noexcept {
    EngagementLook look;
    if (!(radius_m > 0.0)) return look;
    const Vec3 center = center_object_m - surface.origin_object;
    const double reach_m = kReach * radius_m;
    View view(center, reach_m, kPiece * radius_m);
    for_each_triangle_near(surface, center - Vec3(reach_m), center + Vec3(reach_m),
                           [&](std::uint32_t, const Triangle& t) {
                               ++look.triangles_seen;
                               return view.add(t);
                           });
    const double depth_m =
        kReach * radius_m * view.solid_angle() / (2.0 * std::numbers::pi) - (kReach - 1.0) * radius_m;
    look.engagement = {std::clamp(depth_m, 0.0, 2.0 * radius_m), view.direction()};
    return look;
}

}  // namespace burin
