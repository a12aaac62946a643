// SPDX-License-Identifier: MIT
#include "devices/drivers/omni_device.hpp"

#include <memory>
#include <utility>

#include "devices/drivers/served_device.hpp"
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
        ServedState state;
        state.time_ns = newest.time_ns;
        state.pose_device = {newest.pose_hd.position_m - device_->workspace_middle_hd_m(), newest.pose_hd.orientation};
        state.buttons = newest.buttons;
        state.fault = fault_of(newest.condition);
        return samples_.sample(state, now_ns);
    }

    void write(const DeviceWrench& wrench) noexcept override {
        device_->command(samples_.may_push() ? wrench.force_device_N : Vec3(0.0));
    }

    [[nodiscard]] std::vector<std::string> take_messages() override { return device_->take_messages(); }

private:
    DeviceDescription description_ = omni_description();
    std::unique_ptr<HdDevice> device_;
    AnyHand hand_;
    Clock& clock_;
    Nanoseconds start_ns_;
    ServedSamples samples_{nanoseconds(kTurn_s)};
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

}  // namespace

Result<OpenedDevice> open_omni(const std::string& name_at_library, AnyHand hand, Clock& clock) {
    const std::size_t at = name_at_library.find('@');
    const std::string name = name_at_library.substr(0, at);
    std::string library = kHdLibrary;
    if (name.starts_with("emulated")) library = library_beside_program(kEmulatedHdLibrary);
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
