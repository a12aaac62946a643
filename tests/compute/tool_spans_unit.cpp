// SPDX-License-Identifier: MIT
// What tools cover of rays, against distances found by searching.
#include "compute/tools/tool_spans.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "compute/engine/engine.hpp"
#include "compute/rays/set_algebra.hpp"
#include "compute/tools/turning_sweep.hpp"
#include "shaders/shared/octahedral.h"
#include "tests/compute/tool_reference.hpp"

namespace burin::compute::test {
namespace {

WorkerPool& span_pool() {
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

// One kind after the other, but not the ball, whose number is 0.
int without_ball(int i) { return 1 + i % (kDrawnKinds - 1); }

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
    const auto spans = tool_spans(solid, sweep, span_pool());
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
    const int rays = soak != nullptr ? std::atoi(soak) : repeated(4000);
    const Solid solid = bench_solid();
    for (int kind = 0; kind < kDrawnKinds; ++kind) {
        // The bull-nose has no closed form, and of a ball the centre is rounded to units.
        if (kind == kKindOf<BallTool> || kind == kKindOf<BullNoseTool>) continue;
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

namespace {

// Depths along a ray at which the tool certainly is, or certainly is not, going by its distance.
void expect_within_tolerance(const Solid& solid, const ToolSweep& sweep, double tolerance_m, int poses,
                             Random& random) {
    const auto spans = tool_spans(solid, sweep, span_pool());
    ASSERT_TRUE(spans) << spans.error().line();
    ASSERT_FALSE(spans->rays.empty());
    const auto covered = by_code(*spans);
    const double unit_m = solid.lattice.unit_m();
    int inside = 0, outside = 0;
    for (int i = 0; i < 120; ++i) {
        const auto pick = static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(spans->rays.size()) - 1));
        RayPlace place = place_of(spans->rays[pick].code);
        place.u = std::clamp(place.u + random.small(-1, 1), 0, solid.lattice.rays_u(place.axis) - 1);
        const auto found = covered.find(place.code());
        const std::vector<shared::DexelEnd> ends =
            found == covered.end() ? std::vector<shared::DexelEnd>{} : found->second;
        for (int k = 0; k < 8; ++k) {
            // Near an end, where it counts, or anywhere.
            const int deepest = solid.lattice.cells[static_cast<std::size_t>(place.axis)] * 4096;
            int depth = random.small(1, deepest - 1);
            if (!ends.empty() && k < 6) {
                const int end =
                    depth_of(ends[static_cast<std::size_t>(random.small(0, static_cast<int>(ends.size()) - 1))]);
                depth = std::clamp(end + static_cast<int>(random.any_size(12)), 1, deepest - 1);
            }
            Vec3 units;
            units[place.axis] = depth;
            units[(place.axis + 1) % 3] = place.u * 4096.0;
            units[(place.axis + 2) % 3] = place.v * 4096.0;
            const double distance = signed_distance_from_poses(sweep, solid.lattice.object_from_units(units), poses);
            bool is_covered = false;
            for (std::size_t e = 0; e < ends.size(); e += 2) {
                is_covered = is_covered || (depth_of(ends[e]) <= depth && depth < depth_of(ends[e + 1]));
            }
            if (distance < -tolerance_m - 2.0 * unit_m) {
                ASSERT_TRUE(is_covered) << distance / unit_m << " units, within";
                ++inside;
            }
            if (distance > tolerance_m + 2.0 * unit_m) {
                ASSERT_FALSE(is_covered) << distance / unit_m << " units, without";
                ++outside;
            }
        }
    }
    EXPECT_GT(inside, 0);
    EXPECT_GT(outside, 0);
}

ToolSweep turning_sweep(Random& random, int kind) {
    ToolSweep sweep;
    sweep.shape = any_shape(random, 0.05, 0.25, kind);
    sweep.start = {Vec3(random.between(0.3, 0.7), random.between(0.3, 0.7), random.between(0.3, 0.7)),
                   any_orientation(random)};
    sweep.end = {
        sweep.start.position_m + Vec3(random.between(-0.2, 0.2), random.between(-0.2, 0.2), random.between(-0.2, 0.2)),
        any_orientation(random)};
    sweep.tolerance_cells = random.between(0.1, 0.5);
    return sweep;
}

}  // namespace

TEST(ToolSpans, TurningToolsStayWithinTheirTolerance) {
    const Solid solid = bench_solid(48);
    Random random(7);
    for (int i = 0; i < repeated(16); ++i) {
        const ToolSweep sweep = turning_sweep(random, without_ball(i));
        // The reference's own poses: up to half a turn in 1500 of them moves a point 0.5 m away by 0.0005 m a half
        // pose.
        const double pose_error_m = 0.5 * (3.2 * 0.5 + 0.4) / 1500;
        expect_within_tolerance(solid, sweep, sweep.tolerance_cells * solid.lattice.spacing_m + pose_error_m, 1500,
                                random);
        if (HasFatalFailure()) return;
    }
}

TEST(ToolSpans, BullNosesStayWithinTheirTolerance) {
    const Solid solid = bench_solid();
    Random random(8);
    for (int i = 0; i < repeated(16); ++i) {
        ToolSweep sweep = any_straight_sweep(random, kKindOf<BullNoseTool>);
        sweep.tolerance_cells = random.chance(0.5) ? 0.1 : 0.01;
        if (tool_spans(solid, sweep, span_pool())->rays.size() < 50) continue;
        const double pose_error_m = 0.5 * glm::length(sweep.end.position_m - sweep.start.position_m) / 2000;
        expect_within_tolerance(solid, sweep, 0.25 * sweep.tolerance_cells * solid.lattice.spacing_m + pose_error_m,
                                2000, random);
        if (HasFatalFailure()) return;
    }
}

// Out of the tool, and across the way where the motion leaves the surface: compared with the distance's own gradient.
TEST(ToolSpans, NormalsAreTheGradientOfTheDistance) {
    const Solid solid = bench_solid();
    Random random(9);
    int looked_at = 0, at_border = 0, off = 0;
    for (int i = 0; i < repeated(200); ++i) {
        ToolSweep sweep = any_straight_sweep(random, without_ball(i));
        sweep.tolerance_cells = 0.004;  // so that a bull-nose's slices lie on its surface
        const auto spans = tool_spans(solid, sweep, span_pool());
        ASSERT_TRUE(spans);
        for (int k = 0; k < 20 && !spans->rays.empty(); ++k) {
            const auto pick =
                static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(spans->rays.size()) - 1));
            const RayBatch::Ray& ray = spans->rays[pick];
            const RayPlace place = place_of(ray.code);
            const shared::DexelEnd end = spans->ends_of(ray)[static_cast<std::size_t>(random.small(0, 1))];
            const int deepest = solid.lattice.cells[static_cast<std::size_t>(place.axis)] * 4096;
            if (depth_of(end) == 0 || depth_of(end) == deepest) {  // cut off by the lattice's face, which looks outward
                const shared::Direction face = shared::decode_normal(end.normal);
                const double outward = Vec3(face.x, face.y, face.z)[place.axis] * (depth_of(end) == 0 ? -1.0 : 1.0);
                ++at_border;
                off += outward > 0.999 ? 0 : 1;
                continue;
            }
            Vec3 units;
            units[place.axis] = depth_of(end);
            units[(place.axis + 1) % 3] = place.u * 4096.0;
            units[(place.axis + 2) % 3] = place.v * 4096.0;
            const Vec3 p = solid.lattice.object_from_units(units);
            const shared::Direction d = shared::decode_normal(end.normal);
            const Vec3 normal(d.x, d.y, d.z);
            // A step out along the true normal moves as far away as the step is long; along another one, less far.
            const double step = 0.002;
            ++looked_at;
            off += distance_from_sweep(sweep, p + step * normal) > 0.96 * step ? 0 : 1;
        }
    }
    EXPECT_GT(looked_at, repeated(1000));
    EXPECT_GT(at_border, repeated(20));
    EXPECT_EQ(off, 0);
}

TEST(ToolSpans, ABallsSpansAreThoseOfTheEngine) {
    Random random(10);
    for (int i = 0; i < repeated(60); ++i) {
        Solid solid = bench_solid(random.small(16, 40));
        solid.materials.push_back({"tool", {}});
        const auto anywhere = [&] {
            return Vec3(random.between(-0.2, 1.2), random.between(-0.2, 1.2), random.between(-0.2, 1.2));
        };
        const Vec3 from = anywhere(), to = random.chance(0.3) ? from : anywhere();
        const double radius = random.between(0.01, 0.4);
        ToolSweep sweep{
            BallTool{radius}, {from, any_orientation(random)}, {to, any_orientation(random)}, Operation::cut, 1};
        const auto engine = make_cpu_engine(solid, span_pool());
        const BallSweep ball{from, to, radius, 1, Operation::cut};
        ASSERT_TRUE(engine->carve({&ball, 1}));
        const auto spans = tool_spans(solid, sweep, span_pool());
        ASSERT_TRUE(spans);
        const auto covered = by_code(*spans);
        for (int axis = 0; axis < 3; ++axis) {
            for (int v = 0; v < solid.lattice.rays_v(axis); ++v) {
                for (int u = 0; u < solid.lattice.rays_u(axis); ++u) {
                    const auto found = covered.find(shared::ray_code(axis, u, v));
                    std::vector<shared::DexelEnd> left;
                    append_difference(solid.sets[static_cast<std::size_t>(axis)].ends(u, v),
                                      found == covered.end() ? RayEnds{} : RayEnds(found->second), left);
                    const RayEnds held = engine->solid().sets[static_cast<std::size_t>(axis)].ends(u, v);
                    ASSERT_TRUE(same_ends(left, held)) << i << " axis " << axis << " ray " << u << ' ' << v;
                }
            }
        }
    }
}

TEST(ToolSpans, ThreadsDoNotChangeTheBatch) {
    WorkerPool one(1), five(5);
    const Solid solid = bench_solid(40);
    Random random(11);
    for (int kind = 0; kind < kDrawnKinds; ++kind) {
        const ToolSweep sweep =
            kind == kKindOf<BallTool> ? any_straight_sweep(random, kind) : turning_sweep(random, kind);
        const auto a = tool_spans(solid, sweep, one), b = tool_spans(solid, sweep, five);
        ASSERT_TRUE(a && b);
        ASSERT_EQ(a->rays.size(), b->rays.size());
        EXPECT_TRUE(same_ends(a->ends, b->ends));
        for (std::size_t i = 0; i < a->rays.size(); ++i) ASSERT_EQ(a->rays[i].code, b->rays[i].code);
    }
}

// A tool that lies along the lattice with its faces exactly on rays: touched rays count, and nothing is lost or
// doubled.
TEST(ToolSpans, FacesOnRaysAndTangentRaysCount) {
    const Solid solid = bench_solid();
    const Lattice& lattice = solid.lattice;
    const auto node = [&](int x, int y, int z) { return lattice.object_from_units(Vec3(x, y, z) * 4096.0); };
    const double h = lattice.spacing_m;
    const ToolSweep box{BoxTool{Vec3(4 * h, 3 * h, 2 * h)}, Pose{node(20, 20, 20)}, Pose{node(20, 20, 30)}};
    const auto of_box = by_code(*tool_spans(solid, box, span_pool()));
    const ToolSweep cylinder{CylinderTool{3 * h, 5 * h}, Pose{node(20, 20, 20)}, Pose{node(26, 20, 20)}};
    const auto of_cylinder = by_code(*tool_spans(solid, cylinder, span_pool()));
    const auto expect_span = [&](const auto& rays, int axis, int u, int v, double lo, double hi) {
        const auto found = rays.find(shared::ray_code(axis, u, v));
        ASSERT_NE(found, rays.end()) << axis << ' ' << u << ' ' << v;
        EXPECT_NEAR(depth_of(found->second[0]), lo * 4096, 1.01);
        EXPECT_NEAR(depth_of(found->second[1]), hi * 4096, 1.01);
    };
    // Rays strictly within; those in a face lie where rounding puts them, but have the whole length or nothing.
    for (int y = 18; y <= 22; ++y)
        for (int x = 17; x <= 23; ++x) expect_span(of_box, 2, x, y, 18, 32);
    for (int z = 19; z <= 31; ++z)
        for (int y = 18; y <= 22; ++y) expect_span(of_box, 0, y, z, 16, 24);
    for (const auto& [code, ends] : of_box) EXPECT_GE(depth_of(ends[1]) - depth_of(ends[0]), 6 * 4096 - 2);
    for (int x = 20; x <= 26; ++x) expect_span(of_cylinder, 1, 20, x, 20, 25);  // u along z, v along x
    for (int z = 18; z <= 22; ++z) expect_span(of_cylinder, 1, z, 23, 20, 25);
    for (int y = 21; y <= 24; ++y) expect_span(of_cylinder, 0, y, 20, 17, 29);
}

TEST(ToolSpans, ToolsFarLargerAndFarSmallerThanACell) {
    const Solid solid = bench_solid(32);
    const double h = solid.lattice.spacing_m;
    const Vec3 on_ray = solid.lattice.object_from_units(Vec3(16.0, 16.0, 16.3) * 4096.0);
    const ToolSweep tiny{BoxTool{Vec3(0.01 * h)}, Pose{on_ray}, Pose{on_ray}};
    EXPECT_EQ(tool_spans(solid, tiny, span_pool())->rays.size(), 1u);
    const ToolSweep nothing{CylinderTool{1e-9 * h, 1e-9 * h}, Pose{on_ray}, Pose{on_ray}};
    EXPECT_EQ(tool_spans(solid, nothing, span_pool())->rays.size(), 0u);
    Random random(12);
    const Pose middle{Vec3(0.5), any_orientation(random)};
    for (const ToolShape& huge : {ToolShape(BoxTool{Vec3(50.0)}), ToolShape(CylinderTool{60.0, 60.0})}) {
        ToolSweep all{huge, middle, middle};
        if (!std::holds_alternative<BoxTool>(huge))
            all.start.position_m = all.end.position_m -= middle.orientation * Vec3(0, 30, 0);
        const auto spans = tool_spans(solid, all, span_pool());
        ASSERT_TRUE(spans) << spans.error().line();
        ASSERT_EQ(spans->rays.size(), solid.rays_held());
        for (const RayBatch::Ray& ray : spans->rays) {
            const int deepest = solid.lattice.cells[static_cast<std::size_t>(place_of(ray.code).axis)] * 4096;
            ASSERT_EQ(depth_of(spans->ends_of(ray)[0]), 0);
            ASSERT_EQ(depth_of(spans->ends_of(ray)[1]), deepest);
        }
    }
}

TEST(ToolSpans, LongWaysAreClippedAndFarOnesMiss) {
    const Solid solid = bench_solid(32);
    Random random(13);
    for (int i = 0; i < 20; ++i) {
        ToolSweep far = any_straight_sweep(random, without_ball(i)), near = far;
        const Vec3 way = any_orientation(random) * Vec3(1, 0, 0);
        far.start.position_m = Vec3(0.5) - 1e4 * way;
        far.end.position_m = Vec3(0.5) + 1e4 * way;
        near.start.position_m = Vec3(0.5) - 4.0 * way;
        near.end.position_m = Vec3(0.5) + 4.0 * way;
        const auto a = tool_spans(solid, far, span_pool()), b = tool_spans(solid, near, span_pool());
        ASSERT_TRUE(a && b);
        EXPECT_NEAR(static_cast<double>(a->rays.size()), static_cast<double>(b->rays.size()), 3.0);
        far.start.position_m += Vec3(-way.y, way.x, 0) * 1e5 + Vec3(0, 0, 1e5);
        far.end.position_m = far.start.position_m + way;
        EXPECT_TRUE(tool_spans(solid, far, span_pool())->rays.empty());
    }
}

TEST(ToolSpans, RefusesToolsThatCannotBeNamingTheRemedy) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const Solid solid = bench_solid(32);
    const ToolSweep good{BoxTool{Vec3(0.1)}, Pose{Vec3(0.5)}, Pose{Vec3(0.6)}};
    std::vector<ToolSweep> bad;
    for (const ToolShape& shape :
         {ToolShape(BallTool{0}), ToolShape(BallTool{nan}), ToolShape(CylinderTool{0, 1}),
          ToolShape(CylinderTool{1, -1}), ToolShape(CylinderTool{nan, 1}), ToolShape(CylinderTool{1, inf}),
          ToolShape(CylinderTool{1e3, 1}), ToolShape(ConeTool{0, 0, 1}), ToolShape(ConeTool{-1, 1, 1}),
          ToolShape(ConeTool{0, 1, 0}), ToolShape(ConeTool{nan, 1, 1}), ToolShape(BullNoseTool{0.1, 0.2, 1}),
          ToolShape(BullNoseTool{0.1, 0, 1}), ToolShape(BullNoseTool{0.1, 0.05, 0.01}),
          ToolShape(BoxTool{Vec3(0.1, 0, 0.1)}), ToolShape(BoxTool{Vec3(0.1, nan, 0.1)}), ToolShape(BoxTool{Vec3(1e5)}),
          ToolShape(MeshTool{nullptr}), ToolShape(MeshTool{std::make_shared<geometry::TriangleMesh>()})}) {
        bad.push_back(good);
        bad.back().shape = shape;
    }
    const auto also = [&](auto change) {
        bad.push_back(good);
        change(bad.back());
    };
    also([&](ToolSweep& s) { s.start.position_m.x = nan; });
    also([&](ToolSweep& s) { s.end.position_m.y = inf; });
    also([&](ToolSweep& s) { s.end.position_m.y = 1e300; });
    also([&](ToolSweep& s) { s.start.orientation = Quat(0, 0, 0, 0); });
    also([&](ToolSweep& s) { s.end.orientation.x = nan; });
    also([&](ToolSweep& s) { s.tolerance_cells = 0; });
    also([&](ToolSweep& s) { s.tolerance_cells = nan; });
    also([&](ToolSweep& s) { s.material = 1; });
    also([&](ToolSweep& s) {  // half a turn of a tool of 2000 cells, to a thousandth of a cell
        s.shape = BoxTool{Vec3(30.0)};
        s.end.orientation = Quat(0, 0, 1, 0);
        s.tolerance_cells = 0.001;
    });
    EXPECT_TRUE(check_sweep(solid, good));
    for (std::size_t i = 0; i < bad.size(); ++i) {
        const auto checked = check_sweep(solid, bad[i]);
        const auto spans = tool_spans(solid, bad[i], span_pool());
        ASSERT_FALSE(checked.has_value()) << i;
        ASSERT_FALSE(spans.has_value()) << i;
        EXPECT_EQ(checked.error().line(), spans.error().line()) << i;
        EXPECT_FALSE(checked.error().remedy.empty()) << i;
    }
}

TEST(Turned, IsEvenTurningAboutOneAxis) {
    Random random(14);
    for (int i = 0; i < 2000; ++i) {
        ToolSweep sweep;
        sweep.start.orientation = any_orientation(random);
        sweep.end.orientation = any_orientation(random);
        const double share = random.chance(0.1) ? random.small(0, 4) / 4.0 : random.unit();
        const Quat expected = pose_at(sweep, share).orientation,
                   found = turned(sweep.start.orientation, sweep.end.orientation, share);
        EXPECT_GT(std::abs(glm::dot(expected, found)), 1.0 - 1e-12);
    }
}

}  // namespace burin::compute::test
