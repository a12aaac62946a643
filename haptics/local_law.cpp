// SPDX-License-Identifier: MIT
#include "haptics/local_law.hpp"

#include <algorithm>
#include <cmath>

namespace burin::haptics {
namespace {

// The plane of a contact: the normals of its points, weighted by their depths.
Vec3 plane_of(const ContactRecord& contact) {
    Vec3 sum(0.0);
    for (std::uint32_t i = 0; i < contact.point_count; ++i)
        if (contact.points[i].constraints > 0) sum += contact.points[i].penetration_m * contact.points[i].normal_object;
    const double length = glm::length(sum);
    return length > 0.0 ? sum / length : Vec3(0.0);
}

devices::DriveLaw law_of(const TickRecord& record, const TickState& tick, const TickParameters& parameters,
                         const devices::DeviceDescription& device) {
    const Similarity& map = record.motion.object_from_device;
    const Quat device_from_object = glm::conjugate(map.orientation);
    devices::DriveLaw law;
    double slack_N = 0.0;
    for (std::uint32_t i = 0; i < record.contact.point_count; ++i) {
        const PointRecord& point = record.contact.points[i];
        if (point.constraints == 0) continue;
        const TouchMaterial& touched = parameters.materials[tick.probe.materials[i]];
        const double moves = glm::dot(device_from_object * point.normal_object, record.sample.drive.moves_device);
        const double share = parameters.probe.points[i].share;
        law.spring_N_per_m += share * touched.stiffness_N_per_m * moves * moves;
        law.damping_Ns_per_m += share * touched.damping_Ns_per_m * moves * moves;
        slack_N += share * touched.stiffness_N_per_m * moves * point.penetration_m / map.scale;
    }
    if (!(law.spring_N_per_m > 0.0) || !(slack_N > 0.0)) return {};
    law.start_m = record.sample.drive.length_m + slack_N / law.spring_N_per_m;
    if (device.max_stiffness_N_per_m > 0.0)
        law.spring_N_per_m = std::min(law.spring_N_per_m, device.max_stiffness_N_per_m);
    law.most_N = std::min(parameters.limits.max_force_N, device.max_force_N);
    law.holds = true;
    return law;
}

}  // namespace

LocalLawState step_local_law(const LocalLawState& state, const TickRecord& record, const TickState& tick,
                             const TickParameters& parameters, const devices::DeviceDescription& device,
                             double dt_s) noexcept {
    const bool may = parameters.local_rendering && record.sample.drive.is_one() && record.in_contact() &&
                     record.gate.cause == GateCause::none && !record.contact.jumped && !record.contact.eases &&
                     (record.flags & (kTickHeldOver | kTickDoubted | kTickStaleSurface)) == 0;
    if (!may) return {};
    const Vec3 plane = plane_of(record.contact);
    const bool rested = state.law.holds;
    const double cosine = glm::dot(plane, state.normal_object);
    const Vec3 way_m = state.way_device_m + dt_s * (tick.motion.foot_velocity_device_m_per_s -
                                                    record.contact.surface_velocity_device_m_per_s);
    const std::uint32_t object = record.deepest().object;
    const bool goes_on = object == state.object &&
                         cosine >= (rested ? LocalLawState::kMovesCosine : LocalLawState::kRestsCosine) &&
                         glm::length(way_m) <= (rested ? LocalLawState::kMoves_m : LocalLawState::kRests_m);
    if (!goes_on) {
        LocalLawState anew;
        anew.object = object;
        anew.normal_object = plane;
        return anew;
    }
    LocalLawState next = state;
    next.way_device_m = way_m;
    next.rests_s += dt_s;
    if (!rested && next.rests_s >= LocalLawState::kBegins_s && !record.gate.ramping)
        next.law = law_of(record, tick, parameters, device);
    return next;
}

}  // namespace burin::haptics
