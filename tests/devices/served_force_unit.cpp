// SPDX-License-Identifier: MIT
// The force of served arms in told time: none in any turn once the haptic thread is silent, none that is no number,
// none while a sample says that something is wrong, and none in the last turn of all.
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "devices/served/line_servo.hpp"
#include "devices/served/served_arm.hpp"
#include "tests/devices/told_clock.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::devices {
namespace {

DeviceWrench wrench_asked() { return {40.0 * uneven_offset(1), 3.0 * uneven_offset(2)}; }

// A line that gives a command for so many turns, falls silent, and gives one again.
class SilencedLine final : public DeviceLine {
public:
    struct Turn {
        Nanoseconds since_command_ns = 0;
        Vec3 force_N{0.0}, torque_Nm{0.0};
    };
    struct Record {
        LineServo* servo = nullptr;
        std::vector<Turn> turns;
        DeviceWrench last;  // also when the turns are over
        std::promise<void> begins, is_over;
    };
    SilencedLine(ToldClock& clock, Record& record) : clock_(clock), record_(record) {}
    static constexpr std::size_t kSpeaks = 20, kSilent = 80, kTurns = 3 * (kSpeaks + kSilent);

    [[nodiscard]] Result<void> open() override { return {}; }
    [[nodiscard]] bool turn(const DeviceWrench& wrench, ServedState& state) noexcept override {
        record_.last = wrench;
        state.pose_device = uneven_pose(record_.turns.size());
        if (waits_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return true;
        const std::size_t turn = record_.turns.size() % (kSpeaks + kSilent);
        if (record_.turns.size() < kTurns) {
            record_.turns.push_back({clock_.now_ns() - commanded_ns_, wrench.force_device_N, wrench.torque_device_Nm});
            if (record_.turns.size() == kTurns) record_.is_over.set_value();
        }
        // In the end it goes on to speak, so that the last turn has something to take away.
        if (turn < kSpeaks || record_.turns.size() == kTurns) {
            commanded_ns_ = clock_.now_ns();
            record_.servo->exchange().command(wrench_asked(), commanded_ns_);
        }
        return true;
    }
    void close() noexcept override {}
    [[nodiscard]] LineNotice notice() noexcept override { return {}; }
    [[nodiscard]] std::string words_for(const LineNotice&) const override { return {}; }

private:
    ToldClock& clock_;
    Record& record_;
    std::shared_future<void> waits_ = record_.begins.get_future().share();
    Nanoseconds commanded_ns_ = 0;
};

// A servo that a test plays by hand.
class PlayedLink final : public ServedLink {
public:
    [[nodiscard]] ServedExchange& exchange() noexcept override { return exchange_; }
    [[nodiscard]] std::vector<std::string> take_messages() override { return std::exchange(said_, {}); }
    void say(const std::string& what) { said_.push_back(what); }
    void tell(const ServedState& state) {
        exchange_.draft() = state;
        exchange_.publish();
    }

private:
    ServedExchange exchange_;
    std::vector<std::string> said_;
};

}  // namespace

TEST(ServedForce, NoTurnHasForceOrTorqueOnceTheHapticThreadIsSilentAndTheLastTurnHasNoneEither) {
    SilencedLine::Record record;
    {
        auto clock = std::make_unique<ToldClock>();
        auto line = std::make_unique<SilencedLine>(*clock, record);
        auto servo = LineServo::open(std::move(line), std::move(clock));
        ASSERT_TRUE(servo);
        record.servo = servo->get();
        record.begins.set_value();
        ASSERT_EQ(record.is_over.get_future().wait_for(std::chrono::seconds(30)), std::future_status::ready);
    }
    EXPECT_EQ(record.last.force_device_N, Vec3(0.0)) << "the end";
    EXPECT_EQ(record.last.torque_device_Nm, Vec3(0.0)) << "the end";
    int with = 0, without = 0;
    for (std::size_t i = 1; i < record.turns.size(); ++i) {
        const auto& [since_ns, force_N, torque_Nm] = record.turns[i];
        if (since_ns < kServedSilent_ns) {
            EXPECT_EQ(force_N, wrench_asked().force_device_N) << i << ", " << since_ns;
            EXPECT_EQ(torque_Nm, wrench_asked().torque_device_Nm) << i << ", a line's device may have a motor for it";
        } else {
            EXPECT_EQ(force_N, Vec3(0.0)) << i << ", " << since_ns;
            EXPECT_EQ(torque_Nm, Vec3(0.0)) << i << ", " << since_ns;
        }
        (since_ns < kServedSilent_ns ? with : without) += 1;
    }
    EXPECT_GT(with, 90);
    EXPECT_GT(without, 150);
}

TEST(ServedForce, WhatIsNoNumberInAnyPlaceIsNoForceAndNoTorque) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN(), kFar = std::numeric_limits<double>::infinity();
    for (int place = 0; place < 6; ++place)
        for (const double spoilt : {kNone, kFar, -kFar}) {
            ServedExchange exchange;
            DeviceWrench wrench = wrench_asked();
            (place < 3 ? wrench.force_device_N : wrench.torque_device_Nm)[place % 3] = spoilt;
            exchange.command(wrench, 5);
            EXPECT_EQ(exchange.wanted(6).force_device_N, Vec3(0.0)) << place;
            EXPECT_EQ(exchange.wanted(6).torque_device_Nm, Vec3(0.0)) << place;
            exchange.command(wrench_asked(), 7);
            EXPECT_EQ(exchange.wanted(8).force_device_N, wrench_asked().force_device_N) << "the next one counts";
            EXPECT_EQ(exchange.wanted(8).torque_device_Nm, wrench_asked().torque_device_Nm);
            EXPECT_EQ(exchange.wanted_N(8), wrench_asked().force_device_N);
        }
}

TEST(ServedForce, ATickThatSeesAFaultOrNoServoAsksForNoForceAndTheNextThatIsWellDoes) {
    for (const DeviceFault fault :
         {DeviceFault::disconnected, DeviceFault::overheated, DeviceFault::overspeed, DeviceFault::other}) {
        ToldClock clock;
        auto link = std::make_unique<PlayedLink>();
        PlayedLink& servo = *link;
        const SimulatedHand hand = SimulatedHand::create({{0.0, Vec3(0.0)}}).value();
        const OpenedDevice opened =
            served_arm(std::move(link), describe_served_arm("arm", OmniModel{}, 0.0), hand, clock);
        HapticDevice& arm = *opened.parts[0].device;
        const auto tick = [&] {
            const DeviceSample sample = arm.read();
            arm.write(wrench_asked());
            return sample;
        };
        const auto asked = [&] { return servo.exchange().wanted(clock.now_ns()); };
        EXPECT_EQ(tick().fault, DeviceFault::disconnected) << "no turn yet";
        EXPECT_EQ(asked().force_device_N, Vec3(0.0));
        ServedState state;
        state.buttons = 6;
        state.joints = {0.1, 0.2, 0.3};
        // Twice, so that what the first left does not count.
        for (int time = 0; time < 2; ++time) {
            state.time_ns = clock.now_ns();
            state.pose_device = uneven_pose(2);
            state.fault = DeviceFault::none;
            servo.tell(state);
            clock.move_on(1'000'000);
            const DeviceSample well = tick();
            EXPECT_EQ(well.fault, DeviceFault::none);
            EXPECT_EQ(well.buttons, 6u);
            EXPECT_EQ(well.joints, state.joints);
            EXPECT_EQ(well.position_device_m, uneven_offset(2));
            EXPECT_EQ(asked().force_device_N, wrench_asked().force_device_N);
            EXPECT_EQ(asked().torque_device_Nm, wrench_asked().torque_device_Nm);
            state.time_ns = clock.now_ns();
            state.fault = fault;
            servo.tell(state);
            EXPECT_EQ(tick().fault, fault);
            EXPECT_EQ(asked().force_device_N, Vec3(0.0)) << static_cast<int>(fault);
            EXPECT_EQ(asked().torque_device_Nm, Vec3(0.0)) << static_cast<int>(fault);
            state.time_ns = clock.now_ns() + 1;
            state.fault = DeviceFault::none;
            servo.tell(state);
            EXPECT_EQ(tick().fault, DeviceFault::none);
            clock.move_on(kServedLost_ns);
            EXPECT_EQ(tick().fault, DeviceFault::none) << "not lost yet";
            clock.move_on(2);
            EXPECT_EQ(tick().fault, DeviceFault::disconnected) << "the servo is silent";
            EXPECT_EQ(asked().force_device_N, Vec3(0.0));
        }
        servo.say("what it has to say");
        EXPECT_EQ(opened.messages->take_messages(), std::vector<std::string>{"what it has to say"});
        EXPECT_TRUE(opened.messages->take_messages().empty());
    }
}

}  // namespace burin::devices
