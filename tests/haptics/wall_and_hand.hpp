// SPDX-License-Identifier: MIT
// Random devices, walls and hands in one dimension: what the simulations of the promises share (passivity_prop.cpp,
// lost_ticks_prop.cpp). Depth is positive into the wall, and so is motion; the force pushes out.
#pragma once

#include <cmath>
#include <random>

#include "haptics/signals/filters.hpp"
#include "haptics/stability/rendered_wall.hpp"

namespace burin::haptics::test {

class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double between(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double spread(double lo, double hi) { return lo * std::pow(hi / lo, between(0.0, 1.0)); }  // logarithmically
    bool one_in(int n) { return engine_() % static_cast<std::uint64_t>(n) == 0; }
    int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

private:
    std::mt19937_64 engine_;  // its numbers are the same everywhere
};

enum class Motion { back_and_forth, random_turns, against_the_wall, held_by_a_hand };

struct WallAndHand {
    int steps = 8;  // of the simulation, in a period
    devices::DeviceDescription device;
    int delay_steps = 0;
    ContactDemand demand;
    SignalSettings signals;
    Motion motion = Motion::back_and_forth;
    double depth_m = 0.0;  // how deep the motion goes
    double hand_mass_kg = 0.0, hand_stiffness_N_per_m = 0.0, hand_damping_Ns_per_m = 0.0;

    // The device but for its rate; then the wall and the signals; then the hand and its motion.
    void draw_device(Dice& dice, double period_s) {
        device.apparent_mass_kg = dice.spread(0.02, 0.5);
        device.damping_Ns_per_m = dice.one_in(5) ? 0.0 : dice.spread(0.01, 20.0);
        if (!dice.one_in(5) || device.damping_Ns_per_m == 0.0) device.friction_N = dice.spread(0.01, 2.0);
        device.resolution_m = dice.one_in(5) ? 0.0 : dice.spread(1e-6, 2e-4);
        device.max_force_N = dice.spread(1.0, 30.0);
        delay_steps = dice.one_in(2) ? steps * dice.below(4) : dice.below(4 * steps);
        device.delay_s = delay_steps * period_s / steps;
    }
    void draw_wall(Dice& dice, double period_s) {
        demand.contact_speed_m_per_s = dice.spread(0.02, 1.0);
        demand.stiffness_N_per_m = dice.one_in(2) ? 1e7 : dice.spread(10.0, 1e4);
        demand.damping_Ns_per_m = dice.one_in(2) ? 0.0 : dice.spread(0.05, 20.0);
        signals.force_alpha = dice.one_in(3) ? dice.between(0.1, 0.95) : 0.0;
        demand.filter_lag_s = mean_lag_s(signals.force_alpha, period_s);
        signals.velocity = static_cast<VelocityMethod>(dice.below(3));
    }
    void draw_hand(Dice& dice, double period_s) {
        motion = static_cast<Motion>(dice.below(4));
        depth_m = demand.contact_speed_m_per_s * period_s * dice.between(1.0, 40.0);
        hand_mass_kg = dice.spread(0.02, 1.0);
        hand_stiffness_N_per_m = dice.spread(10.0, 3000.0);
        hand_damping_Ns_per_m = dice.spread(0.3, 30.0);
    }
};

// The tool, as the hand moves it.
class MovedTool {
public:
    // All references must outlive it. The dice are the simulation's.
    MovedTool(const WallAndHand& d, double step_s, Dice& dice) : d_(d), step_s_(step_s), dice_(dice) {
        // A hand that starts at full speed would soon be too fast.
        const bool held = d.motion == Motion::held_by_a_hand;
        x_ = held ? -0.1 * d.depth_m : -0.5 * d.depth_m;
        v_ = held ? 0.7 * d.demand.contact_speed_m_per_s : d.demand.contact_speed_m_per_s;
        target_m_ = 0.5 * d.depth_m;
    }

    // Moves for a step against this force; returns the way. spring_N is the force that the wall should have.
    double step(double force_N, double spring_N) {
        const double V = d_.demand.contact_speed_m_per_s;
        switch (d_.motion) {
            case Motion::back_and_forth: turn_at_ends(); break;
            case Motion::random_turns:
                if (dice_.one_in(d_.steps * 3 / 4)) v_ = dice_.between(-V, V);
                if (dice_.one_in(d_.steps * 3 / 4)) v_ = std::copysign(V, v_);
                turn_at_ends();
                break;
            // Moves in where the force is less than the spring would have it, and out where it is more.
            case Motion::against_the_wall:
                v_ = std::copysign(V, spring_N - force_N);
                if (dice_.one_in(d_.steps * 5 / 4)) v_ = -v_;
                turn_at_ends();
                break;
            case Motion::held_by_a_hand: move_freely(force_N); break;
        }
        x_ += v_ * step_s_;
        return v_ * step_s_;
    }

    [[nodiscard]] double at_m() const { return x_; }
    [[nodiscard]] bool too_fast() const { return too_fast_; }  // nothing is promised of that

private:
    void turn_at_ends() {
        if (x_ > d_.depth_m) v_ = -std::abs(v_);
        if (x_ < -0.3 * d_.depth_m) v_ = std::abs(v_);
    }

    void move_freely(double force_N) {
        const double mass = d_.device.apparent_mass_kg + d_.hand_mass_kg;
        if (dice_.one_in(40 * d_.steps)) target_m_ = dice_.between(-0.5, 1.0) * d_.depth_m;
        const double pull = d_.hand_stiffness_N_per_m * (target_m_ - x_) - force_N;
        const double damping = d_.device.damping_Ns_per_m + d_.hand_damping_Ns_per_m;
        const double v = (v_ + step_s_ / mass * pull) / (1.0 + step_s_ / mass * damping);
        const double brake = step_s_ * d_.device.friction_N / mass;
        v_ = std::abs(v) <= brake ? 0.0 : v - std::copysign(brake, v);
        too_fast_ = std::abs(v_) > d_.demand.contact_speed_m_per_s;
    }

    const WallAndHand& d_;
    double step_s_;
    Dice& dice_;
    double x_ = 0.0, v_ = 0.0, target_m_ = 0.0;
    bool too_fast_ = false;
};

// The position as the device's encoder reads it.
[[nodiscard]] inline double read_m(double at_m, const devices::DeviceDescription& device) {
    const double D = device.resolution_m;
    return D > 0.0 ? D * std::floor(at_m / D + 0.5) : at_m;
}

}  // namespace burin::haptics::test
