// SPDX-License-Identifier: MIT
#include "devices/drivers/dhd_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "devices/drivers/arm_models.hpp"

namespace burin::devices {
namespace {

enum DhdNotice : std::uint32_t {
    kDhdGone = 1,
    kDhdBack,
    kDhdUnsound,
    kDhdWantsReset,
    kDhdForceOff,
    kDhdWell,
    kDhdNoWatchdog,
    kDhdUnknownType
};

// The library has one list of devices for the process.
std::mutex& dhd_list() {
    static std::mutex mutex;
    return mutex;
}

// A device that a line of this process has open. The library gives whoever opens it again the same ID, so that two
// lines would write their forces to one device.
struct OpenDhd {
    int (*close)(char) = nullptr;  // of its library
    int id = 0;
    std::weak_ptr<const int> line;
};
std::vector<OpenDhd>& open_dhds() {
    static std::vector<OpenDhd> all;
    return all;
}

// The library's axes are the device frame's in another order: x to the user, y to the right, z up.
Vec3 from_dhd(const Vec3& v) { return {v.y, v.z, v.x}; }
Vec3 to_dhd(const Vec3& v) { return {v.z, v.x, v.y}; }

std::optional<Quat> turn_of(const std::array<std::array<double, 3>, 3>& rows) {
    glm::dmat3 turn;
    for (int column = 0; column < 3; ++column) {
        // The device frame's axis `column` is the library's (column + 1) % 3.
        const auto from = static_cast<std::size_t>((column + 1) % 3);
        turn[column] = from_dhd({rows[0][from], rows[1][from], rows[2][from]});
    }
    constexpr double kRounded = 1e-3;
    if (!(std::abs(glm::determinant(turn) - 1.0) < kRounded)) return std::nullopt;
    for (int column = 0; column < 3; ++column)
        if (!(std::abs(glm::length(turn[column]) - 1.0) < kRounded)) return std::nullopt;
    return glm::normalize(glm::quat_cast(turn));
}

}  // namespace

std::string DhdLine::last_error() const {
    const int error = api_.last_error();
    const char* const text = api_.error_text(error);
    return (text != nullptr ? std::string(text) : "an error") + " (" + std::to_string(error) + ")";
}

Result<void> DhdLine::open() {
    const std::lock_guard lock(dhd_list());
    const int count = api_.device_count();
    device_ =
        choice_.serial ? api_.open_by_serial(*choice_.serial) : api_.open_by_index(static_cast<char>(choice_.index));
    if (device_ < 0)
        return fail(
            "haptic device " + name_,
            "cannot be opened: " + last_error() + "; the library sees " + std::to_string(std::max(count, 0)) +
                (count == 1 ? " device" : " devices"),
            "see that it is plugged in and switched on and may be opened by this user; if it is in use, end the "
            "other program");
    std::erase_if(open_dhds(), [](const OpenDhd& one) { return one.line.expired(); });
    const auto is_it = [&](const OpenDhd& one) { return one.close == api_.close && one.id == device_; };
    if (std::ranges::any_of(open_dhds(), is_it)) {
        device_ = -1;
        return fail("haptic device " + name_, "is the device that another hand of this session has opened already",
                    "give each hand a device of its own: burin devices lists those that there are");
    }
    opened_ = std::make_shared<const int>(device_);
    open_dhds().push_back({api_.close, device_, opened_});
    const auto id = static_cast<char>(device_);
    owes_watchdog_ = !arm_watchdog() && !std::exchange(told_watchdog_, true);
    static_cast<void>(api_.write_force(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, id));
    static_cast<void>(api_.enable_force(1, id));
    const int type = api_.system_type(id);
    type_->store(type, std::memory_order_relaxed);
    if (dhd_has_gripper(type) && api_.emulate_button != nullptr) static_cast<void>(api_.emulate_button(1, id));
    const bool is_by_hand = !dhd_knows(type) && choice_.most_N > 0.0;
    most_N_ = is_by_hand ? choice_.most_N : dhd_model(type).figures.max_force_N;
    owes_type_ = !dhd_knows(type) && !is_by_hand && !std::exchange(told_type_, true);
    turns_ = 0;
    status_ = DeviceFault::none;
    if (std::exchange(is_gone_, false)) tell(kDhdBack);
    return {};
}

bool DhdLine::arm_watchdog() const noexcept {
    constexpr double kStep_s = 125e-6;
    if (api_.set_watchdog == nullptr || api_.enable_expert_mode == nullptr) return false;
    return api_.enable_expert_mode() >= 0 &&
           api_.set_watchdog(static_cast<unsigned char>(kDhdWatchdog_s / kStep_s), static_cast<char>(device_)) >= 0;
}

void DhdLine::close() noexcept {
    const std::lock_guard lock(dhd_list());
    if (device_ >= 0) static_cast<void>(api_.close(static_cast<char>(device_)));
    device_ = -1;
    opened_.reset();
}

bool DhdLine::turn(const DeviceWrench& wrench, ServedState& state) noexcept {
    const auto id = static_cast<char>(device_);
    const Vec3& force_N = wrench.force_device_N;
    const double size_N = glm::length(force_N);
    const Vec3 given = to_dhd(size_N > most_N_ ? force_N * (most_N_ / size_N) : force_N);
    // A library that writes nothing is found out.
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    Vec3 place(kNan);
    // A device without a wrist leaves the turn as it is.
    std::array<std::array<double, 3>, 3> rows{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    const bool is_read =
        api_.read_pose(&place.x, &place.y, &place.z, reinterpret_cast<double(*)[3]>(rows.data()), id) >= 0;
    const bool is_given = api_.write_force(given.x, given.y, given.z, 0.0, 0.0, 0.0, 0.0, id) >= 0;
    if (!is_read || !is_given) {
        if (!std::exchange(is_gone_, true)) tell(kDhdGone, api_.last_error());
        return false;
    }
    state.buttons = api_.buttons(id);
    const std::optional<Quat> orientation = turn_of(rows);
    const bool is_sound = finite(place) && orientation;
    if (is_sound) state.pose_device = {from_dhd(place), *orientation};
    state.fault = status_fault();
    if (!is_sound) {
        state.fault = DeviceFault::other;
        tell(kDhdUnsound);
    }
    return true;
}

DeviceFault DhdLine::status_fault() noexcept {
    constexpr unsigned int kTurns = 10;
    if (turns_++ % kTurns != 0) return status_;
    std::array<int, kDhdStatusRoom> status{};
    if (api_.status(status.data(), static_cast<char>(device_)) < 0) return status_;
    const DeviceFault before = status_;
    const int off = status[kDhdStatusForceOff];
    status_ = DeviceFault::none;
    if (status[kDhdStatusReset] != 0) {
        status_ = DeviceFault::other;
        tell(kDhdWantsReset);
    } else if (status[kDhdStatusForce] == 0) {
        status_ = off == kDhdOffByVelocity ? DeviceFault::overspeed : DeviceFault::other;
        tell(kDhdForceOff, off);
    } else if (before != DeviceFault::none) {
        tell(kDhdWell);
    }
    return status_;
}

LineNotice DhdLine::notice() noexcept {
    if (std::exchange(owes_watchdog_, false)) return {kDhdNoWatchdog};
    if (std::exchange(owes_type_, false)) return {kDhdUnknownType, type()};
    const LineNotice notice = std::exchange(notice_, {});
    // A state that lasts is told when it begins, and no more.
    if (notice == told_) return {};
    if (notice.what != 0) told_ = notice;
    return notice;
}

std::string DhdLine::words_for(const LineNotice& notice) const {
    const std::string who = "the " + name_;
    switch (notice.what) {
        case kDhdGone: {
            const char* const text = api_.error_text(notice.number);
            return who + " is gone: " + (text != nullptr ? text : "an error") + " (" + std::to_string(notice.number) +
                   "); see that its cable and its power are plugged in";
        }
        case kDhdBack: return who + " is there again";
        case kDhdUnsound: return who + " reads a pose that is none: switch it off and on";
        case kDhdWantsReset: return who + " does not know where its handle is: calibrate it as its manual says";
        case kDhdWell: return who + " gives force again";
        case kDhdNoWatchdog:
            return who +
                   " has not taken a watchdog: if this program dies, switch its force off by the button on its base";
        case kDhdUnknownType:
            return who + " is of a type that is not known here (" + std::to_string(notice.number) +
                   "), and gives the least force of those that are: name what it is, as in dhd:0,model=delta (" +
                   dhd_model_keys() + ")";
        case kDhdForceOff: break;
        default: return {};
    }
    constexpr const char* kPress = "; press the force button on its base";
    switch (notice.number) {
        case kDhdOffByVelocity: return who + " gives no force, since it was moved too fast" + kPress;
        case kDhdOffByWatchdog: return who + " gives no force, since it had no command in time" + kPress;
        case kDhdOffByDeadMan: return who + " gives no force, since its handle is not held";
        case kDhdOffByCable: return who + " gives no force, since its cable was pulled" + kPress;
        case kDhdOffBySoftware: return who + " gives no force, since a program switched it off" + kPress;
        default: return who + " gives no force: its force is switched off" + kPress;
    }
}

}  // namespace burin::devices
