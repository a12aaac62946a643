// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_motion.hpp"

#include <cmath>
#include <numbers>

namespace burin::devices {

EmulatedMotion emulated_motion(double time_s) {
    const auto turn = [&](double period_s) { return 2.0 * std::numbers::pi * time_s / period_s; };
    EmulatedMotion motion;
    motion.head_world.position_m = {0.2 * std::sin(turn(8.0)), 1.65 + 0.02 * std::sin(turn(3.0)), 2.0};
    motion.head_world.orientation = glm::angleAxis(0.15 * std::sin(turn(8.0)), Vec3(0.0, 1.0, 0.0));
    motion.wand_world.position_m = {0.3 + 0.15 * std::cos(turn(6.0)), 1.2 + 0.15 * std::sin(turn(6.0)), 1.4};
    motion.wand_world.orientation = glm::angleAxis(0.3 * std::sin(turn(5.0)), Vec3(1.0, 0.0, 0.0));
    const double phase_s = std::fmod(time_s, 10.0);
    motion.is_pressed = phase_s >= 3.0 && phase_s < 5.0;
    if (phase_s >= 7.0 && phase_s < 8.0) motion.stick = {0.5, 0.0};
    return motion;
}

}  // namespace burin::devices
