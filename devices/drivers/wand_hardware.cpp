// SPDX-License-Identifier: MIT
#include "devices/drivers/wand_hardware.hpp"

#include <array>
#include <cmath>

#include "devices/served/served_arm.hpp"

namespace burin::devices {
namespace {

// The greatest steps of place and turn that one step of every encoder makes, over what the linkages reach of the
// workspace.
void set_steps(const WandDescription& wand, DeviceDescription& device) {
    const TwinPantograph& arm = wand.mechanism.arm;
    const Quat turn = device_from_maker(wand).orientation;
    constexpr int kCells = 8;
    double place_m = 0.0, turned_rad = 0.0;
    for (int x = 0; x <= kCells; ++x)
        for (int y = 0; y <= kCells; ++y)
            for (int z = 0; z <= kCells; ++z) {
                const Vec3 share = Vec3(x, y, z) / static_cast<double>(kCells);
                const WandAxis axis{wand.workspace_maker_m.lo + share * wand.workspace_maker_m.extent(),
                                    Vec3(0.0, 0.0, 1.0)};
                const auto joints = wand_joints(arm, axis);
                const auto jacobian = joints ? wand_jacobian(arm, *joints) : std::nullopt;
                if (!jacobian) continue;
                std::array<Vec3, kWandJoints> moves, turns;
                const auto column = [&](std::size_t joint, const Vec3& tip_moves, double side) {
                    moves[joint] = turn * (0.5 * tip_moves);
                    turns[joint] = turn * (side * glm::cross(axis.along, tip_moves) / handle_length_m(arm));
                };
                column(0, jacobian->upper[0], 1.0);
                column(1, jacobian->upper[1], 1.0);
                column(2, jacobian->lower[0], -1.0);
                column(3, jacobian->lower[1], -1.0);
                column(4, jacobian->upper[2], 1.0);
                column(5, jacobian->lower[2], -1.0);
                place_m = std::fmax(place_m, step_at_handle(device.joints, moves));
                turned_rad = std::fmax(turned_rad, step_at_handle(device.joints, turns));
            }
    if (place_m > 0.0) device.resolution_m = place_m;
    if (turned_rad > 0.0) device.orientation_step_rad = turned_rad;
}

}  // namespace

DeviceDescription device_of_hardware(const WandDescription& wand) {
    DeviceDescription device = device_of(wand);
    device.joints = joints_of(wand.mechanism);
    set_steps(wand, device);
    device.delay_s = kServedDelay_s + wand.arm.delay_s;  // its exchange with ticks, and the device's own
    device.watchdog_s = seconds(kServedSilent_ns);
    device.felt_by_person = true;
    device.has_buttons = false;  // the card reads encoders alone
    return device;
}

}  // namespace burin::devices
