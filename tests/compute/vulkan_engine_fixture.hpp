// SPDX-License-Identifier: MIT
// The device, the random sweeps and the random rays that the tests of the Vulkan engine share.
#pragma once

#include <algorithm>
#include <vector>

#include "compute/vulkan/vulkan_engine.hpp"
#include "gpu/core.hpp"
#include "tests/compute/effort.hpp"
#include "tests/compute/engine_pair.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::compute::test {

class VulkanEngineGpu : public gpu::DeviceTest {
protected:
    void SetUp() override {
        gpu::DeviceTest::SetUp();
        if (IsSkipped()) return;
        const gpu::Capabilities& can = device().capabilities();
        if (!can.shader_int64 || !can.shader_float64) {
            GTEST_SKIP() << device().info().name << " has no 64-bit integers or no doubles in shaders";
        }
    }
    // To play a lesser device.
    gpu::Capabilities& capabilities() { return device().core()->capabilities; }

    WorkerPool pool_{1};
};

inline Vec3 random_point(Random& random, double lo, double hi) {
    return {random.between(lo, hi), random.between(lo, hi), random.between(lo, hi)};
}

// Radii of all sizes, from a fraction of a cell to more than the solid; mostly short moves, some through everything.
inline BallSweep random_sweep(Random& random, double spacing_m) {
    BallSweep sweep;
    sweep.radius_m = 0.2 * spacing_m * std::pow(1.5 / (0.2 * spacing_m), std::pow(random.unit(), 2.0));
    sweep.start_object_m = random_point(random, -0.3, 1.3);
    sweep.end_object_m = random.chance(0.3)   ? sweep.start_object_m
                         : random.chance(0.8) ? sweep.start_object_m + random_point(random, -0.1, 0.1)
                                              : random_point(random, -2.0, 3.0);
    if (random.chance(0.2)) sweep.end_object_m.x = sweep.start_object_m.x;  // parallel to lattice planes
    if (random.chance(0.2)) sweep.end_object_m.y = sweep.start_object_m.y;
    sweep.material = static_cast<std::uint8_t>(random.small(0, 1));
    if (random.chance(0.4)) sweep.operation = random.chance(0.5) ? Operation::fill : Operation::paint;
    return sweep;
}

// Rays with up to `most_plates` plates each, half of them with just so many, so that a power of two leaves no room for
// more. All rays are different; the three axes need not fit together for an engine.
inline Solid plates(int resolution, int most_plates, std::uint64_t seed) {
    Solid solid = unit_cube(resolution);
    Random random(seed);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<std::uint32_t> counts;
        std::vector<shared::DexelEnd> ends;
        for (std::size_t ray = 0; ray < solid.sets[axis].ray_count(); ++ray) {
            const int count = random.chance(0.5) ? most_plates : random.small(0, most_plates);
            int depth = 0;
            for (int i = 0; i < 2 * count; ++i) {
                depth += random.small(1, solid.lattice.cells[axis] * shared::kUnitsPerCell / (2 * most_plates));
                ends.push_back(shared::make_end(depth, 0, static_cast<shared::uint>(random.bits())));
            }
            counts.push_back(static_cast<std::uint32_t>(2 * count));
        }
        solid.sets[axis].assign(counts, ends);
    }
    EXPECT_TRUE(well_formed(solid));
    return solid;
}

// Random lists of ends for some rays, none of them named twice.
inline RayBatch random_rays(const Lattice& lattice, int count, Random& random) {
    std::vector<std::uint32_t> codes;
    for (int i = 0; i < count; ++i) {
        const int axis = random.small(0, 2);
        codes.push_back(shared::ray_code(axis, random.small(0, lattice.rays_u(axis) - 1),
                                         random.small(0, lattice.rays_v(axis) - 1)));
    }
    std::ranges::sort(codes);
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    RayBatch batch;
    for (const std::uint32_t code : codes) {
        std::vector<shared::DexelEnd> ends;
        const int most = lattice.cells[static_cast<std::size_t>(shared::axis_of(code))] * shared::kUnitsPerCell;
        const int plates = random.small(0, 20);
        for (int i = 0, depth = 0; i < 2 * plates; ++i) {
            depth += random.small(1, most / 40);
            ends.push_back(shared::make_end(depth, 1, static_cast<shared::uint>(random.bits())));
        }
        batch.add(code, ends);
    }
    return batch;
}

// What undoes a record in which each ray appears once at most per step: the oldest entry of a ray counts.
inline RayBatch as_before(const Changes& changes) {
    RayBatch batch;
    std::vector<std::uint32_t> seen;
    for (const shared::ChangedRay& ray : changes.rays) {
        if (std::ranges::find(seen, ray.ray) != seen.end()) continue;
        seen.push_back(ray.ray);
        batch.add(ray.ray, changes.before_of(ray));
    }
    return batch;
}

}  // namespace burin::compute::test
