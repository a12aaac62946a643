// SPDX-License-Identifier: MIT
#include "haptics/forces/easing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burin::haptics {
namespace {

double excess(const Eased& value, double asked) { return std::max(0.0, value.value - asked); }

// Begins below the aim by what others still have in excess, which is then spoken for.
void begin_with_what_is_left(Eased& value, double asked, double& in_excess) {
    const double less = std::min(asked, in_excess);
    in_excess -= less;
    value.begin(asked - less, asked);
}

}  // namespace

void Eased::begin(double at, double new_aim) noexcept {
    value = at;
    aim = new_aim;
    rate_per_s = std::max(std::abs(aim - value), kDrift * aim) / kEase_s;
}

void Eased::move_to(double new_aim, double dt_s) noexcept {
    if (new_aim != aim) begin(value, new_aim);
    const double most = rate_per_s * dt_s;
    value = std::abs(aim - value) <= most ? aim : value + std::copysign(most, aim - value);
}

void ease_walls(std::span<EasedWall> walls, std::span<const std::optional<CoupledWall>> asked, double dt_s) noexcept {
    double stiffness = 0.0, damping = 0.0;  // in excess of what is asked
    for (std::size_t i = 0; i < walls.size(); ++i) {
        if (!asked[i] || !walls[i].touches) continue;
        stiffness += excess(walls[i].stiffness_N_per_m, asked[i]->stiffness_N_per_m);
        damping += excess(walls[i].damping_Ns_per_m, asked[i]->damping_Ns_per_m);
    }
    for (std::size_t i = 0; i < walls.size(); ++i) {
        EasedWall& wall = walls[i];
        if (!asked[i]) {
            wall = {};
            continue;
        }
        if (wall.touches) {
            wall.stiffness_N_per_m.move_to(asked[i]->stiffness_N_per_m, dt_s);
            wall.damping_Ns_per_m.move_to(asked[i]->damping_Ns_per_m, dt_s);
        } else {
            begin_with_what_is_left(wall.stiffness_N_per_m, asked[i]->stiffness_N_per_m, stiffness);
            begin_with_what_is_left(wall.damping_Ns_per_m, asked[i]->damping_Ns_per_m, damping);
        }
        wall.touches = true;
    }
}

TouchMaterial with_eased_friction(EasedFriction& state, TouchMaterial material, bool touched, double dt_s) noexcept {
    state.ticks = touched ? static_cast<std::uint8_t>(std::min(state.ticks + 1, 2)) : std::uint8_t{0};
    const bool goes_on = state.ticks > 1;
    const auto move = [&](Eased& value, double asked) {
        if (goes_on)
            value.move_to(asked, dt_s);
        else
            value.begin(asked, asked);
    };
    move(state.static_friction, material.static_friction);
    move(state.dynamic_friction, material.dynamic_friction);
    if (!goes_on) {
        state.coulomb_from_m_per_s = state.coulomb_to_m_per_s = material.coulomb_velocity_m_per_s;
        state.coulomb_share.begin(1.0, 1.0);
    } else if (state.coulomb_to_m_per_s != material.coulomb_velocity_m_per_s) {
        state.coulomb_from_m_per_s = std::exchange(state.coulomb_to_m_per_s, material.coulomb_velocity_m_per_s);
        state.coulomb_share.begin(0.0, 1.0);
    }
    state.coulomb_share.move_to(1.0, dt_s);
    material.static_friction = state.static_friction.value;
    material.dynamic_friction = std::min(state.dynamic_friction.value, state.static_friction.value);
    return material;
}

FrictionCone eased_friction_at(const EasedFriction& state, const TouchMaterial& material,
                               double slip_speed_m_per_s) noexcept {
    const FrictionCone to = friction_at(material, slip_speed_m_per_s);
    const double share = state.coulomb_share.value;
    if (state.ticks == 0 || share >= 1.0) return to;
    TouchMaterial before = material;
    before.coulomb_velocity_m_per_s = state.coulomb_from_m_per_s;
    const FrictionCone from = friction_at(before, slip_speed_m_per_s);
    return {from.static_friction + share * (to.static_friction - from.static_friction),
            from.dynamic_friction + share * (to.dynamic_friction - from.dynamic_friction)};
}

ContactForce eased(EasedForce& state, const ContactForce& force, double changed_s, double dt_s) noexcept {
    if (changed_s > 0.0) state = {state.last, state.last, 1.0 / changed_s, 0.0, state.changes()};
    state.last = force;
    if (!state.changes()) return force;
    const double step = state.rate_per_s * dt_s;
    state.gone += step;
    // The old force fades out within kEase_s, however long the new one takes to fade in.
    const double left = std::max(0.0, 1.0 - state.gone / std::min(1.0, state.rate_per_s * kEase_s)),
                 come = std::max(0.0, state.gone - (state.again ? step : 0.0));
    constexpr double kRounding = 1e-9;
    if (come >= 1.0 - kRounding) {
        state.rate_per_s = 0.0;
        return force;
    }
    const devices::DeviceWrench &from = state.from.wrench, &to = force.wrench;
    state.last = {{left * from.force_device_N + come * to.force_device_N,
                   left * from.torque_device_Nm + come * to.torque_device_Nm},
                  left * state.from.stored_J + come * force.stored_J};
    return state.last;
}

}  // namespace burin::haptics
