// SPDX-License-Identifier: MIT
// What of a tool's surface is engaged, as a look around it tells, and when it looks.
#include "haptics/forces/engagement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/haptics/pressed_ball.hpp"

namespace burin::haptics {
using test::ball, test::flat, test::kPlenty, test::kRadius_m, test::pressing;

TEST(Engagement, OnAPlaneItIsTheCapWhateverTheTriangles) {
    for (const int squares : {4, 80, 400}) {
        const test::Surface plane = test::plane(0.05, squares);
        const Vec3 place(0.0011, kRadius_m, 0.0007);
        const Engagement seen = look_around(*plane, ball(), place, Quat(1, 0, 0, 0), 1, kPlenty).engagement;
        for (const double depth : {0.0006, 0.001, 0.0015}) {
            double section_m2 = 0.0;
            for (std::uint32_t i = 0; i < seen.count; ++i) {
                const EngagedSample& s = seen.samples[i];
                const ToolSample& on_tool = ball().samples[s.sample];
                const double height =
                    glm::dot(Vec3(s.normal), Vec3(on_tool.position_m)) - static_cast<double>(s.offset_m);
                EXPECT_GT(s.normal.y, 0.999f);
                if (height < depth) section_m2 -= static_cast<double>(s.area_m2 * on_tool.normal.y);
            }
            const double expected = test::engaged_areas(kRadius_m, depth).section_m2;
            EXPECT_NEAR(section_m2, expected, 0.15 * expected) << squares << ' ' << depth;
        }
    }
    const Engagement away =
        look_around(flat(), ball(), {0.0, 2.5 * kRadius_m, 0.0}, Quat(1, 0, 0, 0), 1, kPlenty).engagement;
    EXPECT_EQ(away.count, 0u);
}

TEST(Engagement, WorkComesToAnEndAndTheNextLookIsCoarser) {
    const test::Surface fine = test::plane(0.006, 200);
    CuttingState state;
    const CuttingInput in = pressing(0.001);
    const EngagementWork little{100'000, 2'000};
    std::uint32_t looks = 0;
    do {
        CuttingInput moved = in;
        moved.proxy_object_m.x += 0.11 * kRadius_m * (looks + 1);
        const LookedAt looked = look_at(state, moved, ball(), *fine, little);
        EXPECT_LE(looked.work.pieces, little.pieces);
        state.known = looked.known;
    } while (++looks < 12);
    EXPECT_GT(state.known.stride, 1u);
    ASSERT_GT(state.known.count, 10u);
    double area_m2 = 0.0;
    for (std::uint32_t i = 0; i < state.known.count; ++i)
        area_m2 += static_cast<double>(state.known.samples[i].area_m2);
    const Engagement whole =
        look_around(*fine, ball(), state.known.place_object_m, Quat(1, 0, 0, 0), 1, kPlenty).engagement;
    double whole_m2 = 0.0;
    for (std::uint32_t i = 0; i < whole.count; ++i) whole_m2 += static_cast<double>(whole.samples[i].area_m2);
    EXPECT_NEAR(area_m2, whole_m2, 0.1 * whole_m2);
}

// Where there are too many triangles even to be looked at, each so manieth stands for all; a tick that has nothing else
// to do affords so much. Before, a look that ran out of looks was made coarser without end and saw next to nothing: a
// ball of 8 mm went through a block at N = 512 as through air.
TEST(Engagement, AreasAreTheSameWhereThereAreMoreTrianglesThanLooks) {
    const test::Surface fine = test::plane(0.012, 240);
    CuttingState state;
    const EngagementWork few{8'300, 4'100};
    for (int i = 0; i < 20; ++i) {
        CuttingInput moved = pressing(0.001);
        moved.proxy_object_m.x += 0.11 * kRadius_m * (i + 1);
        const LookedAt looked = look_at(state, moved, ball(), *fine, few);
        EXPECT_LE(looked.work.looks, few.looks);
        state.known = looked.known;
    }
    const auto area_of = [](const Engagement& seen) {
        double area_m2 = 0.0;
        for (std::uint32_t i = 0; i < seen.count; ++i) area_m2 += static_cast<double>(seen.samples[i].area_m2);
        return area_m2;
    };
    const Engagement whole =
        look_around(*fine, ball(), state.known.place_object_m, Quat(1, 0, 0, 0), 1, kPlenty).engagement;
    ASSERT_GT(whole.count, 10u);
    EXPECT_GT(state.known.stride, 1u);
    EXPECT_NEAR(area_of(state.known), area_of(whole), 0.15 * area_of(whole));
}

// A contact that takes all of a tick's work for once must not make the tool blind for the next ones: what a coarser
// look misses it takes for air. Before, a box that was drawn through material at N = 512 met an eighth of it.
TEST(Engagement, ATickWithoutWorkLeavesTheLookAsFineAsItWas) {
    const test::Surface fine = test::plane(0.006, 200);
    CuttingState state;
    const CuttingInput in = pressing(0.001);
    state.known = look_at(state, in, ball(), *fine, kPlenty).known;
    const std::uint32_t stride = state.known.stride, count = state.known.count;
    ASSERT_GT(count, 10u);
    CuttingInput moved = in;
    moved.proxy_object_m.x += 0.11 * kRadius_m;
    for (int i = 0; i < 19; ++i) state.known = look_at(state, moved, ball(), *fine, {50, 25}).known;
    EXPECT_EQ(state.known.stride, stride);
    EXPECT_EQ(state.known.count, count);
    EXPECT_EQ(state.known.place_object_m, in.proxy_object_m) << "what is known is of the last whole look";
    state.known = look_at(state, moved, ball(), *fine, {50, 25}).known;
    EXPECT_GT(state.known.stride, stride) << "there never is enough";
}

TEST(Engagement, LooksAgainWhenTheSurfaceIsAnotherOrTheToolHasMovedOrTurned) {
    const test::Surface plane = test::plane(0.05, 40);
    CuttingInput in = pressing(0.001);
    CuttingState state;
    const auto looks = [&] {
        const LookedAt looked = look_at(state, in, ball(), *plane, kPlenty);
        state.known = looked.known;
        return looked.work.looks > 0;
    };
    EXPECT_TRUE(looks());
    EXPECT_FALSE(looks()) << "nothing is new";
    in.proxy_object_m.y -= 0.05 * kRadius_m;
    EXPECT_FALSE(looks());
    in.proxy_object_m.y -= 0.1 * kRadius_m;
    EXPECT_TRUE(looks());
    in.orientation_object = glm::angleAxis(0.15, Vec3(1.0, 0.0, 0.0));
    EXPECT_TRUE(looks());
    plane->sequence = 2;
    EXPECT_TRUE(looks());
}

TEST(Engagement, TheWayIntoTheMaterialIsAcrossItsFaceAndAGrooveDoesNotTiltIt) {
    EXPECT_GT(glm::dot(into_material(flat(), {0.001, 0.002, 0.0}, 0.005), Vec3(0.0, -1.0, 0.0)), 0.999);
    const test::Surface groove = test::groove(kRadius_m, 0.05, 24, 200, 0.0);
    EXPECT_GT(glm::dot(into_material(*groove, Vec3(0.0), 1.6 * kRadius_m), Vec3(0.0, -1.0, 0.0)), 0.999);
    EXPECT_EQ(into_material(flat(), {0.0, 0.02, 0.0}, 0.005), Vec3(0.0));
    // Of a place below the face, where strokes that are to cut mostly go.
    EXPECT_GT(glm::dot(into_material(flat(), {0.001, -0.002, 0.0}, 0.005), Vec3(0.0, -1.0, 0.0)), 0.999);
}

}  // namespace burin::haptics
