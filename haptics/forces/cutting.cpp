// SPDX-License-Identifier: MIT
#include "haptics/forces/cutting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin {
namespace {

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

// Halvings of an interval: enough for every digit of a double.
constexpr int kHalvings = 54;

// How far c goes along n in one step. Implicit Euler: the root of H A(d + s) s = k g^2 dt (x - s) between 0 and x, x the way
// from c to the hand. The left side rises with s and the right one falls, so there is one.
struct Advance {
    double hardness_Ns_per_m3, pull_Ns_per_m, radius_m, depth_m, way_m;  // pull: k g^2 dt

    [[nodiscard]] double length_m() const {
        double lo = 0.0, hi = way_m;
        for (int i = 0; i < kHalvings; ++i) {
            const double s = 0.5 * (lo + hi);
            const double resists = hardness_Ns_per_m3 * engaged_areas(radius_m, depth_m + s).along_m2 * s;
            (resists < pull_Ns_per_m * (way_m - s) ? lo : hi) = s;
        }
        return lo;
    }
};

// Where the tool has eaten to before this step.
Vec3 carried_over(const CuttingState& state, const CuttingInput& in) {
    if (!state.engaged) return in.proxy_object_m;
    const Vec3 lag = state.point_object_m - in.hip_object_m;
    const double most = length(in.proxy_object_m - in.hip_object_m) + in.slack_m;
    const double lag_m = length(lag);
    return lag_m > most ? in.hip_object_m + lag * (most / lag_m) : state.point_object_m;
}

Vec3 into_material(const CuttingState& state, const CuttingInput& in) {
    const bool shown = state.known.into_object != Vec3(0.0);
    return shown ? state.known.into_object : -in.normal_object;
}

// Viscous, over the engaged area.
Vec3 drag(const CuttingInput& in, const TouchMaterial& material, double area_device_m2) {
    return -material.cutting_drag_Ns_per_m3 * area_device_m2 * in.velocity_device_m_per_s;
}

CuttingStep not_cutting(const CuttingState& state, const CuttingInput& in) {
    CuttingStep step;
    step.next = state;
    step.next.point_object_m = step.bearing_object_m = in.proxy_object_m;
    step.next.engaged = false;
    return step;
}

}  // namespace

EngagedAreas engaged_areas(double radius_m, double depth_m) noexcept {
    const double d = std::min(depth_m, radius_m);
    const double half_width2 = d * (2.0 * radius_m - d);
    if (!(half_width2 > 0.0)) return {};
    const double width = 2.0 * std::sqrt(half_width2);
    return {std::numbers::pi * half_width2, 2.0 / 3.0 * width * d + d * d * d / (2.0 * width)};
}

CuttingStep cut(const CuttingState& state, const CuttingInput& in, const TouchMaterial& material) noexcept {
    const double hardness = material.hardness_Ns_per_m3;
    if (!in.cutting || !std::isfinite(hardness)) return not_cutting(state, in);
    CuttingStep step;
    step.next = state;
    step.next.engaged = true;
    const Vec3 before = carried_over(state, in);
    const Vec3 into = into_material(state, in);
    const Vec3 way = in.hip_object_m - before;
    const double way_in_m = std::max(0.0, glm::dot(way, into));  // 0: c was deeper than the hand now is
    const Vec3 way_across = way - glm::dot(way, into) * into;
    const double ahead_m = glm::dot(before - in.proxy_object_m, into);
    const double depth_m = std::max(0.0, state.known.depth_m + ahead_m);
    const double pull = in.stiffness_N_per_m * in.scale * in.scale * in.dt_s;

    const double advance_m =
        hardness > 0.0 ? Advance{hardness, pull, in.tool_radius_m, depth_m, way_in_m}.length_m() : way_in_m;
    const EngagedAreas areas = engaged_areas(in.tool_radius_m, depth_m + advance_m);
    const double resists = hardness * areas.across_m2;
    const Vec3 left_across = resists > 0.0 ? way_across * (resists / (resists + pull)) : Vec3(0.0);
    const Vec3 point = in.hip_object_m - (way_in_m - advance_m) * into - left_across;

    step.next.point_object_m = step.bearing_object_m = point;
    step.engaged_depth_m = depth_m + advance_m;
    step.engaged_area_m2 = areas.along_m2 / (in.scale * in.scale);
    step.cut_speed_m_per_s = length(advance_m * into + way_across - left_across) / (in.scale * in.dt_s);
    step.drag_device_N = drag(in, material, step.engaged_area_m2);
    return step;
}

LookedAt look_at(const CuttingState& state, const LocalSurface& surface, const Vec3& proxy_object_m,
                 double tool_radius_m) noexcept {
    const double moved_m = length(proxy_object_m - state.looked_at_object_m);
    if (state.surface_sequence == surface.sequence && moved_m <= 0.1 * tool_radius_m) return {state, 0};
    const EngagementLook look = engagement(surface, proxy_object_m, tool_radius_m);
    LookedAt looked{state, look.triangles_seen};
    looked.next.known = look.engagement;
    looked.next.looked_at_object_m = proxy_object_m;
    looked.next.surface_sequence = surface.sequence;
    return looked;
}

}  // namespace burin
