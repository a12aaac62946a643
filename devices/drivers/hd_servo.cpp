// SPDX-License-Identifier: MIT
#include "devices/drivers/hd_servo.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::devices {
namespace {

// Bounds what a library may say of a device's greatest force; more is taken for nonsense. The strongest PHANTOM, the
// Premium 3.0, has 22 N (data sheet).
constexpr double kMostOfAny_N = 100.0;

unsigned int turn_of(void* servo) {
    static_cast<HdServo*>(servo)->turn();
    return kHdCallAgain;
}

HdCondition condition_of(unsigned int error) {
    if (error == kHdWarmMotors) return HdCondition::warm;
    if (error == kHdTooFast) return HdCondition::too_fast;
    if (error >= kHdFirstForceError && error <= kHdLastForceError) return HdCondition::force_error;
    return error >= kHdFirstDeviceError && error <= kHdLastDeviceError ? HdCondition::gone : HdCondition::unsound;
}

DeviceFault fault_of(HdCondition condition) {
    switch (condition) {
        case HdCondition::well: return DeviceFault::none;
        case HdCondition::warm: return DeviceFault::overheated;
        case HdCondition::too_fast: return DeviceFault::overspeed;
        case HdCondition::gone: return DeviceFault::disconnected;
        case HdCondition::uncalibrated:
        case HdCondition::unsound:
        case HdCondition::force_error: break;
    }
    return DeviceFault::other;
}

// Sixteen numbers, column by column, in millimetres; nothing where they are no rigid transform.
std::optional<Pose> pose_of(const std::array<double, 16>& transform) {
    glm::dmat3 turn;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) turn[column][row] = transform[static_cast<std::size_t>(4 * column + row)];
    Pose pose;
    pose.position_m = 0.001 * Vec3(transform[12], transform[13], transform[14]);
    constexpr double kRounded = 1e-3;  // the library computes a part of it in single precision
    const double determinant = glm::determinant(turn);
    if (!finite(pose.position_m) || !(std::abs(determinant - 1.0) < kRounded)) return std::nullopt;
    for (int column = 0; column < 3; ++column)
        if (!(std::abs(glm::length(turn[column]) - 1.0) < kRounded)) return std::nullopt;
    pose.orientation = glm::normalize(glm::quat_cast(turn));
    return pose;
}

const char* way_to_calibrate(int style) {
    switch (static_cast<unsigned int>(style)) {
        case kHdByEncoderReset:
            return "hold it in its reset position, all links at right angles to one another, and press a button of it";
        case kHdByInkwell: return "put the stylus into the inkwell";
        default: return "calibrate it as its manual says";
    }
}

}  // namespace

HdDevice::~HdDevice() { servo_->close(*this); }

std::vector<std::string> HdDevice::take_messages() {
    std::vector<std::string> messages;
    if (!first_.empty()) messages.push_back(std::exchange(first_, {}));
    HdError last{};
    for (HdError notice{}; notices_.pop(notice);) {
        if (notice.code == last.code && notice.internal_code == last.internal_code) continue;
        last = notice;
        const std::string who = name_.empty() ? "the omni" : "the omni " + name_;
        if (notice.code == kHdCalibrationNeedsHand) {
            messages.push_back(who + " does not know where its stylus is: " + way_to_calibrate(notice.internal_code));
        } else if (notice.code == kHdMostForce) {
            messages.push_back(who + " gives no force: its library says of no greatest force that it is one");
        } else if (notice.code == kHdCalibrated) {
            messages.push_back(who + " is calibrated");
        } else {
            const char* const text = servo_->api_.error_text(notice.code);
            messages.push_back(
                who + ": " + (text != nullptr ? text : "an error") +
                formatted(" (0x%04x, the device's own number is %d)", notice.code, notice.internal_code));
        }
    }
    return messages;
}

Result<std::shared_ptr<HdServo>> HdServo::of_library(const std::string& library) {
    // HDAPI has one scheduler and one list of devices for the whole process, and so has this.
    static std::mutex mutex;
    static std::map<std::string, std::weak_ptr<HdServo>> servos;
    const std::lock_guard lock(mutex);
    if (auto known = servos[library].lock()) return known;
    BURIN_TRY(api, load_hd_api(library));
    std::shared_ptr<HdServo> servo = of_api(api, library, std::make_unique<MonotonicClock>());
    servos[library] = servo;
    return servo;
}

std::shared_ptr<HdServo> HdServo::of_api(const HdApi& api, const std::string& library, std::unique_ptr<Clock> clock) {
    return std::shared_ptr<HdServo>(new HdServo(api, library, std::move(clock)));
}

HdServo::~HdServo() {
    // relaxed: the flag says nothing of other memory.
    ends_.store(true, std::memory_order_relaxed);
    if (watch_.joinable()) watch_.join();
}

// Opens a device of the library. The maker's setup calls the usual one by either of two names, or by none.
HdHandle HdServo::init(const std::string& name, std::string& why) {
    const std::array<const char*, 3> usual{"Default Device", "Default PHANToM", nullptr};
    const std::array<const char*, 1> named{name.c_str()};
    const std::span<const char* const> names = name.empty() ? std::span<const char* const>(usual) : named;
    for (const char* const one : names) {
        const HdHandle handle = api_.init_device(one);
        HdError newest{};
        for (int i = 0; i < 16; ++i) {
            const HdError error = api_.error();
            if (error.code == 0) break;
            if (newest.code == 0) newest = error;
        }
        if (handle != kHdNoDevice && newest.code == 0) return handle;
        if (handle != kHdNoDevice) api_.disable_device(handle);
        const char* const text = api_.error_text(newest.code);
        why = newest.code == 0 || text == nullptr ? "the library gives no reason"
                                                  : text + formatted(" (0x%04x)", newest.code);
    }
    return kHdNoDevice;
}

Result<std::unique_ptr<HdDevice>> HdServo::open(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const std::string where = "haptic device omni" + (name.empty() ? std::string() : " " + name);
    const auto free = std::ranges::find(devices_, nullptr);
    if (free == devices_.end()) return fail(where, "is one more than the four that can be opened", "close another");
    stop();
    std::string why;
    const HdHandle handle = init(name, why);
    if (handle == kHdNoDevice) {
        start();
        return fail(where, "cannot be opened: " + why,
                    "see that it is plugged in, may be opened by this user and is known to the maker's setup by this "
                    "name; if it is in use, end the other program");
    }
    api_.make_current(handle);
    const char* const version = api_.read_string(kHdVersion);
    const std::string known = version != nullptr ? version : "";
    if (!known.starts_with("3.")) {
        api_.disable_device(handle);
        start();
        return fail(where,
                    "the library " + library_ + " is HDAPI " + (known.empty() ? "of no version" : known) +
                        ", and Burin knows version 3",
                    "install OpenHaptics 3");
    }
    std::unique_ptr<HdDevice> device(new HdDevice(shared_from_this(), name));
    const char* const model = api_.read_string(kHdModel);
    device->model_ = model != nullptr ? model : "";
    std::array<double, 6> box{};
    api_.read_doubles(kHdUsableWorkspace, box.data());
    device->middle_m_ = 0.0005 * Vec3(box[0] + box[3], box[1] + box[4], box[2] + box[5]);
    if (!finite(device->middle_m_)) device->middle_m_ = Vec3(0.0);
    api_.read_doubles(kHdMostForce, &device->most_N_);
    if (!(device->most_N_ > 0.0 && device->most_N_ <= kMostOfAny_N)) {
        device->most_N_ = 0.0;
        device->notices_.push({kHdMostForce, 0, 0});
    }
    int styles = 0;
    api_.read_integers(kHdCalibrationStyles, &styles);
    for (const unsigned int style : {kHdByItself, kHdByInkwell, kHdByEncoderReset})
        if (device->calibrates_by_ == 0 && (static_cast<unsigned int>(styles) & style) != 0)
            device->calibrates_by_ = style;
    api_.enable(kHdForceOutput);
    device->handle_ = handle;
    *free = device.get();
    start();
    if (!watch_.joinable()) watch_ = std::thread([this] { watch(); });
    return device;
}

void HdServo::start() {
    if (runs_ || std::ranges::all_of(devices_, [](const HdDevice* device) { return device == nullptr; })) return;
    scheduled_ = api_.schedule(turn_of, this, kHdUsualPriority);
    api_.start_scheduler();
    runs_ = true;
}

void HdServo::stop() {
    if (!runs_) return;
    // A turn that has begun may still write a force; the one after it writes none. A library whose thread does not come
    // to it, as it waits for a device that is gone, is not waited for.
    constexpr Nanoseconds kMostWait_ns = 500'000'000;
    // relaxed: the flag and the count say nothing of other memory.
    pauses_.store(true, std::memory_order_relaxed);
    const std::uint64_t turns = turns_.load(std::memory_order_relaxed);
    const Nanoseconds until_ns = clock_->now_ns() + kMostWait_ns;
    while (turns_.load(std::memory_order_relaxed) < turns + 2 && clock_->now_ns() < until_ns)
        clock_->sleep_until(clock_->now_ns() + 1'000'000);
    api_.stop_scheduler();
    api_.unschedule(scheduled_);
    runs_ = false;
    pauses_.store(false, std::memory_order_relaxed);
}

void HdServo::close(HdDevice& device) {
    const std::lock_guard lock(mutex_);
    stop();
    if (device.handle_ != kHdNoDevice) api_.disable_device(device.handle_);
    std::ranges::replace(devices_, &device, nullptr);
    start();
}

void HdServo::turn() noexcept {
    const Nanoseconds now_ns = clock_->now_ns();
    for (HdDevice* const device : devices_)
        if (device != nullptr) serve(*device, now_ns);
    take_errors(clock_->now_ns());
    turns_.fetch_add(1, std::memory_order_relaxed);
}

void HdServo::serve(HdDevice& device, Nanoseconds now_ns) noexcept {
    const HdHandle handle = device.handle_.load(std::memory_order_relaxed);
    if (handle == kHdNoDevice) return;
    api_.make_current(handle);
    api_.begin_frame(handle);
    std::array<double, 16> transform;
    transform.fill(std::numeric_limits<double>::quiet_NaN());  // a library that writes nothing is found out
    api_.read_doubles(kHdTransform, transform.data());
    int buttons = 0;
    api_.read_integers(kHdButtons, &buttons);
    calibrate(device, buttons != 0);
    const std::optional<Pose> pose = pose_of(transform);
    HdCondition condition = HdCondition::well;
    if (device.calibration_ != kHdCalibrated) condition = HdCondition::uncalibrated;
    if (!pose) condition = HdCondition::unsound;
    if (device.error_ != HdCondition::well && now_ns - device.error_ns_ >= kServedErrorHolds_ns) {
        device.error_ = HdCondition::well;
        device.is_gone_.store(false, std::memory_order_relaxed);
    }
    if (device.error_ != HdCondition::well) condition = device.error_;
    if (pose) device.pose_device_ = {pose->position_m - device.middle_m_, pose->orientation};
    device.exchange_.draft() = {now_ns, device.pose_device_, static_cast<std::uint32_t>(buttons), fault_of(condition)};
    device.exchange_.publish();
    const bool may = !pauses_.load(std::memory_order_relaxed) && condition == HdCondition::well;
    Vec3 force_N = may ? device.exchange_.wanted_N(now_ns) : Vec3(0.0);
    const double size_N = glm::length(force_N);
    if (size_N > device.most_N_) force_N *= device.most_N_ / size_N;
    const std::array<double, 3> given{force_N.x, force_N.y, force_N.z};
    api_.write_doubles(kHdForce, given.data());
    api_.end_frame(handle);
}

// Looks a few times a second; does what the device can do by itself, and says what a person has to do.
void HdServo::calibrate(HdDevice& device, bool is_pressed) noexcept {
    constexpr unsigned int kTurns = 100;
    const bool is_by_reset = device.calibrates_by_ == kHdByEncoderReset;
    const bool presses = !std::exchange(device.was_pressed_, is_pressed) && is_pressed;
    // Encoders that were never reset need it, whichever of the two the library says.
    const bool waits =
        device.calibration_ == kHdCalibrationNeedsHand || device.calibration_ == kHdCalibrationNeedsUpdate;
    if (is_by_reset && waits && presses) {
        api_.update_calibration(kHdByEncoderReset);
        device.turns_ = 0;
    }
    if (device.turns_++ % kTurns != 0) return;
    device.calibration_ = api_.check_calibration();
    if (is_by_reset && device.calibration_ == kHdCalibrationNeedsUpdate) device.calibration_ = kHdCalibrationNeedsHand;
    if (device.calibration_ == kHdCalibrationNeedsUpdate) {
        api_.update_calibration(device.calibrates_by_);
        device.calibration_ = api_.check_calibration();
    }
    const bool tells = device.calibration_ == kHdCalibrationNeedsHand ||
                       (device.calibration_ == kHdCalibrated && device.told_calibration_ != 0);
    if (!tells || device.told_calibration_ == device.calibration_) return;
    device.told_calibration_ = device.calibration_;
    device.notices_.push({device.calibration_, static_cast<int>(device.calibrates_by_), 0});
}

void HdServo::take_errors(Nanoseconds now_ns) noexcept {
    constexpr int kMost = 16;  // a turn; what is left is taken in the next
    // Of those of a turn the gravest counts, whatever their order: else each turn would bring a new one.
    std::array<HdError, kMostDevices> gravest{};
    for (int i = 0; i < kMost; ++i) {
        const HdError error = api_.error();
        if (error.code == 0) break;
        bool is_of_one = false;
        for (HdDevice* const device : devices_)
            is_of_one = is_of_one || (device != nullptr && device->handle_ == error.device);
        // An error of no device that is open is taken to be of all.
        for (std::size_t at = 0; at < kMostDevices; ++at) {
            if (devices_[at] == nullptr || (is_of_one && devices_[at]->handle_ != error.device)) continue;
            if (gravest[at].code == 0 || condition_of(error.code) > condition_of(gravest[at].code)) gravest[at] = error;
        }
    }
    for (std::size_t at = 0; at < kMostDevices; ++at) {
        if (gravest[at].code == 0) continue;
        HdDevice& device = *devices_[at];
        const HdCondition condition = condition_of(gravest[at].code);
        const bool is_new = device.error_ != condition;
        device.error_ = condition;
        device.error_ns_ = now_ns;
        // relaxed: the watch only looks whether it has work.
        device.is_gone_.store(condition == HdCondition::gone, std::memory_order_relaxed);
        if (is_new) device.notices_.push(gravest[at]);
    }
}

// Opens devices anew that are gone.
void HdServo::watch() {
    Nanoseconds tried_ns = clock_->now_ns();
    while (!ends_.load(std::memory_order_relaxed)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (clock_->now_ns() - tried_ns < kAgain_ns) continue;
        tried_ns = clock_->now_ns();
        const std::lock_guard lock(mutex_);
        open_again();
    }
}

void HdServo::open_again() {
    bool any = false;
    for (const HdDevice* const device : devices_) {
        if (device == nullptr) continue;
        if (!device->is_gone_.load(std::memory_order_relaxed)) return;  // it goes on, and is not to be stopped
        any = true;
    }
    if (!any) return;
    stop();
    for (HdDevice* const device : devices_) {
        if (device == nullptr) continue;
        if (device->handle_ != kHdNoDevice) api_.disable_device(device->handle_);
        std::string why;
        device->handle_ = init(device->name_, why);
        if (device->handle_ == kHdNoDevice) continue;
        api_.make_current(device->handle_);
        api_.enable(kHdForceOutput);
        device->turns_ = 0;
        device->is_gone_.store(false, std::memory_order_relaxed);
    }
    start();
}

}  // namespace burin::devices
