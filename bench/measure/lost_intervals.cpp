// SPDX-License-Identifier: MIT
#include "bench/lost_intervals.hpp"

#include <random>
#include <vector>

#include "bench/exact_rays.hpp"

namespace burin::bench {
namespace {

// The ray's intervals in metres, object frame.
std::vector<Interval> held(const Solid& solid, const RayPlace& ray) {
    const auto ends = solid.sets[static_cast<std::size_t>(ray.axis)].ends(ray.index(solid.lattice));
    const auto depth_m = [&](const shared::DexelEnd& end) {
        return solid.lattice.origin_object[ray.axis] + shared::depth_of(end) * solid.lattice.unit_m();
    };
    std::vector<Interval> intervals;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) intervals.push_back({depth_m(ends[i]), depth_m(ends[i + 1])});
    return intervals;
}

}  // namespace

IntervalCheck check_intervals(const Solid& solid, const CarveScene& scene, std::uint64_t rays_an_axis,
                              std::uint64_t seed) {
    const Lattice& lattice = solid.lattice;
    const double unit = lattice.unit_m(), least = 2.0 * unit;
    std::mt19937_64 random(seed);
    IntervalCheck check;
    for (int axis = 0; axis < 3; ++axis) {
        const RayColumns columns(scene.sweeps, axis, unit);
        const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
        for (std::uint64_t i = 0; i < rays_an_axis; ++i) {
            RayPlace ray{axis, 0, 0};
            ray.u = static_cast<int>(random() % static_cast<std::uint64_t>(lattice.rays_u(axis)));
            ray.v = static_cast<int>(random() % static_cast<std::uint64_t>(lattice.rays_v(axis)));
            const double u = lattice.origin_object[u_axis] + ray.u * lattice.spacing_m;
            const double v = lattice.origin_object[v_axis] + ray.v * lattice.spacing_m;
            const std::vector<Interval> is = held(solid, ray);
            check.lost += pieces_missing(columns.kept(u, v, unit), is, least);
            check.extra += pieces_missing(is, columns.kept(u, v, -unit), least);
            ++check.rays;
        }
    }
    return check;
}

}  // namespace burin::bench
