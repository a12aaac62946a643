// SPDX-License-Identifier: MIT
#include "study/felt/stage_touch.hpp"

#include <algorithm>

#include "study/metrics/path.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::study {
namespace {

constexpr double kGuidanceReach_m = 0.04;
constexpr double kGuidanceDamping_s = 0.02;  // of its stiffness: the time in which a led hand comes to rest
constexpr std::size_t kCurvePoints = 200;
constexpr double kAtEnd_m = 1e-3, kHandAtEnd_m = 0.012;  // of the attracting point, and of a hand that lags behind it

}  // namespace

devices::WandDescription study_wand(const Protocol& protocol) {
    devices::WandDescription wand;
    wand.points = {{"top", {0.0, protocol.point_offset_m, 0.0}}, {"bottom", {0.0, -protocol.point_offset_m, 0.0}}};
    return wand;
}

haptics::Probe wand_probe(const devices::WandDescription& wand) {
    haptics::Probe probe;
    probe.count = 0;
    for (const devices::WandPoint& point : wand.points)
        probe.points[probe.count++].offset_device_m = devices::offset_device_m(wand, point);
    return probe;
}

Similarity world_from_wand(const devices::WandDescription& wand, const Box& world) {
    Similarity placed = devices::scene_from_device(wand);
    const Similarity device_from_world = inverse(placed);
    const Vec3 half = 0.5 * devices::device_of(wand).workspace_m;
    bool reached = true;
    for (const Vec3& corner : {world.lo, world.hi})
        reached = reached && glm::all(glm::lessThanEqual(glm::abs(device_from_world * corner), half));
    if (!reached) placed.position_m = world.center();
    return placed;
}

StageTouch::StageTouch(const Protocol& protocol, const Stage& stage, const Group& group, const FeltWorld& world,
                       TouchPurpose purpose)
    : protocol_(protocol),
      stage_(stage),
      world_(world),
      wand_(study_wand(protocol)),
      device_(devices::device_of(wand_)) {
    parameters_.sequence = 1;
    parameters_.workspace.object_from_device = world_from_wand(wand_, world.bounds());
    parameters_.workspace.workspace_device_m = device_.workspace_m;
    parameters_.probe = wand_probe(wand_);
    parameters_.position_noise_m = device_.resolution_m;
    parameters_.limits.max_force_N = protocol.force_limit_N;
    parameters_.max_surface_age_s = 0.0;  // nothing moves: the surface is as good as new
    set_walls(stage, group, purpose);
    leads_ = purpose == TouchPurpose::stage && stage.kind == StageKind::led_training && group.feels_tube &&
             protocol.guidance_N_per_m > 0.0;
    if (leads_) set_curve();
}

void StageTouch::set_walls(const Stage& stage, const Group& group, TouchPurpose purpose) {
    const StudyWorld& world = world_.world();
    haptics::TouchMaterial wall = scene::touch_material({world.wall_N_per_m, world.wall_Ns_per_m, 0.0, 0.0});
    parameters_.materials[kFunnelMaterial] = wall;
    const bool felt = purpose == TouchPurpose::model || (group.feels_tube && stage.feels_world);
    if (!felt) wall.stiffness_N_per_m = wall.damping_Ns_per_m = 0.0;
    parameters_.materials[kTubeMaterial] = wall;
}

void StageTouch::set_curve() {
    const std::vector<Vec3> line = resampled(world_.world().spine_m, kCurvePoints);
    haptics::GuidanceCurve& curve = parameters_.curve;
    for (const Vec3& p : line) curve.points_object_m[curve.count++] = Vec3f(p);
    curve_length_m_ = path_length_m(world_.world().spine_m);
    haptics::GuidanceSettings& guidance = parameters_.guidance;
    guidance.reach_m = kGuidanceReach_m;
    guidance.max_force_N = protocol_.force_limit_N;
    guidance.holds_orientation = true;  // upright, as the wand is held
}

// Strength and direction of the guidance from now on.
void StageTouch::guide_on(Nanoseconds now_ns, const haptics::GuidanceState& state, double near_end_m) {
    haptics::GuidanceSettings& guidance = parameters_.guidance;
    bool turned = false;
    if (state.held &&
        (lead_sign_ > 0.0 ? state.along_m >= curve_length_m_ - near_end_m : state.along_m <= near_end_m)) {
        lead_sign_ = -lead_sign_;
        turned = true;
    }
    if (ticks_ > 0 && now_ns < guidance_ns_ && !turned) return;
    if (now_ns >= guidance_ns_) guidance_ns_ = now_ns + kGuidanceStep_ns;
    const double time_s = seconds(now_ns - begun_ns_);
    const double share = stage_.ends_after_s ? std::clamp(time_s / *stage_.ends_after_s, 0.0, 1.0) : 0.0;
    const double strength = stage_.guidance_first + share * (stage_.guidance_last - stage_.guidance_first);
    guidance.repels = strength < 0.0;
    guidance.stiffness_N_per_m = std::abs(strength) * protocol_.guidance_N_per_m;
    guidance.damping_Ns_per_m = kGuidanceDamping_s * guidance.stiffness_N_per_m;
    guidance.lead_speed_m_per_s = lead_sign_ * protocol_.lead_m_per_s;
    ++parameters_.sequence;
}

void StageTouch::lead(Nanoseconds now_ns, const haptics::GuidanceState& state) {
    if (ticks_ == 0) begun_ns_ = guidance_ns_ = now_ns;
    if (leads_) guide_on(now_ns, state, kAtEnd_m);
    ++ticks_;
}

void StageTouch::follow(Nanoseconds now_ns, const devices::DeviceSample& sample) {
    if (ticks_++ == 0) begun_ns_ = guidance_ns_ = now_ns;
    if (!leads_) return;
    const Vec3 middle = place_in_world(sample.position_device_m);
    guide_on(now_ns, {nearest_on(world_.world().spine_m, middle).along_m, true}, kHandAtEnd_m);
}

Vec3 StageTouch::place_in_world(const Vec3& position_device_m) const {
    return parameters_.workspace.object_from_device * position_device_m;
}

Vec3 StageTouch::place_at_device(const Vec3& position_m) const {
    return inverse(parameters_.workspace.object_from_device) * position_m;
}

std::array<Vec3, 2> StageTouch::points_m(const devices::DeviceSample& sample) const {
    std::array<Vec3, 2> points;
    for (std::uint32_t i = 0; i < kWandPoints; ++i)
        points[i] = place_in_world(sample.position_device_m +
                                   sample.orientation_device * parameters_.probe.points[i].offset_device_m);
    return points;
}

}  // namespace burin::study
