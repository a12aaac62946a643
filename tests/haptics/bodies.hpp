// SPDX-License-Identifier: MIT
// Bodies that move: plates, cylinders and balls as meshes, published at 100 Hz with pose and velocity and ticked at
// 1 kHz.
#pragma once

#include <functional>
#include <numbers>

#include "geometry/contact/touch_mesh.hpp"
#include "haptics/tick.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics::test {

using Snapshot = std::shared_ptr<const geometry::TouchSnapshot>;

inline Snapshot snapshot_of(const geometry::TriangleMesh& mesh) {
    auto touched = geometry::TouchMesh::create(mesh);
    return touched->snapshot();
}

// The triangles of a surface that was built of loose ones, as a mesh.
inline Snapshot snapshot_of(const Surface& surface) {
    geometry::TriangleMesh mesh;
    for (const Vec3f& p : surface->loose->positions_m) mesh.positions_m.push_back(Vec3(p) + surface->origin_object);
    mesh.triangles = surface->loose->triangles;
    return snapshot_of(mesh);
}

// A closed plate around the origin, its upper side at y = 0.
inline Snapshot plate(double half_m, double thickness_m, int n = 4) {
    return snapshot_of(box({-half_m, -thickness_m, -half_m}, {half_m, 0.0, half_m}, n));
}

// A drum around the z axis.
inline Snapshot drum(double radius_m, double half_length_m, int facets) {
    geometry::TriangleMesh mesh;
    for (int i = 0; i < facets; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / facets;
        for (const double z : {-half_length_m, half_length_m})
            mesh.positions_m.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle), z});
    }
    const auto count = static_cast<std::uint32_t>(2 * facets);
    for (std::uint32_t i = 0; i < count; i += 2) {
        const std::uint32_t a = i, b = i + 1, c = (i + 3) % count, d = (i + 2) % count;
        mesh.triangles.push_back({a, d, c});
        mesh.triangles.push_back({a, c, b});
    }
    return snapshot_of(mesh);
}

inline geometry::LocalSurface around(std::vector<geometry::TouchedMesh> meshes) {
    geometry::LocalSurface surface;
    surface.sequence = 1;
    surface.radius_m = 1e3;
    surface.meshes = std::move(meshes);
    return surface;
}

// Where a body is and how fast, at a time.
using Motion = std::function<geometry::MeshMotion(double time_s)>;

// A body that goes along y with a height and a speed for each time.
inline Motion along_y(std::function<double(double)> height_m, std::function<double(double)> speed_m_per_s) {
    return [=](double time_s) {
        geometry::MeshMotion motion;
        motion.body = 1;
        motion.object_from_mesh.position_m.y = height_m(time_s);
        motion.velocity_object_m_per_s.y = speed_m_per_s(time_s);
        return motion;
    };
}

// Whole ticks of a held device among bodies; each is published every ten ticks.
struct Bodies {
    geometry::LocalSurface surface;
    std::vector<Motion> motions;  // one for each mesh; empty: it rests
    TickParameters parameters;
    devices::DeviceDescription device = kStrongDevice;
    int publish_every = 10;     // ticks
    int next_publication = -1;  // the tick of the next one; below 0: each publish_every ticks
    // False: a body is published where it is, as an edit of the scene, without its motion.
    bool announced = true;
    FullTickState state{};
    int ticks = 0;

    Bodies() {
        parameters.probe = ball_probe(0.004);
        parameters.clearance_ratio = 0.0;
        parameters.limit_stiffness = false;
        parameters.materials[0].damping_Ns_per_m = 0.5;
    }
    [[nodiscard]] Nanoseconds now_ns() const { return Nanoseconds{1'000'000} * (ticks + 1000); }
    [[nodiscard]] double time_s() const { return 1e-3 * ticks; }

    void publish() {
        ++surface.sequence;
        surface.made_ns = now_ns();
        for (std::size_t i = 0; i < motions.size(); ++i) {
            if (!motions[i]) continue;
            geometry::MeshMotion motion = motions[i](time_s());
            motion.time_ns = surface.made_ns;
            if (!announced) motion.velocity_object_m_per_s = motion.angular_velocity_object_rad_per_s = Vec3(0.0);
            surface.meshes[i].motion = motion;
        }
    }
    TickRecord tick(const Vec3& hand_m) {
        if (next_publication < 0 ? ticks % publish_every == 0 : ticks == next_publication) publish();
        devices::DeviceSample sample;
        sample.time_ns = now_ns();
        sample.position_device_m = hand_m;
        const FullTick full = full_tick(state, sample, surface, parameters, device, sample.time_ns, 1e-3);
        state = full.next;
        ++ticks;
        return full.record;
    }
};

}  // namespace burin::haptics::test
