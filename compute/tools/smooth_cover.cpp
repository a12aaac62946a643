// SPDX-License-Identifier: MIT
#include "compute/tools/smooth_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace burin::compute {
namespace {

// The radius of the balls, of half the tool's least width: they stand out a little, so that what lies at the tool's
// sides is smoothed too. Their distance from one another, of the same half width.
constexpr double kStandsOut = 1.25, kApart = 1.0;

struct Body {
    Box box;
    double turned_radius_m = 0.0;  // of a tool turned about +Y; 0: it is not
};

Body turned_body(double radius_m, double length_m) {
    return {{{-radius_m, 0.0, -radius_m}, {radius_m, length_m, radius_m}}, radius_m};
}
Body body_of(const BallTool& t) { return {{Vec3(-t.radius_m), Vec3(t.radius_m)}, t.radius_m}; }
Body body_of(const CylinderTool& t) { return turned_body(t.radius_m, t.length_m); }
Body body_of(const ConeTool& t) { return turned_body(std::max(t.tip_radius_m, t.top_radius_m), t.length_m); }
Body body_of(const BullNoseTool& t) { return turned_body(t.radius_m, t.length_m); }
Body body_of(const BoxTool& t) { return {{-t.half_size_m, t.half_size_m}, 0.0}; }
Body body_of(const MeshTool& t) {
    Body body;
    for (const Vec3& p : t.mesh->positions_m) body.box.include(p);
    return body;
}

// Counts the balls along each axis. Widens their distance until there are at most kMostSmoothBalls in all.
std::array<int, 3> counts(const Vec3& inner_m, double& apart_m) {
    for (;; apart_m *= 1.25) {
        std::array<int, 3> n{};
        double all = 1.0;
        for (int i = 0; i < 3; ++i) {
            const double along = 1.0 + std::ceil(std::max(inner_m[i], 0.0) / apart_m - 1e-9);
            all *= along;
            n.at(static_cast<std::size_t>(i)) = static_cast<int>(std::min(along, 1.0 + kMostSmoothBalls));
        }
        if (all <= kMostSmoothBalls) return n;
    }
}

}  // namespace

SmoothCover smooth_cover(const ToolShape& shape) {
    if (const auto* ball = std::get_if<BallTool>(&shape)) return {{Vec3(0.0)}, ball->radius_m};
    const Body body = std::visit([](const auto& tool) { return body_of(tool); }, shape);
    const Vec3 extent = body.box.extent();
    // A mesh may be as thin as nothing.
    const double longest_m = std::max({extent.x, extent.y, extent.z});
    const double half_m = std::max(0.5 * std::min({extent.x, extent.y, extent.z}), 1e-3 * longest_m);
    if (!(half_m > 0.0)) return {{body.box.center()}, 0.0};
    const Vec3 inner = glm::max(extent - 2.0 * half_m, Vec3(0.0));
    double apart_m = kApart * half_m;
    const std::array<int, 3> n = counts(inner, apart_m);
    SmoothCover cover;
    cover.radius_m = std::max(kStandsOut * half_m, 0.9 * apart_m);
    const auto place = [&](int axis, int i) {
        const int of = n.at(static_cast<std::size_t>(axis));
        return of == 1 ? body.box.center()[axis] : body.box.lo[axis] + half_m + inner[axis] * i / (of - 1);
    };
    for (int x = 0; x < n[0]; ++x)
        for (int y = 0; y < n[1]; ++y)
            for (int z = 0; z < n[2]; ++z) {
                const Vec3 middle(place(0, x), place(1, y), place(2, z));
                if (body.turned_radius_m > 0.0 && std::hypot(middle.x, middle.z) > body.turned_radius_m) continue;
                cover.middles_m.push_back(middle);
            }
    return cover;
}

SmoothBalls::SmoothBalls(const ToolSweep& sweep)
    : start_(sweep.start),
      end_(sweep.end),
      turns_(sweep.start.orientation != sweep.end.orientation),
      strength_(sweep.smooth_strength),
      material_(sweep.material),
      cover_(smooth_cover(sweep.shape)) {
    double farthest_m = 0.0;
    for (const Vec3& middle : cover_.middles_m)
        farthest_m = std::max(farthest_m, glm::length(end_ * middle - start_ * middle));
    stretches_ = static_cast<std::size_t>(std::max(1.0, std::ceil(farthest_m / (kSmoothStretch * cover_.radius_m))));
}

Pose SmoothBalls::pose_at(double part) const {
    const Quat orientation = turns_ ? glm::slerp(start_.orientation, end_.orientation, part) : start_.orientation;
    return Pose{start_.position_m + (end_.position_m - start_.position_m) * part, orientation};
}

SmoothBall SmoothBalls::operator[](std::size_t i) const {
    const auto stretches = static_cast<double>(stretches_), stretch = static_cast<double>(i / cover_.middles_m.size());
    const Pose from = pose_at(stretch / stretches), to = pose_at((stretch + 1.0) / stretches);
    const Vec3& middle = cover_.middles_m[i % cover_.middles_m.size()];
    return {from * middle, to * middle, cover_.radius_m, strength_, material_};
}

}  // namespace burin::compute
