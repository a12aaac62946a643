// SPDX-License-Identifier: MIT
#include "compute/vulkan/standby_engine.hpp"
#include "tests/compute/updates.hpp"
#include "tests/compute/vulkan_engine_fixture.hpp"

namespace burin::compute::test {
namespace {

class UpdatesOfADevice : public VulkanEngineGpu {
protected:
    [[nodiscard]] MakeEngine on_vulkan(const VulkanEngineOptions& options = {}) {
        return [this, options](const Solid& solid) -> std::unique_ptr<CarvingEngine> {
            auto made = VulkanEngine::create(Solid(solid), device(), pool_, options);
            EXPECT_TRUE(made) << made.error().line();
            return std::move(*made);
        };
    }
};

}  // namespace

TEST_F(UpdatesOfADevice, AreTakenOneByOne) {
    for (int round = 0; round < repeated(4); ++round) {
        const auto seed = static_cast<std::uint64_t>(300 + round);
        takes_updates_one_by_one(on_vulkan(), seed);
        takes_updates_one_by_one(
            on_vulkan({.spare_ends = 0, .export_per_ray = 0, .tasks_a_pass = 2, .spans_a_ray = 0, .smooth_percent = 0}),
            seed);
    }
}

TEST_F(UpdatesOfADevice, AreTakenAsTheyAreDone) {
    for (int round = 0; round < repeated(4); ++round)
        takes_updates_as_they_are_done(on_vulkan(), static_cast<std::uint64_t>(400 + round));
}

TEST_F(UpdatesOfADevice, AreNotBegunWithABadSweep) { refuses_a_bad_sweep_and_begins_nothing(on_vulkan()); }

// Whichever update is the first to notice the loss, those that were begun and not taken are carried out.
TEST_F(UpdatesOfADevice, AreCarriedOutByTheProcessorWhereItIsLost) {
    for (int lost_at = 0; lost_at < repeated(6); ++lost_at) {
        Random random(static_cast<std::uint64_t>(500 + lost_at));
        const Solid solid = unit_cube(24);
        auto own = gpu::Device::create({.validation = true});
        ASSERT_TRUE(own);
        StandbyEngine engine(solid, *own, pool_);
        const auto alone = make_cpu_engine(solid, pool_);
        Ticket taken = 0;
        for (Ticket number = 1; number <= 8; ++number) {
            if (number == static_cast<Ticket>(lost_at)) own->core()->lose_at_next_submit = true;
            const Work work = any_work(random, solid.lattice);
            ASSERT_EQ(begin(engine, work), number);
            ASSERT_EQ(begin(*alone, work), number);
            ASSERT_TRUE(alone->take(Wait::yes));
            while (engine.under_way() > (number < 8 ? 2u : 0u)) {
                const auto delta = engine.take(number < 8 ? Wait::briefly : Wait::yes);
                ASSERT_TRUE(delta);
                if (!*delta) continue;
                EXPECT_GT((*delta)->ticket, taken);
                taken = (*delta)->ticket;
            }
        }
        EXPECT_EQ(taken, 8u);
        EXPECT_EQ(first_difference(engine.solid(), alone->solid()), "") << "lost at " << lost_at;
        EXPECT_LE(engine.take_notices().size(), 1u);
    }
}

// A device that rounds otherwise cuts with balls; the other tools are the processor's, and that is said once.
TEST_F(UpdatesOfADevice, LeaveToolsToTheProcessorWhereItRoundsOtherwise) {
    VulkanEngineOptions rounds_otherwise;
    rounds_otherwise.roundings[7].rounded.quotient += 1e-9;
    const Solid solid = unit_cube(24);
    StandbyEngine engine(solid, device(), pool_, rounds_otherwise);
    const auto alone = make_cpu_engine(solid, pool_);
    ToolSweep ball{.shape = BallTool{0.2}, .start = {}, .end = {}};
    ball.end.position_m = Vec3(0.4);
    ToolSweep cylinder = ball;
    cylinder.shape = CylinderTool{0.1, 0.3};
    cylinder.start.position_m = Vec3(0.2, 0.6, 0.5);
    std::vector<std::size_t> notices;
    for (const ToolSweep& sweep : {ball, cylinder, ball, cylinder}) {
        const auto done = engine.carve({&sweep, 1}), expected = alone->carve({&sweep, 1});
        ASSERT_TRUE(done && expected);
        EXPECT_EQ(done->rays_changed, expected->rays_changed);
        notices.push_back(engine.take_notices().size());
    }
    EXPECT_EQ(notices, (std::vector<std::size_t>{0, 1, 0, 0})) << "it is said when it first matters";
    EXPECT_STREQ(engine.name(), "vulkan") << "balls stay the device's";
    EXPECT_EQ(first_difference(engine.solid(), alone->solid()), "");
}

}  // namespace burin::compute::test
