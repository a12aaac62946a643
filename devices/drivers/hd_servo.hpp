// SPDX-License-Identifier: MIT
// The devices of one HDAPI library, and the turn that its servo thread makes of them a thousand times a second.
//
// The library's own thread waits for the device, and meets the haptic thread as served_arm.hpp says. A turn writes zero
// unless the haptic thread has given a force within the last kServedSilent_ns, the device is calibrated, its state is
// sound, and no error has come within kServedErrorHolds_ns: so whatever fails, the last force written is zero.
// Errors of the library are a stack, newest first: each turn takes all of them, says which device they are of, and
// leaves the gravest of each device for whoever shows it.
// A device that says it is gone (no communication, a fault) is opened anew from a thread of its own, once in
// kAgain_ns, when no other device of the library is well: opening stops the library's thread for all. A device that is
// calibrated by a reset of its encoders has no inkwell: whoever holds it in its reset position presses a button of it.
// Before that
// thread is stopped, for whatever reason, it has written zero to every device. Threads: open() and close on one;
// take_messages() on the frame's. HDAPI is one for a process, so its servo is too.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.hpp"
#include "base/ring.hpp"
#include "base/space.hpp"
#include "devices/drivers/hd_api.hpp"
#include "devices/served/served_arm.hpp"

namespace burin::devices {

// The graver the later.
enum class HdCondition : std::uint8_t { well, uncalibrated, unsound, warm, too_fast, force_error, gone };

class HdServo;

// One device, while it lives. Destroying it leaves zero force and gives the device back.
class HdDevice final : public ServedLink {
public:
    ~HdDevice() override;
    HdDevice(const HdDevice&) = delete;
    HdDevice& operator=(const HdDevice&) = delete;

    [[nodiscard]] ServedExchange& exchange() noexcept override { return exchange_; }
    [[nodiscard]] const std::string& model() const { return model_; }
    // Returns the greatest force that its library says; 0: it is none.
    [[nodiscard]] double most_N() const { return most_N_; }
    // Has the next take_messages() begin with it.
    void tell_first(std::string message) { first_ = std::move(message); }
    [[nodiscard]] std::vector<std::string> take_messages() override;

private:
    friend class HdServo;
    HdDevice(std::shared_ptr<HdServo> servo, std::string name)
        : servo_(std::move(servo)), name_(std::move(name)), notices_(64) {}

    std::shared_ptr<HdServo> servo_;
    std::string name_, model_;
    std::string first_;  // the frame's thread's: what is told before all else; empty: nothing more
    std::atomic<HdHandle> handle_ = kHdNoDevice;
    Vec3 middle_m_{0.0};  // of the workspace, about HDAPI's origin
    double most_N_ = 0.0;
    unsigned int calibrates_by_ = 0;
    ServedExchange exchange_;
    // The servo's thread -> the frame's; kHdCalibrationNeedsHand: it waits for a hand, in the way that stands as the
    // number of the device's own.
    Ring<HdError> notices_;
    std::atomic<bool> is_gone_ = false;
    // Of the servo's thread:
    Nanoseconds error_ns_ = 0;
    HdCondition error_ = HdCondition::well;
    Pose pose_device_;  // the last that was one
    unsigned int calibration_ = 0, told_calibration_ = 0, turns_ = 0;
    bool was_pressed_ = false;  // any of its buttons, in the turn before
};

class HdServo : public std::enable_shared_from_this<HdServo> {
public:
    static constexpr Nanoseconds kAgain_ns = 1'000'000'000;
    static constexpr std::size_t kMostDevices = 4;

    // Returns the servo of a library, which all who ask for it share.
    [[nodiscard]] static Result<std::shared_ptr<HdServo>> of_library(const std::string& library);
    // Returns a servo of a loaded library that is shared with nobody. The clock is the machine's, or a test's.
    [[nodiscard]] static std::shared_ptr<HdServo> of_api(const HdApi& api, const std::string& library,
                                                         std::unique_ptr<Clock> clock);
    ~HdServo();
    HdServo(const HdServo&) = delete;
    HdServo& operator=(const HdServo&) = delete;

    // Opens the device of that name in the maker's setup; empty: the usual one.
    [[nodiscard]] Result<std::unique_ptr<HdDevice>> open(const std::string& name);
    // Makes one turn; what the library's thread calls.
    void turn() noexcept;

private:
    friend class HdDevice;
    HdServo(const HdApi& api, std::string library, std::unique_ptr<Clock> clock)
        : api_(api), library_(std::move(library)), clock_(std::move(clock)) {}
    [[nodiscard]] HdHandle init(const std::string& name, std::string& why);
    void start();
    void stop();
    void close(HdDevice& device);
    void serve(HdDevice& device, Nanoseconds now_ns) noexcept;
    void take_errors(Nanoseconds now_ns) noexcept;
    void calibrate(HdDevice& device, bool is_pressed) noexcept;
    void watch();
    void open_again();

    HdApi api_;
    std::string library_;
    std::unique_ptr<Clock> clock_;
    std::mutex mutex_;                               // of open, close and opening anew; never the servo's thread's
    std::array<HdDevice*, kMostDevices> devices_{};  // changed while the scheduler stands
    bool runs_ = false;
    unsigned long scheduled_ = 0;
    std::atomic<bool> pauses_ = false;      // all forces are zero, since the scheduler is about to stand
    std::atomic<std::uint64_t> turns_ = 0;  // made so far
    std::atomic<bool> ends_ = false;
    std::thread watch_;
};

}  // namespace burin::devices
