// SPDX-License-Identifier: MIT
// The time after a fault of a served arm, turn by turn in told time: no force in any turn until the hold time is over,
// whatever the fault was, and the same the second time.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "devices/served/line_servo.hpp"
#include "tests/devices/told_clock.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::devices {
namespace {

// What a line does in one of its turns.
struct TurnOfLine {
    DeviceFault fault = DeviceFault::none;
    bool is_gone = false, is_nowhere = false;
};

struct SeenTurn {
    Nanoseconds time_ns = 0;
    Vec3 force_N{0.0};
    TurnOfLine did;
    DeviceFault told_before = DeviceFault::none;  // to the haptic thread, after the turn before
};

// A line that asks for a force in each turn, as a haptic thread would that sees no fault, and does as its script says.
class ScriptedLine final : public DeviceLine {
public:
    struct Record {
        std::vector<SeenTurn> turns;
        int opened = 0, closed = 0;
        std::promise<void> is_over;
    };
    ScriptedLine(ToldClock& clock, std::function<TurnOfLine(std::size_t turn)> script, std::size_t turns,
                 std::atomic<LineServo*>& servo, Record& record)
        : clock_(clock), script_(std::move(script)), turns_(turns), servo_(servo), record_(record) {}

    static Vec3 asked_N() { return 40.0 * uneven_offset(1); }

    [[nodiscard]] Result<void> open() override {
        ++record_.opened;
        return {};
    }
    [[nodiscard]] bool turn(const DeviceWrench& wrench, ServedState& state) noexcept override {
        LineServo* const servo = servo_.load();
        if (servo == nullptr || record_.turns.size() == turns_) return true;
        SeenTurn seen{
            .time_ns = clock_.now_ns(), .force_N = wrench.force_device_N, .did = script_(record_.turns.size())};
        seen.told_before = servo->exchange().newest().fault;
        record_.turns.push_back(seen);
        servo->exchange().command({asked_N(), Vec3(0.0)}, clock_.now_ns());
        state.pose_device = uneven_pose(record_.turns.size());
        if (seen.did.is_nowhere) state.pose_device.position_m.y = std::numeric_limits<double>::quiet_NaN();
        if (seen.did.fault != DeviceFault::none) state.fault = seen.did.fault;
        if (record_.turns.size() == turns_) record_.is_over.set_value();
        return !seen.did.is_gone;
    }
    void close() noexcept override { ++record_.closed; }
    [[nodiscard]] LineNotice notice() noexcept override { return {}; }
    [[nodiscard]] std::string words_for(const LineNotice&) const override { return {}; }

private:
    ToldClock& clock_;
    std::function<TurnOfLine(std::size_t turn)> script_;
    std::size_t turns_;
    std::atomic<LineServo*>& servo_;
    Record& record_;
};

// Runs the script for so many turns.
void serve_script(ScriptedLine::Record& record, std::size_t turns, std::function<TurnOfLine(std::size_t turn)> script) {
    auto clock = std::make_unique<ToldClock>();
    std::atomic<LineServo*> at = nullptr;
    auto line = std::make_unique<ScriptedLine>(*clock, std::move(script), turns, at, record);
    auto servo = LineServo::open(std::move(line), std::move(clock));
    ASSERT_TRUE(servo);
    at = servo->get();
    EXPECT_EQ(record.is_over.get_future().wait_for(std::chrono::seconds(30)), std::future_status::ready);
}

bool is_bad(const TurnOfLine& did) { return did.fault != DeviceFault::none || did.is_gone || did.is_nowhere; }

// In each turn within the hold time of a fault there is no force and the fault is told; soon afterwards there is force.
// Returns how many turns had none.
int expect_held(const std::vector<SeenTurn>& turns) {
    constexpr Nanoseconds kSlack_ns = 5'000'000;  // of turns until a sound state has been told and asked for
    Nanoseconds bad_ns = turns.front().time_ns - 2 * kServedErrorHolds_ns;
    int without = 0;
    for (std::size_t i = 1; i < turns.size(); ++i) {
        if (is_bad(turns[i - 1].did)) bad_ns = turns[i - 1].time_ns;
        const Nanoseconds since_ns = turns[i].time_ns - bad_ns;
        without += turns[i].force_N == Vec3(0.0) ? 1 : 0;
        if (since_ns <= kServedErrorHolds_ns) {
            EXPECT_EQ(turns[i].force_N, Vec3(0.0)) << i << ", " << since_ns << " ns after the fault";
            EXPECT_NE(turns[i].told_before, DeviceFault::none) << i;
        }
        if (since_ns > kServedErrorHolds_ns + kSlack_ns && i > 5) {
            EXPECT_EQ(turns[i].force_N, ScriptedLine::asked_N()) << i;
            EXPECT_EQ(turns[i].told_before, DeviceFault::none) << i;
        }
    }
    return without;
}

}  // namespace

TEST(AfterAFault, NoTurnOfTheHoldTimeHasForceWhateverItWasAndEachTimeAnew) {
    const TurnOfLine nowhere{.is_nowhere = true};
    std::vector<TurnOfLine> kinds{nowhere};
    for (const DeviceFault fault :
         {DeviceFault::disconnected, DeviceFault::overheated, DeviceFault::overspeed, DeviceFault::other})
        kinds.push_back({.fault = fault});
    for (const TurnOfLine& kind : kinds) {
        ScriptedLine::Record record;
        // One turn of fault; a second time after force has come back; and a third within the hold time of that.
        serve_script(record, 1200,
                     [&](std::size_t turn) { return turn == 20 || turn == 400 || turn == 600 ? kind : TurnOfLine{}; });
        const int without = expect_held(record.turns);
        EXPECT_GE(without, 250 + 450) << static_cast<int>(kind.fault);
        EXPECT_LE(without, 250 + 450 + 20) << static_cast<int>(kind.fault);
        EXPECT_EQ(record.turns[20].force_N, ScriptedLine::asked_N()) << "until it is known there is force";
    }
}

TEST(AfterAFault, TheFaultThatIsToldWhileItIsHeldIsTheOneThatWas) {
    for (const DeviceFault fault :
         {DeviceFault::disconnected, DeviceFault::overheated, DeviceFault::overspeed, DeviceFault::other}) {
        ScriptedLine::Record record;
        serve_script(record, 200,
                     [&](std::size_t turn) { return TurnOfLine{.fault = turn == 20 ? fault : DeviceFault::none}; });
        for (std::size_t turn = 21; turn < 200; ++turn) EXPECT_EQ(record.turns[turn].told_before, fault) << turn;
    }
}

TEST(AfterAFault, ALineThatWasLostIsToldZeroIsOpenedAgainAndHasNoForceForTheHoldTimeEitherTime) {
    ScriptedLine::Record record;
    serve_script(record, 1200, [](std::size_t turn) { return TurnOfLine{.is_gone = turn == 30 || turn == 700}; });
    for (const std::size_t lost : {std::size_t{30}, std::size_t{700}}) {
        EXPECT_EQ(record.turns[lost].force_N, ScriptedLine::asked_N());
        EXPECT_EQ(record.turns[lost + 1].force_N, Vec3(0.0)) << "once more, where it still hears";
        EXPECT_EQ(record.turns[lost + 1].time_ns, record.turns[lost].time_ns) << "at once";
        EXPECT_GE(record.turns[lost + 2].time_ns - record.turns[lost].time_ns, kLineAgain_ns);
        const Nanoseconds back_ns = record.turns[lost + 2].time_ns;
        for (std::size_t turn = lost + 2; record.turns[turn].time_ns - back_ns <= kServedErrorHolds_ns - 2'000'000;
             ++turn)
            EXPECT_EQ(record.turns[turn].force_N, Vec3(0.0)) << turn;
        EXPECT_EQ(record.turns[lost + 300].force_N, ScriptedLine::asked_N()) << "and it comes back";
    }
    EXPECT_EQ(record.opened, 3);
    EXPECT_EQ(record.closed, 3) << "twice when it was lost, and at the end";
}

TEST(AfterAFault, TheWayBetweenTwoTurnsOfAHandleIsTheShortOneWithEitherSign) {
    for (std::size_t i = 0; i < kUnevenPoses; ++i) {
        const Quat from = uneven_turn(i);
        constexpr double kAngle_rad = 0.3;
        const Vec3 about = uneven_direction(i + 2);
        const Quat to = glm::angleAxis(kAngle_rad, about) * from;
        for (const double from_sign : {1.0, -1.0})
            for (const double to_sign : {1.0, -1.0}) {
                ServedState before, newest;
                before.time_ns = 5'000'000;
                newest.time_ns = 6'000'000;
                before.pose_device = {uneven_offset(i), from_sign * from};
                newest.pose_device = {uneven_offset(i + 1), to_sign * to};
                for (const double share : {0.0, 0.25, 0.5, 0.8, 1.0}) {
                    const Pose pose = served_pose_at(before, newest, 5'000'000 + nanoseconds(0.001 * share));
                    const Vec3 place = uneven_offset(i) + share * (uneven_offset(i + 1) - uneven_offset(i));
                    EXPECT_LT(glm::distance(pose.position_m, place), 1e-12);
                    // A normalised line between quaternions 0.3 rad apart is within 1e-3 rad of the even turn.
                    const Quat even = glm::angleAxis(share * kAngle_rad, about) * from;
                    EXPECT_GT(std::abs(glm::dot(pose.orientation, even)), 1.0 - 1e-6) << i << " " << share;
                    EXPECT_NEAR(glm::length(pose.orientation), 1.0, 1e-12);
                }
            }
    }
}

}  // namespace burin::devices
