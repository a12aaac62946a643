// SPDX-License-Identifier: MIT
// A force-feedback arm that a thread of its own meets: the library's, or one of the driver's. That thread waits for the
// device and the haptic thread never does.
//
// Data flow: servo thread -> newest state -> the haptic thread; its newest force -> servo thread -> device. A force
// that the haptic thread has not renewed within kServedSilent_ns is none. Servo turns and ticks are a millisecond
// apart, each by its own clock: a sample is where the handle was a turn ago, on the straight line between the two
// newest turns, so that a tick sees a motion and neither the same place twice nor a jump.
// Frame: device (base/space.hpp). Threads: ServedExchange as its functions say; ServedArm as haptic_device.hpp.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/newest_slot.hpp"
#include "devices/hand/any_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/simulated_omni.hpp"

namespace burin::devices {

inline constexpr Nanoseconds kServedSilent_ns = 20'000'000;       // a haptic thread that is silent for so long
inline constexpr Nanoseconds kServedLost_ns = 20'000'000;         // a servo thread that is
inline constexpr Nanoseconds kServedErrorHolds_ns = 250'000'000;  // without force after an error has passed
inline constexpr double kServedTurn_s = 0.001;
// From a tick's force until the device has it, and from the device's pose until a tick sees it: a turn each.
inline constexpr double kServedDelay_s = 2.0 * kServedTurn_s;

struct ServedState {
    Nanoseconds time_ns = 0;  // of the servo turn; 0: none yet
    Pose pose_device;         // always finite: that of the last sound turn
    std::uint32_t buttons = 0;
    DeviceFault fault = DeviceFault::other;
    JointValues joints{};  // as read
};

// Returns where the handle was at a time: on the straight line between two servo turns, and nowhere beyond them.
[[nodiscard]] Pose served_pose_at(const ServedState& before, const ServedState& newest, Nanoseconds time_ns) noexcept;

class ServedExchange {
public:
    // The haptic thread's; wait-free.
    [[nodiscard]] const ServedState& newest() noexcept { return state_.newest(); }
    void command(const DeviceWrench& wrench, Nanoseconds now_ns) noexcept;

    // The servo thread's; wait-free. The draft has some older content.
    [[nodiscard]] ServedState& draft() noexcept { return state_.draft(); }
    void publish() noexcept { state_.publish(); }
    // Returns the newest force and torque; zero where none has come for kServedSilent_ns, or where one is no number.
    [[nodiscard]] DeviceWrench wanted(Nanoseconds now_ns) noexcept;
    [[nodiscard]] Vec3 wanted_N(Nanoseconds now_ns) noexcept { return wanted(now_ns).force_device_N; }

private:
    struct Wanted {
        DeviceWrench wrench;
        Nanoseconds time_ns = 0;
    };
    NewestSlot<ServedState> state_;
    NewestSlot<Wanted> wanted_;
};

// Asks for a real-time priority for the calling thread, as the haptic loop asks for its own; false: it is refused, and
// the thread does without.
[[nodiscard]] bool ask_for_servo_priority() noexcept;

// What keeps the servo of a device going. Destroying it leaves zero force and gives the device back.
class ServedLink {
public:
    virtual ~ServedLink() = default;
    [[nodiscard]] virtual ServedExchange& exchange() noexcept = 0;
    // As DeviceMessages.
    [[nodiscard]] virtual std::vector<std::string> take_messages() = 0;
};

// Describes an arm of this kind that is served a thousand times a second and held by a person. `own_delay_s` is the
// device's and its cable's, beside that of the exchange with ticks.
[[nodiscard]] DeviceDescription describe_served_arm(const char* name, const OmniModel& model, double own_delay_s);

// Returns an opened device whose samples come from a link. Its fault is disconnected where the servo has been silent
// for kServedLost_ns. The clock must be the machine's and outlive the device. `hand` is not followed: a person's is
// there.
[[nodiscard]] OpenedDevice served_arm(std::unique_ptr<ServedLink> link, const DeviceDescription& description,
                                      AnyHand hand, Clock& clock);
// Returns one that is nowhere and rests, for a recording that is done again.
[[nodiscard]] OpenedDevice arm_that_rests(const DeviceDescription& description, Clock& clock);

}  // namespace burin::devices
