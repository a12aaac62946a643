// SPDX-License-Identifier: MIT
// What leaves out sections of rays with pieces (compute/tools/ray_union.hpp) against the union of all sections.
#include "compute/tools/ray_union.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "compute/rays/lattice.hpp"
#include "compute/rays/normal_code.hpp"
#include "compute/rays/set_algebra.hpp"
#include "compute/tools/tool_spans.hpp"
#include "tests/compute/tool_reference.hpp"

namespace burin::compute::test {
namespace {

constexpr double kCell = shared::kUnitsPerCell;

WorkerPool& union_pool() {
    static WorkerPool two(2);
    return two;
}

// The union of all sections of a ray: of those with the least lo and the greatest hi the first decides the normals.
void append_all_sections(const ConvexPieces& sweep, const std::vector<Box>& boxes, const RayPlace& place, int deepest,
                         std::vector<shared::DexelEnd>& ends) {
    const double u = place.u * kCell, v = place.v * kCell;
    std::vector<SweepSpan> spans;
    for (std::size_t i = 0; i < sweep.pieces.size(); ++i) {
        const Box& box = boxes[i];
        const int along_u = (place.axis + 1) % 3, along_v = (place.axis + 2) % 3;
        if (u < box.lo[along_u] - kCell || u > box.hi[along_u] + kCell || v < box.lo[along_v] - kCell ||
            v > box.hi[along_v] + kCell) {
            continue;
        }
        const SweepSpan span = span_of(sweep.pieces[i], place.axis, u, v);
        if (!is_empty(span)) spans.push_back(span);
    }
    std::ranges::stable_sort(spans, {}, &SweepSpan::lo);
    Vec3 e(0.0);
    e[place.axis] = 1.0;
    for (std::size_t i = 0; i < spans.size();) {
        SweepSpan whole = spans[i++];
        for (; i < spans.size() && std::ceil(spans[i].lo) <= std::floor(whole.hi) + 1.0; ++i) {
            if (spans[i].hi > whole.hi) whole.hi = spans[i].hi, whole.normal_hi = spans[i].normal_hi;
        }
        if (whole.lo < 0.0) whole.lo = 0.0, whole.normal_lo = -e;
        if (whole.hi > deepest) whole.hi = deepest, whole.normal_hi = e;
        const double lo = std::ceil(whole.lo), hi = std::floor(whole.hi);
        if (!(lo < hi)) continue;
        ends.push_back(shared::make_end(static_cast<int>(lo), 0, normal_code(whole.normal_lo)));
        ends.push_back(shared::make_end(static_cast<int>(hi), 0, normal_code(whole.normal_hi)));
    }
}

std::map<std::uint32_t, std::vector<shared::DexelEnd>> union_of_all(const Lattice& lattice, const ConvexPieces& sweep) {
    std::map<std::uint32_t, std::vector<shared::DexelEnd>> rays;
    std::vector<Box> boxes;
    Box whole;
    for (const ConvexPiece& piece : sweep.pieces) {
        boxes.push_back(bounds_of(piece));
        whole.include(boxes.back().lo);
        whole.include(boxes.back().hi);
    }
    std::vector<shared::DexelEnd> ends;
    for (int axis = 0; axis < 3; ++axis) {
        const auto first = [&](int a) {
            return static_cast<int>(std::max(0.0, std::floor(whole.lo[a] / kCell) - 1.0));
        };
        const auto last = [&](int a, int rays) {
            return static_cast<int>(std::min(rays - 1.0, std::ceil(whole.hi[a] / kCell) + 1.0));
        };
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const int deepest = lattice.cells[static_cast<std::size_t>(axis)] * shared::kUnitsPerCell;
        RayPlace place{axis, 0, 0};
        for (place.v = first(v); place.v <= last(v, lattice.rays_v(axis)); ++place.v) {
            for (place.u = first(u); place.u <= last(u, lattice.rays_u(axis)); ++place.u) {
                ends.clear();
                append_all_sections(sweep, boxes, place, deepest, ends);
                if (!ends.empty()) rays.emplace(place.code(), ends);
            }
        }
    }
    return rays;
}

testing::AssertionResult is_union_of_all(const Lattice& lattice, const ConvexPieces& sweep) {
    const RayBatch batch = convex_spans(lattice, sweep, 0, union_pool()).batch;
    const auto all = union_of_all(lattice, sweep);
    if (batch.rays.size() != all.size())
        return testing::AssertionFailure() << batch.rays.size() << " rays in place of " << all.size();
    for (const RayBatch::Ray& ray : batch.rays) {
        const auto found = all.find(ray.code);
        if (found != all.end() && same_ends(batch.ends_of(ray), found->second)) continue;
        const RayPlace place = place_of(ray.code);
        return testing::AssertionFailure()
               << "other ends on axis " << place.axis << ", u " << place.u << ", v " << place.v;
    }
    return testing::AssertionSuccess();
}

// A sweep of a tool of this kind: a stamp, a straight one or one that turns, as often about an axis of the lattice as
// about any.
ToolSweep any_sweep_of(Random& random, int kind, double lo_m, double hi_m) {
    ToolSweep sweep;
    sweep.shape = any_shape(random, lo_m, hi_m, kind);
    const auto anywhere = [&] {
        return Vec3(random.between(-0.05, 1.05), random.between(-0.05, 1.05), random.between(-0.05, 1.05));
    };
    const auto orientation = [&] { return random.chance(0.3) ? Quat(1.0, 0.0, 0.0, 0.0) : any_orientation(random); };
    sweep.start = {anywhere(), orientation()};
    sweep.end = sweep.start;
    if (random.chance(0.7)) {
        const double far = random.chance(0.5) ? hi_m : 5.0 * hi_m;
        for (int a = 0; a < 3; ++a) {
            if (random.chance(0.8)) sweep.end.position_m[a] += random.between(-far, far);
        }
    }
    if (random.chance(0.3)) return sweep;
    const double angle = random.chance(0.7) ? random.between(0.0, 0.4) : random.between(0.0, 3.0);
    Vec3 about(0.0);
    about[random.small(0, 2)] = 1.0;
    if (random.chance(0.5)) about = any_orientation(random) * about;
    sweep.end.orientation = glm::angleAxis(angle, about) * sweep.start.orientation;
    return sweep;
}

}  // namespace

TEST(RayUnion, IsTheUnionOfAllSections) {
    // BURIN_SOAK_SWEEPS=20000 in the environment for the long form.
    const char* soak = std::getenv("BURIN_SOAK_SWEEPS");
    const int sweeps = soak != nullptr ? std::atoi(soak) : repeated(120);
    Random random(61);
    for (int i = 0; i < sweeps; ++i) {
        const int kind = 1 + i % (kDrawnKinds - 1);  // not the ball, whose spans are whole numbers
        const int resolution = random.small(48, 256);
        const double cell_m = 1.0 / resolution;
        const Lattice lattice{Vec3(0.0), cell_m, {resolution, resolution, resolution}};
        ToolSweep sweep =
            any_sweep_of(random, kind, random.between(0.2, 3.0) * cell_m, random.between(3.0, 20.0) * cell_m);
        sweep.tolerance_cells = random.chance(0.5) ? 0.1 : random.between(0.02, 0.5);
        const auto pieces = convex_pieces(lattice, sweep);
        ASSERT_TRUE(pieces) << pieces.error().line();
        if (pieces->pieces.size() > 2000) continue;
        ASSERT_TRUE(is_union_of_all(lattice, *pieces)) << "sweep " << i << ", tool " << kind << ", N " << resolution;
    }
}

namespace {

// Returns the ends, whole units, of what boxes with given extents along x cover of a ray through their middles.
std::vector<int> joined_depths(const std::vector<Vec2>& extents) {
    const Lattice lattice{Vec3(0.0), 1.0 / 32, {32, 32, 32}};
    ConvexPieces sweep;
    for (const Vec2& x : extents) {
        const Vec3 half(0.5 * (x.y - x.x), 5000.0, 5000.0), middle(0.5 * (x.x + x.y), 10 * kCell, 10 * kCell);
        sweep.pieces.emplace_back(BoxSweep(half, middle, Quat(1.0, 0.0, 0.0, 0.0), Vec3(0.0)));
    }
    const RayBatch batch = convex_spans(lattice, sweep, 0, union_pool()).batch;
    std::vector<int> depths;
    for (const RayBatch::Ray& ray : batch.rays) {
        if (ray.code != shared::ray_code(0, 10, 10)) continue;
        for (const shared::DexelEnd& end : batch.ends_of(ray)) depths.push_back(depth_of(end));
    }
    return depths;
}

}  // namespace

TEST(RayUnion, MovesJoinWhereNoWholeDepthIsBetweenThem) {
    using Depths = std::vector<int>;
    EXPECT_EQ(joined_depths({{4096.5, 8000.5}, {8001.0, 9000.5}}), Depths({4097, 9000}));
    EXPECT_EQ(joined_depths({{8001.5, 9000.5}, {4096.5, 8000.5}}), Depths({4097, 8000, 8002, 9000}));
    // The one in between touches both that were apart.
    EXPECT_EQ(joined_depths({{4096.5, 6000.5}, {8000.5, 9000.5}, {6000.75, 8000.25}}), Depths({4097, 9000}));
    EXPECT_EQ(joined_depths({{4096.5, 9000.5}, {5000.5, 6000.5}}), Depths({4097, 9000}));
}

namespace {

// A bull-nose of 20 cells on a way of 4 cells, at N = 512.
ToolSweep fine_sweep(const Lattice& lattice, double turn_rad) {
    const double cell_m = lattice.spacing_m;
    ToolSweep sweep;
    sweep.shape = BullNoseTool{20.0 * cell_m, 4.0 * cell_m, 30.0 * cell_m};
    const Quat aslant = glm::angleAxis(0.5, glm::normalize(Vec3(1.0, 0.3, 0.2)));
    sweep.start = {Vec3(0.5), aslant};
    sweep.end = {Vec3(0.5) + cell_m * Vec3(4.0, 1.2, 0.0),
                 glm::angleAxis(turn_rad, glm::normalize(Vec3(0.2, 0.1, 1.0))) * aslant};
    return sweep;
}

}  // namespace

TEST(RayUnion, ABullNoseThatTurnsTakesAtMostThreeTimesTheSectionsOfAStraightOne) {
    const Lattice lattice{Vec3(0.0), 1.0 / 512, {512, 512, 512}};
    const auto straight = convex_pieces(lattice, fine_sweep(lattice, 0.0));
    const auto turning = convex_pieces(lattice, fine_sweep(lattice, 0.1));
    ASSERT_TRUE(straight && turning);
    ASSERT_GE(turning->pieces.size(), 15 * straight->pieces.size());
    const ConvexSpans of_straight = convex_spans(lattice, *straight, 0, union_pool());
    const ConvexSpans of_turning = convex_spans(lattice, *turning, 0, union_pool());
    EXPECT_LE(of_turning.sections, 3 * of_straight.sections);
    EXPECT_LE(of_turning.sections, 10 * of_turning.batch.rays.size()) << "of " << turning->pieces.size() << " pieces";
}

}  // namespace burin::compute::test
