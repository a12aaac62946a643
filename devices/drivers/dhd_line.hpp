// SPDX-License-Identifier: MIT
// The driver of a Force Dimension device: a line whose turn reads pose, buttons and status from the maker's library and
// gives it a force (dhd_api.hpp, devices/served/line_servo.hpp).
//
// A pose is sound where its place is finite and its turn is one. The force is off where the device says so: by its
// button, since it was too fast, by its watchdog, its dead man's switch. Where the library can, the device itself takes
// its force off when it has had no command for kDhdWatchdog_s; where that is refused a message says so. A handle
// without a wrist has the identity for its turn; a gripper presses the first button, and gets no force. A device that
// another line of the process has open is refused. Frame: device; +x to the right is the library's y, +y up its z, +z
// to the user its x. Thread: the servo's.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "devices/drivers/dhd_api.hpp"
#include "devices/served/line_servo.hpp"

namespace burin::devices {

inline constexpr double kDhdWatchdog_s = 0.02;

// Which device of a library: by its place in the library's list, or by its serial number.
struct DhdChoice {
    std::optional<int> serial;
    int index = 0;
    double most_N = 0.0;  // of the model that was named by hand; 0: none was
};

class DhdLine final : public DeviceLine {
public:
    // `name` is as the user calls it, for messages.
    DhdLine(std::string name, const DhdApi& api, DhdChoice choice)
        : name_(std::move(name)), api_(api), choice_(choice) {}

    [[nodiscard]] Result<void> open() override;
    [[nodiscard]] bool turn(const DeviceWrench& wrench, ServedState& state) noexcept override;
    void close() noexcept override;
    [[nodiscard]] LineNotice notice() noexcept override;
    [[nodiscard]] std::string words_for(const LineNotice& notice) const override;
    // Returns the system type of the device that is open, as DHD numbers it. Any thread.
    [[nodiscard]] int type() const noexcept { return type_->load(std::memory_order_relaxed); }

private:
    // Returns the fault that the device's status is; it is asked for at first and then a hundred times a second.
    [[nodiscard]] DeviceFault status_fault() noexcept;
    [[nodiscard]] std::string last_error() const;
    // Returns whether the device has taken its watchdog.
    [[nodiscard]] bool arm_watchdog() const noexcept;
    void tell(std::uint32_t what, std::int32_t number = 0) noexcept { notice_ = {what, number}; }

    std::string name_;
    DhdApi api_;
    DhdChoice choice_;
    int device_ = -1;
    std::shared_ptr<const int> opened_;  // lives while the device is this line's
    std::shared_ptr<std::atomic<int>> type_ = std::make_shared<std::atomic<int>>(0);
    double most_N_ = 0.0;
    bool is_gone_ = false;
    bool owes_watchdog_ = false, told_watchdog_ = false;  // that it has none has to be said, and has been
    bool owes_type_ = false, told_type_ = false;          // likewise that its type is not known
    unsigned int turns_ = 0;
    DeviceFault status_ = DeviceFault::none;
    LineNotice told_, notice_;
};

}  // namespace burin::devices
