// SPDX-License-Identifier: MIT
#include "devices/drivers/served_device.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace burin::devices {

Pose pose_between(const ServedState& before, const ServedState& newest, Nanoseconds time_ns) noexcept {
    const Nanoseconds between_ns = newest.time_ns - before.time_ns;
    if (before.time_ns == 0 || between_ns <= 0 || between_ns > kServedLost_ns) return newest.pose_device;
    const double share = std::clamp(seconds(time_ns - before.time_ns) / seconds(between_ns), 0.0, 1.0);
    const Pose &from = before.pose_device, &to = newest.pose_device;
    const Quat nearer = glm::dot(from.orientation, to.orientation) < 0.0 ? -to.orientation : to.orientation;
    return {from.position_m + share * (to.position_m - from.position_m),
            glm::normalize(glm::lerp(from.orientation, nearer, share))};
}

DeviceSample ServedSamples::sample(const ServedState& newest, Nanoseconds now_ns) noexcept {
    if (newest.time_ns != newest_.time_ns) before_ = std::exchange(newest_, newest);
    const bool is_lost = newest_.time_ns == 0 || now_ns - newest_.time_ns > kServedLost_ns;
    DeviceSample sample;
    sample.time_ns = now_ns;
    sample.buttons = newest_.buttons;
    sample.fault = is_lost ? DeviceFault::disconnected : newest_.fault;
    const Pose pose = pose_between(before_, newest_, now_ns - turn_ns_);
    sample.position_device_m = pose.position_m;
    sample.orientation_device = pose.orientation;
    sample.joints = newest_.joints;
    may_push_ = sample.fault == DeviceFault::none;
    return sample;
}

std::string library_beside_program(const char* name) {
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    for (const std::filesystem::path& at : {folder, folder.parent_path()})
        if (std::filesystem::exists(at / name, ignored)) return (at / name).string();
    return name;
}

}  // namespace burin::devices
