// SPDX-License-Identifier: MIT
// The limiter's promise (haptics/stability/rendered_wall.hpp) on ten thousand random devices, hands and motions: what
// a sampled wall has given out since the contact began never exceeds what the device's friction and damping have taken.
// The wall is simulated here, in steps of an eighth of a period, with work and losses summed up exactly along the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "tests/haptics/wall_and_hand.hpp"

namespace burin::haptics {
namespace {

using test::Dice;
using test::Motion;
using Draw = test::WallAndHand;

constexpr int kSteps = 8;  // a period

Draw draw(Dice& dice) {
    Draw d;
    d.steps = kSteps;
    d.device.rate_Hz = dice.spread(100.0, 4000.0);
    const double period_s = 1.0 / d.device.rate_Hz;
    d.draw_device(dice, period_s);
    d.draw_wall(dice, period_s);
    d.draw_hand(dice, period_s);
    return d;
}

class Simulation {
public:
    Simulation(const Draw& d, const StiffnessLimit& wall, std::uint64_t seed)
        : d_(d), wall_(wall), dice_(seed), period_s_(1.0 / d.device.rate_Hz), step_s_(period_s_ / kSteps) {
        told_.assign(static_cast<std::size_t>(d.delay_steps) + 1, 0.0);
    }

    // The most that has come out beyond what the device took; above 0 the promise is broken.
    double worst_excess_J(int ticks) {
        for (int i = 0; i < ticks * kSteps && !tool_.too_fast(); ++i) {
            if (i % kSteps == 0) sample();
            told_.push_back(command_N_);
            told_.pop_front();
            const double spring_N = wall_.stiffness_N_per_m * std::max(0.0, tool_.at_m());
            account(tool_.step(told_.front(), spring_N), told_.front());
        }
        return worst_J_;
    }
    [[nodiscard]] bool touched() const { return touched_; }

private:
    void sample() {
        const double measured = test::read_m(tool_.at_m(), d_.device);
        window_ = with_position(window_, {measured, 0.0, 0.0});
        const VelocityEstimate v = estimate_velocity(d_.signals, window_, velocity_, d_.device.resolution_m, period_s_);
        velocity_ = v.average;
        double force = 0.0;
        if (measured > 0.0) {
            force = std::max(0.0, wall_.stiffness_N_per_m * measured + wall_.damping_Ns_per_m * v.velocity_m_per_s.x);
        }
        force = std::min(force, d_.device.max_force_N);
        force_ = with_input(force_, {force, 0.0, 0.0}, d_.signals.force_alpha);
        command_N_ = force_.value.x;
    }

    void account(double dx, double force_N) {
        if (tool_.too_fast()) return;
        const double lost = d_.device.friction_N * std::abs(dx) + d_.device.damping_Ns_per_m * dx * dx / step_s_;
        recent_.push_back(lost);
        if (recent_.size() > static_cast<std::size_t>(kSteps * (VelocityWindow::kLongest + 1))) recent_.pop_front();
        // A contact is over when no force is left on its way either.
        const bool touches = tool_.at_m() > 0.0 || tool_.at_m() - dx > 0.0 || command_N_ > 1e-12 ||
                             std::ranges::any_of(told_, [](double force) { return force > 1e-12; });
        if (!touches) {
            in_contact_ = false;
            return;
        }
        if (!in_contact_) begin_contact();
        given_J_ -= force_N * dx;
        taken_J_ += lost;
        if (d_.device.friction_N == 0.0) {  // nothing hides the encoder's steps: their share, a force times the way
            const double D = d_.device.resolution_m;
            taken_J_ += (0.5 * wall_.stiffness_N_per_m * D + wall_.damping_Ns_per_m * D / period_s_) * std::abs(dx);
        }
        worst_J_ = std::max(worst_J_, given_J_ - taken_J_);
    }

    void begin_contact() {
        in_contact_ = touched_ = true;
        given_J_ = taken_J_ = 0.0;
        // A damper remembers the motion before, and has to answer for it.
        if (wall_.damping_Ns_per_m > 0.0)
            for (const double lost : recent_) taken_J_ += lost;
    }

    const Draw& d_;
    StiffnessLimit wall_;
    Dice dice_;
    double period_s_, step_s_;
    test::MovedTool tool_{d_, step_s_, dice_};
    double command_N_ = 0.0;
    std::deque<double> told_, recent_;
    VelocityWindow window_;
    MovingAverage velocity_, force_;
    bool in_contact_ = false, touched_ = false;
    double given_J_ = 0.0, taken_J_ = 0.0, worst_J_ = -HUGE_VAL;
};

constexpr int kDraws = 10'000, kTicks = 120;
constexpr double kRounding_J = 1e-12;

}  // namespace

TEST(StiffnessLimit, KeepsEveryWallPassiveOnTenThousandDevicesHandsAndMotions) {
    int touched = 0, limited_ones = 0;
    for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
        Dice dice(seed);
        const Draw d = draw(dice);
        const StiffnessLimit wall = limited(d.demand, d.device);
        limited_ones += wall.bound != StiffnessBound::none ? 1 : 0;
        Simulation simulation(d, wall, seed);
        const double excess = simulation.worst_excess_J(kTicks);
        touched += simulation.touched() ? 1 : 0;
        ASSERT_LE(excess, kRounding_J) << "draw " << seed << ", wall " << wall.stiffness_N_per_m << " N/m, "
                                       << wall.damping_Ns_per_m << " Ns/m, motion " << static_cast<int>(d.motion);
    }
    EXPECT_GT(touched, kDraws * 9 / 10);
    EXPECT_GT(limited_ones, kDraws / 3);  // else nothing is tried at the limit
}

// The test above would also pass on a limiter that allows next to nothing, or in a simulation that loses energy.
TEST(StiffnessLimit, IsNotFarBelowWhatBreaksThePromise) {
    int broken = 0, tried = 0;
    for (std::uint64_t seed = 1; seed <= kDraws / 10; ++seed) {
        Dice dice(seed);
        Draw d = draw(dice);
        d.demand.stiffness_N_per_m = 1e7;
        d.demand.damping_Ns_per_m = 0.0;
        d.motion = Motion::against_the_wall;
        d.device.max_force_N = 1e9;
        StiffnessLimit wall = limited(d.demand, d.device);
        wall.stiffness_N_per_m *= 3.0;
        ++tried;
        Simulation simulation(d, wall, seed);
        broken += simulation.worst_excess_J(kTicks) > kRounding_J ? 1 : 0;
    }
    EXPECT_GT(broken, tried / 2);
}

TEST(StiffnessLimit, IsExactForASteadyMotionBackAndForth) {
    Draw d;
    d.device.rate_Hz = 1000.0;
    d.device.friction_N = 0.26;
    d.device.damping_Ns_per_m = 0.05;
    d.device.delay_s = 0.001;
    d.device.max_force_N = 1e9;
    d.delay_steps = kSteps;
    d.demand.stiffness_N_per_m = 1e7;
    d.depth_m = 0.15;  // a thousand ticks: the turns do not count
    const double most = limited(d.demand, d.device).stiffness_N_per_m;
    const auto excess = [&](double stiffness) {
        return Simulation(d, {stiffness, 0.0, StiffnessBound::none}, 1).worst_excess_J(6000);
    };
    EXPECT_LE(excess(most), kRounding_J);
    EXPECT_GT(excess(1.02 * most), kRounding_J);
}

}  // namespace burin::haptics
