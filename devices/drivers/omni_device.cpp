// SPDX-License-Identifier: MIT
#include "devices/drivers/omni_device.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <utility>

#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/hd_shared.hpp"

namespace burin::devices {
namespace {

constexpr double kTurn_s = 0.001;  // of the library's thread

DeviceDescription omni_description() {
    const OmniModel model;
    DeviceDescription d;
    d.name = "PHANTOM Omni";
    d.workspace_m = model.workspace_m;
    d.resolution_m = model.resolution_m;
    d.max_force_N = model.max_force_N;
    d.max_stiffness_N_per_m = model.max_stiffness_N_per_m;
    d.rate_Hz = 1000.0;
    d.apparent_mass_kg = model.apparent_mass_kg;
    d.damping_Ns_per_m = model.damping_Ns_per_m;
    d.friction_N = model.friction_N;
    // A turn until the library's thread takes the force, a turn that the sample is old, and the device's own.
    d.delay_s = 2.0 * kTurn_s + seconds(SimulatedOmni::kDelay_ns);
    d.watchdog_s = seconds(HdServo::kSilent_ns);
    d.felt_by_person = true;
    return d;
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

class OmniDevice final : public HapticDevice, public DeviceMessages {
public:
    OmniDevice(std::unique_ptr<HdDevice> device, AnyHand hand, Clock& clock)
        : device_(std::move(device)), hand_(std::move(hand)), clock_(clock), start_ns_(clock.now_ns()) {}

    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }

    [[nodiscard]] DeviceSample read() noexcept override {
        const Nanoseconds now_ns = clock_.now_ns();
        // The mouse's way is taken from its channel and left: a person's hand leads the stylus.
        static_cast<void>(target_of(hand_, seconds(now_ns - start_ns_)));
        const HdState& newest = device_->newest();
        if (newest.time_ns != newest_.time_ns) before_ = std::exchange(newest_, newest);
        const bool is_lost = newest_.time_ns == 0 || now_ns - newest_.time_ns > kOmniLost_ns;
        DeviceSample sample;
        sample.time_ns = now_ns;
        sample.buttons = newest_.buttons;
        sample.fault = is_lost ? DeviceFault::disconnected : fault_of(newest_.condition);
        const Pose pose = omni_pose_at(before_, newest_, now_ns - nanoseconds(kTurn_s));
        sample.position_device_m = pose.position_m - device_->workspace_middle_hd_m();
        sample.orientation_device = pose.orientation;
        may_push_ = sample.fault == DeviceFault::none;
        return sample;
    }

    void write(const DeviceWrench& wrench) noexcept override {
        device_->command(may_push_ ? wrench.force_device_N : Vec3(0.0));
    }

    [[nodiscard]] std::vector<std::string> take_messages() override { return device_->take_messages(); }

private:
    DeviceDescription description_ = omni_description();
    std::unique_ptr<HdDevice> device_;
    AnyHand hand_;
    Clock& clock_;
    Nanoseconds start_ns_;
    HdState newest_, before_;
    bool may_push_ = false;
};

class RestingOmni final : public HapticDevice {
public:
    explicit RestingOmni(Clock& clock) : clock_(clock) {}
    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] DeviceSample read() noexcept override {
        DeviceSample sample;
        sample.time_ns = clock_.now_ns();
        return sample;
    }
    void write(const DeviceWrench& /*wrench*/) noexcept override {}

private:
    DeviceDescription description_ = omni_description();
    Clock& clock_;
};

// Beside the program, or in the folder above it.
std::string emulated_library() {
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    for (const std::filesystem::path& at : {folder, folder.parent_path()})
        if (std::filesystem::exists(at / kEmulatedHdLibrary, ignored)) return (at / kEmulatedHdLibrary).string();
    return kEmulatedHdLibrary;
}

}  // namespace

Pose omni_pose_at(const HdState& before, const HdState& newest, Nanoseconds time_ns) noexcept {
    const Nanoseconds between_ns = newest.time_ns - before.time_ns;
    if (before.time_ns == 0 || between_ns <= 0 || between_ns > kOmniLost_ns) return newest.pose_hd;
    const double share = std::clamp(seconds(time_ns - before.time_ns) / seconds(between_ns), 0.0, 1.0);
    const Pose &from = before.pose_hd, &to = newest.pose_hd;
    const Quat nearer = glm::dot(from.orientation, to.orientation) < 0.0 ? -to.orientation : to.orientation;
    return {from.position_m + share * (to.position_m - from.position_m),
            glm::normalize(glm::lerp(from.orientation, nearer, share))};
}

Result<OpenedDevice> open_omni(const std::string& name_at_library, AnyHand hand, Clock& clock) {
    const std::size_t at = name_at_library.find('@');
    const std::string name = name_at_library.substr(0, at);
    std::string library = kHdLibrary;
    if (name.starts_with("emulated")) library = emulated_library();
    if (at != std::string::npos) library = name_at_library.substr(at + 1);
    auto servo = HdServo::of_library(library);
    if (!servo) return std::unexpected(servo.error());
    auto device = (*servo)->open(name);
    if (!device) return std::unexpected(device.error());
    auto omni = std::make_unique<OmniDevice>(std::move(*device), std::move(hand), clock);
    DeviceMessages* const messages = omni.get();
    OpenedDevice opened = of_one_part(std::move(omni));
    opened.messages = messages;
    return opened;
}

OpenedDevice omni_that_rests(Clock& clock) { return of_one_part(std::make_unique<RestingOmni>(clock)); }

std::vector<DevicePresence> look_for_omnis() {
    std::vector<DevicePresence> found;
    if (auto api = load_hd_api(kHdLibrary); api)
        found.push_back({Presence::perhaps,
                         kOmni,
                         "OpenHaptics is installed; whether a device is plugged in shows when it is opened",
                         {}});
    else
        found.push_back({api.error().what.contains("has no function") ? Presence::unusable : Presence::absent, kOmni,
                         api.error().what, api.error().remedy});
    for (const std::string& name : emulated_omnis())
        found.push_back({Presence::there, std::string(kOmni) + ":" + name, "an emulated one", {}});
    return found;
}

}  // namespace burin::devices
