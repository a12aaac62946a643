// SPDX-License-Identifier: MIT
// A fingertip of several points, each a small ball that moves by itself, on a sphere: the scene of the tests of parts
// of a device.
#pragma once

#include <cmath>
#include <deque>
#include <numbers>
#include <vector>

#include "devices/haptic/simulated_fingers.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics::test {

// The sphere's top is the device's origin. Its mesh, of edges of 1 to 1.2 mm, lies at most 8 um below it.
constexpr double kSphere_m = 0.03, kPointBall_m = 0.0015, kStiffness_N_per_m = 400.0;
const Vec3 kSphereCenter{0.0, -kSphere_m, 0.0};
inline Surface fingertip_sphere() { return sphere(kSphere_m, 5, kSphereCenter); }

// One ball without friction and damping, whose force then is k depth n.
inline TickParameters point_parameters() {
    TickParameters p;
    p.sequence = 1;
    p.probe = ball_probe(kPointBall_m);
    p.clearance_ratio = 0.0;
    p.materials[0].stiffness_N_per_m = kStiffness_N_per_m;
    p.materials[0].damping_Ns_per_m = 0.0;
    p.max_surface_age_s = 0.0;
    return p;
}

// What the ball of a point at this place is pushed back with; no contact gives 0.
inline Vec3 force_by_the_book(const Vec3& position_m) {
    const Vec3 out = position_m - kSphereCenter;
    const double distance = glm::length(out);
    return std::max(0.0, kStiffness_N_per_m * (kSphere_m + kPointBall_m - distance)) * (out / distance);
}

// Each point presses and leaves in a rhythm of its own, and meanwhile wanders a little across the sphere: one in the
// middle, the others around it on rings of four, 4 mm apart.
inline devices::SimulatedHand point_hand(std::size_t index, double duration_s) {
    const double turn = 2.0 * std::numbers::pi;
    const double ring = index == 0 ? 0.0 : 0.13 * static_cast<double>(1 + (index - 1) / 4);
    const double around = 0.25 * turn * static_cast<double>(index % 4) + 0.3 * ring;
    const double period_s = 0.5 + 0.13 * static_cast<double>(index % 5), phase = 0.2 * static_cast<double>(index);
    std::vector<devices::HandPose> script;
    for (double t = 0.0; t <= duration_s; t += 0.025) {
        const double tilt = ring + 0.04 * std::sin(turn * (0.9 * t + phase));
        const Vec3 n(std::sin(tilt) * std::cos(around), std::cos(tilt), std::sin(tilt) * std::sin(around));
        const double pressed_m = -0.001 + 0.004 * std::cos(turn * (t / period_s + phase));
        const double above_m = t < 0.1 ? std::max(pressed_m, 0.001) : pressed_m;  // begins in the air
        script.push_back({t, kSphereCenter + (kSphere_m + kPointBall_m + above_m) * n});
    }
    return *devices::SimulatedHand::create(std::move(script), devices::HandPath::monotone_cubic);
}

inline std::vector<devices::SimulatedHand> point_hands(std::size_t count, double duration_s) {
    std::vector<devices::SimulatedHand> hands;
    for (std::size_t i = 0; i < count; ++i) hands.push_back(point_hand(i, duration_s));
    return hands;
}

// A loop of so many parts in simulated time.
struct PartsRig {
    SimulatedClock clock;
    std::deque<HapticChannels> channels;
    devices::SimulatedFingers fingers;
    HapticLoop loop;

    explicit PartsRig(std::vector<devices::SimulatedHand> hands)
        : channels(), fingers(std::move(hands), devices::SimulatedFingers::kFinger, &clock), loop(parts(), clock) {}

    std::vector<LoopPart> parts() {
        std::vector<LoopPart> all;
        for (std::size_t i = 0; i < fingers.count(); ++i)
            all.push_back({fingers.part(i), channels.emplace_back(std::size_t{64}, std::size_t{64})});
        return all;
    }
    void publish(const geometry::LocalSurface& surface, std::uint64_t sequence = 1) {
        for (HapticChannels& one : channels) {
            one.surface.draft() = surface;
            one.surface.draft().sequence = sequence;
            one.surface.draft().made_ns = clock.now_ns();
            one.surface.publish();
        }
    }
    void publish(const TickParameters& parameters, std::size_t part) {
        channels[part].parameters.draft() = parameters;
        channels[part].parameters.publish();
    }
    void publish_to_all(const TickParameters& parameters) {
        for (std::size_t i = 0; i < channels.size(); ++i) publish(parameters, i);
    }
    void step() {
        clock.sleep_until(clock.now_ns() + loop.period_ns());
        loop.step();
    }
    // Runs a turn; returns the record of each part.
    std::vector<TickRecord> turn() {
        step();
        std::vector<TickRecord> records(channels.size());
        for (std::size_t i = 0; i < channels.size(); ++i) {
            channels[i].records.pop(records[i]);
            for (TickRecord read; channels[i].ticks.pop(read);) continue;
        }
        return records;
    }
};

}  // namespace burin::haptics::test
