// SPDX-License-Identifier: MIT
#include "haptics/forces/engagement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/contact/lanes.hpp"
#include "geometry/contact/local_surface_search.hpp"

namespace burin::haptics {
namespace {

// Fractions of the ball's radius.
constexpr double kReach = 1.1;
constexpr double kSurroundings = 1.6;
constexpr double kPiece = 1.0 / 3.0;     // longest edge of a piece
constexpr std::uint32_t kMostCuts = 24;  // pieces along an edge; coarser than kPiece where a triangle is huge

// A sum in double of values in float.
class Sum {
public:
    void add(geometry::LaneMask those, geometry::Lanes values) {
        lanes_ += __builtin_convertvector(those != 0 ? values : geometry::Lanes{}, DoubleLanes);
    }
    [[nodiscard]] double all() const { return (lanes_[0] + lanes_[1]) + (lanes_[2] + lanes_[3]); }

private:
    using DoubleLanes [[gnu::vector_size(8 * geometry::kLanes)]] = double;
    DoubleLanes lanes_{};
};

geometry::Lanes square_root(geometry::Lanes x) {
    for (std::size_t k = 0; k < geometry::kLanes; ++k) x[k] = std::sqrt(x[k]);
    return x;
}

// Accumulates the solid angle of the surface within reach of the centre. Processes four triangles at a time, relative
// to the centre in units of the radius, in float: its rounding is 1e-7 of the radius, like that of the surface. Sums
// are double.
class View {
public:
    View(const Vec3& center, double radius_m, const Vec3& ahead)
        : center_(center),
          per_m_(1.0 / radius_m),
          ahead_(geometry::in_all_lanes(Vec3f(ahead))),
          bias_(static_cast<float>(std::sqrt(glm::dot(ahead, ahead)))) {}

    // Adds a triangle; returns false when kMostEngagementPieces have been processed.
    bool add(const geometry::Triangle& t) {
        put(Vec3f((t.a - center_) * per_m_), a_);
        put(Vec3f((t.b - center_) * per_m_), b_);
        put(Vec3f((t.c - center_) * per_m_), c_);
        return ++count_ < geometry::kLanes || look();
    }
    // Processes the triangles left over in the last group.
    void end() {
        while (count_ > 0) add({center_, center_, center_});  // degenerate triangles, which are rejected
    }

    [[nodiscard]] double solid_angle() const { return solid_angle_.all(); }
    [[nodiscard]] Vec3 into() const {
        const Vec3 area(area_x_.all(), area_y_.all(), area_z_.all());
        const double l = std::sqrt(glm::dot(area, area));
        return l > 1e-9 * kPiece * kPiece ? -area / l : Vec3(0.0);
    }

private:
    void put(const Vec3f& p, geometry::Vec3Lanes& lanes) const {
        lanes.x[count_] = p.x;
        lanes.y[count_] = p.y;
        lanes.z[count_] = p.z;
    }
    bool look() {
        constexpr float kPiece2 = static_cast<float>(kPiece * kPiece);
        const geometry::Vec3Lanes u = b_ - a_, v = c_ - a_, w = c_ - b_;
        const geometry::Vec3Lanes area = geometry::Lanes{0.5f, 0.5f, 0.5f, 0.5f} * cross(u, v);
        const geometry::LaneMask facing = geometry::dot(area, a_) < 0.0f;
        const geometry::Lanes longest2 =
            geometry::greater(geometry::greater(geometry::dot(u, u), geometry::dot(v, v)), geometry::dot(w, w));
        const geometry::LaneMask large = facing & (longest2 > kPiece2);
        const geometry::Lanes third = geometry::Lanes{} + 1.0f / 3.0f;
        add_pieces(facing & ~large, third * (a_ + b_ + c_), area);
        pieces_ += count_;
        count_ = 0;
        if (geometry::any(large)) {
            for (std::size_t k = 0; k < geometry::kLanes; ++k)
                if (large[k] != 0) cut_up(in_lane(a_, k), in_lane(u, k), in_lane(v, k), in_lane(area, k), longest2[k]);
        }
        return pieces_ < kMostEngagementPieces;
    }
    [[nodiscard]] static Vec3f in_lane(const geometry::Vec3Lanes& lanes, std::size_t k) {
        return {lanes.x[k], lanes.y[k], lanes.z[k]};
    }
    // Divides a triangle into n^2 pieces: n rows in which upright and inverted triangles alternate.
    void cut_up(const Vec3f& a, const Vec3f& u, const Vec3f& v, const Vec3f& area, float longest2) {
        const double edges = std::ceil(std::sqrt(static_cast<double>(longest2)) / kPiece);
        const auto n = static_cast<std::uint32_t>(std::min(edges, double{kMostCuts}));
        const float share = 1.0f / static_cast<float>(n);
        const geometry::Vec3Lanes piece = geometry::in_all_lanes(area * (share * share));
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t in_row = 2 * (n - j) - 1;
            for (std::uint32_t first = 0; first < in_row; first += geometry::kLanes) {
                geometry::Lanes i{}, up{};
                geometry::LaneMask there{};
                for (std::uint32_t k = 0; k < geometry::kLanes; ++k) {
                    i[k] = static_cast<float>((first + k) / 2);
                    up[k] = (first + k) % 2 == 0 ? 1.0f / 3.0f : 2.0f / 3.0f;
                    there[k] = first + k < in_row ? -1 : 0;
                }
                const geometry::Lanes along_u = (i + up) * share, along_v = (static_cast<float>(j) + up) * share;
                add_pieces(there,
                           geometry::in_all_lanes(a) + along_u * geometry::in_all_lanes(u) +
                               along_v * geometry::in_all_lanes(v),
                           piece);
            }
        }
        pieces_ += n * n;
    }
    void add_pieces(geometry::LaneMask those, const geometry::Vec3Lanes& to, const geometry::Vec3Lanes& area) {
        constexpr float kReach2 = static_cast<float>(kReach * kReach);
        constexpr float kSurroundings2 = static_cast<float>(kSurroundings * kSurroundings);
        const geometry::Lanes r2 = geometry::dot(to, to);
        those &= (r2 <= kSurroundings2) & (r2 > 0.0f);
        if (!geometry::any(those)) return;
        area_x_.add(those, area.x);
        area_y_.add(those, area.y);
        area_z_.add(those, area.z);
        those &= r2 <= kReach2;
        if (!geometry::any(those)) return;
        const geometry::Lanes weight =
            geometry::dot(to, ahead_) > 0.0f ? geometry::Lanes{} + (1.0f + bias_) : geometry::Lanes{} + (1.0f - bias_);
        solid_angle_.add(those, weight * -geometry::dot(area, to) / (r2 * square_root(r2)));
    }

    Vec3 center_;
    double per_m_;
    geometry::Vec3Lanes ahead_;
    float bias_;
    Sum solid_angle_, area_x_, area_y_, area_z_;
    geometry::Vec3Lanes a_{}, b_{}, c_{};
    std::uint32_t count_ = 0, pieces_ = 0;
};

}  // namespace

EngagementLook engagement(const geometry::LocalSurface& surface, const Vec3& center_object_m, double radius_m,
                          const Vec3& ahead_object) noexcept {
    EngagementLook look;
    if (!(radius_m > 0.0)) return look;
    const Vec3 center = center_object_m - surface.origin_object;
    View view(center, radius_m, ahead_object);
    geometry::Near near{center, center, kSurroundings * radius_m};
    geometry::for_each_triangle_near(surface, near,
                                     [&](std::uint32_t, const geometry::Triangle& t) { return view.add(t); });
    view.end();
    look.triangles_seen = UINT32_MAX - near.looks_left;
    const double depth_m =
        kReach * radius_m * view.solid_angle() / (2.0 * std::numbers::pi) - (kReach - 1.0) * radius_m;
    look.engagement = {std::clamp(depth_m, 0.0, 2.0 * radius_m), view.into()};
    return look;
}

}  // namespace burin::haptics
