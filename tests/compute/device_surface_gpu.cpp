// SPDX-License-Identifier: MIT
// The surface that the device makes against the one that the CPU makes: the same vertices to the last bit where the
// device rounds as the host does, the same triangles, whatever the solid and however it came about.
#include "compute/vulkan/device_surface.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <string>
#include <vector>

#include "compute/mesher/surface.hpp"
#include "gpu/core.hpp"
#include "shaders/shared/mesh_job.h"
#include "tests/compute/effort.hpp"
#include "tests/compute/engine_pair.hpp"
#include "tests/compute/random_solids.hpp"
#include "tests/compute/surface_difference.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::compute::test {
namespace {

class DeviceSurfaceGpu : public gpu::DeviceTest {
protected:
    void SetUp() override {
        gpu::DeviceTest::SetUp();
        if (IsSkipped()) return;
        const gpu::Capabilities& can = device().capabilities();
        if (!can.shader_int64 || !can.shader_float64 || !can.buffer_address) {
            GTEST_SKIP() << device().info().name << " cannot run the Vulkan engine";
        }
    }
    gpu::Capabilities& capabilities() { return device().core()->capabilities; }
    testing::AssertionResult equal(DeviceSurface& surface, const Surface& cpu);
    WorkerPool pool_{1};
};

std::unique_ptr<DeviceSurface> surface_of(VulkanEngine& engine, const DeviceSurfaceOptions& options = {}) {
    auto made = DeviceSurface::create(engine, options);
    EXPECT_TRUE(made) << made.error().line();
    return made ? std::move(*made) : nullptr;
}

}  // namespace

testing::AssertionResult DeviceSurfaceGpu::equal(DeviceSurface& surface, const Surface& cpu) {
    return test::equal(surface, cpu, Tolerance(device(), cpu.lattice().spacing_m));
}

TEST_F(DeviceSurfaceGpu, ABlockHasTheSameSurface) {
    EnginePair engines(unit_cube(40), device());
    Surface cpu(engines.cpu().solid().lattice);
    cpu.mesh_all(engines.cpu().solid(), engines.pool());
    const auto surface = surface_of(engines.vulkan());
    ASSERT_NE(surface, nullptr);
    EXPECT_TRUE(equal(*surface, cpu));
}

TEST_F(DeviceSurfaceGpu, NoiseHasTheSameSurfaceWhateverItsRaysSay) {
    std::uint64_t seed = 0;
    for (const Rays rays : {Rays::agree, Rays::disturbed, Rays::unrelated}) {
        for (const double p : {0.02, 0.2, 0.5}) {
            for (int round = 0; round < repeated(2); ++round) {
                const Solid solid = noise_solid({20, 17, 34}, p, rays, ++seed);
                auto engine = VulkanEngine::create(Solid(solid), device(), pool_);
                ASSERT_TRUE(engine);
                const auto surface = surface_of(**engine);
                ASSERT_NE(surface, nullptr);
                WorkerPool pool(2);
                Surface cpu(solid.lattice);
                cpu.mesh_all(solid, pool);
                ASSERT_TRUE(equal(*surface, cpu)) << "seed " << seed << " p " << p;
            }
        }
    }
}

TEST_F(DeviceSurfaceGpu, AStrokeCarvedAndMeshedOnTheDeviceGivesTheSameSurfaceAndSolid) {
    const Solid solid = unit_cube(64);
    EnginePair engines(solid, device());
    const auto surface = surface_of(engines.vulkan());
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    const std::vector<BallSweep> stroke = stroke_1000(kSanitized ? 64 : 16);
    const std::uint64_t before = surface->counts().submissions;
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        ASSERT_TRUE(engines.cpu().carve(std::span(&stroke[i], 1)));
        cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
        const auto carved = surface->carve(std::span(&stroke[i], 1));
        ASSERT_TRUE(carved) << carved.error().line();
        if (i % 8 == 7) {
            ASSERT_TRUE(equal(*surface, cpu)) << "after ball " << i;
        }
    }
    ASSERT_TRUE(equal(*surface, cpu));
    EXPECT_EQ(surface->counts().submissions, before + stroke.size()) << "a frame is one submission";
    EXPECT_TRUE(engines.read_back());
}

// Lists and pools start far too small, and few tiles are taken at once: tiles have to wait, several times over.
TEST_F(DeviceSurfaceGpu, RunningOutOfRoomLosesNoSurface) {
    const Solid solid = noise_solid({40, 33, 34}, 0.1, Rays::disturbed, 77);
    EnginePair engines(solid, device());
    const auto surface =
        surface_of(engines.vulkan(), {.slots = 5, .cells = 64, .edges = 64, .vertices = 64, .indices = 64});
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    ASSERT_TRUE(equal(*surface, cpu));
    EXPECT_GT(surface->counts().growths, 4u);
    Random random(3);
    for (int i = 0; i < repeated(10); ++i) {
        BallSweep sweep;
        sweep.start_object_m = Vec3(-0.3, 0.2, 0.1) + Vec3(random.between(0, 0.4), random.between(0, 0.33), 0.17);
        sweep.end_object_m = sweep.start_object_m + Vec3(0.05, 0.02, 0.1);
        sweep.radius_m = random.between(0.01, 0.2);
        sweep.operation = static_cast<Operation>(i % 3);  // cut, fill, paint
        sweep.material = 1;
        ASSERT_TRUE(engines.cpu().carve(std::span(&sweep, 1)));
        cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
        ASSERT_TRUE(surface->carve(std::span(&sweep, 1)));
        ASSERT_TRUE(equal(*surface, cpu)) << i;
    }
    EXPECT_TRUE(engines.read_back());
}

// What no changed ray reaches is copied: the device makes the cells that the processor makes, and no others.
TEST_F(DeviceSurfaceGpu, AStrokeMakesTheCellsThatTheProcessorMakes) {
    const Solid solid = unit_cube(64);
    EnginePair engines(solid, device());
    const auto surface = surface_of(engines.vulkan());
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    EXPECT_EQ(surface->counts().cells, cpu.mesh_all(solid, engines.pool()).cells);
    for (const BallSweep& sweep : stroke_1000(kSanitized ? 64 : 16)) {
        ASSERT_TRUE(engines.cpu().carve(std::span(&sweep, 1)));
        const RemeshStats expected = cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
        const std::uint64_t before = surface->counts().cells;
        ASSERT_TRUE(surface->carve(std::span(&sweep, 1)));
        ASSERT_TRUE(surface->finish());
        ASSERT_EQ(surface->counts().cells - before, expected.cells);
    }
    EXPECT_TRUE(equal(*surface, cpu));
}

// In noise a small ball changes a few cells of a tile full of loops that pass a face twice, whose fans are never
// copied. Rays that disagree are counted although the quads around them are copied.
TEST_F(DeviceSurfaceGpu, NoiseWithRandomChangesHasTheSameSurface) {
    for (const Rays rays : {Rays::agree, Rays::disturbed, Rays::unrelated}) {
        const Solid solid = noise_solid({34, 20, 37}, 0.2, rays, 11);
        EnginePair engines(solid, device());
        // Too little of everything in the first of the two, so that tiles wait.
        for (const bool roomy : {false, true}) {
            const auto surface = surface_of(
                engines.vulkan(),
                roomy ? DeviceSurfaceOptions{}
                      : DeviceSurfaceOptions{.slots = 3, .cells = 64, .edges = 64, .vertices = 64, .indices = 64});
            ASSERT_NE(surface, nullptr);
            Surface cpu(solid.lattice);
            cpu.mesh_all(engines.cpu().solid(), engines.pool());
            Random random(roomy ? 21 : 22);
            for (int i = 0; i < repeated(4); ++i) {
                BallSweep sweep;
                sweep.start_object_m =
                    solid.lattice.origin_object +
                    solid.lattice.spacing_m * Vec3(34 * random.unit(), 20 * random.unit(), 37 * random.unit());
                sweep.end_object_m = sweep.start_object_m + solid.lattice.spacing_m * Vec3(random.unit());
                sweep.radius_m = solid.lattice.spacing_m * random.between(0.5, 4.0);
                sweep.operation = static_cast<Operation>(i % 3);  // cut, fill, paint
                sweep.material = 1;
                ASSERT_TRUE(engines.cpu().carve(std::span(&sweep, 1)));
                const RemeshStats expected =
                    cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
                const std::uint64_t before = surface->counts().cells;
                ASSERT_TRUE(surface->carve(std::span(&sweep, 1)));
                ASSERT_TRUE(equal(*surface, cpu)) << i;
                if (roomy) {
                    ASSERT_EQ(surface->counts().cells - before, expected.cells) << i;
                }
            }
            EXPECT_TRUE(engines.read_back());
        }
    }
}

// Many frames that nobody looks at, cuts that take several passes, and changes that come from the host in between.
TEST_F(DeviceSurfaceGpu, FramesThatAreNotWaitedForAndChangesFromTheHostGiveTheSameSurface) {
    const Solid solid = unit_cube(48);
    EnginePair engines(solid, device(), {.spare_ends = 0, .tasks_a_pass = 8});
    const auto surface = surface_of(engines.vulkan(), {.slots = 16});
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    Random random(9);
    for (int round = 0; round < repeated(6); ++round) {
        for (int frame = 0; frame < 5; ++frame) {
            std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, 6)));
            for (BallSweep& sweep : sweeps) {
                sweep.start_object_m = Vec3(random.unit(), random.unit(), random.unit());
                sweep.end_object_m = Vec3(random.unit(), random.unit(), random.unit());
                sweep.radius_m = random.between(0.01, 0.12);
                sweep.operation = static_cast<Operation>(random.small(0, 2));
                sweep.material = 1;
            }
            ASSERT_TRUE(engines.cpu().carve(sweeps));
            ASSERT_TRUE(surface->carve(sweeps));
        }
        ASSERT_TRUE(surface->finish());
        ASSERT_TRUE(engines.read_back());
        const Changes undone = engines.vulkan().take_changes();
        if (round % 2 == 0) {  // undo
            RayBatch batch;
            for (const shared::ChangedRay& ray : undone.rays) batch.add(ray.ray, undone.before_of(ray));
            ASSERT_TRUE(engines.assign(batch));
            ASSERT_TRUE(surface->update(engines.vulkan().take_changes()));
        }
        cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
        ASSERT_TRUE(equal(*surface, cpu)) << "round " << round;
    }
}

TEST_F(DeviceSurfaceGpu, WithoutUnifiedMemoryTheSurfaceIsTheSame) {
    capabilities().unified_memory = false;
    const Solid solid = noise_solid({30, 20, 34}, 0.05, Rays::agree, 5);
    EnginePair engines(solid, device());
    const auto surface = surface_of(engines.vulkan(), {.slots = 7, .vertices = 256, .indices = 256});
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    const BallSweep sweep{Vec3(-0.2, 0.3, 0.2), Vec3(-0.1, 0.3, 0.3), 0.06, 1};
    ASSERT_TRUE(engines.cpu().carve(std::span(&sweep, 1)));
    cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
    ASSERT_TRUE(surface->carve(std::span(&sweep, 1), DeviceSurface::Ball{sweep.start_object_m, 0.1}));
    EXPECT_TRUE(equal(*surface, cpu));
    EXPECT_TRUE(engines.read_back());
    RayBatch undo;
    const Changes done = engines.vulkan().take_changes();
    for (const shared::ChangedRay& ray : done.rays) undo.add(ray.ray, done.before_of(ray));
    ASSERT_FALSE(undo.rays.empty());
    ASSERT_TRUE(engines.assign(undo));
    ASSERT_TRUE(surface->update(engines.vulkan().take_changes()));
    cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
    EXPECT_TRUE(equal(*surface, cpu));
}

TEST_F(DeviceSurfaceGpu, AfterADeviceErrorTheSurfaceIsThatOfTheHostsSolid) {
    const Solid solid = noise_solid({30, 20, 34}, 0.1, Rays::agree, 6);
    EnginePair engines(solid, device(), {.spare_ends = 0});
    const auto surface = surface_of(engines.vulkan());
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    std::vector<BallSweep> holes;  // each splits intervals, for which the store has no room
    for (int i = 0; i < 20; ++i) holes.push_back({Vec3(-0.3 + 0.01 * i, 0.2, 0.1), Vec3(-0.1, 0.39, 0.4), 0.004, 1});
    const std::uint64_t limit = device().core()->max_allocation_bytes;
    device().core()->max_allocation_bytes = 1024;
    auto failed = surface->carve(holes);
    if (failed) failed = surface->finish();
    device().core()->max_allocation_bytes = limit;
    EXPECT_FALSE(failed);
    EXPECT_TRUE(engines.vulkan().solid().same_content(solid));
    ASSERT_TRUE(equal(*surface, cpu));
    ASSERT_TRUE(engines.cpu().carve(holes));
    cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
    ASSERT_TRUE(surface->carve(holes));
    EXPECT_TRUE(equal(*surface, cpu));
    EXPECT_TRUE(engines.read_back());
}

// The cut and the new surface are on the device already when it turns out that some rays found no room.
TEST_F(DeviceSurfaceGpu, AfterACutThatFailsHalfwayTheSurfaceIsThatOfTheHostsSolid) {
    const Solid solid = unit_cube(32);
    EnginePair engines(solid, device(), {.spare_ends = 0});
    const auto surface = surface_of(engines.vulkan());
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    const std::vector<BallSweep> balls{{Vec3(0.0), Vec3(0.0), 0.2, 1}, {Vec3(0.6), Vec3(0.6), 0.2, 1}};
    ASSERT_TRUE(surface->carve(balls));
    const std::uint64_t limit = device().core()->max_allocation_bytes;
    device().core()->max_allocation_bytes = 1024;
    const auto failed = surface->finish();
    device().core()->max_allocation_bytes = limit;
    ASSERT_FALSE(failed);
    EXPECT_TRUE(engines.vulkan().solid().same_content(solid));
    ASSERT_TRUE(equal(*surface, cpu));
    ASSERT_TRUE(engines.cpu().carve(balls));
    cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
    ASSERT_TRUE(surface->carve(balls));
    EXPECT_TRUE(equal(*surface, cpu));
    EXPECT_TRUE(engines.read_back());
}

// ---- Near the tool

namespace {

using Place = std::array<float, 3>;
using PlacedTriangle = std::array<Place, 3>;

Place place_near(const Vec3& p) {
    const Vec3f rounded(p);
    return {rounded.x, rounded.y, rounded.z};
}

std::vector<PlacedTriangle> sorted(std::vector<PlacedTriangle> triangles) {
    for (PlacedTriangle& t : triangles) std::ranges::rotate(t, std::ranges::min_element(t));
    std::ranges::sort(triangles);
    return triangles;
}

std::vector<PlacedTriangle> triangles_of(const geometry::LocalSurface& surface) {
    std::vector<PlacedTriangle> triangles;
    for (std::uint32_t i = 0; i < surface.triangles(); ++i) {
        const geometry::Triangle t = surface.triangle(i);
        triangles.push_back({place_near(t.a), place_near(t.b), place_near(t.c)});
    }
    return sorted(triangles);
}

// All whose box comes within the ball, relative to its centre.
template <typename TileOf>
std::vector<PlacedTriangle> triangles_within(const Lattice& lattice, std::uint32_t tile_count, TileOf&& tile_of,
                                             const Vec3& center_object, double radius_m) {
    std::vector<PlacedTriangle> triangles;
    const Vec3 center = center_object - lattice.origin_object;
    const Vec3f center_float(center);
    const auto radius = static_cast<float>(radius_m);
    for (std::uint32_t t = 0; t < tile_count; ++t) {
        const TileMesh& tile = tile_of(t);
        const auto corner = [&](std::size_t i) {
            const shared::SurfaceVertex& v = tile.vertices[tile.indices[i]];
            return Vec3f(v.x, v.y, v.z);
        };
        for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
            const Vec3f a = corner(i), b = corner(i + 1), c = corner(i + 2);
            const Vec3f lo = glm::min(a, glm::min(b, c)), hi = glm::max(a, glm::max(b, c));
            const Vec3f outside = glm::max(glm::max(lo - center_float, center_float - hi), Vec3f(0.0f));
            if (glm::dot(outside, outside) > radius * radius) continue;
            triangles.push_back(
                {place_near(Vec3(a) - center), place_near(Vec3(b) - center), place_near(Vec3(c) - center)});
        }
    }
    return sorted(triangles);
}

// Those of the CPU's surface, or, on a device that rounds otherwise, of its own.
std::vector<PlacedTriangle> triangles_within(DeviceSurface& device, bool rounds_alike, const Surface& cpu,
                                             const Vec3& center_object, double radius_m) {
    if (rounds_alike) {
        return triangles_within(
            cpu.lattice(), static_cast<std::uint32_t>(cpu.tile_count()),
            [&](std::uint32_t t) -> const TileMesh& { return cpu.tile(t); }, center_object, radius_m);
    }
    const auto tiles = device.download();
    EXPECT_TRUE(tiles) << tiles.error().line();
    if (!tiles) return {};
    return triangles_within(
        cpu.lattice(), static_cast<std::uint32_t>(cpu.tile_count()),
        [&](std::uint32_t t) -> const TileMesh& { return (*tiles)[t]; }, center_object, radius_m);
}

}  // namespace

TEST_F(DeviceSurfaceGpu, TheTrianglesNearTheToolAreTheSameAsASet) {
    const Solid solid = unit_cube(64);
    EnginePair engines(solid, device());
    const auto surface = surface_of(engines.vulkan());
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    geometry::LocalSurface actual;
    std::uint64_t triangles = 0;
    for (const BallSweep& sweep : stroke_1000(32)) {
        ASSERT_TRUE(engines.cpu().carve(std::span(&sweep, 1)));
        cpu.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
        const std::uint64_t before = surface->counts().submissions;
        ASSERT_TRUE(surface->carve(std::span(&sweep, 1), DeviceSurface::Ball{sweep.start_object_m, 0.1}));
        for (const double radius : {0.1, 0.013}) {  // the one that was told, and another
            const auto gathered = surface->local_surface(sweep.start_object_m, radius, actual);
            ASSERT_TRUE(gathered) << gathered.error().line();
            EXPECT_EQ(actual.radius_m, radius);
            EXPECT_EQ(actual.center_object, sweep.start_object_m);
            ASSERT_EQ(triangles_of(actual),
                      triangles_within(*surface, device().info().is_software(), cpu, sweep.start_object_m, radius));
            triangles += actual.triangles();
        }
        EXPECT_EQ(surface->counts().submissions, before + 2);
    }
    EXPECT_GT(triangles, 1000u);
}

// Then they are reached by address, which software drivers do more slowly.
TEST_F(DeviceSurfaceGpu, TheTrianglesNearTheToolAreTheSameWhereNoBindingShowsAllVertices) {
    capabilities().max_storage_buffer_bytes = 2u << 20;
    const Solid solid = unit_cube(48);
    EnginePair engines(solid, device());
    const auto surface = surface_of(engines.vulkan(), {.slots = 16, .cells = 1u << 12, .edges = 1u << 13});
    ASSERT_NE(surface, nullptr);
    ASSERT_GT(surface->vertices().size_bytes(), capabilities().max_storage_buffer_bytes);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    geometry::LocalSurface actual;
    const Vec3 corner(1.0);
    const auto gathered = surface->local_surface(corner, 0.3, actual);
    ASSERT_TRUE(gathered) << gathered.error().line();
    EXPECT_GT(actual.triangles(), 100u);
    EXPECT_EQ(triangles_of(actual), triangles_within(*surface, device().info().is_software(), cpu, corner, 0.3));
}

// As large a ball as was asked for: with a smaller one, a tool that has cut itself free would find nothing near.
TEST_F(DeviceSurfaceGpu, ABallWithMoreTrianglesThanAnyBeforeIsGatheredWhole) {
    const Solid solid = noise_solid({60, 60, 60}, 0.3, Rays::agree, 8);
    EnginePair engines(solid, device());
    const auto surface = surface_of(engines.vulkan(), {.ball_triangles = 64, .ball_vertices = 64});
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    geometry::LocalSurface actual;
    const Vec3 center(0.0, 0.5, 0.4);
    for (const double radius : {0.02, 0.3, 0.5, 0.1}) {
        ASSERT_TRUE(surface->local_surface(center, radius, actual));
        EXPECT_EQ(actual.radius_m, radius);
        EXPECT_EQ(triangles_of(actual), triangles_within(*surface, device().info().is_software(), cpu, center, radius));
    }
    ASSERT_TRUE(surface->local_surface(center, 0.5, actual));
    EXPECT_GT(actual.triangles(), 50'000u);
}

TEST_F(DeviceSurfaceGpu, ABallWithMoreTrianglesThanTheDeviceShowsIsMadeSmaller) {
    const Solid solid = noise_solid({60, 60, 60}, 0.3, Rays::agree, 8);
    EnginePair engines(solid, device());
    const auto surface = surface_of(engines.vulkan());
    ASSERT_NE(surface, nullptr);
    Surface cpu(solid.lattice);
    cpu.mesh_all(solid, engines.pool());
    const std::uint64_t shown = capabilities().max_storage_buffer_bytes;
    capabilities().max_storage_buffer_bytes = 12 << 15;
    geometry::LocalSurface actual;
    const Vec3 center(0.0, 0.5, 0.4);
    ASSERT_TRUE(surface->local_surface(center, 0.5, actual));
    capabilities().max_storage_buffer_bytes = shown;
    EXPECT_LT(actual.radius_m, 0.5);
    EXPECT_GT(actual.triangles(), 1000u);
    EXPECT_EQ(triangles_of(actual),
              triangles_within(*surface, device().info().is_software(), cpu, center, actual.radius_m));
}

}  // namespace burin::compute::test
