// SPDX-License-Identifier: MIT
// The Vulkan engine against the CPU engine: the same ends on every ray, to the last bit, and the same counts.
#include "compute/vulkan_engine.hpp"

#include <algorithm>
#include <limits>

#include "compute/surface.hpp"
#include "gpu/core.hpp"
#include "tests/compute/effort.hpp"
#include "tests/compute/engine_pair.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::test {
namespace {

class VulkanEngineGpu : public gpu::DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (IsSkipped()) return;
        const gpu::Capabilities& can = device().capabilities();
        if (!can.shader_int64 || !can.shader_float64) {
            GTEST_SKIP() << device().info().name << " has no 64-bit integers or no doubles in shaders";
        }
    }
    // To play a lesser device.
    gpu::Capabilities& capabilities() { return device().core()->capabilities; }
};

Vec3 random_point(Random& random, double lo, double hi) {
    return {random.between(lo, hi), random.between(lo, hi), random.between(lo, hi)};
}

// Radii of all sizes, from a fraction of a cell to more than the solid; mostly short moves, some through everything.
BallSweep random_sweep(Random& random, double spacing_m) {
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

// Rays with up to `most_plates` plates each, half of them with just so many, so that a power of two leaves no room for more.
// All rays are different; the three axes need not fit together for an engine.
Solid plates(int resolution, int most_plates, std::uint64_t seed) {
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
RayBatch random_rays(const Lattice& lattice, int count, Random& random) {
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
RayBatch as_before(const Changes& changes) {
    RayBatch batch;
    std::vector<std::uint32_t> seen;
    for (const shared::ChangedRay& ray : changes.rays) {
        if (std::ranges::find(seen, ray.ray) != seen.end()) continue;
        seen.push_back(ray.ray);
        batch.add(ray.ray, changes.before_of(ray));
    }
    return batch;
}

}  // namespace

TEST_F(VulkanEngineGpu, ABallAndACapsuleTakeTheSameEnds) {
    EnginePair engines(unit_cube(64), device());
    EXPECT_TRUE(engines.cut({Vec3(0.5, 0.5, 0.9), Vec3(0.5, 0.5, 0.9), 0.2, 1}));
    EXPECT_TRUE(engines.cut({Vec3(0.1, 0.2, 0.8), Vec3(0.9, 0.7, 1.1), 0.13, 0}));
    EXPECT_GT(engines.changed(), 1000u);
    EXPECT_TRUE(well_formed(engines.vulkan().solid()));
}

TEST_F(VulkanEngineGpu, EqualsTheCpuEngineOnRandomBatches) {
    for (int round = 0; round < repeated(32); ++round) {
        Random random(static_cast<std::uint64_t>(round));
        const Solid solid = unit_cube(random.small(16, 48));
        EnginePair engines(solid, device());
        for (int batch = 0; batch < 6; ++batch) {
            std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, random.chance(0.2) ? 150 : 8)));
            for (BallSweep& sweep : sweeps) sweep = random_sweep(random, solid.lattice.spacing_m);
            ASSERT_TRUE(engines.cut(sweeps)) << "round " << round << " batch " << batch;
        }
    }
}

TEST_F(VulkanEngineGpu, EqualsTheCpuEngineOnStroke1000OneBallAtATime) {
    EnginePair engines(unit_cube(128), device());
    for (const BallSweep& sweep : stroke_1000(kSanitized ? 16 : 1)) ASSERT_TRUE(engines.cut(sweep));
    EXPECT_GT(engines.changed(), kSanitized ? 10'000u : 200'000u);
}

TEST_F(VulkanEngineGpu, EqualsTheCpuEngineOnStroke1000InBatches) {
    const std::vector<BallSweep> stroke = stroke_1000(kSanitized ? 4 : 1);
    for (const std::size_t size : {std::size_t{7}, std::size_t{100}, stroke.size()}) {
        EnginePair engines(unit_cube(kSanitized ? 64 : 128), device());
        for (std::size_t i = 0; i < stroke.size(); i += size) {
            ASSERT_TRUE(engines.cut(std::span(stroke).subspan(i, std::min(size, stroke.size() - i))));
        }
    }
}

// Whole units: rays exactly at the radius from a ball's centre or a capsule's axis, a unit inside, and a unit outside.
TEST_F(VulkanEngineGpu, RaysThatOnlyGrazeTheToolAreDecidedAlike) {
    const Solid solid = unit_cube(32);
    EnginePair engines(solid, device());
    const auto at = [&](double x, double y, double z) {
        return solid.lattice.object_from_units(Vec3(x, y, z) * double(shared::kUnitsPerCell));
    };
    for (const double off : {0.0, 1.0, -1.0, 0.5}) {
        const double radius_m = solid.lattice.unit_m() * (3.0 * shared::kUnitsPerCell + off);
        const BallSweep ball{at(9, 9, 9), at(9, 9, 9), radius_m, 1};
        const BallSweep along_x{at(5, 22, 9), at(20, 22, 9), radius_m, 1};
        const BallSweep along_z{at(22, 9, 25), at(22, 9, 8), radius_m, 1};
        const BallSweep diagonal{at(10, 10, 20), at(20, 20, 28), radius_m, 1};
        const BallSweep flat{at(26, 6, 20), at(27, 20, 20), radius_m, 1};
        ASSERT_TRUE(engines.cut(std::vector<BallSweep>{ball, along_x, along_z, diagonal, flat}));
    }
}

TEST_F(VulkanEngineGpu, AToolSmallerThanACellTakesTheSameEnds) {
    const Solid solid = unit_cube(32);
    EnginePair engines(solid, device());
    const double h = solid.lattice.spacing_m;
    Random random(4);
    for (int i = 0; i < repeated(64); ++i) {
        const Vec3 p = random_point(random, 0.0, 1.0);
        ASSERT_TRUE(engines.cut({p, p + random_point(random, -h, h), random.between(0.001 * h, 0.6 * h), 1}));
    }
    const Vec3 on_a_ray = solid.lattice.object_from_units(Vec3(10 * shared::kUnitsPerCell));
    EXPECT_TRUE(engines.cut({on_a_ray, on_a_ray, 0.01 * h, 1}));
    EXPECT_GT(engines.changed(), 0u);
}

TEST_F(VulkanEngineGpu, AToolLargerThanTheSolidLeavesNothing) {
    EnginePair engines(unit_cube(32), device());
    EXPECT_TRUE(engines.cut({Vec3(-1.0, 0.5, 0.5), Vec3(2.0, 0.5, 0.5), 1.1, 1}));
    for (const DexelSet& set : engines.vulkan().solid().sets) {
        for (std::size_t ray = 0; ray < set.ray_count(); ++ray) ASSERT_TRUE(set.ends(ray).empty());
    }
    EXPECT_TRUE(engines.cut({Vec3(0.5), Vec3(0.5), 0.1, 1})) << "cutting nothing";
}

TEST_F(VulkanEngineGpu, SegmentsThatLeaveTheLatticeTakeTheSameEnds) {
    EnginePair engines(unit_cube(32), device());
    EXPECT_TRUE(engines.cut({Vec3(0.5, 0.4, 0.9), Vec3(80.0, 30.0, 200.0), 0.1, 1}));
    EXPECT_TRUE(engines.cut({Vec3(-500.0, 0.31, 0.3), Vec3(700.0, 0.32, 0.35), 0.07, 1}));
    EXPECT_TRUE(engines.cut({Vec3(9.0), Vec3(10.0), 0.5, 1})) << "nowhere near";
    EXPECT_GT(engines.changed(), 0u);
}

// The store starts without any spare room, the exported ends and the passes are as small as can be.
TEST_F(VulkanEngineGpu, RunningOutOfRoomLosesNoMaterial) {
    for (const int most_plates : {1, 4, 32}) {
        EnginePair engines(plates(20, most_plates, 1), device(),
                           {.spare_ends = 0, .export_per_ray = 0, .tasks_a_pass = 2});
        Random random(2);
        for (int batch = 0; batch < repeated(32); ++batch) {
            std::vector<BallSweep> sweeps;
            for (int i = 0; i < 20; ++i) {
                const Vec3 p = random_point(random, 0.0, 1.0);
                sweeps.push_back(
                    {p, p + random_point(random, -0.3, 0.3), random.between(0.0005, 0.1 / (2.0 + most_plates)), 1});
            }
            ASSERT_TRUE(engines.cut(sweeps)) << "batch " << batch << " of " << most_plates << " plates";
        }
        EXPECT_GT(engines.vulkan().counts().store_rebuilds, 0u) << most_plates << " plates";
        EXPECT_TRUE(well_formed(engines.vulkan().solid()));
    }
}

// A software driver ends an invocation's loops after 65535 turns without a word; thousands of capsules on one ray need more.
TEST_F(VulkanEngineGpu, ThousandsOfCapsulesOnOneRayAreAllTaken) {
    const Solid solid = unit_cube(16);
    const double h = solid.lattice.spacing_m;
    const Vec3 ray = solid.lattice.object_from_units(Vec3(8 * shared::kUnitsPerCell));
    EnginePair engines(solid, device());
    std::vector<BallSweep> sweeps;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p(ray.x, ray.y, (i * 7 % 3000) / 3000.0);
        sweeps.push_back({p, p, h / 1000.0, static_cast<std::uint8_t>(i % 2)});
    }
    EXPECT_TRUE(engines.cut(sweeps));
    const auto middle = static_cast<std::size_t>(8 + 8 * solid.lattice.rays_u(2));
    EXPECT_EQ(engines.vulkan().solid().sets[2].ends(middle).size(), 2u + 2u * 3000u - 2u)
        << "3000 holes, the first of them open to the outside";
}

TEST_F(VulkanEngineGpu, ABatchLongerThanOnePassLooksAtIsTakenWhole) {
    EnginePair engines(unit_cube(16), device());
    std::vector<BallSweep> sweeps;
    Random random(3);
    for (int i = 0; i < 6000; ++i) {
        const Vec3 p = random_point(random, 0.0, 1.0);
        sweeps.push_back({p, p, 0.0005, 1});
    }
    EXPECT_TRUE(engines.cut(sweeps));
}

TEST_F(VulkanEngineGpu, AnUpdateIsOneSubmission) {
    EnginePair engines(unit_cube(64), device());
    for (const BallSweep& sweep : stroke_1000(kSanitized ? 32 : 4)) ASSERT_TRUE(engines.cut(sweep));
    const VulkanEngineCounts counts = engines.vulkan().counts();
    EXPECT_GT(counts.cuts, 20u);
    EXPECT_EQ(counts.submissions, counts.cuts);
    EXPECT_EQ(counts.store_rebuilds, 0u);
}

TEST_F(VulkanEngineGpu, TheMeshesOfBothEnginesAreTheSame) {
    const Solid solid = unit_cube(64);
    EnginePair engines(solid, device());
    Surface cpu_surface(solid.lattice), vulkan_surface(solid.lattice);
    cpu_surface.mesh_all(solid, engines.pool());
    vulkan_surface.mesh_all(solid, engines.pool());
    const std::vector<BallSweep> stroke = stroke_1000(4);
    for (std::size_t i = 0; i < stroke.size(); i += 25) {
        ASSERT_TRUE(engines.cut(std::span(stroke).subspan(i, std::min<std::size_t>(25, stroke.size() - i))));
        cpu_surface.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
        vulkan_surface.update(engines.vulkan().solid(), engines.vulkan().take_changes(), engines.pool());
    }
    const TriangleMesh expected = cpu_surface.welded(), actual = vulkan_surface.welded();
    EXPECT_GT(expected.triangles.size(), 10'000u);
    EXPECT_EQ(actual.positions_m, expected.positions_m);
    EXPECT_EQ(actual.triangles, expected.triangles);
    EXPECT_EQ(actual.colours, expected.colours);
}

// As on a graphics card of its own: nothing is mapped, all goes through copies.
TEST_F(VulkanEngineGpu, WithoutUnifiedMemoryTheEndsAreTheSame) {
    capabilities().unified_memory = false;
    EnginePair engines(plates(20, 3, 5), device(), {.spare_ends = 0, .export_per_ray = 1});
    Random random(6);
    for (int batch = 0; batch < 32; ++batch) {
        std::vector<BallSweep> sweeps(4);
        for (BallSweep& sweep : sweeps) sweep = random_sweep(random, 0.05), sweep.radius_m *= 0.3;
        ASSERT_TRUE(engines.cut(sweeps));
    }
    EXPECT_GT(engines.vulkan().counts().store_rebuilds, 0u);
}

TEST_F(VulkanEngineGpu, BadSweepsAreRefusedAndChangeNothing) {
    const Solid solid = unit_cube(16);
    EnginePair engines(solid, device());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<BallSweep> good_then_bad = {{Vec3(0.5), Vec3(0.5), 0.3, 0}, {Vec3(nan), Vec3(0.5), 0.3, 0}};
    EXPECT_FALSE(engines.vulkan().carve(good_then_bad));
    EXPECT_FALSE(engines.vulkan().carve(std::vector<BallSweep>{{Vec3(0.5), Vec3(0.5), 0.0, 0}}));
    EXPECT_TRUE(engines.vulkan().solid().same_content(solid));
    EXPECT_TRUE(engines.cut(std::span<const BallSweep>{})) << "an empty batch";
}

TEST_F(VulkanEngineGpu, ADeviceWithout64BitArithmeticOrAddressesIsRefused) {
    for (bool gpu::Capabilities::* lacking :
         {&gpu::Capabilities::shader_int64, &gpu::Capabilities::shader_float64, &gpu::Capabilities::buffer_address}) {
        capabilities().*lacking = false;
        const auto engine = make_vulkan_engine(unit_cube(16), device());
        ASSERT_FALSE(engine);
        EXPECT_NE(engine.error().line().find("--engine cpu"), std::string::npos) << engine.error().line();
        capabilities().*lacking = true;
    }
}

TEST_F(VulkanEngineGpu, ASolidTooLargeForTheDevicesBuffersIsRefusedWithAResolutionThatFits) {
    const Solid solid = unit_cube(128);
    device().core()->max_allocation_bytes = 512 << 10;
    const auto engine = VulkanEngine::create(solid, device(), {.spare_ends = 0});
    ASSERT_FALSE(engine);
    const std::string line = engine.error().line();
    const std::size_t number = line.find("about ");
    ASSERT_NE(number, std::string::npos) << line;
    const int fits = std::stoi(line.substr(number + 6));
    EXPECT_GE(fits, kMinResolution);
    EXPECT_TRUE(VulkanEngine::create(unit_cube(fits), device(), {.spare_ends = 0})) << fits;
}

TEST_F(VulkanEngineGpu, AfterADeviceErrorTheSolidIsAsBeforeAndTheNextCutWorks) {
    const Solid before = plates(20, 4, 7);
    EnginePair engines(before, device(), {.spare_ends = 0});
    const std::uint64_t limit = device().core()->max_allocation_bytes;
    std::vector<BallSweep> holes;  // each splits a few plates
    Random random(8);
    for (int i = 0; i < 200; ++i) {
        const Vec3 p = random_point(random, 0.0, 1.0);
        holes.push_back({p, p + random_point(random, -0.3, 0.3), 0.01, 1});
    }
    (void)engines.vulkan().take_changes();

    device().core()->max_allocation_bytes = 1024;  // the store cannot grow
    const auto refused = engines.vulkan().carve(holes);
    device().core()->max_allocation_bytes = limit;

    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("--engine cpu"), std::string::npos) << refused.error().line();
    EXPECT_TRUE(engines.vulkan().solid().same_content(before));
    EXPECT_TRUE(engines.vulkan().take_changes().empty());
    EXPECT_TRUE(engines.cut(holes)) << "the device's half-cut solid must not shine through";
}

TEST_F(VulkanEngineGpu, ARayWithMoreEndsThanAPassCanHandleIsRefused) {
    Solid solid = unit_cube(16);
    std::vector<std::uint32_t> counts(solid.sets[2].ray_count(), 0);
    std::vector<shared::DexelEnd> ends;
    for (int i = 0; i < 10'000; ++i) ends.push_back(shared::make_end(1000 + 3 * i, 0, 0));
    counts[100] = static_cast<std::uint32_t>(ends.size());
    solid.sets[2].assign(counts, ends);
    const auto engine = VulkanEngine::create(solid, device());
    ASSERT_TRUE(engine);
    const auto refused = (*engine)->carve(std::vector<BallSweep>{{Vec3(0.5), Vec3(0.5), 0.5, 0}});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("--engine cpu"), std::string::npos);
    EXPECT_TRUE((*engine)->solid().same_content(solid));
}

// Undo and tools whose spans the host works out arrive as lists of ends; carves on the device go on from there.
TEST_F(VulkanEngineGpu, AssignedRaysAndCutsMixAndTheEnginesStayEqual) {
    for (int round = 0; round < repeated(12); ++round) {
        Random random(static_cast<std::uint64_t>(100 + round));
        const Solid solid = plates(random.small(16, 32), random.small(1, 5), static_cast<std::uint64_t>(round));
        EnginePair engines(solid, device(), {.spare_ends = 0});
        std::vector<Changes> strokes;
        for (int step = 0; step < 8; ++step) {
            (void)engines.vulkan().take_changes();
            std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, 6)));
            for (BallSweep& sweep : sweeps) sweep = random_sweep(random, solid.lattice.spacing_m);
            ASSERT_TRUE(engines.cut(sweeps)) << "round " << round << " step " << step;
            strokes.push_back(engines.vulkan().take_changes());
            if (random.chance(0.5)) {
                const int count = random.small(0, 40);  // far more ends than the ray had room for
                ASSERT_TRUE(engines.assign(random_rays(solid.lattice, count, random)));
                strokes.push_back(engines.vulkan().take_changes());
            }
            if (random.chance(0.3)) {
                ASSERT_TRUE(engines.assign(as_before(strokes.back())));
                strokes.pop_back();
            }
        }
        EXPECT_GT(engines.vulkan().counts().store_rebuilds, 0u);
        while (!strokes.empty()) {
            ASSERT_TRUE(engines.assign(as_before(strokes.back())));
            strokes.pop_back();
        }
        EXPECT_TRUE(engines.cut({Vec3(0.4), Vec3(0.6), 0.1, 1})) << "the device must hold what was assigned";
    }
}

TEST_F(VulkanEngineGpu, AssigningAFewRaysIsOneSubmissionAndSendsNothingElse) {
    EnginePair engines(unit_cube(32), device());
    const std::uint64_t before = engines.vulkan().counts().submissions;
    Random random(5);
    ASSERT_TRUE(engines.assign(random_rays(engines.cpu().solid().lattice, 10, random)));
    EXPECT_EQ(engines.vulkan().counts().submissions, before + 1);
    EXPECT_EQ(engines.vulkan().counts().store_rebuilds, 0u);
    EXPECT_TRUE(engines.cut({Vec3(0.4), Vec3(0.6), 0.3, 1}));
}

TEST_F(VulkanEngineGpu, AfterADeviceErrorInAssignTheSolidIsAsBefore) {
    const Solid before = plates(20, 4, 7);
    EnginePair engines(before, device(), {.spare_ends = 0});
    const std::uint64_t limit = device().core()->max_allocation_bytes;
    Random random(9);
    const RayBatch rays = random_rays(before.lattice, 500, random);
    device().core()->max_allocation_bytes = 1024;
    const auto refused = engines.vulkan().assign(rays);
    device().core()->max_allocation_bytes = limit;
    ASSERT_FALSE(refused);
    EXPECT_TRUE(engines.vulkan().solid().same_content(before));
    EXPECT_TRUE(engines.vulkan().take_changes().empty());
    EXPECT_TRUE(engines.assign(rays));
    EXPECT_TRUE(engines.cut({Vec3(0.2), Vec3(0.8), 0.2, 1}));
}

// Drivers bind as little as 128 MiB. The table of rays fits into that at every resolution; the ends need not.
TEST_F(VulkanEngineGpu, AStoreLargerThanABindingWorks) {
    const Solid solid = plates(24, 40, 11);
    capabilities().max_storage_buffer_bytes = solid.rays_held() * sizeof(shared::RayRef);
    ASSERT_GT(solid.sets[0].end_count() * sizeof(shared::DexelEnd), 3 * capabilities().max_storage_buffer_bytes);
    EnginePair engines(solid, device(), {.spare_ends = 0, .export_per_ray = 1, .tasks_a_pass = 1});
    Random random(12);
    for (int batch = 0; batch < repeated(8); ++batch) {
        std::vector<BallSweep> sweeps(4);
        for (BallSweep& sweep : sweeps) sweep = random_sweep(random, 0.04), sweep.radius_m *= 0.05;
        ASSERT_TRUE(engines.cut(sweeps)) << batch;
        ASSERT_TRUE(engines.assign(random_rays(solid.lattice, 20, random))) << batch;
    }
}

TEST_F(VulkanEngineGpu, DeferredCutsReadBackAreTheSameAndRecordEachRayOnce) {
    for (int round = 0; round < repeated(12); ++round) {
        Random random(static_cast<std::uint64_t>(200 + round));
        const Solid solid = plates(random.small(16, 32), random.small(1, 5), static_cast<std::uint64_t>(round));
        EnginePair engines(solid, device(), {.spare_ends = 0, .tasks_a_pass = 8});
        for (int frame = 0; frame < 6; ++frame) {
            for (int update = random.small(1, 3); update > 0; --update) {
                std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, 6)));
                for (BallSweep& sweep : sweeps) sweep = random_sweep(random, solid.lattice.spacing_m);
                ASSERT_TRUE(engines.cut_deferred(sweeps)) << "round " << round << " frame " << frame;
            }
            const Solid held = engines.vulkan().solid();
            (void)engines.vulkan().take_changes();
            ASSERT_TRUE(engines.read_back());
            const Changes changes = engines.vulkan().take_changes();
            std::vector<std::uint32_t> codes;
            for (const shared::ChangedRay& ray : changes.rays) {
                codes.push_back(ray.ray);
                const RayPlace place = place_of(ray.ray);
                const auto before = held.sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v);
                ASSERT_TRUE(std::ranges::equal(changes.before_of(ray), before, [](const auto& a, const auto& b) {
                    return a.depth_material == b.depth_material && a.normal == b.normal;
                }));
            }
            std::ranges::sort(codes);
            EXPECT_EQ(std::ranges::adjacent_find(codes), codes.end()) << "a ray is listed twice";
            if (random.chance(0.5)) {
                ASSERT_TRUE(engines.cut(random_sweep(random, solid.lattice.spacing_m)));
            }
        }
    }
}

}  // namespace burin::test
