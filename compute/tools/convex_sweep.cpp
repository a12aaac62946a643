// SPDX-License-Identifier: MIT
#include "compute/tools/convex_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace burin::compute {

FrustumSweep::FrustumSweep(const Frustum& shape, const Vec3& tip, const Vec3& axis, const Vec3& along)
    : swept_{.tip_radius = shape.tip_radius,
             .top_radius = shape.top_radius,
             .height = shape.length,
             .rim_radius = shape.rim_radius,
             .rim_height = shape.rim_height,
             .slope = (shape.top_radius - shape.tip_radius) / shape.length,
             .distance = std::sqrt(glm::dot(along, along)),
             .tip = tip,
             .axis = axis,
             .direction = Vec3(0.0),
             .middle = tip + 0.5 * (along + axis * shape.length)},
      along_(along) {
    if (swept_.distance > 0.0) swept_.direction = along / swept_.distance;
}

SweepSpan FrustumSweep::span(int axis, double ray_u, double ray_v) const {
    return shared::frustum_span(swept_, {axis, ray_u, ray_v});
}

Box FrustumSweep::bounds() const {
    Box box;
    const Vec3& axis = swept_.axis;
    const Vec3 across(std::sqrt(std::max(0.0, 1.0 - axis.x * axis.x)), std::sqrt(std::max(0.0, 1.0 - axis.y * axis.y)),
                      std::sqrt(std::max(0.0, 1.0 - axis.z * axis.z)));
    for (const Vec3& tip : {swept_.tip, swept_.tip + along_}) {
        const Vec3 top = tip + axis * swept_.height;
        box.include(tip - across * swept_.tip_radius);
        box.include(tip + across * swept_.tip_radius);
        box.include(top - across * swept_.top_radius);
        box.include(top + across * swept_.top_radius);
    }
    return box;
}

BoxSweep::BoxSweep(const Vec3& half_size, const Vec3& center, const Quat& orientation, const Vec3& along)
    : swept_{.half_size = half_size,
             .middle = center + 0.5 * along,
             .half_along_tool = glm::conjugate(orientation) * (0.5 * along),
             .lattice_from_tool = {orientation.w, Vec3(orientation.x, orientation.y, orientation.z)}},
      along_(along),
      orientation_(orientation) {}

SweepSpan BoxSweep::span(int axis, double ray_u, double ray_v) const {
    return shared::box_span(swept_, {axis, ray_u, ray_v});
}

Vec3 BoxSweep::side(int side) const { return orientation_ * shared::axis_vector(side); }

Box BoxSweep::bounds() const {
    Vec3 reach = glm::abs(0.5 * along_);
    for (int i = 0; i < 3; ++i) reach += glm::abs(side(i)) * swept_.half_size[i];
    return {swept_.middle - reach, swept_.middle + reach};
}

}  // namespace burin::compute
