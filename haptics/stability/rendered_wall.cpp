// SPDX-License-Identifier: MIT
#include "haptics/stability/rendered_wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace burin::haptics {
namespace {

// The condition per_stiffness K + per_damping B <= budget.
struct Line {
    double per_stiffness = 0.0, per_damping = 0.0, budget = 0.0;
    StiffnessBound bound = StiffnessBound::sampling;

    [[nodiscard]] double most_stiffness(double damping) const {
        const double left = std::max(0.0, budget - per_damping * damping);
        return per_stiffness > 0.0 ? left / per_stiffness : (left > 0.0 ? HUGE_VAL : 0.0);
    }
    [[nodiscard]] double most_damping(double stiffness) const {
        const double left = std::max(0.0, budget - per_stiffness * stiffness);
        return per_damping > 0.0 ? left / per_damping : HUGE_VAL;
    }
};

// The conditions at rest and at speed; both have to hold.
struct Cover {
    Line rest, speed;

    [[nodiscard]] const Line& tighter() const {
        return rest.most_stiffness(0.0) < speed.most_stiffness(0.0) ? rest : speed;
    }
    [[nodiscard]] double most_damping(double stiffness) const {
        return std::min(rest.most_damping(stiffness), speed.most_damping(stiffness));
    }
};

struct Loop {
    double period_s = 0.0;
    double lag_s = 0.0;  // T/2 + t_d + t_f
    double step_m = 0.0;
};

// (1 + 1 + 1/2 + ... + 1/16) / 2: the worst-case number of times that adaptive windows of up to 16 count one
// difference.
constexpr double kAdaptiveWindows = 2.2;

Loop loop_of(const ContactDemand& wanted, const devices::DeviceDescription& device) {
    Loop loop;
    loop.period_s = wanted.period_s > 0.0 ? wanted.period_s : (device.rate_Hz > 0.0 ? 1.0 / device.rate_Hz : 0.001);
    // Rounded up to whole periods: a part of one costs as much in the worst phase. The millionth allows for rounding.
    const double delay_s = std::ceil(device.delay_s / loop.period_s - 1e-6) * loop.period_s;
    loop.lag_s = 0.5 * loop.period_s + std::max(0.0, delay_s) + wanted.filter_lag_s;
    loop.step_m = device.resolution_m;
    return loop;
}

Cover by_friction(const Loop& loop, const devices::DeviceDescription& device, double speed) {
    const double half_step_m = 0.5 * loop.step_m, damper = speed + loop.step_m / loop.period_s;
    return {{half_step_m, damper, device.friction_N, StiffnessBound::quantisation},
            {loop.lag_s * speed + half_step_m, damper, device.friction_N + device.damping_Ns_per_m * speed,
             StiffnessBound::sampling}};
}

Cover by_damping(const Loop& loop, const devices::DeviceDescription& device) {
    Cover cover;
    cover.rest = {0.0, 0.0, HUGE_VAL, StiffnessBound::quantisation};
    if (device.friction_N > 0.0)
        cover.rest = {0.5 * loop.step_m, loop.step_m / loop.period_s, device.friction_N, StiffnessBound::quantisation};
    cover.speed = {loop.lag_s, kAdaptiveWindows, device.damping_Ns_per_m, StiffnessBound::sampling};
    return cover;
}

}  // namespace

CoupledWall through(const VirtualCoupling& coupling, const CoupledWall& wall) noexcept {
    if (!(coupling.stiffness_N_per_m > 0.0)) return wall;
    const double sum = wall.stiffness_N_per_m + coupling.stiffness_N_per_m;
    const double of_wall = coupling.stiffness_N_per_m / sum;  // share of the motion taken up by the wall
    const double of_coupling = wall.stiffness_N_per_m / sum;  // share taken up by the coupling
    return {wall.stiffness_N_per_m * of_wall,
            wall.damping_Ns_per_m * of_wall * of_wall + coupling.damping_Ns_per_m * of_coupling * of_coupling};
}

StiffnessLimit limited(const ContactDemand& wanted, const devices::DeviceDescription& device) noexcept {
    StiffnessLimit out{wanted.stiffness_N_per_m, wanted.damping_Ns_per_m, StiffnessBound::none};
    if (device.max_stiffness_N_per_m > 0.0 && !(out.stiffness_N_per_m <= device.max_stiffness_N_per_m)) {
        out.stiffness_N_per_m = device.max_stiffness_N_per_m;
        out.bound = StiffnessBound::device;
    }
    if (!(device.friction_N > 0.0) && !(device.damping_Ns_per_m > 0.0)) return out;  // nothing is known of the device
    const Loop loop = loop_of(wanted, device);
    const Cover friction = by_friction(loop, device, wanted.contact_speed_m_per_s);
    const Cover damping = by_damping(loop, device);
    const Line& stiffest = friction.tighter().most_stiffness(0.0) > damping.tighter().most_stiffness(0.0)
                               ? friction.tighter()
                               : damping.tighter();
    if (!(out.stiffness_N_per_m <= stiffest.most_stiffness(0.0))) {
        return {stiffest.most_stiffness(0.0), 0.0, stiffest.bound};
    }
    const double room =
        std::max(friction.most_damping(out.stiffness_N_per_m), damping.most_damping(out.stiffness_N_per_m));
    if (!(out.damping_Ns_per_m <= room)) {
        out.damping_Ns_per_m = room;
        if (out.bound == StiffnessBound::none) out.bound = StiffnessBound::damping;
    }
    return out;
}

StiffnessLimit limited_by_rotation(const ContactDemand& wall, double sum_of_squared_arms_m2,
                                   const devices::DeviceDescription& device) noexcept {
    const StiffnessLimit wanted{wall.stiffness_N_per_m, wall.damping_Ns_per_m, StiffnessBound::none};
    if (!(sum_of_squared_arms_m2 > 0.0) || device.max_torque_Nm == Vec3(0.0)) return wanted;
    // In angular units the conditions are the same.
    devices::DeviceDescription rotation;
    rotation.rate_Hz = device.rate_Hz;
    rotation.delay_s = device.delay_s;
    rotation.friction_N = device.angular_friction_Nm;
    rotation.damping_Ns_per_m = device.angular_damping_Nms_per_rad;
    rotation.resolution_m = device.orientation_step_rad;
    rotation.max_stiffness_N_per_m = device.max_torsion_Nm_per_rad;
    ContactDemand demand = wall;
    demand.stiffness_N_per_m *= sum_of_squared_arms_m2;
    demand.damping_Ns_per_m *= sum_of_squared_arms_m2;
    demand.contact_speed_m_per_s = kTurnSpeed_rad_per_s;
    const StiffnessLimit limit = limited(demand, rotation);
    if (limit.bound == StiffnessBound::none) return wanted;
    return {limit.stiffness_N_per_m / sum_of_squared_arms_m2, limit.damping_Ns_per_m / sum_of_squared_arms_m2,
            StiffnessBound::rotation};
}

RenderedWall rendered(const WallDemand& asked, const devices::DeviceDescription& device) noexcept {
    const CoupledWall wall = through(asked.coupling, asked.wall);
    if (!asked.limit) return {wall};
    ContactDemand demand;
    demand.stiffness_N_per_m = wall.stiffness_N_per_m * asked.points;
    demand.damping_Ns_per_m = wall.damping_Ns_per_m * asked.points;
    demand.filter_lag_s = asked.filter_lag_s;
    demand.period_s = asked.period_s;
    const StiffnessLimit limit = limited(demand, device);
    const CoupledWall each{limit.stiffness_N_per_m / asked.points, limit.damping_Ns_per_m / asked.points};
    if (!(asked.squared_arms_m2 > 0.0)) return {each, limit.bound};
    demand.stiffness_N_per_m = each.stiffness_N_per_m;
    demand.damping_Ns_per_m = each.damping_Ns_per_m;
    const StiffnessLimit turning = limited_by_rotation(demand, asked.squared_arms_m2, device);
    return {{turning.stiffness_N_per_m, turning.damping_Ns_per_m},
            turning.bound != StiffnessBound::none ? turning.bound : limit.bound};
}

const char* short_text(StiffnessBound bound) noexcept {
    switch (bound) {
        case StiffnessBound::none: return "";
        case StiffnessBound::sampling: return "its rate and delay";
        case StiffnessBound::quantisation: return "its encoders' steps";
        case StiffnessBound::device: return "its maker's limit";
        case StiffnessBound::damping: return "its own damping";
        case StiffnessBound::rotation: return "its torque";
    }
    return "";
}

const char* text(StiffnessBound bound) noexcept {
    switch (bound) {
        case StiffnessBound::none: return "as stiff as the material says";
        case StiffnessBound::sampling:
            return "softer than the material says: the device's friction and damping cannot take away what a stiffer "
                   "wall "
                   "gives out at this rate and delay";
        case StiffnessBound::quantisation:
            return "softer than the material says: the device's friction cannot hide its encoders' steps on a stiffer "
                   "wall";
        case StiffnessBound::device: return "softer than the material says: the device is not made for stiffer walls";
        case StiffnessBound::damping:
            return "less damped than the material says: the device cannot take away what more damping gives out";
        case StiffnessBound::rotation:
            return "softer than the material says: the torque of several points is more than the device renders";
    }
    return "softer than the material says";
}

}  // namespace burin::haptics
