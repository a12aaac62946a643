// SPDX-License-Identifier: MIT
// A servo thread of the driver's own, for a device that has none: a thousand times a second it exchanges a force for a
// state over the device's line, which may wait; the haptic thread meets it as served_arm.hpp says.
//
// A turn gives zero unless the haptic thread has given a force within kServedSilent_ns, the last state was sound, and
// no fault has been within kServedErrorHolds_ns. A line that fails is given zero once more before it is let go, and is
// opened again each kLineAgain_ns. At the end the last turn gives zero. So whatever fails, the last force written is
// zero. Threads: open() and destruction on one; take_messages() on the frame's; the line is the servo thread's between.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/error.hpp"
#include "base/ring.hpp"
#include "devices/served/served_arm.hpp"

namespace burin::devices {

inline constexpr Nanoseconds kLineAgain_ns = 1'000'000'000;

// What a line has to say: a number that it knows the words for.
struct LineNotice {
    std::uint32_t what = 0;
    std::int32_t number = 0;
    bool operator==(const LineNotice&) const = default;
};

class DeviceLine {
public:
    virtual ~DeviceLine() = default;
    // Opens it, at first and again after close(). An Error says why not.
    [[nodiscard]] virtual Result<void> open() = 0;
    // Gives a force and a torque and takes the newest state, whose time the servo sets: pose, buttons and a fault of
    // its own. Its pose is left alone where none is known. A device without a motor for the torque leaves it, as its
    // description says (DeviceDescription::max_torque_Nm). Returns false where the device is gone.
    [[nodiscard]] virtual bool turn(const DeviceWrench& wrench, ServedState& state) noexcept = 0;
    virtual void close() noexcept = 0;
    // Returns what has been noticed since, once; what == 0: nothing. Then the words for it, on the frame's thread.
    [[nodiscard]] virtual LineNotice notice() noexcept = 0;
    [[nodiscard]] virtual std::string words_for(const LineNotice& notice) const = 0;
};

class LineServo final : public ServedLink {
public:
    // Opens the line, and starts the thread, which sleeps by the clock: the machine's, or a test's.
    [[nodiscard]] static Result<std::unique_ptr<LineServo>> open(
        std::unique_ptr<DeviceLine> line, std::unique_ptr<Clock> clock = std::make_unique<MonotonicClock>());
    ~LineServo() override;
    LineServo(const LineServo&) = delete;
    LineServo& operator=(const LineServo&) = delete;

    [[nodiscard]] ServedExchange& exchange() noexcept override { return exchange_; }
    [[nodiscard]] std::vector<std::string> take_messages() override;

private:
    LineServo(std::unique_ptr<DeviceLine> line, std::unique_ptr<Clock> clock)
        : clock_(std::move(clock)), line_(std::move(line)), notices_(64) {}
    void run();
    void turn() noexcept;
    void publish(Nanoseconds now_ns) noexcept;
    void lose() noexcept;
    void open_again();
    void take_notice() noexcept;

    std::unique_ptr<Clock> clock_;
    std::unique_ptr<DeviceLine> line_;
    ServedExchange exchange_;
    Ring<LineNotice> notices_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
    LineNotice told_;  // the frame's thread's
    // The servo thread's:
    bool is_open_ = true;
    ServedState state_;
    DeviceFault held_ = DeviceFault::none;
    Nanoseconds fault_ns_ = 0, tried_ns_ = 0;
};

}  // namespace burin::devices
