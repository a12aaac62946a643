// SPDX-License-Identifier: MIT
// What begin() and take() promise of every engine: one body of tests, run with the processor's and with a device's.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "tests/compute/effort.hpp"
#include "tests/compute/engine_pair.hpp"

namespace burin::compute::test {

using Work = std::variant<std::vector<ToolSweep>, RayBatch>;
using MakeEngine = std::function<std::unique_ptr<CarvingEngine>(const Solid& solid)>;

// Mostly balls, some other tools, a quarter of all that smooths, and rays that are assigned.
[[nodiscard]] inline Work any_work(Random& random, const Lattice& lattice) {
    const auto somewhere = [&] { return Vec3(random.between(-0.1, 1.1), random.unit(), random.unit()); };
    if (random.chance(0.2)) {
        RayBatch emptied;
        const int v = random.small(1, lattice.rays_v(1) - 2);
        for (int u = 1; u < lattice.rays_u(1) - 1; ++u) emptied.add(shared::ray_code(1, u, v), {});
        return emptied;
    }
    std::vector<ToolSweep> sweeps;
    for (int i = random.small(1, 3); i > 0; --i) {
        ToolSweep sweep{.shape = BallTool{random.between(0.05, 0.2)}, .start = {}, .end = {}};
        if (random.chance(0.2)) sweep.shape = CylinderTool{random.between(0.05, 0.15), 0.3};
        if (random.chance(0.1)) sweep.shape = BoxTool{Vec3(0.1, 0.05, 0.08)};
        if (random.chance(0.1)) sweep.shape = ConeTool{0.02, random.between(0.05, 0.15), 0.2};
        sweep.start.position_m = somewhere();
        sweep.end.position_m = random.chance(0.3) ? sweep.start.position_m : somewhere();
        sweep.operation = static_cast<Operation>(random.small(0, 3));
        sweep.material = static_cast<std::uint8_t>(random.small(0, 1));
        sweep.smooth_strength = random.unit();
        sweeps.push_back(std::move(sweep));
    }
    return sweeps;
}

[[nodiscard]] inline Ticket begin(CarvingEngine& engine, const Work& work) {
    const auto* const rays = std::get_if<RayBatch>(&work);
    const auto ticket = rays != nullptr ? engine.begin(*rays) : engine.begin(std::get<std::vector<ToolSweep>>(work));
    EXPECT_TRUE(ticket) << ticket.error().line();
    return ticket ? *ticket : 0;
}

// Which rays have changed, and what each held before its first change. The processor records each ball's change of a
// ray, the device the change of all balls of an update.
[[nodiscard]] inline std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, std::uint32_t>>> first_held(
    const Changes& changes) {
    std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, std::uint32_t>>> held;
    for (const shared::ChangedRay& ray : changes.rays) {
        const auto [at, is_first] = held.try_emplace(ray.ray);
        if (!is_first) continue;
        for (const shared::DexelEnd& end : changes.before_of(ray))
            at->second.emplace_back(end.depth_material, end.normal);
    }
    return held;
}

// The solid on the host is the one after the last update that was taken, however many were begun.
inline void takes_updates_one_by_one(const MakeEngine& make, std::uint64_t seed) {
    Random random(seed);
    WorkerPool pool(1);
    const Solid solid = unit_cube(random.small(16, 40));
    const auto engine = make(solid), alone = make_cpu_engine(solid, pool);
    std::vector<Work> works;
    std::size_t taken = 0;
    for (int round = 0; round < 4; ++round) {
        for (int i = random.small(1, 4); i > 0; --i) {
            works.push_back(any_work(random, solid.lattice));
            ASSERT_EQ(begin(*engine, works.back()), works.size());
        }
        ASSERT_EQ(engine->under_way(), works.size() - taken);
        for (std::size_t left = static_cast<std::size_t>(random.small(0, 2)); engine->under_way() > left;) {
            ASSERT_TRUE(engine->solid().same_content(alone->solid())) << "before update " << taken + 1;
            const auto delta = engine->take(Wait::yes);
            ASSERT_TRUE(delta && *delta);
            EXPECT_EQ((*delta)->ticket, ++taken);
            ASSERT_EQ(begin(*alone, works[taken - 1]), taken);
            const auto expected = alone->take(Wait::yes);
            ASSERT_TRUE(expected && *expected);
            EXPECT_EQ((*delta)->stats.rays_touched, (*expected)->stats.rays_touched);
            EXPECT_EQ((*delta)->stats.rays_changed, (*expected)->stats.rays_changed);
            EXPECT_EQ(first_held((*delta)->changes), first_held((*expected)->changes));
        }
        ASSERT_EQ(first_difference(engine->solid(), alone->solid()), "") << "after update " << taken;
    }
}

// Taken as they are done, updates may come together, but none is lost and their order stays.
inline void takes_updates_as_they_are_done(const MakeEngine& make, std::uint64_t seed) {
    Random random(seed);
    WorkerPool pool(1);
    const Solid solid = unit_cube(random.small(16, 40));
    const auto engine = make(solid), alone = make_cpu_engine(solid, pool);
    Solid back = solid;
    Ticket taken = 0, begun = 0;
    std::vector<Changes> all;
    while (begun < 12 || engine->under_way() > 0) {
        if (begun < 12) {
            const Work work = any_work(random, solid.lattice);
            ASSERT_EQ(begin(*engine, work), ++begun);
            ASSERT_EQ(begin(*alone, work), begun);
            ASSERT_TRUE(alone->take(Wait::yes));
        }
        auto delta = engine->take(random.chance(0.5) ? Wait::no : Wait::briefly);
        ASSERT_TRUE(delta);
        if (!*delta) continue;
        EXPECT_GT((*delta)->ticket, taken);
        taken = (*delta)->ticket;
        EXPECT_EQ(engine->under_way(), begun - taken);
        all.push_back(std::move((*delta)->changes));
    }
    EXPECT_EQ(taken, begun);
    EXPECT_EQ(first_difference(engine->solid(), alone->solid()), "");
    back = engine->solid();
    for (auto changes = all.rbegin(); changes != all.rend(); ++changes) {
        for (auto ray = changes->rays.rbegin(); ray != changes->rays.rend(); ++ray) {
            const RayPlace place = place_of(ray->ray);
            back.sets[static_cast<std::size_t>(place.axis)].replace(place.u, place.v, changes->before_of(*ray));
        }
    }
    EXPECT_EQ(first_difference(back, solid), "") << "the changes do not lead back";
}

inline void refuses_a_bad_sweep_and_begins_nothing(const MakeEngine& make) {
    const Solid solid = unit_cube(16);
    const auto engine = make(solid);
    ToolSweep good{.shape = BallTool{0.2}, .start = {}, .end = {}}, bad = good;
    bad.shape = CylinderTool{-1.0, 0.2};
    EXPECT_FALSE(engine->begin(std::vector{good, bad}));
    EXPECT_EQ(engine->under_way(), 0u);
    const auto taken = engine->take(Wait::yes);
    ASSERT_TRUE(taken);
    EXPECT_FALSE(*taken);
    EXPECT_TRUE(engine->solid().same_content(solid));
    EXPECT_EQ(begin(*engine, std::vector{good}), 1u) << "what was refused is not counted";
}

}  // namespace burin::compute::test
