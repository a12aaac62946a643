// SPDX-License-Identifier: MIT
// A glove's driver at whose line a test is the controller, set by set.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "devices/gloves/glove_device.hpp"
#include "devices/haptic/haptic_device.hpp"
#include "tests/devices/bare_glove.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::devices {

// Angles within a finger's limits; each of the sixteen is another.
inline GloveSet healthy_set(std::uint8_t number) {
    GloveSet set{.number = number, .motors_on = true, .fault = false, .is_local = false, .joints = {}, .forces_N = {}};
    for (std::size_t finger = 0; finger < kGloveFingers; ++finger)
        for (std::size_t joint = 0; joint < kFingerJoints; ++joint)
            set.joints[finger][joint] =
                0.06 + 0.045 * static_cast<double>(finger) + 0.13 * static_cast<double>(joint * joint);
    set.forces_N = GloveForces{1.35, 0.4, 6.2, 3.05};
    return set;
}

// A glove that has been opened with a palm that stands turned, and the host's end of it.
class OpenedGlove {
public:
    OpenedGlove() {
        glove_.say(healthy_set(1));
        const Pose palm = uneven_pose(0);
        const auto hand = SimulatedHand::create({{0.0, palm.position_m, palm.orientation, 0}}).value();
        auto opened = open_glove(glove_.name(), hand, glove_.clock());
        EXPECT_TRUE(opened) << opened.error().line();
        if (opened) device_ = std::move(*opened);
        const auto first = glove_.heard_turn();
        EXPECT_TRUE(first.back().command.stop) << "nobody has asked for a force yet";
    }
    [[nodiscard]] std::vector<DeviceSample> read() {
        std::vector<DeviceSample> samples;
        for (const DevicePart& part : device_.parts) samples.push_back(part.device->read());
        return samples;
    }
    // A tick that asks each piston for a force along itself.
    void tick(const GloveForces& along_N) {
        const std::vector<DeviceSample> samples = read();
        for (std::size_t i = 0; i < samples.size(); ++i)
            device_.parts[i].device->write({along_N[i] * samples[i].drive.along_device, Vec3(0.0)});
    }
    // Has the glove say a set, a turn later, and returns what is read once it has come: which a finger's measured force
    // says, so that it must be another than in the set before.
    [[nodiscard]] std::vector<DeviceSample> after_finger(const GloveSet& set, std::size_t finger) {
        glove_.clock().move_on(GloveLink::kSend_ns);
        glove_.say(set);
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        auto samples = read();
        while (std::abs(samples[finger].drive.measured_N - (*set.forces_N)[finger]) > 1e-9) {
            EXPECT_LT(std::chrono::steady_clock::now(), until) << "the set has not come for half a minute";
            if (std::chrono::steady_clock::now() >= until) break;
            std::this_thread::yield();
            samples = read();
        }
        return samples;
    }
    [[nodiscard]] std::vector<DeviceSample> after(GloveSet set, double first_N) {
        (*set.forces_N)[0] = first_N;
        return after_finger(set, 0);
    }
    void offer(std::size_t finger, const DriveLaw& law) { device_.parts[finger].device->offer(law); }
    void close() { device_.parts.clear(); }
    [[nodiscard]] BareGlove& glove() { return glove_; }

private:
    BareGlove glove_;
    OpenedDevice device_;
};

}  // namespace burin::devices
