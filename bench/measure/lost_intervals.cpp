// SPDX-License-Identifier: MIT
#include "bench/measure/lost_intervals.hpp"

#include <random>
#include <vector>

#include "bench/measure/exact_rays.hpp"

namespace burin::bench {
namespace {

// Returns the ray's intervals in metres, object frame.
std::vector<Interval> held(const compute::Solid& solid, const compute::RayPlace& ray) {
    const auto ends = solid.sets[static_cast<std::size_t>(ray.axis)].ends(ray.index(solid.lattice));
    const auto depth_m = [&](const shared::DexelEnd& end) {
        return solid.lattice.origin_object[ray.axis] + shared::depth_of(end) * solid.lattice.unit_m();
    };
    std::vector<Interval> intervals;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) intervals.push_back({depth_m(ends[i]), depth_m(ends[i + 1])});
    return intervals;
}

// Returns what a ray holds of the workpiece before the first cut. A turned cube's corners are rounded to whole units,
// as a tool's coordinates are, so its faces are moved by `growth_m` as well.
std::vector<Interval> held_uncut(const CarveScene& scene, const compute::Solid* uncut, const compute::RayPlace& ray,
                                 double u, double v, double growth_m) {
    if (uncut != nullptr) return held(*uncut, ray);
    const auto cube = through_cube(scene.object_from_scene, ray.axis, u, v, scene.is_turned() ? growth_m : 0.0);
    return cube ? std::vector{*cube} : std::vector<Interval>{};
}

}  // namespace

IntervalCheck check_intervals(const compute::Solid& solid, const CarveScene& scene, std::uint64_t rays_an_axis,
                              std::uint64_t seed, const compute::Solid* uncut) {
    const compute::Lattice& lattice = solid.lattice;
    const double unit = lattice.unit_m(), least = 2.0 * unit;
    std::vector<compute::BallSweep> sweeps;
    for (const compute::BallSweep& sweep : scene.sweeps) sweeps.push_back(in_object(scene, sweep));
    std::mt19937_64 random(seed);
    IntervalCheck check;
    for (int axis = 0; axis < 3; ++axis) {
        const RayColumns columns(sweeps, axis, unit);
        const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
        for (std::uint64_t i = 0; i < rays_an_axis; ++i) {
            compute::RayPlace ray{axis, 0, 0};
            ray.u = static_cast<int>(random() % static_cast<std::uint64_t>(lattice.rays_u(axis)));
            ray.v = static_cast<int>(random() % static_cast<std::uint64_t>(lattice.rays_v(axis)));
            const double u = lattice.origin_object[u_axis] + ray.u * lattice.spacing_m;
            const double v = lattice.origin_object[v_axis] + ray.v * lattice.spacing_m;
            const std::vector<Interval> is = held(solid, ray);
            // Tools one unit larger and a cube one unit smaller leave less than there must be; the reverse, more.
            const auto kept = [&](double growth_m) {
                return columns.kept_of(held_uncut(scene, uncut, ray, u, v, -growth_m), u, v, growth_m);
            };
            check.lost += pieces_missing(kept(unit), is, least);
            check.extra += pieces_missing(is, kept(-unit), least);
            ++check.rays;
        }
    }
    return check;
}

}  // namespace burin::bench
