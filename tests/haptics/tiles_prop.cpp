// SPDX-License-Identifier: MIT
// The tiles of a carved surface as they are touched: the god-object on them and on the same triangles as loose ones,
// and the haptic loop on tiles that are carved meanwhile.
#include <gtest/gtest.h>

#include <set>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/channels.hpp"
#include "haptics/contact/god_object.hpp"
#include "haptics/contact/touching.hpp"
#include "haptics/contact/triangle_contact.hpp"
#include "haptics/realtime.hpp"
#include "tests/compute/random_solids.hpp"
#include "tests/haptics/rig.hpp"
#include "tests/haptics/workpiece.hpp"

namespace burin::haptics {
namespace {

using test::kToolRadius_m;
using test::Workpiece;

// The same triangles, relative to the same origin, one by one and in an order of their own.
geometry::LocalSurface loosened(const geometry::LocalSurface& tiles) {
    auto piece = std::make_shared<geometry::GriddedTriangles>();
    for (std::uint32_t id = tiles.triangles(); id-- > 0;) {
        const geometry::Triangle t = tiles.triangle(id);
        const auto first = static_cast<std::uint32_t>(piece->positions_m.size());
        for (const Vec3& corner : {t.a, t.b, t.c}) piece->positions_m.emplace_back(corner);
        piece->triangles.push_back({first, first + 1, first + 2});
    }
    geometry::build_search(*piece);
    geometry::LocalSurface loose = tiles;
    loose.tiles = {};
    loose.loose = std::move(piece);
    return loose;
}

geometry::LocalSurface tiles_around(const compute::Surface& surface, const Vec3& center_object, double radius_m) {
    geometry::LocalSurface local;
    compute::gather_local_surface(surface, center_object, radius_m, local);
    local.sequence = 1;
    return local;
}

// A walk of the hand over the surface and into it, one tick after another; each tick starts from one state on both.
void expect_alike(const geometry::LocalSurface& tiles, const geometry::LocalSurface& loose, const Vec3& about,
                  double reach, double tool_radius, std::uint64_t seed) {
    compute::test::Random random(seed);
    ProxyState state;
    Vec3 hip = about, way(0.0);
    // As many under the sanitizers: a shorter walk may not touch anything.
    constexpr int kTicks = 1500;
    int in_contact = 0, apart_by_more = 0;
    for (int i = 0; i < kTicks; ++i) {
        if (i % 40 == 0) {
            const Vec3 goal = about + reach * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
            way = (goal - hip) / 40.0;
        }
        hip += way;
        const ProxyResult a = move_proxy(state, hip, {tool_radius, false}, tiles);
        const ProxyResult b = move_proxy(state, hip, {tool_radius, false}, loose);
        ASSERT_EQ(a.pushed_out, b.pushed_out) << i;
        // Ties are broken in the order in which triangles come by: within the tolerances of god_object.hpp. A proxy
        // that is still on its way when its steps are used up may be a step ahead.
        const double apart = glm::length(a.next.position_object_m - b.next.position_object_m);
        if (!a.work_limited && !b.work_limited) {
            // On one plane both are within kTouch of it. Where planes meet, the places may be further apart than the
            // distances to the planes: by 1 / cos of half the angle between the normals, twice as far at 120 degrees.
            const double apart_at_most = (a.constraints > 1 && b.constraints > 1 ? 4.0 : 2.0) * kTouch * tool_radius;
            ASSERT_LT(apart, apart_at_most) << i << ", " << a.constraints << " planes";
        }
        apart_by_more += apart > 3e-5 * tool_radius;
        ASSERT_EQ(a.constraints > 0, b.constraints > 0) << i;
        in_contact += a.constraints > 0;
        state = a.next;
    }
    EXPECT_GT(in_contact, kTicks / 8);
    EXPECT_LE(apart_by_more, kTicks / 100);
}

// At one of many places on it; never less than it is.
double distance_from_way(const Vec3& from, const Vec3& to, const geometry::Triangle& t) {
    constexpr int kPlaces = 40;
    double least = HUGE_VAL;
    for (int i = 0; i <= kPlaces; ++i) {
        const Vec3 p = from + (static_cast<double>(i) / kPlaces) * (to - from);
        least = std::min(least, glm::length(p - nearest_on_triangle(p, t).point));
    }
    return least;
}

}  // namespace

TEST(TouchedTiles, EachTriangleNearAWayIsFoundOnceAndFewThatAreFar) {
    WorkerPool pool(2);
    Workpiece work;  // quads alone
    work.cut({-0.2, 0.4, 0.0}, {0.2, 0.4, 0.05});
    const compute::Solid noise =
        compute::test::noise_solid({20, 20, 20}, 0.4, compute::test::Rays::agree, 4);  // with fans
    compute::Surface noisy(noise.lattice);
    noisy.mesh_all(noise, pool);
    for (const compute::Surface* surface : {&*work.surface, &noisy}) {
        const double cell = surface->lattice().spacing_m;
        const Vec3 middle = surface == &noisy ? noise.lattice.origin_object + 10.0 * cell : Vec3(0.0, 0.4, 0.0);
        const geometry::LocalSurface tiles =
            tiles_around(*surface, middle, surface == &noisy ? 1e3 * cell : 2.0 * cell);
        ASSERT_GT(tiles.triangles(), 100u);
        compute::test::Random random(8);
        const auto place = [&] {
            const Vec3 off(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
            return middle - tiles.origin_object + 10.0 * cell * off;
        };
        for (int run = 0; run < compute::test::repeated(16); ++run) {
            const Vec3 from = place(), to = run % 4 == 0 ? from : from + random.between(0.01, 1.0) * (place() - from);
            const double reach = cell * random.between(0.3, 5.0);
            std::set<std::uint32_t> found;
            geometry::Near near{glm::min(from, to), glm::max(from, to), reach, UINT32_MAX, true, from, to};
            ASSERT_TRUE(
                geometry::for_each_triangle_near(tiles, near, [&](std::uint32_t id, const geometry::Triangle& t) {
                    EXPECT_TRUE(found.insert(id).second);
                    EXPECT_LT(distance_from_way(from, to, t), reach + 4.0 * cell);  // two corners of its quad's box
                    return true;
                }));
            for (std::uint32_t id = 0; id < tiles.triangles(); ++id) {
                const geometry::Triangle t = tiles.triangle(id);
                if (!geometry::is_degenerate(t) && distance_from_way(from, to, t) <= reach) {
                    ASSERT_TRUE(found.contains(id)) << run;
                }
            }
        }
    }
}

TEST(TouchedTiles, TheProxyGoesAsOnTheSameTrianglesLoose) {
    Workpiece work;
    work.cut({-0.2, 0.4, 0.0}, {0.2, 0.4, 0.05});
    const Vec3 top(0.0, 0.4, 0.0);
    const geometry::LocalSurface tiles = tiles_around(*work.surface, top, 0.5);
    const geometry::LocalSurface loose = loosened(tiles);
    ASSERT_EQ(tiles.triangles(), loose.triangles());
    // As large as the groove, smaller, larger, and of the size of a cell.
    const double cell = work.surface->lattice().spacing_m;
    for (const double radius : {0.98 * kToolRadius_m, 0.5 * kToolRadius_m, 1.7 * kToolRadius_m, cell}) {
        expect_alike(tiles, loose, top, 0.25, radius, 5);
    }
}

TEST(TouchedTiles, TheProxyGoesAsOnTheSameTrianglesLooseInNoiseWithFans) {
    WorkerPool pool(2);
    const compute::Solid solid = compute::test::noise_solid({24, 24, 24}, 0.4, compute::test::Rays::agree, 3);
    compute::Surface surface(solid.lattice);
    surface.mesh_all(solid, pool);
    const double cell = solid.lattice.spacing_m;
    const Vec3 middle = solid.lattice.origin_object + 12.0 * cell;
    const geometry::LocalSurface tiles = tiles_around(surface, middle, 1e3 * cell), loose = loosened(tiles);
    ASSERT_FALSE(tiles.tiles.places.front().tile->only_quads());
    // Larger than the gaps: it stays outside and rolls over the bumps.
    const Vec3 above = middle + Vec3(0.0, 16.0 * cell, 0.0);
    expect_alike(tiles, loose, above, 6.0 * cell, 3.0 * cell, 6);
}

TEST(TouchedTiles, TilesAndLooseTrianglesAreTouchedTogether) {
    // A loose plate over the ball: each is felt where it is.
    Workpiece work;
    geometry::LocalSurface both = tiles_around(*work.surface, Vec3(0.0), 1.0);
    auto plate = std::make_shared<geometry::GriddedTriangles>();
    for (const Vec3& p : {Vec3(0.5, 0.2, -0.5), Vec3(0.5, 0.2, 0.5), Vec3(1.0, 0.2, 0.5), Vec3(1.0, 0.2, -0.5)}) {
        plate->positions_m.emplace_back(p - both.origin_object);
    }
    plate->triangles = {{0, 1, 2}, {0, 2, 3}};
    geometry::build_search(*plate);
    both.loose = plate;
    std::set<std::uint32_t> ids;
    geometry::for_each_triangle_near(both, Vec3(-10.0), Vec3(10.0), [&](std::uint32_t id, const geometry::Triangle&) {
        ids.insert(id);
        return true;
    });
    EXPECT_EQ(ids.size(), work.surface->triangles() + 2);
    EXPECT_EQ(*ids.rbegin(), both.triangles() - 1);
    EXPECT_EQ(both.triangle(both.triangles() - 1).b, Vec3(plate->positions_m[2]));

    const double radius = 0.03;
    ProxyState state;
    for (const double y : {0.5, 0.3, 0.18}) state = move_proxy(state, {0.75, y, 0.0}, {radius}, both).next;
    EXPECT_NEAR(state.position_object_m.y, 0.2 + radius, 1e-6);
    state = {};
    for (const double y : {0.6, 0.45, 0.39}) state = move_proxy(state, {0.0, y, 0.0}, {radius}, both).next;
    EXPECT_NEAR(state.position_object_m.y, 0.4 + radius, 0.002);  // facets of a cell, 0.02, on a radius of 0.4
}

// Under the thread sanitizer: the loop reads tiles while others are made and the old ones freed.
TEST(TouchedTiles, TheHapticThreadReadsWhileTheCarvingSideMakesAndFreesTiles) {
    Workpiece work;
    MonotonicClock clock;
    std::vector<devices::HandPose> script;  // circles below the top: in contact from the first surface on
    for (int i = 0; i < 400; ++i) {
        script.push_back({0.02 * i, Vec3(0.05 * std::sin(0.3 * i), -0.005 * (4 + i % 3), 0.05 * std::cos(0.3 * i))});
    }
    devices::SimulatedOmni omni(*devices::SimulatedHand::create(script), {}, &clock);
    HapticChannels channels(1u << 14, 1u << 14);
    HapticLoop loop(omni, clock, channels);
    TickParameters& parameters = channels.parameters.draft();
    parameters.sequence = 1;
    parameters.probe.points[0].radius_m = kToolRadius_m;
    parameters.workspace.object_from_device.position_m = Vec3(0.0, 0.42, 0.0);
    parameters.workspace.object_from_device.scale = 4.0;
    channels.parameters.publish();
    HapticThread thread(loop);
    (void)thread.start();
    std::uint64_t published = 0, in_contact = 0, ticks = 0;
    TickRecord record;
    while (published < 150 || (in_contact == 0 && published < 3000)) {  // until the thread has ticked, on any machine
        const double a = 0.1 * static_cast<double>(published);
        const Vec3 at(0.2 * std::sin(a), 0.44 - 1e-4 * static_cast<double>(published % 300), 0.2 * std::cos(a));
        work.cut(at, at + Vec3(0.01, 0.0, 0.0));
        geometry::LocalSurface& draft = channels.surface.draft();
        compute::gather_local_surface(*work.surface, Vec3(0.0, 0.4, 0.0), 0.6, draft);
        draft.sequence = ++published;
        draft.made_ns = clock.now_ns();
        channels.surface.publish();
        clock.sleep_until(clock.now_ns() + 1'000'000);
        for (; channels.records.pop(record); ++ticks) in_contact += (record.flags & kTickInContact) != 0 ? 1u : 0u;
    }
    thread.stop();
    EXPECT_GT(ticks, 0u);
    EXPECT_GT(in_contact, 0u);
}

}  // namespace burin::haptics
