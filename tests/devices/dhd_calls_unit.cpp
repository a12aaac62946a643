// SPDX-License-Identifier: MIT
// Calls of the driver of Force Dimension devices, in their order. In place of the maker's library stand functions that
// write each call down under its device; the library's own axes are written out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "devices/drivers/dhd_line.hpp"
#include "tests/devices/told_clock.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::devices {
namespace {

// The library's handles of the devices 0 and 1 of its list: neither is its place in the list.
constexpr std::array<int, 2> kDhdHandles{3, 0};

// The devices behind the functions below, and the calls that each was given. One test at a time has it.
struct NotedDhd {
    struct Device {
        std::vector<std::string> calls;  // without forces that are as the one before
        std::string last_force;
        Vec3 force_N{0.0};  // in the library's axes
        // A haptic thread that asks for this in each turn and sees no fault; null: nobody asks.
        std::atomic<LineServo*> servo = nullptr;
        Vec3 asks_N{0.0};
        TurnsClock* clock = nullptr;
    };
    std::array<Device, 2> devices;
    int type = 33;
    int strangers = 0;  // calls of handles that it has not given
    bool is_expert = false, has_watchdog = true;
    std::mutex lock;  // of all that is written down, whatever a driver calls of which thread

    [[nodiscard]] Device& at(int handle) {
        const auto found = std::ranges::find(kDhdHandles, handle);
        if (found == kDhdHandles.end()) ++strangers;
        return devices[found == kDhdHandles.begin() ? 0 : 1];
    }
};
NotedDhd* dhd_noted = nullptr;

int note_dhd(const std::string& what, int handle) {
    const std::scoped_lock held(dhd_noted->lock);
    dhd_noted->at(handle).calls.push_back(what + " " + std::to_string(handle));
    return 0;
}

void note_force(const std::array<double, 7>& force, int handle) {
    const std::scoped_lock held(dhd_noted->lock);
    NotedDhd::Device& device = dhd_noted->at(handle);
    std::string text = formatted("force %d: %.2f %.2f %.2f", handle, force[0], force[1], force[2]);
    if (std::ranges::any_of(force.begin() + 3, force.end(), [](double value) { return value != 0.0; }))
        text += " and a torque";
    if (std::exchange(device.last_force, text) != text) device.calls.push_back(text);
    device.force_N = {force[0], force[1], force[2]};
    if (LineServo* const servo = device.servo.load())
        servo->exchange().command({device.asks_N, Vec3(0.0)}, device.clock->now_ns());
}

DhdApi noting_dhd() {
    DhdApi api;
    api.device_count = [] { return 2; };
    api.open_by_index = [](char index) {
        const int handle = kDhdHandles[static_cast<std::size_t>(index)];
        const std::scoped_lock held(dhd_noted->lock);
        dhd_noted->at(handle).calls.push_back("open " + std::to_string(int{index}));
        return handle;
    };
    api.close = [](char device) { return note_dhd("close", device); };
    api.enable_force = [](unsigned char on, char device) {
        return note_dhd(on == 1 ? "force on" : "force off", device);
    };
    api.system_type = [](char) { return dhd_noted->type; };
    api.status = [](int* status, char) {
        status[0] = status[1] = status[5] = 1;  // power, connected, force on
        return 0;
    };
    api.buttons = [](char device) { return device == kDhdHandles[0] ? 5u : 2u; };
    api.read_pose = [](double* x, double* y, double* z, double(*turn)[3], char device) {
        // x to the user, y to the right, z up. A quarter turn about x, which takes y to z and z to -y: rows.
        *x = 0.031, *y = -0.017, *z = device == kDhdHandles[0] ? 0.046 : 0.059;
        constexpr double kTurn[3][3] = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
        for (int row = 0; row < 3; ++row) std::copy_n(kTurn[row], 3, turn[row]);
        return 0;
    };
    api.write_force = [](double x, double y, double z, double tx, double ty, double tz, double grip, char device) {
        note_force({x, y, z, tx, ty, tz, grip}, device);
        return 0;
    };
    api.last_error = [] { return 0; };
    api.error_text = [](int) { return "none"; };
    api.enable_expert_mode = [] {
        dhd_noted->is_expert = true;
        return 0;
    };
    api.set_watchdog = [](unsigned char steps, char device) {
        const int noted = note_dhd("watchdog of " + std::to_string(steps), device);
        return dhd_noted->is_expert && dhd_noted->has_watchdog ? noted : -1;
    };
    return api;
}

DhdLine noted_line(int index) { return {"dhd:" + std::to_string(index), noting_dhd(), {.serial = {}, .index = index}}; }

// Serves a device of the library, which is asked for its force in each turn.
std::unique_ptr<LineServo> served_dhd(NotedDhd& noted, int index, const Vec3& asks_N) {
    NotedDhd::Device& device = noted.devices[static_cast<std::size_t>(index)];
    auto clock = std::make_unique<TurnsClock>();
    device.clock = clock.get();
    device.asks_N = asks_N;
    auto servo = LineServo::open(std::make_unique<DhdLine>(noted_line(index)), std::move(clock));
    EXPECT_TRUE(servo) << servo.error().line();
    if (!servo) return nullptr;
    device.servo = servo->get();
    return std::move(*servo);
}

void end(NotedDhd::Device& device, std::unique_ptr<LineServo>& servo) {
    device.clock->let_go();
    servo.reset();
    device.servo = nullptr;
}

}  // namespace

TEST(DhdCalls, OpenWithAWatchdogAndZeroForceBeforeTheForceIsSwitchedOn) {
    for (const int index : {0, 1}) {
        NotedDhd noted;
        dhd_noted = &noted;
        const NotedDhd::Device& device = noted.devices[static_cast<std::size_t>(index)];
        DhdLine line = noted_line(index);
        ASSERT_TRUE(line.open());
        const std::string handle = index == 0 ? "3" : "0";
        // 20 ms in steps of 125 us.
        ASSERT_EQ(device.calls,
                  (std::vector<std::string>{"open " + std::to_string(index), "watchdog of 160 " + handle,
                                            "force " + handle + ": 0.00 0.00 0.00", "force on " + handle}));
        EXPECT_TRUE(noted.is_expert) << "which dhdSetWatchdog needs by its header";
        EXPECT_EQ(line.notice(), LineNotice{}) << "the watchdog is armed, and nothing is said of it";
        line.close();
        EXPECT_EQ(device.calls.back(), "close " + handle);
        EXPECT_TRUE(noted.devices[static_cast<std::size_t>(1 - index)].calls.empty());
    }
}

TEST(DhdCalls, AWatchdogThatIsNotArmedIsToldOnceWhyeverItIsNot) {
    const auto is_told = [](const DhdApi& api) {
        DhdLine line("dhd", api, {});
        EXPECT_TRUE(line.open());
        const LineNotice notice = line.notice();
        const std::string said = line.words_for(notice);
        EXPECT_EQ(line.notice(), LineNotice{}) << "once";
        line.close();
        EXPECT_TRUE(line.open());
        EXPECT_EQ(line.notice(), LineNotice{}) << "nor when it is found again";
        line.close();
        return notice.what != 0 && said.contains("the dhd has not taken a watchdog") && said.contains("button");
    };
    NotedDhd noted;
    dhd_noted = &noted;
    DhdApi api = noting_dhd();
    noted.has_watchdog = false;
    EXPECT_TRUE(is_told(api)) << "the device refuses it";
    noted.has_watchdog = true;
    api.enable_expert_mode = [] { return -1; };
    noted.is_expert = false;
    EXPECT_TRUE(is_told(api)) << "the expert section stays shut";
    api.enable_expert_mode = nullptr;
    EXPECT_TRUE(is_told(api)) << "the library has none";
    api = noting_dhd();
    api.set_watchdog = nullptr;
    EXPECT_TRUE(is_told(api)) << "the library has none";
}

TEST(DhdCalls, HaveAxesOfTheLibrarysForPlaceTurnAndForceAndTheDevicesOwnMost) {
    for (const auto& [type, most_N] : {std::pair{33, 12.0}, {60, 8.0}, {104, 12.0}})
        for (const int index : {0, 1}) {
            NotedDhd noted;
            noted.type = type;
            dhd_noted = &noted;
            const NotedDhd::Device& device = noted.devices[static_cast<std::size_t>(index)];
            DhdLine line = noted_line(index);
            ASSERT_TRUE(line.open());
            ServedState state;
            ASSERT_TRUE(line.turn({Vec3(0.7, -1.3, 2.1), Vec3(0.0)}, state));
            // To the right 0.7, up -1.3 and to the user 2.1 are its y, z and x.
            EXPECT_EQ(device.force_N, Vec3(2.1, 0.7, -1.3));
            ASSERT_FALSE(device.calls.empty());
            EXPECT_EQ(device.calls.back(), std::string(index == 0 ? "force 3: " : "force 0: ") + "2.10 0.70 -1.30");
            EXPECT_EQ(state.buttons, index == 0 ? 5u : 2u);
            EXPECT_EQ(state.pose_device.position_m, Vec3(-0.017, index == 0 ? 0.046 : 0.059, 0.031));
            // About the way to the user: what is to the right goes up, and what is up to the left.
            const Quat& turn = state.pose_device.orientation;
            EXPECT_LT(glm::distance(turn * Vec3(0, 0, 1), Vec3(0, 0, 1)), 1e-9);
            EXPECT_LT(glm::distance(turn * Vec3(1, 0, 0), Vec3(0, 1, 0)), 1e-9);
            EXPECT_LT(glm::distance(turn * Vec3(0, 1, 0), Vec3(-1, 0, 0)), 1e-9);
            const Vec3 way = uneven_direction(2);
            ASSERT_TRUE(line.turn({50.0 * way, Vec3(0.0)}, state));
            const Vec3& strong = device.force_N;
            EXPECT_LT(glm::distance(Vec3(strong.y, strong.z, strong.x), most_N * way), 1e-9) << type;
        }
}

// Whichever ends first: its force is its own until then, zero is its last before it is closed, and nothing is called of
// it afterwards, while the other's force never stops.
TEST(DhdCalls, EachOfTwoIsGivenItsOwnForceAndZeroBeforeItIsClosed) {
    const std::vector<std::string> of_first{"open 0",     "watchdog of 160 3",        "force 3: 0.00 0.00 0.00",
                                            "force on 3", "force 3: 2.10 0.70 -1.30", "force 3: 0.00 0.00 0.00",
                                            "close 3"};
    const std::vector<std::string> of_second{"open 1",     "watchdog of 160 0",        "force 0: 0.00 0.00 0.00",
                                             "force on 0", "force 0: 1.60 -0.40 0.90", "force 0: 0.00 0.00 0.00",
                                             "close 0"};
    for (const std::size_t ends_first : {0u, 1u}) {
        NotedDhd noted;
        dhd_noted = &noted;
        std::array<std::unique_ptr<LineServo>, 2> servos{served_dhd(noted, 0, Vec3(0.7, -1.3, 2.1)),
                                                         served_dhd(noted, 1, Vec3(-0.4, 0.9, 1.6))};
        constexpr int kTurns = 30;
        for (NotedDhd::Device& device : noted.devices) device.clock->take_turns(kTurns);
        end(noted.devices[ends_first], servos[ends_first]);
        EXPECT_EQ(noted.devices[ends_first].calls, ends_first == 0 ? of_first : of_second);
        noted.devices[1 - ends_first].clock->take_turns(kTurns);
        end(noted.devices[1 - ends_first], servos[1 - ends_first]);
        EXPECT_EQ(noted.devices[0].calls, of_first) << ends_first;
        EXPECT_EQ(noted.devices[1].calls, of_second) << ends_first;
        EXPECT_EQ(noted.strangers, 0);
    }
}

}  // namespace burin::devices
