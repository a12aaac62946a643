// SPDX-License-Identifier: MIT
// What tools cover of rays, against distances found by searching.
#include "compute/tool_spans.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "compute/ray_algebra.hpp"
#include "tests/compute/tool_reference.hpp"

namespace burin::test {
namespace {

WorkerPool& pool() {
    static WorkerPool two(2);
    return two;
}

// An empty solid on a lattice of 64 cells of the unit cube; the tools are what is looked at.
Solid bench_solid(int resolution = 64) {
    Solid solid = *make_block(Vec3(1), resolution, {"cube", {}});
    return solid;
}

std::map<std::uint32_t, std::vector<shared::DexelEnd>> by_code(const RayBatch& batch) {
    std::map<std::uint32_t, std::vector<shared::DexelEnd>> rays;
    for (const RayBatch::Ray& ray : batch.rays) {
        const auto ends = batch.ends_of(ray);
        EXPECT_TRUE(rays.emplace(ray.code, std::vector(ends.begin(), ends.end())).second) << "a ray twice";
    }
    return rays;
}

ToolSweep any_straight_sweep(Random& random, int kind) {
    ToolSweep sweep;
    sweep.shape = any_shape(random, 0.03, 0.4, kind);
    const auto anywhere = [&] {
        return Vec3(random.between(-0.1, 1.1), random.between(-0.1, 1.1), random.between(-0.1, 1.1));
    };
    sweep.start = {anywhere(), any_orientation(random)};
    sweep.end = {random.chance(0.2) ? sweep.start.position_m : anywhere(), sweep.start.orientation};
    if (random.chance(0.2))
        sweep.end.position_m = sweep.start.position_m + sweep.start.orientation * Vec3(0, random.between(-0.5, 0.5), 0);
    if (random.chance(0.2))
        sweep.end.position_m = sweep.start.position_m + sweep.start.orientation * Vec3(random.between(-0.5, 0.5), 0, 0);
    return sweep;
}

struct Agreement {
    int rays = 0, hits = 0, disagreements = 0;
    double error_units = 0.0;
};

// Random rays through the tool's bounds; those it misses by less than a thousandth of a unit are left to rounding.
void compare(const Solid& solid, const ToolSweep& sweep, int rays, Random& random, Agreement& sum) {
    const auto spans = tool_spans(solid, sweep, pool());
    ASSERT_TRUE(spans) << spans.error().line();
    const auto covered = by_code(*spans);
    for (int i = 0; i < rays; ++i) {
        const int axis = random.small(0, 2);
        int u = random.small(0, solid.lattice.rays_u(axis) - 1), v = random.small(0, solid.lattice.rays_v(axis) - 1);
        if (random.chance(0.5) && !spans->rays.empty()) {  // a ray that is hit, or a neighbour of one
            const RayPlace place = place_of(
                spans
                    ->rays[static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(spans->rays.size()) - 1))]
                    .code);
            if (place.axis == axis) {
                u = std::clamp(place.u + random.small(-1, 1), 0, solid.lattice.rays_u(axis) - 1);
                v = std::clamp(place.v + random.small(-1, 1), 0, solid.lattice.rays_v(axis) - 1);
            }
        }
        const ReferenceSpan reference = reference_span(solid.lattice, sweep, axis, u, v);
        const double deepest = solid.lattice.cells[static_cast<std::size_t>(axis)] * 4096.0;
        const double lo = std::ceil(std::max(reference.lo, 0.0)), hi = std::floor(std::min(reference.hi, deepest));
        const auto found = covered.find(shared::ray_code(axis, u, v));
        ++sum.rays;
        const bool hit = found != covered.end(), expected = !reference.misses && lo < hi;
        if (hit != expected) {
            // Within the reference's own error of a touch, or of a length of one unit?
            const bool touch = expected ? reference.hi - reference.lo < 3.0 || hi - lo < 3.0
                                        : reference.clearance < 1e-3 || hi - lo > -3.0;
            sum.disagreements += touch ? 0 : 1;
            continue;
        }
        if (!hit) continue;
        ++sum.hits;
        ASSERT_EQ(found->second.size(), 2u);
        sum.error_units = std::max(
            {sum.error_units, std::abs(depth_of(found->second[0]) - lo), std::abs(depth_of(found->second[1]) - hi)});
    }
}

}  // namespace

TEST(ToolSpans, ClosedFormsAgreeWithSearchedDistances) {
    // BURIN_SOAK_RAYS=1000000 in the environment for the long form.
    const char* soak = std::getenv("BURIN_SOAK_RAYS");
    const int rays = soak != nullptr ? std::atoi(soak) : repeated(16000);
    const Solid solid = bench_solid();
    for (const int kind : {1, 2, 4}) {
        Random random(static_cast<std::uint64_t>(kind));
        Agreement sum;
        while (sum.rays < rays) compare(solid, any_straight_sweep(random, kind), 100, random, sum);
        EXPECT_EQ(sum.disagreements, 0) << "tool " << kind;
        EXPECT_GT(sum.hits, rays / 10) << "tool " << kind;
        // 2e-5 of the lattice's extent.
        EXPECT_LE(sum.error_units, 2e-5 * 64 * 4096) << "tool " << kind;
        RecordProperty("error_units_of_tool_" + std::to_string(kind), std::to_string(sum.error_units));
    }
}

}  // namespace burin::test
