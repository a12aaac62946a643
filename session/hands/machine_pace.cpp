// SPDX-License-Identifier: MIT
#include "session/hands/machine_pace.hpp"

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/contact/touch_mesh.hpp"
#include "haptics/contact/god_object.hpp"

namespace burin::session {
namespace {

// Others may disturb a run, but none makes it faster than the machine is.
constexpr int kRuns = 4;
constexpr std::uint32_t kSquares = 48;  // a side of the plate
constexpr double kEdge_m = 0.001;

Nanoseconds thread_cpu_ns() noexcept {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return now.tv_sec * kNanosecondsPerSecond + now.tv_nsec;
}

double height_m(double x_m, double z_m) {
    return kEdge_m *
           (std::sin(x_m / (1.3 * kEdge_m)) * std::cos(z_m / (1.7 * kEdge_m)) + 0.2 * std::sin(z_m / kEdge_m));
}

geometry::TriangleMesh bumpy_plate() {
    geometry::TriangleMesh plate;
    for (std::uint32_t j = 0; j <= kSquares; ++j)
        for (std::uint32_t i = 0; i <= kSquares; ++i) {
            const double x_m = kEdge_m * (i - 0.5 * kSquares), z_m = kEdge_m * (j - 0.5 * kSquares);
            plate.positions_m.emplace_back(x_m, height_m(x_m, z_m), z_m);
        }
    const auto at = [](std::uint32_t i, std::uint32_t j) { return j * (kSquares + 1) + i; };
    for (std::uint32_t j = 0; j < kSquares; ++j)
        for (std::uint32_t i = 0; i < kSquares; ++i) {
            plate.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            plate.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    return plate;
}

// Drags a ball of each radius round a circle, pressed in by 2 mm, at 0.1 m/s; returns what that costs on the reference
// core.
double drag(const geometry::LocalSurface& plate) {
    constexpr std::array kRadii_m{0.5 * kEdge_m, 1.5 * kEdge_m, 4.0 * kEdge_m};
    constexpr int kTicks = 80;
    double reference_ns = 0.0;
    for (const double radius_m : kRadii_m) {
        haptics::ProxyState proxy;
        for (int tick = 0; tick < kTicks; ++tick) {
            const double angle = 0.01 * tick;
            // From above: where the ball begins it is free.
            const double y_m = std::max(radius_m + (2.0 - 0.2 * tick) * kEdge_m, radius_m - 2.0 * kEdge_m);
            const Vec3 hip_m(0.01 * std::cos(angle), y_m, 0.01 * std::sin(angle));
            const haptics::ProxyResult result =
                haptics::move_proxy(proxy, hip_m, {.contact_radius_m = radius_m}, plate);
            proxy = result.next;
            reference_ns += haptics::cost_ns(result.work);
        }
    }
    return reference_ns;
}

}  // namespace

double pace_of(Nanoseconds took_ns, double reference_ns) {
    return std::clamp(static_cast<double>(took_ns) / reference_ns, kLeastPace, kMostPace);
}

double measured_pace() {
    auto mesh = geometry::TouchMesh::create(bumpy_plate());
    BURIN_CHECK(mesh.has_value());
    if (!mesh) return 1.0;
    geometry::LocalSurface plate;
    plate.sequence = 1;
    plate.radius_m = 1.0;
    plate.meshes.push_back({.snapshot = mesh->snapshot()});
    double reference_ns = 0.0;
    Nanoseconds least_ns = std::numeric_limits<Nanoseconds>::max();
    for (int run = 0; run < kRuns; ++run) {
        const Nanoseconds before_ns = thread_cpu_ns();
        reference_ns = drag(plate);
        least_ns = std::min(least_ns, thread_cpu_ns() - before_ns);
    }
    return pace_of(least_ns, reference_ns);
}

}  // namespace burin::session
