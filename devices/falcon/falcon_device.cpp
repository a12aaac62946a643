// SPDX-License-Identifier: MIT
#include "devices/falcon/falcon_device.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/try.hpp"
#include "devices/falcon/falcon_line.hpp"
#include "devices/falcon/falcon_port.hpp"
#include "devices/served/line_servo.hpp"

namespace burin::devices {
namespace {

// The greatest step along any axis that a step of all encoders makes, within reach of the middle.
double falcon_step_m() {
    constexpr int kSteps = 8;
    constexpr double kReach_m = 0.045;
    const FalconAngles one = falcon_angles({1, 1, 1}), zero = falcon_angles({});
    Joints joints{.count = kFalconLegs};
    for (std::size_t i = 0; i < kFalconLegs; ++i) joints.all[i].step = one[i] - zero[i];
    double most_m = 0.0;
    for (int x = -kSteps; x <= kSteps; ++x)
        for (int y = -kSteps; y <= kSteps; ++y)
            for (int z = -kSteps; z <= kSteps; ++z) {
                const Vec3 from_middle_m = kReach_m / kSteps * Vec3(x, y, z);
                if (glm::length(from_middle_m) > kReach_m) continue;
                const auto angles = falcon_inverse(kFalconMiddle_m + from_middle_m);
                const auto pose = angles ? falcon_forward(*angles) : std::nullopt;
                if (pose) most_m = std::max(most_m, step_at_handle(joints, pose->moves_m_per_rad));
            }
    return most_m;
}

DeviceDescription falcon_description() {
    static const OmniModel model = falcon_model();
    constexpr double kCable_s = 0.001;  // of a full-speed bus and its chip
    return describe_served_arm("Novint Falcon", model, kCable_s);
}

// PLACE, FIRMWARE, or PLACE@FIRMWARE.
struct FalconChoice {
    std::string place, firmware;
};
FalconChoice chosen_falcon(const std::string& text) {
    const std::size_t at = text.find('@');
    const std::string first = text.substr(0, at);
    const bool is_place = first.find_first_not_of("0123456789-.") == std::string::npos || first.starts_with("emulated");
    if (at == std::string::npos && !is_place) return {{}, text};
    return {first, at == std::string::npos ? std::string() : text.substr(at + 1)};
}

}  // namespace

OmniModel falcon_model() {
    static const double step_m = falcon_step_m();
    return {.workspace_m = Vec3(0.1016),
            .resolution_m = step_m,
            .apparent_mass_kg = 0.1,
            .friction_N = 0.2,
            .damping_Ns_per_m = 0.2,
            .max_force_N = 8.0,
            .max_stiffness_N_per_m = 3000.0,
            .watchdog_s = 0.0};
}

Result<OpenedDevice> open_falcon(const std::string& place_at_firmware, AnyHand hand, Clock& clock) {
    const FalconChoice choice = chosen_falcon(place_at_firmware);
    std::vector<std::byte> firmware;
    if (!choice.firmware.empty()) {
        BURIN_TRY(read, read_falcon_firmware(choice.firmware));
        firmware = std::move(read);
    }
    const std::string name = kFalcon + (choice.place.empty() ? std::string() : ":" + choice.place);
    FalconLine::OpenPort open_port = [place = choice.place] {
        return place.starts_with("emulated") ? open_emulated_falcon(place) : open_usb_falcon(place);
    };
    BURIN_TRY(servo, LineServo::open(std::make_unique<FalconLine>(name, std::move(open_port), std::move(firmware))));
    return served_arm(std::move(servo), falcon_description(), std::move(hand), clock);
}

OpenedDevice falcon_that_rests(Clock& clock) { return arm_that_rests(falcon_description(), clock); }

std::vector<DevicePresence> look_for_falcons() {
    std::vector<DevicePresence> found = look_for_usb_falcons();
    for (const std::string& name : emulated_falcons())
        found.push_back({Presence::there, std::string(kFalcon) + ":" + name, "an emulated one", {}});
    return found;
}

}  // namespace burin::devices
