// SPDX-License-Identifier: MIT
// The promise over lost ticks (haptics/stability/energy_account.hpp) on ten thousand random devices, hands, jitters and
// losses of up to five ticks in a row: what the wall has given out since contact began never exceeds what the device's
// friction and damping have taken; neither while the gate fades a force in, nor when the surface is moved under the
// tool, nor on walls far stiffer than the limiter allows. Where the surface is that of a body that moves as announced,
// the work that the acting force does along its motion comes on top, as far as haptics/stability/passivity.hpp counts
// it as honest, and nothing else. The wall is simulated here in steps of a sixteenth of a period, with work and losses
// summed up exactly along the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "haptics/stability/passivity.hpp"
#include "haptics/stability/safety_gate.hpp"
#include "tests/haptics/wall_and_hand.hpp"

namespace burin::haptics {
namespace {

using test::Dice;
using test::Motion;

constexpr int kSteps = 16;  // a period
constexpr std::uint32_t kMostLost = 5;

struct Draw : test::WallAndHand {
    Nanoseconds step_ns = 0;
    int watchdog_steps = 0, jitter_steps = 0;
    int loses_one_in = 0;  // ticks; 0: none
    StiffnessLimit wall;
    PassivitySettings passivity;
    GateLimits limits;
    int jumps_one_in = 0, faults_one_in = 0, edits_one_in = 0;  // ticks; 0: never
    double body_speed_m_per_s = 0.0;                            // the surface's, at most; 0: it rests
};

Draw draw(Dice& dice) {
    Draw d;
    d.steps = kSteps;
    d.step_ns = nanoseconds(1.0 / (dice.spread(100.0, 4000.0) * kSteps));
    const double step_s = seconds(d.step_ns), period_s = kSteps * step_s;
    d.device.rate_Hz = 1.0 / period_s;
    d.draw_device(dice, period_s);
    if (dice.one_in(4)) d.watchdog_steps = d.delay_steps + 2 * kSteps + dice.below(8 * kSteps);
    d.device.watchdog_s = d.watchdog_steps * step_s;
    d.jitter_steps = dice.one_in(3) ? 0 : 1 + dice.below(kSteps / 2 - 1);
    d.loses_one_in = dice.one_in(8) ? 0 : 1 + dice.below(20);
    d.draw_wall(dice, period_s);
    d.passivity.contact_speed_m_per_s = d.demand.contact_speed_m_per_s;
    d.wall = limited(d.demand, d.device);
    // One in four without the limiter: the account has to hold whatever is rendered.
    if (dice.one_in(4)) d.wall = {d.demand.stiffness_N_per_m, d.demand.damping_Ns_per_m, StiffnessBound::none};
    d.passivity.lost_ticks = kMostLost;
    d.limits.max_force_N = dice.spread(1.0, 30.0);
    d.limits.max_slew_N_per_s = dice.spread(100.0, 1e6);
    d.limits.ramp_s = dice.spread(0.5, 200.0) * period_s;
    d.limits.contact_ramp_s = dice.spread(0.5, 100.0) * period_s;
    d.limits.recovery_s = dice.between(0.0, 20.0) * period_s;
    d.limits.max_loop_gap_s = dice.between(0.0, 10.0) * period_s;
    d.limits.max_speed_m_per_s = 100.0;
    if (dice.one_in(3)) d.jumps_one_in = 5 + dice.below(50);
    if (dice.one_in(4)) d.faults_one_in = 20 + dice.below(100);
    if (dice.one_in(4)) d.edits_one_in = 5 + dice.below(50);
    d.draw_hand(dice, period_s);
    return d;
}

// A surface that moves, at up to twice the hand's contact speed, and a limit to what counts as honest below that.
Draw draw_beside_a_body(Dice& dice) {
    Draw d = draw(dice);
    d.body_speed_m_per_s = 2.0 * d.demand.contact_speed_m_per_s;
    d.passivity.surface_speed_m_per_s = dice.one_in(2) ? 2.0 : dice.between(0.0, 1.0) * d.body_speed_m_per_s;
    return d;
}

class Simulation {
public:
    Simulation(const Draw& d, std::uint64_t seed) : d_(d), dice_(seed), body_dice_(seed), step_s_(seconds(d.step_ns)) {}

    // The most that has come out beyond what the device took; above 0 the promise is broken.
    double worst_excess_J(int periods, bool counts_body = true) {
        counts_body_ = counts_body;
        for (int i = 0; i < periods * kSteps && !tool_.too_fast(); ++i, ++now_) {
            if (now_ == next_tick_) {
                sample();
                next_tick_ = following_tick();
            }
            const double force_N = acting_N(now_ + 1);
            const double spring_N = d_.wall.stiffness_N_per_m * std::max(0.0, tool_.at_m() - surface_m_);
            account(tool_.step(force_N, spring_N), force_N);
        }
        return worst_J_;
    }
    [[nodiscard]] bool touched() const { return touched_; }
    [[nodiscard]] double honest_J() const { return honest_J_; }
    [[nodiscard]] int cut_ticks() const { return cut_; }
    [[nodiscard]] int contact_ticks() const { return contact_; }

private:
    // Deadlines lie a period apart. A tick is late by its jitter, and after it some deadlines may be lost.
    int following_tick() {
        int periods = 1;
        if (d_.loses_one_in > 0 && dice_.one_in(d_.loses_one_in)) periods += 1 + dice_.below(kMostLost);
        deadline_ += periods * kSteps;
        return deadline_ + (d_.jitter_steps > 0 ? dice_.below(d_.jitter_steps + 1) : 0);
    }

    void sample() {
        const Nanoseconds now_ns = 1'000'000'000 + now_ * d_.step_ns, last_ns = time_ns_;
        const double period_s = kSteps * step_s_, gap_s = last_ns > 0 ? seconds(now_ns - last_ns) : 0.0;
        time_ns_ = now_ns;
        settle_with_body();
        bool jumped = d_.jumps_one_in > 0 && dice_.one_in(d_.jumps_one_in);
        if (d_.edits_one_in > 0 && dice_.one_in(d_.edits_one_in)) {
            surface_m_ = dice_.between(-0.3, 0.3) * d_.depth_m;
            jumped = jumped || dice_.one_in(2);
        }
        const double measured = test::read_m(tool_.at_m(), d_.device);
        if (gap_s > 1.5 * period_s) window_.count = 0;
        window_ = with_position(window_, {measured, 0.0, 0.0});
        const VelocityEstimate v = estimate_velocity(d_.signals, window_, velocity_, d_.device.resolution_m, period_s);
        velocity_ = v.average;
        const double depth = measured - surface_m_;
        over_ = over_ || (depth <= 0.0 && !force_is_left());
        double force = 0.0;
        if (depth > 0.0)
            force = std::max(0.0, d_.wall.stiffness_N_per_m * depth +
                                      d_.wall.damping_Ns_per_m * (v.velocity_m_per_s.x - body_m_per_s_));
        force_ = with_input(force_, {force, 0.0, 0.0}, d_.signals.force_alpha);

        PassivityInput in;
        in.time_ns = in.now_ns = now_ns;
        in.position_device_m = {measured, 0.0, 0.0};
        in.window = &window_;
        in.wanted.force_device_N = -force_.value;
        in.stored_J = depth > 0.0 ? 0.5 * d_.wall.stiffness_N_per_m * depth * depth : 0.0;
        in.max_force_N = std::min(d_.limits.max_force_N, d_.device.max_force_N);
        in.in_contact = depth > 0.0;
        in.jumped = jumped;
        if (depth > 0.0) in.surface_velocity_device_m_per_s.x = body_m_per_s_;
        const PassivityStep kept = keep_passive(passivity_, in, d_.passivity, d_.device, period_s);
        passivity_ = kept.next;
        contact_ += depth > 0.0 ? 1 : 0;
        cut_ += depth > 0.0 && kept.record.share < 1.0 ? 1 : 0;

        GateInput gate;
        gate.wanted = kept.wrench;
        gate.device_max_force_N = std::min(d_.device.max_force_N, kept.record.most_N);
        gate.loop_gap_s = gap_s;
        gate.in_contact = in.in_contact;
        gate.contact_jumped = jumped;
        if (d_.faults_one_in > 0 && dice_.one_in(d_.faults_one_in)) gate.device_fault = devices::DeviceFault::other;
        const GateStep given = pass_gate(gate_, gate, d_.limits, period_s);
        gate_ = given.next;
        set_commanded_wrench(passivity_, given.output.given, now_ns);
        commands_.push_back({now_, -given.output.given.force_device_N.x});
        if (commands_.size() > 12) commands_.pop_front();
        if (d_.body_speed_m_per_s > 0.0) steer_body();
    }

    // Changes the body's velocity now and then, and turns it back before it leaves the hand's range.
    void steer_body() {
        if (body_dice_.one_in(8)) body_m_per_s_ = body_dice_.between(-1.0, 1.0) * d_.body_speed_m_per_s;
        if (std::abs(surface_m_) > 0.5 * d_.depth_m) body_m_per_s_ = -std::copysign(body_m_per_s_, surface_m_);
    }

    // From sample to sample what the body has given counts, but not what it has taken.
    void settle_with_body() {
        honest_J_ += std::max(0.0, by_body_J_);
        taken_J_ += std::max(0.0, by_body_J_);
        by_body_J_ = 0.0;
    }

    // The command of a transport delay ago; none once the watchdog has gone off. The next one is written at `next`.
    [[nodiscard]] double acting_N(int next) const {
        for (std::size_t i = commands_.size(); i-- > 0;) {
            const Command& c = commands_[i];
            if (c.step + d_.delay_steps > now_) continue;
            const int written = i + 1 < commands_.size() ? commands_[i + 1].step : next;
            const int silent = c.step + d_.watchdog_steps;
            return d_.watchdog_steps > 0 && written > silent && now_ >= silent ? 0.0 : c.force_N;
        }
        return 0.0;
    }

    [[nodiscard]] bool force_is_left() const {
        return acting_N(now_) != 0.0 || std::ranges::any_of(commands_, [&](const Command& c) {
                   return c.force_N != 0.0 && c.step + d_.delay_steps > now_;
               });
    }

    void account(double dx, double force_N) {
        if (tool_.too_fast()) return;
        const double most = d_.passivity.surface_speed_m_per_s;
        if (counts_body_) by_body_J_ -= force_N * std::clamp(body_m_per_s_, -most, most) * step_s_;
        surface_m_ += body_m_per_s_ * step_s_;
        // A contact is over when a tick sees the tool outside and no force is left, and then begins at the next touch.
        if (over_ && tool_.at_m() <= surface_m_ && tool_.at_m() - dx <= surface_m_) {
            given_J_ = taken_J_ = by_body_J_ = 0.0;
            return;
        }
        over_ = false;
        touched_ = true;
        given_J_ -= force_N * dx;
        taken_J_ += d_.device.friction_N * std::abs(dx) + d_.device.damping_Ns_per_m * dx * dx / step_s_;
        worst_J_ = std::max(worst_J_, given_J_ - taken_J_ - std::max(0.0, by_body_J_));
    }

    struct Command {
        int step = 0;
        double force_N = 0.0;
    };
    const Draw& d_;
    Dice dice_, body_dice_;
    double step_s_;
    int now_ = 0, next_tick_ = 0, deadline_ = 0;
    Nanoseconds time_ns_ = 0;
    test::MovedTool tool_{d_, step_s_, dice_};
    double surface_m_ = 0.0, body_m_per_s_ = 0.0;
    std::deque<Command> commands_;
    VelocityWindow window_;
    MovingAverage velocity_, force_;
    PassivityState passivity_;
    GateState gate_;
    bool touched_ = false, over_ = true, counts_body_ = true;
    int cut_ = 0, contact_ = 0;
    double given_J_ = 0.0, taken_J_ = 0.0, worst_J_ = -HUGE_VAL;
    double by_body_J_ = 0.0;  // given since the last sample, as far as it counts
    double honest_J_ = 0.0;   // counted in all
};

constexpr int kDraws = 10'000, kPeriods = 250;
constexpr double kRounding_J = 1e-12;

}  // namespace

TEST(LostTicks, BreakNoPromiseOnTenThousandDevicesHandsJittersAndLosses) {
    int touched = 0;
    for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
        Dice dice(seed);
        const Draw d = draw(dice);
        Simulation simulation(d, seed);
        const double excess = simulation.worst_excess_J(kPeriods);
        touched += simulation.touched() ? 1 : 0;
        ASSERT_LE(excess, kRounding_J) << "draw " << seed << ", wall " << d.wall.stiffness_N_per_m << " N/m, "
                                       << d.wall.damping_Ns_per_m << " Ns/m, motion " << static_cast<int>(d.motion);
    }
    EXPECT_GT(touched, kDraws * 9 / 10);
}

TEST(LostTicks, BreakNoPromiseBesideBodiesThatMoveButForTheirHonestWork) {
    int touched = 0, given = 0;
    for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
        Dice dice(seed);
        const Draw d = draw_beside_a_body(dice);
        Simulation simulation(d, seed);
        const double excess = simulation.worst_excess_J(kPeriods);
        touched += simulation.touched() ? 1 : 0;
        given += simulation.honest_J() > 0.0 ? 1 : 0;
        ASSERT_LE(excess, kRounding_J) << "draw " << seed << ", wall " << d.wall.stiffness_N_per_m
                                       << " N/m, honest up to " << d.passivity.surface_speed_m_per_s << " m/s";
    }
    EXPECT_GT(touched, kDraws * 9 / 10);
    EXPECT_GT(given, kDraws / 2);
}

// What a body gives is felt: with that left out of the sum, more comes out than the device took.
TEST(LostTicks, GiveOutWhatMovingBodiesGive) {
    int more = 0;
    for (std::uint64_t seed = 1; seed <= kDraws / 10; ++seed) {
        Dice dice(seed);
        Draw d = draw_beside_a_body(dice);
        d.passivity.surface_speed_m_per_s = 2.0;
        Simulation simulation(d, seed);
        more += simulation.worst_excess_J(kPeriods, false) > kRounding_J ? 1 : 0;
    }
    EXPECT_GT(more, kDraws / 10 / 10);
}

// The tests above would also pass if nothing ever came out, or with an account that gives next to no force.
TEST(LostTicks, BreakItOnManyOfThemWhereNothingKeepsIt) {
    int broken = 0;
    for (std::uint64_t seed = 1; seed <= kDraws / 10; ++seed) {
        Dice dice(seed);
        Draw d = draw(dice);
        d.passivity.control = false;
        broken += Simulation(d, seed).worst_excess_J(kPeriods) > kRounding_J ? 1 : 0;
    }
    EXPECT_GT(broken, kDraws / 10 / 10);
}

TEST(LostTicks, TheDefaultWallOnAnOmniIsFeltInFullWhileNoneIsLost) {
    // Hands that hold the stylus, at up to the contact speed: how often the account cuts the force.
    int cut = 0, contact = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        Dice dice(seed);
        Draw d = draw(dice);
        d.step_ns = 62'500;
        d.device = {};
        d.device.friction_N = 0.26;
        d.device.damping_Ns_per_m = 0.05;
        d.device.apparent_mass_kg = 0.045;
        d.device.resolution_m = 0.055e-3;
        d.device.max_force_N = 3.3;
        d.device.delay_s = 0.001;
        d.delay_steps = kSteps;
        d.watchdog_steps = d.jitter_steps = d.loses_one_in = 0;
        d.jumps_one_in = d.faults_one_in = d.edits_one_in = 0;
        d.demand = {600.0, 0.5};
        d.wall = limited(d.demand, d.device);
        d.signals = {};
        d.passivity = {};
        d.limits = {};
        d.limits.ramp_s = 0.0;
        d.motion = Motion::held_by_a_hand;
        d.depth_m = dice.between(1e-3, 8e-3);
        Simulation simulation(d, seed);
        EXPECT_LE(simulation.worst_excess_J(400), kRounding_J) << seed;
        cut += simulation.cut_ticks();
        contact += simulation.contact_ticks();
    }
    EXPECT_GT(contact, 10'000);
    EXPECT_LT(cut, contact / 200);  // 115 of 61,124: contacts that begin near the contact speed
}

}  // namespace burin::haptics
