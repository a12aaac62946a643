// SPDX-License-Identifier: MIT
#include "activities/train/participant_device.hpp"

#include <filesystem>
#include <span>
#include <vector>

#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "session/record/recordings.hpp"
#include "study/felt/stage_touch.hpp"

namespace burin::activities {
namespace {

namespace fs = std::filesystem;

constexpr double kSamePoint_m = 1e-6;

// The wand with its points where the protocol has them.
Result<std::string> write_wand(const study::Protocol& protocol, const fs::path& study) {
    std::string text = "name = \"simulated wand\"\n";
    text += formatted("\n[calibration]\ntolerance = %.9g\n", protocol.calibration_tolerance_m);
    for (const devices::WandPoint& point : study::study_wand(protocol).points)
        text += formatted("\n[[point]]\nname = \"%s\"\noffset = [%.9g, %.9g, %.9g]\n", point.name.c_str(),
                          point.offset_m.x, point.offset_m.y, point.offset_m.z);
    const std::string file = (study / "wand.toml").string();
    BURIN_TRY_DO(write_file_atomically(file, std::as_bytes(std::span(text.data(), text.size()))));
    return file;
}

// That the device's points are where the protocol has them.
Result<void> check_points(const std::string& device, const devices::WandDescription& wand,
                          const study::Protocol& protocol) {
    BURIN_TRY(points, devices::points_named(wand, devices::usual_points(wand)));
    const std::vector<devices::WandPoint> wanted = study::study_wand(protocol).points;
    if (points.size() != wanted.size())
        return fail(
            device,
            formatted("touches with %zu points, and the protocol's wand with %zu", points.size(), wanted.size()),
            "describe the points as the protocol's point_offset_m has them");
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Vec3& at_m = points.at(i).offset_m;
        if (glm::distance(at_m, wanted[i].offset_m) > kSamePoint_m)
            return fail(device,
                        formatted("has its point %s %.1f mm above the handle's middle, and the protocol %.1f mm",
                                  wanted[i].name.c_str(), 1e3 * at_m.y, 1e3 * wanted[i].offset_m.y),
                        "describe the points as the protocol's point_offset_m has them");
    }
    return {};
}

// The device's name without the folders of its file: a journal names nobody, and a path may.
std::string without_folders(const std::string& device) {
    std::string file = devices::handle_file_of(device);
    if (device.starts_with(std::string(devices::kRecordedDevice) + ":")) file = device.substr(device.find(':') + 1);
    const std::size_t slash = file.rfind('/'), at = device.find(file);
    if (file.empty() || slash == std::string::npos || at == std::string::npos) return device;
    return device.substr(0, at) + device.substr(at + slash + 1);
}

// Who feels the tube is asked to feel it: a mouse or a SpaceMouse gives no force to whoever holds it.
Result<void> check_force(const std::string& device, const devices::DeviceNature& nature, const study::Group& group) {
    if (nature.has_force || !group.feels_tube) return {};
    return fail("--device " + device, "gives no force, and group " + group.code + " feels the tube",
                "name a device with force (burin devices lists those that are there), or try the visit without one: "
                "--device " +
                    std::string(devices::kSimulatedWand));
}

}  // namespace

Result<ParticipantDevice> participant_device(const std::string& asked, const study::StudyFolder& study,
                                             const study::Group& group) {
    ParticipantDevice made{asked, {}, {without_folders(asked), {}}};
    if (asked == devices::kDefaultHapticDevice || asked == devices::kSimulatedWand) {
        BURIN_TRY(described, write_wand(study.protocol(), study.path()));
        made.held.device = devices::kSimulatedWand;
        made.opened = made.held.device + ":" + described;
    }
    BURIN_TRY(nature, devices::nature_of_device(made.opened, &session::session_recordings()));
    made.held.hand = study::hand_of(nature);
    BURIN_TRY_DO(check_force(asked, nature, group));
    if (!nature.handle) return made;
    BURIN_TRY_DO(check_points(asked, *nature.handle, study.protocol()));
    made.wand = *nature.handle;
    return made;
}

}  // namespace burin::activities
