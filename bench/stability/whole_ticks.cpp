// SPDX-License-Identifier: MIT
#include "bench/stability/whole_ticks.hpp"

#include <algorithm>
#include <cmath>

#include "bench/measure/split_mix.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::bench {
namespace {

constexpr double kBallOfTool_m = 0.004, kWall_N_per_m = 600.0, kDamper_Ns_per_m = 0.5;
constexpr Nanoseconds kWholeTick_ns = 1'000'000;

// A plate of 100 by 100 by 10 mm, its upper side at y = 0.
geometry::TriangleMesh plate_mesh() {
    geometry::TriangleMesh mesh;
    for (const double y : {-0.01, 0.0})
        for (const double z : {-0.05, 0.05})
            for (const double x : {-0.05, 0.05}) mesh.positions_m.push_back({x, y, z});
    mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                      {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    return mesh;
}

geometry::LocalSurface plate_surface() {
    geometry::LocalSurface surface;
    surface.sequence = 1;
    surface.radius_m = 1e3;
    surface.meshes = {{geometry::TouchMesh::create(plate_mesh())->snapshot(), 0}};
    return surface;
}

haptics::TickParameters plate_parameters() {
    haptics::TickParameters p;
    p.sequence = 1;
    p.probe = haptics::ball_probe(kBallOfTool_m);
    p.clearance_ratio = 0.0;
    p.max_surface_age_s = 0.0;
    for (haptics::TouchMaterial& m : p.materials)
        m.stiffness_N_per_m = kWall_N_per_m, m.damping_Ns_per_m = kDamper_Ns_per_m;
    return p;
}

Json lose_ticks(double pressed_N, int lost) {
    const devices::HandGrip grip{0.1, 100.0, 3.0};
    const double rest_m = kBallOfTool_m - pressed_N / kWall_N_per_m;
    SimulatedClock clock;
    haptics::HapticChannels channels{64, 64};
    devices::SimulatedOmni omni(
        *devices::SimulatedHand::create(
            {{0.0, {0.0, 0.01, 0.0}}, {0.5, {0.0, rest_m - pressed_N / grip.stiffness_N_per_m, 0.0}}},
            devices::HandPath::straight, grip),
        {}, &clock);
    haptics::HapticLoop loop(omni, clock, channels);
    channels.surface.draft() = plate_surface();
    channels.surface.publish();
    channels.parameters.draft() = plate_parameters();
    channels.parameters.publish();
    haptics::TickRecord record;
    double lowest_m = HUGE_VAL;
    const auto ticks = [&](int count) {
        for (int i = 0; i < count; ++i) {
            clock.sleep_until(clock.now_ns() + kWholeTick_ns);
            record = loop.step();
            for (haptics::TickRecord read; channels.records.pop(read);) continue;
            for (haptics::TickRecord read; channels.ticks.pop(read);) continue;
            lowest_m = std::min(lowest_m, record.sample.position_device_m.y);
        }
    };
    ticks(2000);
    const double before_m = lowest_m = record.sample.position_device_m.y;
    for (int burst = 0; burst < (lost > 5 ? 1 : 40); ++burst) {
        clock.sleep_until(clock.now_ns() + lost * kWholeTick_ns);
        ticks(20);
    }
    ticks(2000);
    return {{"section", "lost ticks"},
            {"pressed_N", pressed_N},
            {"lost_ticks", lost},
            {"sunk_mm", 1e3 * (before_m - lowest_m)},
            {"force_after_N", record.gate.given.force_device_N.y}};
}

// To and fro between 0 and `high` at one speed.
struct ToAndFro {
    double speed_m_per_s = 0.1, high_m = 0.003;

    [[nodiscard]] double height_m(double time_s) const {
        const double turns = speed_m_per_s * time_s / high_m, part = turns - 2.0 * std::floor(0.5 * turns);
        return high_m * (part < 1.0 ? part : 2.0 - part);
    }
    [[nodiscard]] double velocity_m_per_s(double time_s) const {
        const double turns = std::floor(speed_m_per_s * time_s / high_m + 1e-9);
        return turns - 2.0 * std::floor(0.5 * turns) < 0.5 ? speed_m_per_s : -speed_m_per_s;
    }
};

Json move_plate(double speed_m_per_s, bool quick) {
    const ToAndFro way{speed_m_per_s};
    geometry::LocalSurface surface = plate_surface();
    haptics::TickParameters parameters = plate_parameters();
    parameters.passivity.control = false;  // what the wall may give out is another matter
    parameters.limit_stiffness = false;
    devices::DeviceDescription device;
    device.max_force_N = 100.0;
    device.max_stiffness_N_per_m = 1e6;
    SplitMix random(1);
    haptics::FullTickState state;
    const int ticks = quick ? 1'500 : 20'000, from = 500;
    double felt_N = 0.0, true_N = 0.0, steepest_N = 0.0, last_N = 0.0;
    for (int i = 0, next = 0; i < ticks; ++i) {
        const double time_s = 1e-3 * i;
        const Nanoseconds now_ns = (1000 + i) * kWholeTick_ns;
        if (i == next) {
            next = i + 12 + static_cast<int>(std::round(4.0 * random.signed_unit()));
            ++surface.sequence;
            surface.made_ns = now_ns;
            geometry::MeshMotion& motion = surface.meshes[0].motion;
            motion.body = 1;
            motion.time_ns = now_ns;
            motion.object_from_mesh.position_m.y = way.height_m(time_s);
            motion.velocity_object_m_per_s.y = way.velocity_m_per_s(time_s);
        }
        devices::DeviceSample sample;
        sample.time_ns = now_ns;
        sample.position_device_m = {0.0, kBallOfTool_m - 0.001, 0.0};
        const haptics::FullTick full = haptics::full_tick(state, sample, surface, parameters, device, now_ns, 1e-3);
        state = full.next;
        const double given_N = full.record.gate.given.force_device_N.y;
        if (i >= from) {
            felt_N += given_N / (ticks - from);
            true_N +=
                (kWall_N_per_m * (0.001 + way.height_m(time_s)) + kDamper_Ns_per_m * way.velocity_m_per_s(time_s)) /
                (ticks - from);
            if (i > from) steepest_N = std::max(steepest_N, given_N - last_N);
        }
        last_N = given_N;
    }
    return {{"section", "moving plate"},
            {"speed_m_per_s", speed_m_per_s},
            {"felt_N", felt_N},
            {"true_N", true_N},
            {"steepest_N", steepest_N}};
}

}  // namespace

std::vector<Json> run_whole_ticks(bool quick) {
    std::vector<Json> rows;
    for (const double pressed_N : {1.0, 2.0})
        for (const int lost : {1, 2, 3, 4, 5, 30}) {
            if (quick && (pressed_N < 2.0 || (lost != 5 && lost != 30))) continue;
            rows.push_back(lose_ticks(pressed_N, lost));
        }
    for (const double speed : {0.05, 0.1, 0.2, 0.3}) {
        if (quick && speed != 0.1) continue;
        rows.push_back(move_plate(speed, quick));
    }
    return rows;
}

}  // namespace burin::bench
