// SPDX-License-Identifier: MIT
// The cells that the device makes behind its cuts: tiles that take them over are those that the host makes, in every
// field, to the last bit.
#include "compute/vulkan/cell_maker.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compute/mesher/surface.hpp"
#include "compute/vulkan/standby_engine.hpp"
#include "tests/compute/random_solids.hpp"
#include "tests/compute/same_tiles.hpp"
#include "tests/compute/updates.hpp"
#include "tests/compute/vulkan_engine_fixture.hpp"

namespace burin::compute::test {
namespace {

// An engine on a device, with a surface of the cells that the device makes, and one of those that the host makes of the
// same changes.
class FollowedTwice {
public:
    FollowedTwice(const Solid& solid, const gpu::Device& device, const VulkanEngineOptions& options = {})
        : taken_(solid.lattice), own_(solid.lattice) {
        auto made = VulkanEngine::create(Solid(solid), device, pool_, options);
        EXPECT_TRUE(made) << made.error().line();
        if (!made) return;
        engine_ = std::move(*made);
        engine_->make_cells();
        EXPECT_TRUE(engine_->take_notices().empty());
        taken_.mesh_all(solid, pool_);
        own_.mesh_all(solid, pool_);
    }
    // Takes an update, and tells what differs then; nothing where nothing does.
    [[nodiscard]] std::string take(Wait wait = Wait::yes) {
        const auto delta = engine_->take(wait);
        if (!delta) return delta.error().line();
        if (!*delta) return "";
        made_ += (*delta)->made ? 1 : 0;
        const RemeshStats of_taken =
            taken_.update(engine_->solid(), (*delta)->changes, pool_, (*delta)->made ? &*(*delta)->made : nullptr);
        const RemeshStats of_own = own_.update(engine_->solid(), (*delta)->changes, pool_);
        cells_ += of_own.cells;
        composed_ += taken_.composed_tiles();
        if (of_taken.tiles != of_own.tiles || of_taken.cells != of_own.cells || of_taken.triangles != of_own.triangles)
            return "other statistics";
        if (!std::ranges::equal(taken_.changed_tiles(), own_.changed_tiles())) return "other tiles";
        return first_difference(taken_, own_);
    }
    [[nodiscard]] std::string carve(const std::vector<ToolSweep>& sweeps) {
        const auto begun = engine_->begin(sweeps);
        return begun ? take() : begun.error().line();
    }
    [[nodiscard]] VulkanEngine& engine() { return *engine_; }
    [[nodiscard]] const Surface& own() const { return own_; }
    [[nodiscard]] std::uint64_t made() const { return made_; }          // updates whose cells the device has made
    [[nodiscard]] std::uint64_t cells() const { return cells_; }        // that the host makes
    [[nodiscard]] std::uint64_t composed() const { return composed_; }  // tiles, of the device's cells

private:
    WorkerPool pool_{2};
    std::unique_ptr<VulkanEngine> engine_;
    Surface taken_, own_;
    std::uint64_t made_ = 0, cells_ = 0, composed_ = 0;
};

class CellMakerGpu : public VulkanEngineGpu {};

std::vector<ToolSweep> balls(std::span<const BallSweep> sweeps) {
    std::vector<ToolSweep> tools;
    for (const BallSweep& sweep : sweeps)
        tools.push_back({.shape = BallTool{sweep.radius_m},
                         .start = {sweep.start_object_m},
                         .end = {sweep.end_object_m},
                         .operation = sweep.operation,
                         .material = sweep.material});
    return tools;
}

}  // namespace

TEST_F(CellMakerGpu, AStrokeMakesTheCellsThatTheHostMakesAndTheTilesAreTheSame) {
    FollowedTwice carved(unit_cube(64), device());
    for (const BallSweep& sweep : stroke_1000(kSanitized ? 64 : 16))
        ASSERT_EQ(carved.carve(balls(std::span(&sweep, 1))), "");
    const CellMakerCounts counts = carved.engine().made_cells();
    EXPECT_EQ(counts.cells, carved.cells());
    EXPECT_EQ(counts.updates, carved.made());
    EXPECT_EQ(counts.left_tiles + counts.left_updates, 0u);
    EXPECT_EQ(carved.composed(), counts.tiles) << "the host has none to make itself";
}

TEST_F(CellMakerGpu, EveryToolAndOperationWithRaysThatAreAssignedBetweenGivesTheSameTiles) {
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(repeated(6)); ++seed) {
        Random random(seed);
        const Solid solid = unit_cube(random.small(16, 48));
        FollowedTwice carved(solid, device());
        for (int i = 0; i < 20; ++i) {
            static_cast<void>(begin(carved.engine(), any_work(random, solid.lattice)));
            ASSERT_EQ(carved.take(random.chance(0.5) ? Wait::yes : Wait::no), "") << "seed " << seed << ", " << i;
        }
        while (carved.engine().under_way() > 0) ASSERT_EQ(carved.take(), "") << "seed " << seed;
        EXPECT_GT(carved.made(), 0u);
    }
}

// In noise loops pass faces twice, whose fans the host makes, and rays disagree about nodes.
TEST_F(CellMakerGpu, NoiseGivesTheSameTilesWhateverItsRaysSay) {
    for (const Rays rays : {Rays::agree, Rays::disturbed, Rays::unrelated}) {
        const Solid solid = noise_solid({34, 20, 37}, 0.5, rays, 11);
        FollowedTwice carved(solid, device());
        Random random(21);
        for (int i = 0; i < repeated(8); ++i) {
            BallSweep sweep;
            sweep.start_object_m =
                solid.lattice.origin_object +
                solid.lattice.spacing_m * Vec3(34 * random.unit(), 20 * random.unit(), 37 * random.unit());
            sweep.end_object_m = sweep.start_object_m + solid.lattice.spacing_m * Vec3(random.unit());
            sweep.radius_m = solid.lattice.spacing_m * random.between(0.5, 4.0);
            sweep.operation = static_cast<Operation>(i % 3);  // cut, fill, paint
            sweep.material = 1;
            ASSERT_EQ(carved.carve(balls(std::span(&sweep, 1))), "") << i;
        }
        EXPECT_LT(carved.composed(), carved.engine().made_cells().tiles);
        EXPECT_GT(carved.own().disagreeing_edges() + (rays == Rays::agree ? 1 : 0), 0u);
    }
}

TEST_F(CellMakerGpu, WhatFindsNoRoomIsMadeByTheHostUntilThereIsRoom) {
    for (const CellMakerOptions& small : {CellMakerOptions{.tiles = 1}, CellMakerOptions{.cells = 1},
                                          CellMakerOptions{.edges = 1}, CellMakerOptions{.vertices = 1}}) {
        FollowedTwice carved(unit_cube(48), device(), {.cells = small});
        for (const BallSweep& sweep : stroke_1000(50)) ASSERT_EQ(carved.carve(balls(std::span(&sweep, 1))), "");
        const CellMakerCounts counts = carved.engine().made_cells();
        EXPECT_GT(counts.left_tiles + counts.left_updates, 0u);
        EXPECT_LT(counts.left_updates, 6u) << "it grows";
        EXPECT_GT(counts.cells, 0u);
    }
}

TEST_F(CellMakerGpu, ACutOfSeveralSubmissionsIsMadeByTheHost) {
    FollowedTwice carved(unit_cube(40), device(), {.spare_ends = 0, .export_per_ray = 1, .tasks_a_pass = 4});
    Random random(9);
    for (int i = 0; i < repeated(10); ++i) {
        std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, 5)));
        for (BallSweep& sweep : sweeps) sweep = random_sweep(random, 0.025);
        ASSERT_EQ(carved.carve(balls(sweeps)), "") << i;
    }
}

// A tool that leaves too many parts of a ray is left to the host, after the device has made cells of what came before.
TEST_F(CellMakerGpu, WorkThatIsFoundToBeTheHostsLeavesItTheCellsAsWell) {
    FollowedTwice carved(unit_cube(64), device());
    const ToolSweep ball{.shape = BallTool{0.1}, .start = {Vec3(0.1, 0.1, 1.0)}, .end = {Vec3(0.1, 0.1, 1.0)}};
    const ToolSweep comb{.shape = BoxTool{Vec3(0.0005, 0.45, 0.3)},
                         .start = {Vec3(0.5, 0.5, 0.9)},
                         .end = {Vec3(0.55, 0.5, 0.9), Quat(0.0, 0.0, 0.0, 1.0)},
                         .tolerance_cells = 3.0};
    ASSERT_EQ(carved.carve({ball, comb}), "");
    EXPECT_EQ(carved.made(), 0u) << "the comb is the host's";
    EXPECT_GT(carved.engine().made_cells().cells, 0u) << "the device has made cells after the ball";
}

// Rays of so many ends that a ball cannot smooth over them on the device, which it finds out on its way.
TEST_F(CellMakerGpu, ABallThatTheHostSmoothsAfterTheDeviceHasCutLeavesItTheCells) {
    for (const bool is_lost : {false, true}) {
        auto own = gpu::Device::create({.validation = true});
        ASSERT_TRUE(own) << own.error().line();
        WorkerPool pool(1);
        StandbyEngine carved(unit_cube(32), *own, pool);
        const auto alone = make_cpu_engine(unit_cube(32), pool);
        carved.make_cells();
        RayBatch combs;
        std::vector<shared::DexelEnd> ends;
        for (int i = 0; i < 600; ++i) ends.push_back(shared::make_end(5000 + 200 * i, 1, 0x7fff7fffu));
        for (int u = 25; u < 27; ++u) combs.add(shared::ray_code(2, u, 16), ends);
        ASSERT_TRUE(carved.assign(combs) && alone->assign(combs));
        static_cast<void>(carved.take_changes());
        static_cast<void>(alone->take_changes());
        const Solid before = alone->solid();
        Surface surface(before.lattice), anew(before.lattice);
        surface.mesh_all(before, pool);
        const ToolSweep cut{.shape = BallTool{0.12}, .start = {Vec3(0.1, 0.5, 1.0)}, .end = {Vec3(0.8, 0.5, 1.0)}};
        ToolSweep smoothed = cut, elsewhere = cut;
        smoothed.shape = BallTool{0.2};
        smoothed.operation = Operation::smooth;
        elsewhere.start.position_m = elsewhere.end.position_m = Vec3(0.5, 0.05, 0.3);
        const std::vector<ToolSweep> sweeps{cut, smoothed, elsewhere};
        ASSERT_TRUE(carved.begin(sweeps) && alone->begin(sweeps));
        // Lost, the device fails between what the host does: nothing of the update may be carried out twice.
        own->core()->lose_at_next_submit = is_lost;
        const auto delta = carved.take(Wait::yes), expected = alone->take(Wait::yes);
        ASSERT_TRUE(delta && *delta && expected && *expected);
        EXPECT_EQ(std::string(carved.name()), is_lost ? "cpu" : "vulkan");
        EXPECT_EQ(first_difference(carved.solid(), alone->solid()), "") << is_lost;
        EXPECT_EQ((*delta)->stats.rays_touched, (*expected)->stats.rays_touched) << is_lost;
        EXPECT_EQ(first_held((*delta)->changes), first_held((*expected)->changes)) << is_lost;
        surface.update(carved.solid(), (*delta)->changes, pool, (*delta)->made ? &*(*delta)->made : nullptr);
        anew.mesh_all(alone->solid(), pool);
        EXPECT_EQ(first_difference(surface, anew), "") << is_lost;
    }
}

TEST_F(CellMakerGpu, WithoutUnifiedMemoryTheTilesAreTheSame) {
    capabilities().unified_memory = false;
    FollowedTwice carved(unit_cube(40), device(), {.cells = {.tiles = 4}});
    for (const BallSweep& sweep : stroke_1000(50)) ASSERT_EQ(carved.carve(balls(std::span(&sweep, 1))), "");
    EXPECT_GT(carved.made(), 10u);
}

// The colour of a vertex is the material's.
TEST_F(CellMakerGpu, AMaterialThatIsAddedLaterHasItsColour) {
    FollowedTwice carved(unit_cube(32), device());
    BallSweep sweep{Vec3(0.5, 0.5, 1.0), Vec3(0.5, 0.5, 1.0), 0.2, 0};
    ASSERT_EQ(carved.carve(balls(std::span(&sweep, 1))), "");
    geometry::Material red;
    red.colour = {255, 0, 0};
    const auto added = carved.engine().add_material(red);
    ASSERT_TRUE(added);
    sweep.material = *added;
    sweep.operation = Operation::paint;
    ASSERT_EQ(carved.carve(balls(std::span(&sweep, 1))), "");
    EXPECT_EQ(carved.made(), 2u);
}

}  // namespace burin::compute::test
