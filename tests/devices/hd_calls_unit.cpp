// SPDX-License-Identifier: MIT
// What the driver of Omnis calls of HDAPI, call by call, and what it makes of the library's errors, turn by turn in
// told time: which stylus loses its force, for how long, and that the other loses it in no turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/text.hpp"
#include "devices/drivers/hd_servo.hpp"
#include "tests/devices/told_clock.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::devices {
namespace {

constexpr std::size_t kStyli = 2;
// Handles of the library: numbers like those of places in a list would hide an exchange of the two.
constexpr HdHandle kFirstHandle = 7;

// What the functions below stand for; one test at a time has one.
struct NotedLibrary {
    struct Stylus {
        std::string name;
        std::array<double, 3> force_N{}, given_N{};  // set in this frame; of the last frame that ended
        unsigned int calibration = kHdCalibrated;
        bool gives_force = false;
    };
    std::array<Stylus, kStyli> styli;
    std::size_t opened = 0;
    HdHandle current = 0;
    std::vector<HdError> errors;  // the newest last
    std::vector<std::string> calls;
    HdServo* servo = nullptr;
    bool runs = false;
    std::atomic<int> starts = 0;  // counted when the scheduler has begun, whichever thread has it begin

    void note(const std::string& what) { calls.push_back(what); }
    [[nodiscard]] Stylus& at(HdHandle handle) { return styli[handle - kFirstHandle]; }
};
NotedLibrary* hd_noted = nullptr;

// Told time; while the scheduler runs, who sleeps by it gives the library's thread its turns.
class TurningClock final : public Clock {
public:
    [[nodiscard]] Nanoseconds now_ns() noexcept override { return told_.now_ns(); }
    void sleep_until(Nanoseconds deadline_ns) noexcept override {
        told_.sleep_until(deadline_ns);
        if (hd_noted->runs && hd_noted->servo != nullptr) hd_noted->servo->turn();
    }
    void move_on(Nanoseconds by_ns) { told_.move_on(by_ns); }

private:
    ToldClock told_;
};

// Where a stylus stands, in the library's millimetres, about the middle of its box below.
Pose stands_device(std::size_t stylus) { return uneven_pose(stylus + 1); }
constexpr Vec3 kMiddle_mm{3.0, 41.0, -17.0};

HdApi noting_hd() {
    HdApi api;
    api.init_device = [](const char* name) -> HdHandle {
        hd_noted->note(std::string("init ") + (name != nullptr ? name : "null"));
        std::size_t stylus = 0;
        while (stylus < hd_noted->opened && hd_noted->styli[stylus].name != name) ++stylus;
        if (stylus == hd_noted->opened) hd_noted->styli[hd_noted->opened++].name = name;
        return hd_noted->current = kFirstHandle + static_cast<HdHandle>(stylus);
    };
    api.disable_device = [](HdHandle handle) {
        hd_noted->note("disable " + std::to_string(handle));
        hd_noted->at(handle).gives_force = false;
    };
    api.make_current = [](HdHandle handle) {
        hd_noted->note("current " + std::to_string(handle));
        hd_noted->current = handle;
    };
    api.begin_frame = [](HdHandle handle) { hd_noted->note("begin " + std::to_string(handle)); };
    api.end_frame = [](HdHandle handle) {
        hd_noted->note("end " + std::to_string(handle));
        NotedLibrary::Stylus& stylus = hd_noted->at(handle);
        stylus.given_N = stylus.gives_force ? stylus.force_N : std::array<double, 3>{};
    };
    api.error = [] {
        if (hd_noted->errors.empty()) return HdError{};
        const HdError newest = hd_noted->errors.back();
        hd_noted->errors.pop_back();
        return newest;
    };
    api.error_text = [](unsigned int) { return "it is so"; };
    api.enable = [](unsigned int what) {
        hd_noted->note("enable " + std::to_string(what));
        if (what == 0x4000) hd_noted->at(hd_noted->current).gives_force = true;
    };
    api.read_integers = [](unsigned int what, int* to) {
        if (what == 0x2000) *to = hd_noted->current == kFirstHandle ? 1 : 6;  // buttons
        if (what == 0x2555) *to = 4;                                          // calibrates by the inkwell
    };
    api.read_doubles = [](unsigned int what, double* to) {
        if (what == 0x2052) {  // transform, column by column
            const Pose pose = stands_device(hd_noted->current - kFirstHandle);
            const glm::dmat3 turn = glm::mat3_cast(pose.orientation);
            const Vec3 place_mm = kMiddle_mm + 1000.0 * pose.position_m;
            for (int column = 0; column < 3; ++column) {
                for (int row = 0; row < 3; ++row) to[4 * column + row] = turn[column][row];
                to[4 * column + 3] = 0.0;
                to[12 + column] = place_mm[column];
            }
            to[15] = 1.0;
        }
        if (what == 0x2603) *to = 3.3;  // the most force
        if (what == 0x2551)             // the usable box
            for (int axis = 0; axis < 3; ++axis) {
                to[axis] = kMiddle_mm[axis] - 50.0 - 10.0 * axis;
                to[3 + axis] = kMiddle_mm[axis] + 50.0 + 10.0 * axis;
            }
    };
    api.write_doubles = [](unsigned int what, const double* from) {
        hd_noted->note(formatted("set %u %.2f %.2f %.2f", what, from[0], from[1], from[2]));
        hd_noted->at(hd_noted->current).force_N = {from[0], from[1], from[2]};
    };
    api.read_string = [](unsigned int what) { return what == 0x2500 ? "3.00.66" : "PHANTOM Omni"; };
    api.check_calibration = [] { return hd_noted->at(hd_noted->current).calibration; };
    api.update_calibration = [](unsigned int how) { hd_noted->note("calibrate " + std::to_string(how)); };
    api.start_scheduler = [] { hd_noted->note("start"), hd_noted->runs = true, ++hd_noted->starts; };
    api.stop_scheduler = [] { hd_noted->note("stop"), hd_noted->runs = false; };
    api.schedule = [](HdApi::Callback, void*, unsigned short priority) {
        hd_noted->note("schedule " + std::to_string(priority));
        return 5ul;
    };
    api.unschedule = [](unsigned long what) { hd_noted->note("unschedule " + std::to_string(what)); };
    return api;
}

// Two styli that are asked for a force each in every turn, as by a haptic thread that sees no fault.
class TwoStyli {
public:
    TwoStyli() {
        hd_noted = &library_;
        auto clock = std::make_unique<TurningClock>();
        clock_ = clock.get();
        servo_ = HdServo::of_api(noting_hd(), "noted", std::move(clock));
        library_.servo = servo_.get();
        for (std::size_t i = 0; i < kStyli; ++i) devices_[i] = servo_->open(i == 0 ? "right one" : "left one").value();
    }
    ~TwoStyli() { close(); }
    static Vec3 asked_N(std::size_t stylus) { return 30.0 * uneven_offset(stylus + 1); }
    void turn() {
        clock_->move_on(1'000'000);
        for (std::size_t i = 0; i < kStyli; ++i)
            if (devices_[i] != nullptr) devices_[i]->exchange().command({asked_N(i), Vec3(0.0)}, clock_->now_ns());
        servo_->turn();
    }
    // Lets time pass without a turn until the servo has opened anew what is gone.
    void wait_until_opened_anew() {
        const int starts = library_.starts;
        while (library_.starts == starts) {  // a thread that has begun late counts from then on
            clock_->move_on(1'000'000);
            std::this_thread::yield();
        }
    }
    void raise(unsigned int code, HdHandle handle) { library_.errors.push_back({code, 17, handle}); }
    [[nodiscard]] Vec3 given_N(std::size_t stylus) const {
        const auto& force = library_.styli[stylus].given_N;
        return {force[0], force[1], force[2]};
    }
    [[nodiscard]] const ServedState& told(std::size_t stylus) { return devices_[stylus]->exchange().newest(); }
    [[nodiscard]] NotedLibrary& library() { return library_; }
    [[nodiscard]] HdDevice& device(std::size_t stylus) { return *devices_[stylus]; }
    void close(std::size_t stylus) { devices_[stylus].reset(); }
    void close() {
        for (auto& device : devices_) device.reset();
        library_.servo = nullptr;
        servo_.reset();
    }

private:
    NotedLibrary library_;
    TurningClock* clock_ = nullptr;
    std::shared_ptr<HdServo> servo_;
    std::array<std::unique_ptr<HdDevice>, kStyli> devices_;
};

struct ErrorOfOne {
    unsigned int code = 0;
    DeviceFault fault = DeviceFault::none;
};
// Each kind of error by the header's numbers.
constexpr std::array<ErrorOfOne, 7> kErrorsOfOne{{{0x0200, DeviceFault::overheated},
                                                  {0x0203, DeviceFault::overspeed},
                                                  {0x0201, DeviceFault::other},
                                                  {0x0204, DeviceFault::other},
                                                  {0x0300, DeviceFault::disconnected},
                                                  {0x0302, DeviceFault::disconnected},
                                                  {0x0104, DeviceFault::other}}};
constexpr int kHoldTurns = 250;

void is_well_in_turn(TwoStyli& styli, std::size_t stylus, int turn) {
    EXPECT_EQ(styli.told(stylus).fault, DeviceFault::none) << stylus << " in turn " << turn;
    EXPECT_LT(glm::distance(styli.given_N(stylus), TwoStyli::asked_N(stylus)), 1e-12) << stylus << " in turn " << turn;
}

}  // namespace

TEST(HdCalls, AnErrorOfOneStylusTakesItsForceForTheHoldTimeAndTheOthersInNoTurn) {
    for (std::size_t own = 0; own < kStyli; ++own) {
        TwoStyli styli;
        for (int turn = 0; turn < 5; ++turn) styli.turn();
        // Twice each: what the first has left must not count the second time.
        for (int time = 0; time < 2; ++time)
            for (const ErrorOfOne& error : kErrorsOfOne) {
                const std::size_t other = 1 - own;
                is_well_in_turn(styli, own, -1);
                styli.raise(error.code, kFirstHandle + static_cast<HdHandle>(own));
                styli.turn();
                is_well_in_turn(styli, other, 0);
                for (int turn = 1; turn < kHoldTurns; ++turn) {
                    styli.turn();
                    EXPECT_EQ(styli.told(own).fault, error.fault) << error.code << " in turn " << turn;
                    EXPECT_EQ(styli.given_N(own), Vec3(0.0)) << error.code << " in turn " << turn;
                    is_well_in_turn(styli, other, turn);
                }
                for (int turn = 0; turn < 3; ++turn) styli.turn();
                is_well_in_turn(styli, own, kHoldTurns + 3);
                const std::vector<std::string> said = styli.device(own).take_messages();
                ASSERT_EQ(said.size(), 1u) << error.code;
                EXPECT_TRUE(said[0].contains(own == 0 ? "right one: it is so" : "left one: it is so")) << said[0];
                EXPECT_TRUE(styli.device(other).take_messages().empty());
                if (HasFailure()) return;  // with both gone the servo would open them anew from its own thread
            }
    }
}

TEST(HdCalls, AnErrorThatComesAgainHoldsTheForceBackFromItsLastTimeOn) {
    for (std::size_t own = 0; own < kStyli; ++own)
        for (const ErrorOfOne& error : kErrorsOfOne)
            for (const int between : {1, 100, kHoldTurns - 1}) {
                TwoStyli styli;
                for (int turn = 0; turn < 5; ++turn) styli.turn();
                constexpr int kTimes = 5;
                for (int time = 0; time < kTimes; ++time)
                    for (int turn = 0; turn < (time + 1 < kTimes ? between : kHoldTurns); ++turn) {
                        if (turn == 0) styli.raise(error.code, kFirstHandle + static_cast<HdHandle>(own));
                        styli.turn();
                        is_well_in_turn(styli, 1 - own, turn);
                        if (time + turn == 0) continue;  // it is known after the turn in which it came
                        EXPECT_EQ(styli.given_N(own), Vec3(0.0)) << error.code << " in turn " << turn << " of " << time;
                        EXPECT_EQ(styli.told(own).fault, error.fault) << error.code << " in turn " << turn;
                    }
                for (int turn = 0; turn < 3; ++turn) styli.turn();
                is_well_in_turn(styli, own, kHoldTurns + 3);
                EXPECT_EQ(styli.device(own).take_messages().size(), 1u) << "it is one state";
                if (HasFailure()) return;
            }
}

// The force output of each is on again, and whether it knows where its stylus is is asked anew.
TEST(HdCalls, WhatWasGoneIsOpenedAnewWithItsForceOnAndAskedForItsCalibrationInItsFirstTurn) {
    for (std::size_t waits = 0; waits < kStyli; ++waits) {
        TwoStyli styli;
        for (int time = 0; time < 2; ++time) {
            for (auto& stylus : styli.library().styli) stylus.calibration = kHdCalibrated;
            for (int turn = 0; turn < 105; ++turn) styli.turn();
            for (std::size_t i = 0; i < kStyli; ++i) {
                is_well_in_turn(styli, i, 105);
                styli.raise(0x0300, kFirstHandle + static_cast<HdHandle>(i));
            }
            styli.turn();
            styli.library().styli[waits].calibration = 0x5002;  // as after its cable was pulled
            styli.wait_until_opened_anew();
            for (int turn = 0; turn < 150; ++turn) {
                styli.turn();
                EXPECT_EQ(styli.given_N(waits), Vec3(0.0)) << waits << " in turn " << turn;
                EXPECT_NE(styli.told(waits).fault, DeviceFault::none) << waits << " in turn " << turn;
                if (turn > 1) is_well_in_turn(styli, 1 - waits, turn);
            }
        }
    }
}

TEST(HdCalls, OfTwoErrorsInOneTurnEachStylusHasItsOwnAndOneOfNobodyIsOfBoth) {
    for (const bool first_is_older : {true, false}) {
        TwoStyli styli;
        for (int turn = 0; turn < 5; ++turn) styli.turn();
        const std::size_t older = first_is_older ? 0 : 1;
        styli.raise(0x0200, kFirstHandle + static_cast<HdHandle>(older));
        styli.raise(0x0203, kFirstHandle + static_cast<HdHandle>(1 - older));
        for (int turn = 0; turn < 2; ++turn) styli.turn();
        EXPECT_EQ(styli.told(older).fault, DeviceFault::overheated);
        EXPECT_EQ(styli.told(1 - older).fault, DeviceFault::overspeed);
        for (int turn = 0; turn < kHoldTurns + 3; ++turn) styli.turn();
        styli.raise(0x0203, 99);
        for (int turn = 0; turn < kHoldTurns; ++turn) {
            styli.turn();
            for (std::size_t stylus = 0; stylus < kStyli && turn > 0; ++stylus) {
                EXPECT_EQ(styli.told(stylus).fault, DeviceFault::overspeed) << stylus << " in turn " << turn;
                EXPECT_EQ(styli.given_N(stylus), Vec3(0.0)) << stylus << " in turn " << turn;
            }
        }
    }
}

TEST(HdCalls, AStylusThatWaitsForItsCalibrationTakesTheOthersForceInNoTurn) {
    for (std::size_t own = 0; own < kStyli; ++own) {
        TwoStyli styli;
        styli.library().styli[own].calibration = 0x5002;
        constexpr int kLooked = 100;  // turns within which it has been asked for
        for (int turn = 0; turn < kLooked + 150; ++turn) {
            styli.turn();
            is_well_in_turn(styli, 1 - own, turn);
            if (turn < kLooked) continue;
            EXPECT_EQ(styli.given_N(own), Vec3(0.0)) << turn;
            EXPECT_NE(styli.told(own).fault, DeviceFault::none) << turn;
        }
    }
}

TEST(HdCalls, ATurnIsAFrameOfEachStylusWithItsOwnPoseButtonsAndForce) {
    TwoStyli styli;
    styli.turn();
    styli.library().calls.clear();
    styli.turn();
    EXPECT_EQ(styli.library().calls,
              // 0x2700: the force; 30 times the first and second uneven offsets, in metres, as newtons.
              (std::vector<std::string>{"current 7", "begin 7", "set 9984 -0.69 1.56 0.33", "end 7",  //
                                        "current 8", "begin 8", "set 9984 0.39 0.87 -1.11", "end 8"}));
    for (std::size_t stylus = 0; stylus < kStyli; ++stylus) {
        is_well_in_turn(styli, stylus, 0);
        EXPECT_EQ(styli.told(stylus).buttons, stylus == 0 ? 1u : 6u);
        const Pose& pose = styli.told(stylus).pose_device;
        EXPECT_LT(glm::distance(pose.position_m, stands_device(stylus).position_m), 1e-12) << stylus;
        EXPECT_GT(std::abs(glm::dot(pose.orientation, stands_device(stylus).orientation)), 1.0 - 1e-12) << stylus;
    }
}

TEST(HdCalls, OpenByNameSwitchForcesOnAndCloseWithZeroForce) {
    TwoStyli styli;
    // The scheduler stands while the second is opened, and has given the first one no force before.
    EXPECT_EQ(styli.library().calls.front(), "init right one");
    const auto begins = [&](const std::string& what) {
        return std::ranges::count_if(styli.library().calls, [&](const std::string& call) { return call == what; });
    };
    EXPECT_EQ(begins("init left one"), 1);
    EXPECT_EQ(begins("enable 16384"), 2) << "0x4000: force output";
    EXPECT_EQ(begins("schedule 32767"), 2);
    EXPECT_EQ(begins("start"), 2);
    for (int turn = 0; turn < 5; ++turn) styli.turn();
    for (std::size_t stylus = 0; stylus < kStyli; ++stylus) is_well_in_turn(styli, stylus, 5);
    styli.library().calls.clear();
    styli.close();
    for (std::size_t stylus = 0; stylus < kStyli; ++stylus) EXPECT_EQ(styli.given_N(stylus), Vec3(0.0)) << stylus;
    const auto& calls = styli.library().calls;
    const auto stops = std::ranges::find(calls, "stop"), frame = std::ranges::find(calls, "end 8");
    EXPECT_LT(frame, stops) << "frames of zero force, and then the scheduler stands";
    EXPECT_EQ(begins("disable 7"), 1);
    EXPECT_EQ(begins("disable 8"), 1);
    EXPECT_EQ(calls.back(), "disable 8");
}

// Either one is closed first: its own last force is zero, nothing is called of it afterwards, and the other goes on
// with its own force until it is closed likewise.
TEST(HdCalls, TheLastOfEachStylusIsZeroForceAndThenNothingIsCalledOfItWhicheverIsClosedFirst) {
    const std::array<std::vector<std::string>, kStyli> presses{
        {{"current 7", "begin 7", "set 9984 -0.69 1.56 0.33", "end 7"},
         {"current 8", "begin 8", "set 9984 0.39 0.87 -1.11", "end 8"}}};
    for (std::size_t first = 0; first < kStyli; ++first) {
        TwoStyli styli;
        for (int turn = 0; turn < 5; ++turn) styli.turn();
        std::vector<std::string>& calls = styli.library().calls;
        const auto ends_with = [&](const std::vector<std::string>& last) {
            return calls.size() >= last.size() && std::equal(last.rbegin(), last.rend(), calls.rbegin());
        };
        const std::string own = first == 0 ? "7" : "8", other = first == 0 ? "8" : "7";
        EXPECT_TRUE(ends_with(presses[1])) << calls.back();
        calls.clear();
        styli.close(first);
        // A turn that had begun, and one in which both have none; then the scheduler stands, and goes on for the other.
        EXPECT_TRUE(ends_with({"current 7", "begin 7", "set 9984 0.00 0.00 0.00", "end 7", "current 8", "begin 8",
                               "set 9984 0.00 0.00 0.00", "end 8", "stop", "unschedule 5", "disable " + own,
                               "schedule 32767", "start"}))
            << own << ": " << calls.back();
        calls.clear();
        styli.turn();
        EXPECT_EQ(calls, presses[1 - first]) << "the other goes on, and " << own << " is left alone";
        calls.clear();
        styli.close(1 - first);
        EXPECT_TRUE(ends_with({"current " + other, "begin " + other, "set 9984 0.00 0.00 0.00", "end " + other, "stop",
                               "unschedule 5", "disable " + other}))
            << other << ": " << calls.back();
        EXPECT_EQ(std::ranges::count_if(calls, [&](const std::string& call) { return call.ends_with(" " + own); }), 0);
        const std::size_t count = calls.size();
        styli.close();
        EXPECT_EQ(calls.size(), count) << "nothing is called of a library without devices";
    }
}

TEST(HdCalls, NoMoreForceThanTheLibrarySaysAndInItsDirection) {
    TwoStyli styli;
    styli.turn();
    const Vec3 strong_N = 50.0 * uneven_direction(3);
    for (std::size_t stylus = 0; stylus < kStyli; ++stylus) {
        styli.device(stylus).exchange().command({strong_N, Vec3(0.0)}, kNanosecondsPerSecond + 600'000'000);
    }
    for (std::size_t stylus = 0; stylus < kStyli; ++stylus) {
        styli.library().servo->turn();
        EXPECT_LT(glm::distance(styli.given_N(stylus), 3.3 * uneven_direction(3)), 1e-9) << stylus;
    }
}

}  // namespace burin::devices
