// SPDX-License-Identifier: MIT
// Measures the proxy against the true surface: its error, lost contacts, and the force's jumps.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "base/statistics.hpp"
#include "base/try.hpp"
#include "bench/haptics/hand_path.hpp"
#include "bench/haptics/haptics.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::bench {
namespace {

// Makes a surface from a mesh in a scene whose coordinates are `scale` times metres: 1 is metres, 1000 millimetres.
Result<geometry::LocalSurface> surface_of(geometry::TriangleMesh mesh, double scale) {
    for (Vec3& p : mesh.positions_m) p *= scale;
    BURIN_TRY(touched, geometry::TouchMesh::create(mesh));
    geometry::LocalSurface surface;
    surface.sequence = 1;
    surface.radius_m = 1e6;
    surface.meshes.push_back({touched.snapshot(), 0});
    return surface;
}

// Returns the mesh's largest distance from the true surface, at the centres of facets and edges, where it is largest on
// a surface that bends one way.
double chord_m(const BumpySphere& shape, const geometry::TriangleMesh& mesh) {
    double most = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 &p = mesh.positions_m[a], &q = mesh.positions_m[b], &r = mesh.positions_m[c];
        for (const Vec3& at : {(p + q + r) / 3.0, 0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + p)})
            most = std::max(most, std::abs(shape.distance_m(at)));
    }
    return most;
}

// Moves the proxy of one point as a tick does, without device, loop or gate.
class Point {
public:
    Point(const geometry::LocalSurface& surface, double scale, bool shading = true) : surface_(surface), scale_(scale) {
        settings_.shading = shading;
    }
    // Returns whether the point is in contact.
    bool step(const Vec3& hip_m) {
        const haptics::ProxyResult moved = haptics::move_proxy(state_, scale_ * hip_m, settings_, surface_);
        state_ = moved.next;
        return moved.constraints > 0;
    }
    [[nodiscard]] Vec3 proxy_m() const { return state_.position_object_m / scale_; }

private:
    const geometry::LocalSurface& surface_;
    double scale_;
    haptics::ProxySettings settings_;
    haptics::ProxyState state_;
};

void measure_errors(Haptics& all, const BumpySphere& shape, const geometry::LocalSurface& surface, double chord) {
    ProxyErrors& errors = all.errors;
    errors.triangles = surface.triangles();
    errors.ticks = all.options.accuracy_ticks;
    errors.chord_mm = 1e3 * chord;
    PressedPath path(shape, {});
    Point point(surface, 1.0);
    for (std::uint64_t i = 0; i < errors.ticks; ++i) {
        path.step();
        if (!point.step(path.hip_m())) continue;
        ++errors.in_contact;
        const Vec3 proxy = point.proxy_m();
        errors.normal_mm.push_back(1e3 * std::abs(shape.distance_m(proxy)));
        const BumpySphere::Nearest truth = shape.nearest(path.hip_m(), proxy);
        if (truth.found)
            errors.lag_mm.push_back(1e3 * glm::length(proxy - truth.point));
        else
            ++errors.not_solved;
    }
}

void count_tick(LostContact& counts, bool felt, double distance_m, double chord_m) {
    ++counts.ticks;
    if (distance_m < -chord_m) {
        ++counts.inside;
        if (!felt) ++counts.lost;
    } else if (distance_m > chord_m && felt) {
        ++counts.felt_outside;
    }
}

// Counts lost contacts on a path in and out of the surface; the path is the same in all units.
void measure_contact(Haptics& all, const BumpySphere& shape, const geometry::LocalSurface& in_m,
                     const geometry::LocalSurface& in_mm, const geometry::LocalSurface& in_1024ths, double chord) {
    LostContact metres{.part = "move_proxy", .unit = "m"}, millimetres{.part = "move_proxy", .unit = "mm"};
    Point of_m(in_m, 1.0), of_mm(in_mm, 1000.0), of_1024ths(in_1024ths, 1024.0);
    PressedPath path(shape, {.mean_m = 0.0005, .swing_m = 0.001});
    for (std::uint64_t i = 0; i < all.options.contact_ticks; ++i) {
        path.step();
        const double distance = shape.distance_m(path.hip_m());
        count_tick(metres, of_m.step(path.hip_m()), distance, chord);
        count_tick(millimetres, of_mm.step(path.hip_m()), distance, chord);
        of_1024ths.step(path.hip_m());
        const auto differ_um = [&](const Point& other) { return 1e6 * glm::length(of_m.proxy_m() - other.proxy_m()); };
        if (distance < 0.0) all.metres_and_millimetres_differ_um.push_back(differ_um(of_mm));
        all.metres_and_1024ths_differ_um = std::max(all.metres_and_1024ths_differ_um, differ_um(of_1024ths));
    }
    all.contact = {metres, millimetres};
}

constexpr std::uint64_t kLoopShare = 10;  // one tick of the whole loop for so many calls of move_proxy
constexpr double kShaking_m = 0.0002;     // the largest step of the hand from tick to tick, along each axis
constexpr double kRegion_m = 0.0015;      // how far shaking takes the hand from its path
constexpr double kEncoderStep_m = devices::OmniModel{}.resolution_m;

// A hand that follows a path in and out of the surface and shakes: a random walk about the path, read by encoders. It
// turns round within a tick, as no hand does.
class ShakingHand {
public:
    explicit ShakingHand(const BumpySphere& shape) : path_(shape, {.mean_m = 0.0005, .swing_m = 0.001}) {}
    void step() {
        path_.step();
        for (int axis = 0; axis < 3; ++axis) {
            const double step_m = kShaking_m * (2.0 * static_cast<double>(random_()) / 4294967295.0 - 1.0);
            shaken_m_[axis] = std::clamp(shaken_m_[axis] + step_m, -kRegion_m, kRegion_m);
            read_m_[axis] = kEncoderStep_m * std::round((path_.hip_m()[axis] + shaken_m_[axis]) / kEncoderStep_m);
        }
    }
    [[nodiscard]] const Vec3& read_m() const { return read_m_; }

private:
    PressedPath path_;
    std::mt19937 random_{1};
    Vec3 shaken_m_{0.0}, read_m_{0.0};
};

// Counts lost contacts of the whole loop.
void measure_contact_of_loop(Haptics& all, const BumpySphere& shape, const geometry::LocalSurface& surface,
                             double chord) {
    LostContact counts{.part = "whole_loop", .unit = "m"};
    SimulatedClock clock;
    PathDevice device;
    const auto channels = std::make_unique<haptics::HapticChannels>();
    haptics::HapticLoop loop(device, clock, *channels);
    haptics::TickParameters& parameters = channels->parameters.draft();
    parameters.sequence = 1;
    parameters.max_surface_age_s = 0.0;
    parameters.position_noise_m = kEncoderStep_m;
    parameters.materials[0].static_friction = 0.4;
    parameters.materials[0].dynamic_friction = 0.3;
    channels->parameters.publish();
    channels->surface.draft() = surface;
    channels->surface.publish();
    ShakingHand hand(shape);
    for (std::uint64_t i = 0; i < all.options.contact_ticks / kLoopShare; ++i) {
        hand.step();
        clock.sleep_until(clock.now_ns() + loop.period_ns());
        device.go_to(hand.read_m(), Quat(1.0, 0.0, 0.0, 0.0), clock.now_ns());
        const haptics::TickRecord record = loop.step();
        const bool open = record.gate.cause == haptics::GateCause::none && !record.gate.ramping;
        const bool silent = open && record.gate.given.force_device_N == Vec3(0.0);
        count_tick(counts, record.in_contact() && !silent, shape.distance_m(hand.read_m()), chord);
    }
    all.contact.push_back(counts);
}

// Measures on a plain sphere pressed 1 mm deep all the way: every change of the force beyond the turn of the surface
// itself comes from the facets.
Result<void> measure_jumps(Haptics& all) {
    const BumpySphere sphere{.bumps = 0.0};
    BURIN_TRY(surface, surface_of(mesh_of(sphere, squares_for(all.options.sizes.front())), 1.0));
    for (const bool shading : {true, false}) {
        PressedPath path(sphere, {.mean_m = 0.001, .swing_m = 0.0});
        Point point(surface, 1.0, shading);
        std::vector<double> jumps;
        Vec3 before(0.0), outward_before(0.0);
        double turn = 0.0;
        for (std::uint64_t i = 0; i < all.options.accuracy_ticks; ++i) {
            path.step();
            point.step(path.hip_m());
            const Vec3 spring = point.proxy_m() - path.hip_m();
            // The first ticks approach the surface.
            if (i > 10) jumps.push_back(100.0 * glm::length(spring - before) / glm::length(before));
            if (i > 10) turn = std::max(turn, 100.0 * glm::length(path.outward() - outward_before));
            before = spring, outward_before = path.outward();
        }
        all.jumps.push_back({surface.triangles(), shading, quantile(jumps, 1.0), quantile(jumps, 0.99), turn});
    }
    return {};
}

}  // namespace

Result<void> measure_accuracy(Haptics& all, const Tell& log_progress) {
    const BumpySphere shape;
    const geometry::TriangleMesh mesh = mesh_of(shape, squares_for(all.options.accuracy_size));
    const auto in_m = surface_of(mesh, 1.0), in_mm = surface_of(mesh, 1000.0), in_1024ths = surface_of(mesh, 1024.0);
    if (!in_m) return std::unexpected(in_m.error());
    if (!in_mm) return std::unexpected(in_mm.error());
    if (!in_1024ths) return std::unexpected(in_1024ths.error());
    const double chord = chord_m(shape, mesh);
    log_progress("the proxy against the true surface");
    measure_errors(all, shape, *in_m, chord);
    log_progress("contact lost, in metres and in millimetres");
    measure_contact(all, shape, *in_m, *in_mm, *in_1024ths, chord);
    log_progress("contact lost by the whole loop");
    measure_contact_of_loop(all, shape, *in_m, chord);
    log_progress("jumps of the force at edges");
    return measure_jumps(all);
}

}  // namespace burin::bench
