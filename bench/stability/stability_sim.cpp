// SPDX-License-Identifier: MIT
#include "bench/stability/stability_sim.hpp"

#include <algorithm>
#include <cmath>

#include "devices/haptic/simulated_omni.hpp"
#include "haptics/forces/touch_force.hpp"

namespace burin::bench {
namespace {

constexpr double kLongestStep_s = 50e-6;
constexpr double kStart_m = 0.005;  // above the wall
constexpr double kStill_N = 0.01;   // a tick; a hand feels larger changes as buzzing

// A mass with damping and dry friction under a constant force, solved exactly.
class Body {
public:
    Body(double mass_kg, double damping_Ns_per_m, double friction_N, double step_s)
        : mass_(mass_kg), damping_(damping_Ns_per_m), friction_(friction_N), step_s_(step_s) {}

    double position_m = 0.0, speed_m_per_s = 0.0;

    void move(double force_N) {
        double left_s = step_s_;
        // The body stops at most once and starts again at most once; the third piece is for rounding.
        for (int piece = 0; piece < 3 && left_s > 0.0; ++piece) {
            if (speed_m_per_s == 0.0 && std::abs(force_N) <= friction_) return;
            left_s -= slide(force_N, left_s);
        }
    }

private:
    // Moves until the time is over or the motion stops; returns how long that was.
    double slide(double force_N, double most_s) {
        const double way = speed_m_per_s != 0.0 ? speed_m_per_s : force_N;
        const double pull = force_N - std::copysign(friction_, way);
        const double speed = speed_after(pull, most_s);
        const bool stops = speed_m_per_s != 0.0 && speed * speed_m_per_s < 0.0;
        const double time_s = stops ? stop_s(pull, most_s) : most_s;
        position_m += way_after(pull, time_s);
        speed_m_per_s = stops ? 0.0 : speed;
        return time_s;
    }

    [[nodiscard]] double speed_after(double pull, double t) const {
        if (damping_ * t < 1e-9 * mass_) return speed_m_per_s + pull / mass_ * t;
        return speed_m_per_s + (pull / damping_ - speed_m_per_s) * -std::expm1(-damping_ * t / mass_);
    }
    [[nodiscard]] double way_after(double pull, double t) const {
        if (damping_ * t < 1e-9 * mass_) return (speed_m_per_s + 0.5 * pull / mass_ * t) * t;
        const double end = pull / damping_;
        return end * t + (speed_m_per_s - end) * mass_ / damping_ * -std::expm1(-damping_ * t / mass_);
    }
    [[nodiscard]] double stop_s(double pull, double most_s) const {
        const double t = damping_ * most_s < 1e-9 * mass_
                             ? -speed_m_per_s * mass_ / pull
                             : mass_ / damping_ * std::log1p(-speed_m_per_s * damping_ / pull);
        return std::clamp(t, 0.0, most_s);
    }

    double mass_, damping_, friction_, step_s_;
};

class Wall {
public:
    Wall(const StabilityCase& what, double stiffness)
        : what_(what),
          period_s_(1.0 / what.device.rate_Hz),
          steps_(std::max(4, static_cast<int>(std::ceil(period_s_ / kLongestStep_s - 1e-9)))),
          step_s_(period_s_ / steps_),
          delay_steps_(static_cast<int>(std::lround(what.device.delay_s / step_s_))),
          held_(what.task != HandTask::none),
          body_(what.device.apparent_mass_kg + (held_ ? what.grip.mass_kg : 0.0),
                what.device.damping_Ns_per_m + (held_ ? what.grip.damping_Ns_per_m : 0.0), what.device.friction_N,
                step_s_) {
        render(stiffness);
        settings_ = what.passivity;
        settings_.control = what.control;
        body_.position_m = held_ ? kStart_m : 0.0;
        body_.speed_m_per_s = held_ ? 0.0 : what.tap_speed_m_per_s;
        ticks_ = static_cast<int>(std::lround(what.duration_s / period_s_));
        told_N_.reserve(static_cast<std::size_t>(ticks_));
    }

    StabilityRun run(std::vector<Trace>* trace) {
        for (int tick = 0; tick < ticks_; ++tick) {
            told_N_.push_back(control(tick));
            note(tick);
            if (trace != nullptr) trace->push_back({tick * period_s_, body_.position_m, told_N_.back()});
            for (int i = 0; i < steps_; ++i) {
                const int s = tick * steps_ + i;
                const double force_N =
                    s < delay_steps_ ? 0.0 : told_N_[static_cast<std::size_t>((s - delay_steps_) / steps_)];
                step(s, force_N);
            }
        }
        finish();
        return out_;
    }

private:
    void render(double stiffness) {
        wall_ = haptics::through(what_.coupling, {stiffness, what_.wall_damping_Ns_per_m});
        if (what_.limit) {
            haptics::ContactDemand demand;
            demand.stiffness_N_per_m = wall_.stiffness_N_per_m;
            demand.damping_Ns_per_m = wall_.damping_Ns_per_m;
            demand.filter_lag_s = haptics::mean_lag_s(what_.signals.force_alpha, period_s_);
            demand.period_s = period_s_;
            const haptics::StiffnessLimit limit = haptics::limited(demand, what_.device);
            wall_ = {limit.stiffness_N_per_m, limit.damping_Ns_per_m};
        }
        out_.rendered = wall_;
    }

    // Computes one tick, from the encoder's position to the commanded force.
    double control(int tick) {
        const double D = what_.device.resolution_m;
        const double measured = D > 0.0 ? D * std::floor(body_.position_m / D + 0.5) : body_.position_m;
        const bool in_contact = !held_ || measured < 0.0;
        Vec3 velocity(0.0);
        window_ = haptics::with_position(window_, {0.0, measured, 0.0});
        if (wall_.damping_Ns_per_m > 0.0) {
            const haptics::VelocityEstimate estimate =
                haptics::estimate_velocity(what_.signals, window_, velocity_, D, period_s_);
            velocity_ = estimate.average;
            velocity = estimate.velocity_m_per_s;
        }
        Vec3 force(0.0);
        if (in_contact) force = force_at({0.0, measured, 0.0}, velocity);
        if (what_.signals.force_alpha > 0.0) {
            filtered_ = haptics::with_input(filtered_, force, what_.signals.force_alpha);
            force = filtered_.value;
        }
        const double spring_J = in_contact ? 0.5 * wall_.stiffness_N_per_m * measured * measured : 0.0;
        const Nanoseconds now_ns = nanoseconds((tick + 1) * period_s_);
        if (held_) force = kept_passive(now_ns, {0.0, measured, 0.0}, force, spring_J, in_contact);
        out_.contact_ticks += in_contact ? 1 : 0;
        const double most = what_.device.max_force_N > 0.0 ? what_.device.max_force_N : HUGE_VAL;
        const double given = std::clamp(force.y, -most, most);
        if (held_) haptics::set_commanded_wrench(passivity_, {{0.0, given, 0.0}, Vec3(0.0)}, now_ns);
        return given;
    }

    // A wall pushes to its side only; the wall with two sides pulls too, as the textbook's spring does.
    [[nodiscard]] Vec3 force_at(const Vec3& measured, const Vec3& velocity) const {
        if (!held_) return -wall_.stiffness_N_per_m * measured - wall_.damping_Ns_per_m * velocity;
        haptics::TouchInput touch;
        touch.hip_object_m = measured;
        touch.normal_object = {0.0, 1.0, 0.0};
        touch.velocity_device_m_per_s = velocity;
        touch.stiffness_N_per_m = wall_.stiffness_N_per_m;
        touch.damping_Ns_per_m = wall_.damping_Ns_per_m;
        return touch_force_device(touch);
    }

    Vec3 kept_passive(Nanoseconds now_ns, const Vec3& measured, const Vec3& force, double spring_J, bool in_contact) {
        haptics::PassivityInput input;
        input.time_ns = input.now_ns = now_ns;
        input.window = &window_;
        input.position_device_m = measured;
        input.wanted.force_device_N = force;
        input.stored_J = spring_J;
        input.max_force_N = what_.device.max_force_N;
        input.in_contact = in_contact;
        const haptics::PassivityStep kept =
            haptics::keep_passive(passivity_, input, settings_, what_.device, period_s_);
        passivity_ = kept.next;
        out_.acted_ticks += kept.record.damping_Ns_per_m > 0.0 || kept.record.share < 1.0 ? 1 : 0;
        return kept.wrench.force_device_N;
    }

    // The hand's goal and the velocity at which it moves.
    struct Target {
        double position_m = 0.0, speed_m_per_s = 0.0;
    };
    [[nodiscard]] Target target(double t) const {
        const double v = what_.tap_speed_m_per_s, lowest = -what_.press_N / what_.grip.stiffness_N_per_m;
        const double down_s = (kStart_m - lowest) / v, rest_s = 0.1;
        if (t < down_s) return {kStart_m - v * t, -v};
        if (what_.task == HandTask::tap || t < down_s + rest_s) return {lowest, 0.0};
        const double up = lowest + v * (t - down_s - rest_s);
        return up < kStart_m ? Target{up, v} : Target{kStart_m, 0.0};
    }

    void step(int s, double force_N) {
        const double before = body_.position_m, speed = body_.speed_m_per_s;
        double pull = force_N;
        if (held_) {
            const Target to = target((s + 0.5) * step_s_);
            pull += what_.grip.stiffness_N_per_m * (to.position_m - before - 0.5 * speed * step_s_) +
                    what_.grip.damping_Ns_per_m * to.speed_m_per_s;
        }
        body_.move(pull);
        account(before, speed, force_N);
    }

    // Accounts for the energy of one contact: the work of the wall's force less what the device's friction and damping
    // dissipated (at the mean speed, which underestimates it).
    void account(double before, double speed, double force_N) {
        const double moved = body_.position_m - before;
        if (held_ && before > 0.0 && body_.position_m > 0.0 && std::abs(force_N) < 1e-6) {
            balance_J_ = 0.0;
            return;
        }
        const double mean = 0.5 * (speed + body_.speed_m_per_s);
        balance_J_ += force_N * moved - what_.device.friction_N * std::abs(moved) -
                      what_.device.damping_Ns_per_m * std::abs(mean * moved);
        out_.net_energy_J = std::max(out_.net_energy_J, balance_J_);
        out_.deepest_m = std::max(out_.deepest_m, -body_.position_m);
    }

    void note(int tick) {
        const double y = body_.position_m;
        const double change =
            tick > 0 ? std::abs(told_N_[static_cast<std::size_t>(tick)] - told_N_[static_cast<std::size_t>(tick) - 1])
                     : 0.0;
        change_sum_N_ += change;
        if (5 * tick < ticks_) out_.early_m = std::max(out_.early_m, std::abs(y));
        if (5 * tick < 4 * ticks_) return;
        if (late_ticks_++ == 0) lowest_ = highest_ = y;
        lowest_ = std::min(lowest_, y);
        highest_ = std::max(highest_, y);
        late_sum_N_ += change;
        out_.late_m = std::max(out_.late_m, std::abs(y));
    }

    void finish() {
        out_.swing_m = highest_ - lowest_;
        out_.late_change_N = late_ticks_ > 0 ? late_sum_N_ / late_ticks_ : 0.0;
        out_.force_change_N = out_.contact_ticks > 0 ? change_sum_N_ / out_.contact_ticks : 0.0;
    }

    const StabilityCase& what_;
    double period_s_;
    int steps_;
    double step_s_;
    int delay_steps_, ticks_ = 0;
    bool held_;
    Body body_;
    haptics::CoupledWall wall_;
    haptics::PassivitySettings settings_;
    haptics::VelocityWindow window_;
    haptics::MovingAverage velocity_, filtered_;
    haptics::PassivityObserver passivity_;
    std::vector<double> told_N_;
    double balance_J_ = 0.0, change_sum_N_ = 0.0, late_sum_N_ = 0.0, lowest_ = 0.0, highest_ = 0.0;
    int late_ticks_ = 0;
    StabilityRun out_;
};

// Returns a duration in which a free device shows growth near the limit: many oscillations, within bounds.
double free_duration_s(const StabilityCase& what, double stiffness) {
    const double swing_s = 6.3 * std::sqrt(what.device.apparent_mass_kg / stiffness);
    return std::clamp(80.0 * swing_s, 0.5, 8.0);
}

}  // namespace

devices::DeviceDescription omni_without_delay() {
    const devices::OmniModel model;
    devices::DeviceDescription d;
    d.name = "PHANTOM Omni";
    d.resolution_m = model.resolution_m;
    d.max_force_N = model.max_force_N;
    d.max_stiffness_N_per_m = model.max_stiffness_N_per_m;
    d.apparent_mass_kg = model.apparent_mass_kg;
    d.damping_Ns_per_m = model.damping_Ns_per_m;
    d.friction_N = model.friction_N;
    return d;
}

StabilityRun run_wall(const StabilityCase& what, double stiffness_N_per_m, std::vector<Trace>* trace) {
    StabilityCase lasting = what;
    if (what.task == HandTask::none) lasting.duration_s = free_duration_s(what, stiffness_N_per_m);
    return Wall(lasting, stiffness_N_per_m).run(trace);
}

bool stable(const StabilityCase& what, const StabilityRun& run) {
    const double still_m = std::max(2.0 * what.device.resolution_m, 2e-6);
    if (what.task == HandTask::none) return run.late_m <= run.early_m || run.late_m <= still_m;
    return run.swing_m <= still_m && run.late_change_N <= kStill_N;
}

StiffnessScan scan_stiffness(const StabilityCase& what, double lowest_N_per_m, double highest_N_per_m, double ratio) {
    const auto good = [&](double stiffness) { return stable(what, run_wall(what, stiffness)); };
    StiffnessScan scan;
    int tested = 0, failing = 0;
    const int steps = static_cast<int>(std::ceil(std::log(highest_N_per_m / lowest_N_per_m) / std::log(ratio)));
    for (int i = 0; i <= steps; ++i) {
        const double stiffness = std::min(lowest_N_per_m * std::pow(ratio, i), highest_N_per_m);
        const bool fails = !good(stiffness);
        if (fails && failing == 0) scan.first_failure_N_per_m = stiffness;
        if (!fails && failing == 0) scan.stable_up_to_N_per_m = stiffness;
        failing += fails ? 1 : 0;
        tested += failing > 0 ? 1 : 0;
    }
    scan.failing_share = tested > 0 ? static_cast<double>(failing) / tested : 0.0;
    double &low = scan.stable_up_to_N_per_m, &high = scan.first_failure_N_per_m;
    while (low > 0.0 && high > 1.001 * low) {
        const double middle = std::sqrt(low * high);
        (good(middle) ? low : high) = middle;
    }
    return scan;
}

}  // namespace burin::bench
