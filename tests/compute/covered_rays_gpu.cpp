// SPDX-License-Identifier: MIT
// What convex tools cover of rays: the device's ends are the processor's, to the bit.
#include "compute/vulkan/covered_rays.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/try.hpp"
#include "compute/rays/set_algebra.hpp"
#include "compute/tools/tool_spans.hpp"
#include "tests/compute/tool_reference.hpp"
#include "tests/compute/vulkan_engine_fixture.hpp"
#include "tests/compute/whole_buffers.hpp"

namespace burin::compute::test {
namespace {

using EndsByRay = std::map<std::uint32_t, std::vector<shared::DexelEnd>>;

constexpr std::uint8_t kLeft = 3;  // the material of the ends

class CoveredRaysGpu : public VulkanEngineGpu {
protected:
    WorkerPool pool_{2};

    EndsByRay on_processor(const Lattice& lattice, const ConvexPieces& sweep) {
        EndsByRay rays;
        const RayBatch batch = convex_spans(lattice, sweep, kLeft, pool_).batch;
        for (const RayBatch::Ray& ray : batch.rays) {
            const auto ends = batch.ends_of(ray);
            rays.emplace(ray.code, std::vector(ends.begin(), ends.end()));
        }
        return rays;
    }

    // Runs what was prepared, and returns what was counted.
    Result<shared::CoverCounters> run(CoveredRays& covered) {
        BURIN_TRY(commands, gpu::Commands::begin(device()));
        covered.record(commands);
        covered.fetch_counters(commands);
        BURIN_TRY(submission, std::move(commands).submit());
        BURIN_TRY_DO(submission.wait());
        return covered.counted();
    }

    // Reads the ends of the rays that are covered. Each ray comes once, its spans ascend and do not touch.
    EndsByRay ends_in(const gpu::Buffer& ray_buffer, std::uint32_t ray_count, const gpu::Buffer& span_buffer,
                      std::uint32_t span_count) {
        EndsByRay rays;
        const auto of_rays = read_buffer<shared::CoveredRay>(device(), ray_buffer, ray_count);
        const auto spans = read_buffer<shared::CoveredSpan>(device(), span_buffer, span_count);
        if (!of_rays || !spans) {
            ADD_FAILURE() << (!of_rays ? of_rays.error() : spans.error()).line();
            return rays;
        }
        for (const shared::CoveredRay& ray : *of_rays) {
            if (ray.count == 0) continue;
            std::vector<shared::DexelEnd>& ends = rays[ray.ray];
            EXPECT_TRUE(ends.empty()) << "a ray twice";
            for (std::uint32_t i = ray.first; i < ray.first + ray.count; ++i) {
                const shared::CoveredSpan& span = (*spans)[i];
                EXPECT_TRUE(span.lo < span.hi && (ends.empty() || depth_of(ends.back()) < span.lo));
                ends.push_back(shared::make_end(span.lo, kLeft, span.normal_lo));
                ends.push_back(shared::make_end(span.hi, kLeft, span.normal_hi));
            }
        }
        return rays;
    }

    EndsByRay ends_in(const CoveredRays& covered, const shared::CoverCounters& counters) {
        return ends_in(covered.rays(), covered.ray_count(), covered.spans(), counters.spans);
    }

    // Computes a sweep on the device, with as much space as it takes; nothing where it is left to the processor.
    std::optional<EndsByRay> on_device(CoveredRays& covered) {
        for (int turn = 0; turn < 2; ++turn) {
            const auto counters = run(covered);
            EXPECT_TRUE(counters) << counters.error().line();
            if (!counters || counters->overfull > 0) return {};
            if (is_complete(*counters)) return ends_in(covered, *counters);
            EXPECT_TRUE(covered.make_room(*counters).value_or(false));
        }
        ADD_FAILURE() << "there is no space for the spans";
        return {};
    }
};

// Counts the ends that two results hold and that differ; a ray that only one of them has differs in all its ends.
struct EndsCompared {
    std::size_t ends = 0, differ = 0;
    std::string first;  // ray that differs
};

EndsCompared compared(const EndsByRay& actual, const EndsByRay& expected) {
    EndsCompared sum;
    const auto add_ray = [&](std::uint32_t code, const auto& a, const auto& b) {
        const std::size_t longer = std::max(a.size(), b.size()), before = sum.differ;
        for (std::size_t i = 0; i < longer; ++i) {
            const bool is_same = i < a.size() && i < b.size() && same_ends(RayEnds(&a[i], 1), RayEnds(&b[i], 1));
            sum.differ += is_same ? 0 : 1;
        }
        if (sum.differ > before && sum.first.empty()) {
            const RayPlace place = place_of(code);
            sum.first = "axis " + std::to_string(place.axis) + ", u " + std::to_string(place.u) + ", v " +
                        std::to_string(place.v);
        }
    };
    const std::vector<shared::DexelEnd> none;
    for (const auto& [code, ends] : expected) {
        sum.ends += ends.size();
        const auto found = actual.find(code);
        add_ray(code, found == actual.end() ? none : found->second, ends);
    }
    for (const auto& [code, ends] : actual)
        if (!expected.contains(code)) add_ray(code, ends, none);
    return sum;
}

Lattice cube_lattice(int cells) { return {Vec3(0.0), 1.0 / cells, {cells, cells, cells}}; }

// Of the unit cube or a part of it.
Lattice any_lattice(Random& random, int cells) {
    Lattice lattice = cube_lattice(cells);
    if (random.chance(0.5)) {
        for (int& along : lattice.cells) along = random.small(cells / 3, cells);
    }
    return lattice;
}

// A tool of one of the four kinds, of `size` metres: degenerate ones among them.
ToolShape any_convex_shape(Random& random, int kind, double size) {
    switch (kind) {
        case 0: return CylinderTool{size, size * random.between(0.5, 3.0)};
        case 1: {
            const double tip = random.chance(0.3) ? 0.0 : size * random.unit();
            const double length = size * random.between(0.5, 3.0);
            return random.chance(0.7) ? ConeTool{tip, size, length} : ConeTool{size, tip, length};
        }
        case 2: {
            const double corner = random.chance(0.3) ? size : size * random.between(0.05, 1.0);
            return BullNoseTool{size, corner, random.chance(0.2) ? corner : corner + size * random.between(0.0, 2.0)};
        }
        default:
            return BoxTool{Vec3(size * random.between(0.1, 1.0), size * random.between(0.1, 1.0),
                                size * random.between(0.1, 1.0))};
    }
}

// From a millionth of a cell to more than the lattice, mostly some cells.
double any_size_m(Random& random, double cell_m) {
    if (random.chance(0.03)) return cell_m * std::pow(10.0, random.between(-6.0, -1.0));
    if (random.chance(0.02)) return cell_m * random.between(200.0, 1200.0);
    return cell_m * std::pow(2.0, random.between(-1.0, 4.5));
}

// A stamp, a straight move or one that turns; some of them along the lattice with faces on its planes, or far outside.
ToolSweep any_convex_sweep(Random& random, int kind, const Lattice& lattice) {
    const double cell_m = lattice.spacing_m, size = any_size_m(random, cell_m);
    const bool on_nodes = random.chance(0.2);
    const auto snapped = [&](double x) { return on_nodes ? std::round(x / cell_m) * cell_m : x; };
    ToolSweep sweep;
    sweep.shape = any_convex_shape(random, kind, on_nodes ? snapped(size) + cell_m : size);
    Vec3 at = random_point(random, -0.1, 1.1);
    if (on_nodes) at = Vec3(snapped(at.x), snapped(at.y), snapped(at.z));
    if (random.chance(0.03)) at += 1e4 * random_point(random, -1.0, 1.0);
    const Quat from = on_nodes || random.chance(0.2) ? Quat(1.0, 0.0, 0.0, 0.0) : any_orientation(random);
    sweep.start = sweep.end = {at, from};
    sweep.tolerance_cells = random.chance(0.5) ? 0.1 : random.between(0.02, 0.5);
    const double way = size * random.between(0.01, 2.0);
    const int motion = random.small(0, 9);
    if (motion >= 2) sweep.end.position_m += way * random_point(random, -1.0, 1.0);
    if (motion == 3) sweep.end.position_m = at + Vec3(way, 0.0, 0.0);
    if (motion == 4) sweep.end.position_m = at + from * Vec3(0.0, way, 0.0);
    if (motion == 5) sweep.end.position_m = at + from * Vec3(way, 0.0, 0.0);
    if (motion >= 7) {
        const double turn = random.chance(0.7) ? 0.05 : 0.8;
        const auto off = [&] { return random.between(-turn, turn); };
        sweep.end.orientation = glm::normalize(from + Quat(off(), off(), off(), off()));
    }
    return sweep;
}

// Turning is cut into straight moves; more pieces than this take a software device too long.
constexpr std::size_t kMostTestPieces = 600;

}  // namespace

// BURIN_SOAK_ENDS=1000000 in the environment for the long form.
TEST_F(CoveredRaysGpu, EveryEndIsThatOfTheProcessor) {
    const char* soak = std::getenv("BURIN_SOAK_ENDS");
    const std::size_t wanted =
        soak != nullptr ? std::strtoull(soak, nullptr, 10) : static_cast<std::size_t>(repeated(200'000));
    auto covered = CoveredRays::create(device());
    ASSERT_TRUE(covered) << covered.error().line();
    Random random(4711);
    std::size_t ends = 0, differ = 0, sweeps = 0, refused = 0;
    std::size_t of_kind[4] = {};
    // Until there are enough of each tool; the limit is a guard against a tool that covers nothing.
    const auto of_rarest = [&] { return *std::ranges::min_element(of_kind); };
    for (int i = 0; (ends < wanted || of_rarest() <= wanted / 40) && i < 1'000'000; ++i) {
        const int cells[] = {24, 40, 64, 128, 256};
        const Lattice lattice = any_lattice(random, cells[random.small(0, soak != nullptr ? 4 : 3)]);
        const ToolSweep sweep = any_convex_sweep(random, i % 4, lattice);
        const auto pieces = convex_pieces(lattice, sweep);
        if (!pieces || pieces->pieces.size() > kMostTestPieces) continue;
        const auto prepared = covered->prepare(lattice, *pieces);
        ASSERT_TRUE(prepared) << prepared.error().line();
        if (!*prepared) {
            ++refused;
            continue;
        }
        const auto found = on_device(*covered);
        if (!found) {
            ++refused;
            continue;
        }
        const EndsCompared sum = compared(*found, on_processor(lattice, *pieces));
        EXPECT_EQ(sum.differ, 0u) << "sweep " << i << ", " << sum.first;
        ends += sum.ends;
        differ += sum.differ;
        of_kind[i % 4] += sum.ends;
        ++sweeps;
    }
    RecordProperty("ends", std::to_string(ends));
    if (soak != nullptr) {
        std::cout << sweeps << " sweeps, " << refused << " refused; ends of cylinders " << of_kind[0] << ", cones "
                  << of_kind[1] << ", bull-noses " << of_kind[2] << ", boxes " << of_kind[3] << "; " << differ << " of "
                  << ends << " differ\n";
    }
    EXPECT_GT(of_rarest(), wanted / 40);
    EXPECT_LE(refused, sweeps / 20) << "tools thinner than the steps of their turn leave many parts";
}

// The largest tools that check_sweep accepts measure 4096 cells from their middle.
TEST_F(CoveredRaysGpu, ToolsAtTheBoundsOfWhatIsAccepted) {
    auto covered = CoveredRays::create(device());
    ASSERT_TRUE(covered) << covered.error().line();
    const Lattice lattice = cube_lattice(24);
    const double cell_m = lattice.spacing_m;
    Random random(3);
    for (int i = 0; i < repeated(32); ++i) {
        const double huge = cell_m * random.between(1500.0, 2500.0), tiny = cell_m * random.between(0.001, 1.0);
        const double a = random.chance(0.5) ? huge : tiny, b = random.chance(0.5) ? huge : tiny;
        const ToolShape shapes[] = {CylinderTool{a, b}, ConeTool{0.0, a, b}, BullNoseTool{huge, std::min(a, b), huge},
                                    BoxTool{Vec3(a, b, random.chance(0.5) ? huge : tiny)}};
        ToolSweep sweep;
        sweep.shape = shapes[i % 4];
        sweep.tolerance_cells = 0.5;
        sweep.start.orientation = any_orientation(random);
        sweep.start.position_m = Vec3(0.5) + sweep.start.orientation * Vec3(0.0, -random.unit() * b, 0.0);
        sweep.end = sweep.start;
        if (random.chance(0.6)) sweep.end.position_m += huge * random_point(random, -1.0, 1.0);
        const auto pieces = convex_pieces(lattice, sweep);
        ASSERT_TRUE(pieces) << pieces.error().line();
        const auto prepared = covered->prepare(lattice, *pieces);
        ASSERT_TRUE(prepared && *prepared);
        const EndsCompared sum = compared(on_device(*covered).value(), on_processor(lattice, *pieces));
        EXPECT_EQ(sum.differ, 0u) << "sweep " << i << ", " << sum.first;
    }
}

TEST_F(CoveredRaysGpu, SpansWithoutSpaceAreCountedAndFoundAgain) {
    auto covered = CoveredRays::create(device(), {.spans_a_ray = 0});
    ASSERT_TRUE(covered) << covered.error().line();
    const Lattice lattice = cube_lattice(32);
    const ToolSweep sweep{CylinderTool{0.2, 0.4}, Pose{Vec3(0.5)}, Pose{Vec3(0.6)}};
    const auto pieces = convex_pieces(lattice, sweep);
    ASSERT_TRUE(pieces && *covered->prepare(lattice, *pieces));
    const EndsByRay expected = on_processor(lattice, *pieces);
    const auto counters = run(*covered);
    ASSERT_TRUE(counters);
    EXPECT_FALSE(is_complete(*counters));
    EXPECT_EQ(counters->spans, expected.size());
    EXPECT_GT(counters->unplaced, expected.size() / 2);
    ASSERT_TRUE(*covered->make_room(*counters));
    const auto again = run(*covered);
    ASSERT_TRUE(again && is_complete(*again));
    EXPECT_EQ(compared(ends_in(*covered, *again), expected).differ, 0u);
}

// Rounding may leave a gap between two slices of one move. They are one part all the same, and so on the processor.
TEST_F(CoveredRaysGpu, SlicesOfOneMoveAreOnePart) {
    auto covered = CoveredRays::create(device());
    ASSERT_TRUE(covered) << covered.error().line();
    const Lattice lattice = cube_lattice(32);
    const auto slice = [](double from, double to) {
        return FrustumSweep({9000.0, 9000.0, to - from}, Vec3(60000.0, from, 60000.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0));
    };
    ConvexPieces one_move{{slice(20000.25, 30000.5), slice(30003.5, 40003.75)}, 2}, two_moves = one_move;
    two_moves.a_move = 1;
    for (const auto& [sweep, parts] : {std::pair(&one_move, 1u), std::pair(&two_moves, 2u)}) {
        ASSERT_TRUE(*covered->prepare(lattice, *sweep));
        const EndsByRay expected = on_processor(lattice, *sweep), found = on_device(*covered).value();
        EXPECT_EQ(compared(found, expected).differ, 0u);
        const auto ray = found.find(shared::ray_code(1, 15, 15));
        ASSERT_NE(ray, found.end());
        EXPECT_EQ(ray->second.size(), 2 * parts);
    }
}

TEST_F(CoveredRaysGpu, ARayInTooManyPartsIsCounted) {
    auto covered = CoveredRays::create(device());
    ASSERT_TRUE(covered) << covered.error().line();
    const Lattice lattice = cube_lattice(64);
    const auto boxes = [](int count) {  // in a row along x, each a move of its own, the last in between first
        ConvexPieces sweep;
        for (int i = 0; i < count; ++i) {
            const double x = 4096.0 * (2.0 + 3.0 * ((i * 7) % count));
            sweep.pieces.emplace_back(
                BoxSweep(Vec3(4096.0), Vec3(x, 4096.0 * 20.3, 4096.0 * 20.3), Quat(1, 0, 0, 0), Vec3(0.0)));
        }
        return sweep;
    };
    const ConvexPieces enough = boxes(shared::kMostParts), too_many = boxes(shared::kMostParts + 1);
    ASSERT_TRUE(*covered->prepare(lattice, enough));
    EXPECT_EQ(compared(on_device(*covered).value(), on_processor(lattice, enough)).differ, 0u);
    ASSERT_TRUE(*covered->prepare(lattice, too_many));
    const auto counters = run(*covered);
    ASSERT_TRUE(counters);
    EXPECT_EQ(counters->overfull, 4u) << "the rays along the row";
    EXPECT_FALSE(is_complete(*counters));
    EXPECT_FALSE(*covered->make_room(*counters));
}

TEST_F(CoveredRaysGpu, WhatWouldTakeTooLongIsLeftToTheProcessor) {
    auto covered = CoveredRays::create(device());
    ASSERT_TRUE(covered) << covered.error().line();
    const BoxSweep box(Vec3(9e5), Vec3(5e5), Quat(1, 0, 0, 0), Vec3(0.0));  // over all of the lattice
    ConvexPieces many;
    many.pieces.assign(shared::kMostCoverPieces + 1, box);
    EXPECT_FALSE(*covered->prepare(cube_lattice(8), many));
    EXPECT_EQ(covered->ray_count(), 0u);
    many.pieces.pop_back();
    EXPECT_TRUE(*covered->prepare(cube_lattice(8), many));
    EXPECT_EQ(covered->ray_count(), 3u * 9u * 9u);
    EXPECT_FALSE(*covered->prepare(cube_lattice(256), many)) << "too many sections";
    capabilities().max_storage_buffer_bytes = 100 * sizeof(shared::CoveredSpan);
    EXPECT_FALSE(*covered->prepare(cube_lattice(8), many)) << "more rays than a buffer holds";
}

// The most turns of loops that a sweep can take: a software driver would end them silently if they were too many.
TEST_F(CoveredRaysGpu, TheMostPiecesInTheMostPartsAreAllLookedAt) {
    auto covered = CoveredRays::create(device());
    ASSERT_TRUE(covered) << covered.error().line();
    const Lattice lattice = cube_lattice(64);
    ConvexPieces sweep;
    for (int i = 0; i < shared::kMostCoverPieces; ++i) {  // each wider than the one before at its place
        const double x = 4096.0 * (2.0 + 3.0 * (i % shared::kMostParts)), half = 2000.0 + i;
        sweep.pieces.emplace_back(
            BoxSweep(Vec3(half, 4096.0, 4096.0), Vec3(x, 83000.0, 83000.0), Quat(1, 0, 0, 0), Vec3(0.0)));
    }
    ASSERT_TRUE(*covered->prepare(lattice, sweep));
    const EndsCompared sum = compared(on_device(*covered).value(), on_processor(lattice, sweep));
    EXPECT_EQ(sum.differ, 0u) << sum.first;
    EXPECT_GT(sum.ends, 2u * shared::kMostParts);
}

// Several sweeps in one submission: what consumes the spans of one comes before the next, whose buffers may be others.
TEST_F(CoveredRaysGpu, SweepsFollowEachOtherInTheSameCommands) {
    auto covered = CoveredRays::create(device());
    ASSERT_TRUE(covered) << covered.error().line();
    const Lattice lattice = cube_lattice(48);
    struct Kept {
        gpu::Buffer rays, spans;
        std::uint32_t ray_count = 0;
        EndsByRay expected;
    };
    std::vector<Kept> all;
    auto commands = gpu::Commands::begin(device());
    ASSERT_TRUE(commands);
    for (const double radius : {0.05, 0.3, 0.1}) {
        const ToolSweep sweep{CylinderTool{radius, 0.3}, Pose{Vec3(0.4)}, Pose{Vec3(0.6, 0.4, 0.5)}};
        const auto pieces = convex_pieces(lattice, sweep);
        ASSERT_TRUE(pieces && *covered->prepare(lattice, *pieces));
        covered->record(*commands);
        Kept& kept = all.emplace_back();
        kept.ray_count = covered->ray_count();
        kept.expected = on_processor(lattice, *pieces);
        const std::uint64_t ray_bytes = kept.ray_count * sizeof(shared::CoveredRay),
                            span_bytes = kept.ray_count * sizeof(shared::CoveredSpan);
        ASSERT_TRUE(create_into(kept.rays, device(), gpu::BufferUse::device_storage, ray_bytes, "rays kept"));
        ASSERT_TRUE(create_into(kept.spans, device(), gpu::BufferUse::device_storage, span_bytes, "spans kept"));
        commands->copy(covered->rays(), 0, kept.rays, 0, ray_bytes);
        commands->copy(covered->spans(), 0, kept.spans, 0, span_bytes);
    }
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission && submission->wait());
    for (const Kept& kept : all) {
        const EndsByRay actual = ends_in(kept.rays, kept.ray_count, kept.spans, kept.ray_count);
        EXPECT_EQ(compared(actual, kept.expected).differ, 0u);
        EXPECT_FALSE(kept.expected.empty());
    }
}

TEST_F(CoveredRaysGpu, ASweepBesideTheLatticeCoversNothing) {
    auto covered = CoveredRays::create(device());
    ASSERT_TRUE(covered) << covered.error().line();
    ASSERT_TRUE(*covered->prepare(cube_lattice(16), ConvexPieces{}));
    EXPECT_EQ(covered->ray_count(), 0u);
    const auto counters = run(*covered);
    ASSERT_TRUE(counters);
    EXPECT_TRUE(is_complete(*counters));
    EXPECT_EQ(counters->spans, 0u);
}

TEST_F(CoveredRaysGpu, ADeviceThatRoundsOtherwiseIsRefused) {
    EXPECT_TRUE(check_rounding(device(), hard_roundings()));
    for (double shared::RoundedDoubles::* const part :
         {&shared::RoundedDoubles::quotient, &shared::RoundedDoubles::root, &shared::RoundedDoubles::product,
          &shared::RoundedDoubles::sum}) {
        std::vector<CheckedRounding> cases = hard_roundings();
        double& value = cases[1234].rounded.*part;
        value = std::nextafter(value, 0.0);
        const auto refused = CoveredRays::create(device(), {.roundings = cases});
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().what.find("rounds doubles otherwise"), std::string::npos);
        EXPECT_NE(refused.error().remedy.find("processor"), std::string::npos);
    }
    capabilities().shader_float64 = false;
    EXPECT_FALSE(CoveredRays::create(device()));
}

}  // namespace burin::compute::test
