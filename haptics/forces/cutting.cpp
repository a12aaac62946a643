// SPDX-License-Identifier: MIT
#include "haptics/forces/cutting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin::haptics {
namespace {

// Bisection steps: enough for every digit of a double.
constexpr int kHalvings = 54;

// Advance of c in one step by implicit Euler. With x_n, x_t the vector from c to the hand and K = k g^2 dt,
//     H (A_nn s + A_nt u) = K (x_n - s)      H (A_nt s + A_tt u) = K (x_t - u), u >= 0
// with the areas at depth d + s. The second equation gives u for any s. The residual of the first is negative where the
// tool leaves the material and positive where it reaches the hand, so there is a root between.
struct Advance {
    double hardness_Ns_per_m3, pull_Ns_per_m, radius_m, depth_m, way_in_m, way_across_m;

    struct Step {
        double in_m = 0.0, across_m = 0.0;
    };
    [[nodiscard]] Step step() const {
        double lo = -depth_m, hi = way_in_m;
        for (int i = 0; i < kHalvings; ++i) {
            const double s = 0.5 * (lo + hi);
            (left_over(s) < 0.0 ? lo : hi) = s;
        }
        return {lo, across(lo, engaged_areas(radius_m, depth_m + lo))};
    }

private:
    [[nodiscard]] double across(double s, const EngagedAreas& a) const {
        const double driven = pull_Ns_per_m * way_across_m - hardness_Ns_per_m3 * a.lift_m2 * s;
        const double resists = hardness_Ns_per_m3 * a.across_m2 + pull_Ns_per_m;
        return driven > 0.0 ? std::min(way_across_m, driven / resists) : 0.0;
    }
    [[nodiscard]] double left_over(double s) const {
        const EngagedAreas a = engaged_areas(radius_m, depth_m + s);
        return hardness_Ns_per_m3 * (a.into_m2 * s + a.lift_m2 * across(s, a)) - pull_Ns_per_m * (way_in_m - s);
    }
};

// The cutting point at the beginning of this step.
Vec3 carried_over(const CuttingState& state, const CuttingInput& in) {
    if (!state.engaged) return in.proxy_object_m;
    const Vec3 lag = state.point_object_m - in.hip_object_m;
    const double most = glm::length(in.proxy_object_m - in.hip_object_m) + in.slack_m;
    const double lag_m = glm::length(lag);
    return lag_m > most ? in.hip_object_m + lag * (most / lag_m) : state.point_object_m;
}

Vec3 into_material(const CuttingState& state, const CuttingInput& in) {
    const bool shown = state.known.into_object != Vec3(0.0);
    return shown ? state.known.into_object : -in.normal_object;
}

// Viscous drag over the engaged area.
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
    if (!(radius_m > 0.0) || !(depth_m > 0.0)) return {};
    const double x = std::min(depth_m / radius_m, 1.0);
    const double rim = x * (2.0 - x);  // the rim's radius over R, squared
    const double R2 = radius_m * radius_m;
    return {2.0 * std::numbers::pi * R2 * x * (1.0 - x + x * x / 3.0),
            0.5 * std::numbers::pi * R2 * x * x * (1.0 - x / 3.0), 2.0 / 3.0 * R2 * rim * std::sqrt(rim)};
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

    const double way_across_m = glm::length(way_across);
    const Advance advance{hardness, pull, in.tool_radius_m, depth_m, way_in_m, way_across_m};
    const Advance::Step done = hardness > 0.0 ? advance.step() : Advance::Step{way_in_m, way_across_m};
    const Vec3 sideways = way_across_m > 0.0 ? way_across * (done.across_m / way_across_m) : Vec3(0.0);
    const Vec3 point = in.hip_object_m - (way_in_m - done.in_m) * into - (way_across - sideways);

    step.next.point_object_m = step.bearing_object_m = point;
    step.engaged_depth_m = depth_m + done.in_m;
    const EngagedAreas areas = engaged_areas(in.tool_radius_m, step.engaged_depth_m);
    step.engaged_area_m2 = areas.into_m2 / (in.scale * in.scale);
    step.cut_speed_m_per_s = glm::length(done.in_m * into + sideways) / (in.scale * in.dt_s);
    step.drag_device_N = drag(in, material, step.engaged_area_m2);
    return step;
}

LookedAt look_at(const CuttingState& state, const CuttingInput& in, const geometry::LocalSurface& surface) noexcept {
    const double moved_m = glm::length(in.proxy_object_m - state.looked_at_object_m);
    if (state.surface_sequence == surface.sequence && moved_m <= 0.1 * in.tool_radius_m) return {state, 0};
    // Direction in which the tool is driven sideways; its length is the sideways share of the drive.
    const Vec3 way = in.hip_object_m - carried_over(state, in);
    const Vec3 into = into_material(state, in);
    const Vec3 across = way - glm::dot(way, into) * into;
    const double way_m = glm::length(way);
    const EngagementLook look =
        engagement(surface, in.proxy_object_m, in.tool_radius_m, way_m > 0.0 ? across / way_m : Vec3(0.0));
    LookedAt looked{state, look.triangles_seen};
    looked.next.known = look.engagement;
    looked.next.looked_at_object_m = in.proxy_object_m;
    looked.next.surface_sequence = surface.sequence;
    return looked;
}

}  // namespace burin::haptics
