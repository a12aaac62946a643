// SPDX-License-Identifier: MIT
// The proxy against the true surface: its error, contact that is lost, and the force's jumps.
#include <algorithm>

#include "bench/haptics.hpp"
#include "bench/pressed_path.hpp"
#include "geometry/touch_mesh.hpp"
#include "haptics/tick.hpp"

namespace burin::bench {
namespace {

// A mesh in a scene whose lengths are `scale` times as large: 1 is in metres, 1000 in millimetres.
Result<LocalSurface> surface_of(TriangleMesh mesh, double scale) {
    for (Vec3& p : mesh.positions_m) p *= scale;
    auto touched = TouchMesh::create(mesh);
    if (!touched) return std::unexpected(touched.error());
    LocalSurface surface;
    surface.sequence = 1;
    surface.radius_m = 1e6;
    surface.meshes.push_back({touched->snapshot(), 0});
    return surface;
}

// At the middles of facets, where they are farthest from a surface that bends one way.
double chord_m(const BumpySphere& shape, const TriangleMesh& mesh) {
    double most = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 &p = mesh.positions_m[a], &q = mesh.positions_m[b], &r = mesh.positions_m[c];
        for (const Vec3& at : {(p + q + r) / 3.0, 0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + p)})
            most = std::max(most, std::abs(shape.distance_m(at)));
    }
    return most;
}

// A tick without device, loop or gate: where the proxy of a point goes.
class Point {
public:
    Point(const LocalSurface& surface, double scale, bool shading = true) : surface_(surface), scale_(scale) {
        settings_.shading = shading;
    }
    // Whether it is in contact.
    bool step(const Vec3& hip_m) {
        const ProxyResult moved = move_proxy(state_, scale_ * hip_m, settings_, surface_);
        state_ = moved.next;
        return moved.constraints > 0;
    }
    [[nodiscard]] Vec3 proxy_m() const { return state_.position_object_m / scale_; }

private:
    const LocalSurface& surface_;
    double scale_;
    ProxySettings settings_;
    ProxyState state_;
};

void measure_errors(Haptics& all, const BumpySphere& shape, const LocalSurface& surface, double chord) {
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

// In and out of the surface again and again; the same way in all units.
void measure_contact(Haptics& all, const BumpySphere& shape, const LocalSurface& in_m, const LocalSurface& in_mm,
                     const LocalSurface& in_1024ths, double chord) {
    LostContact metres{.unit = "m"}, millimetres{.unit = "mm"};
    Point of_m(in_m, 1.0), of_mm(in_mm, 1000.0), of_1024ths(in_1024ths, 1024.0);
    PressedPath path(shape, {.mean_m = 0.0005, .swing_m = 0.001});
    const auto count = [&](LostContact& counts, bool felt, double distance) {
        ++counts.ticks;
        if (distance < -chord) {
            ++counts.inside;
            if (!felt) ++counts.lost;
        } else if (distance > chord && felt) {
            ++counts.felt_outside;
        }
    };
    for (std::uint64_t i = 0; i < all.options.contact_ticks; ++i) {
        path.step();
        const double distance = shape.distance_m(path.hip_m());
        count(metres, of_m.step(path.hip_m()), distance);
        count(millimetres, of_mm.step(path.hip_m()), distance);
        of_1024ths.step(path.hip_m());
        const auto differ_um = [&](const Point& other) { return 1e6 * glm::length(of_m.proxy_m() - other.proxy_m()); };
        if (distance < 0.0) all.metres_and_millimetres_differ_um.push_back(differ_um(of_mm));
        all.metres_and_1024ths_differ_um = std::max(all.metres_and_1024ths_differ_um, differ_um(of_1024ths));
    }
    all.contact = {metres, millimetres};
}

double quantile_of(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Of a plain sphere pressed 1 mm deep all the way: every change of the force beyond the surface's own turn is the facets'.
Result<void> measure_jumps(Haptics& all) {
    const BumpySphere sphere{.bumps = 0.0};
    const auto surface = surface_of(mesh_of(sphere, squares_for(all.options.sizes.front())), 1.0);
    if (!surface) return std::unexpected(surface.error());
    for (const bool shading : {true, false}) {
        PressedPath path(sphere, {.mean_m = 0.001, .swing_m = 0.0});
        Point point(*surface, 1.0, shading);
        std::vector<double> jumps;
        Vec3 before(0.0), outward_before(0.0);
        double turn = 0.0;
        for (std::uint64_t i = 0; i < all.options.accuracy_ticks; ++i) {
            path.step();
            point.step(path.hip_m());
            const Vec3 spring = point.proxy_m() - path.hip_m();
            // The first ticks are the way in.
            if (i > 10) jumps.push_back(100.0 * glm::length(spring - before) / glm::length(before));
            if (i > 10) turn = std::max(turn, 100.0 * glm::length(path.outward() - outward_before));
            before = spring, outward_before = path.outward();
        }
        all.jumps.push_back({surface->triangles(), shading, quantile_of(jumps, 1.0), quantile_of(jumps, 0.99), turn});
    }
    return {};
}

}  // namespace

Result<void> measure_accuracy(Haptics& all, const Tell& tell) {
    const BumpySphere shape;
    const TriangleMesh mesh = mesh_of(shape, squares_for(all.options.accuracy_size));
    const auto in_m = surface_of(mesh, 1.0), in_mm = surface_of(mesh, 1000.0), in_1024ths = surface_of(mesh, 1024.0);
    if (!in_m) return std::unexpected(in_m.error());
    if (!in_mm) return std::unexpected(in_mm.error());
    if (!in_1024ths) return std::unexpected(in_1024ths.error());
    const double chord = chord_m(shape, mesh);
    tell("the proxy against the true surface");
    measure_errors(all, shape, *in_m, chord);
    tell("contact lost, in metres and in millimetres");
    measure_contact(all, shape, *in_m, *in_mm, *in_1024ths, chord);
    tell("jumps of the force at edges");
    return measure_jumps(all);
}

}  // namespace burin::bench
