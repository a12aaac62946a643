// SPDX-License-Identifier: MIT
// The fade of parallax at a screen's edges: what shaders/shared/parallax_fade.h promises.
#include "shaders/shared/parallax_fade.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/wall/wall_samples.hpp"
#include "wall/projection.hpp"

namespace burin::wall {
namespace {

constexpr float kBand = 0.2f;

struct Stage {
    Screen screen = screen_of(Wall{});
    Eyes eyes;
    Vec3 middle;
    float middle_to_screen_m;

    explicit Stage(const Pose& head, double apart_m = 0.063) : eyes(eyes_of({head, apart_m})) {
        middle = 0.5 * (eyes.left_world + eyes.right_world);
        middle_to_screen_m = static_cast<float>(distance_in_front(screen, middle));
    }
    [[nodiscard]] glm::vec4 clip(const Vec3& eye, const Vec3& p) const {
        return {off_axis_projection(screen, eye, 0.05, 100.0) * glm::dvec4(p, 1.0)};
    }
    [[nodiscard]] glm::vec4 faded(const Vec3& eye, const Vec3& p, float strength = 1.0f, float band = kBand) const {
        return shared::parallax_faded(clip(eye, p), clip(middle, p), middle_to_screen_m, strength, band);
    }
    [[nodiscard]] Vec2 on_screen(const glm::vec4& c) const { return {c.x / c.w, c.y / c.w}; }
};

const Pose kHead{{0.2, 1.2, 2.0}, turned(0.3, 0.1, 0.2)};

// A point before the screen whose middle view is at (x, y).
Vec3 point_seen_at(const Stage& stage, double x, double y, double in_front_m) {
    const Vec3 on_wall{1.524 * x, 1.143 * (1.0 - y), 0.0};
    return stage.middle + (on_wall - stage.middle) * (1.0 - in_front_m / stage.middle.z);
}

}  // namespace

TEST(ParallaxFade, LeavesWhatIsFarFromTheEdgesOrNotInFrontAlone) {
    const Stage stage(kHead);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> inside(-0.7, 0.7), anywhere(-1.5, 1.5), near(0.0, 1.2), far(-20.0, -1e-3);
    for (int i = 0; i < 10000; ++i) {
        const double x = inside(random), y = inside(random), z = near(random), a = anywhere(random),
                     b = anywhere(random);
        const double behind = far(random);
        for (const Vec3& eye : {stage.eyes.left_world, stage.eyes.right_world}) {
            const Vec3 p = point_seen_at(stage, x, y, z);
            EXPECT_EQ(stage.faded(eye, p), stage.clip(eye, p));
            const Vec3 q = point_seen_at(stage, a, b, behind);
            EXPECT_EQ(stage.faded(eye, q), stage.clip(eye, q));
            EXPECT_EQ(stage.faded(eye, p, 0.0f), stage.clip(eye, p));
        }
    }
}

TEST(ParallaxFade, LeavesNoParallaxAtTheEdge) {
    const Stage stage(kHead);
    for (double t = -1.0; t <= 1.0; t += 0.05) {
        for (const Vec2& at : {Vec2{-1, t}, Vec2{1, t}, Vec2{t, -1}, Vec2{t, 1}}) {
            for (const double z : {0.01, 0.3, 1.0, 1.7}) {
                const Vec3 p = point_seen_at(stage, at.x, at.y, z);
                const Vec2 left = stage.on_screen(stage.faded(stage.eyes.left_world, p));
                const Vec2 right = stage.on_screen(stage.faded(stage.eyes.right_world, p));
                EXPECT_LT(glm::length(left - right), 2e-5) << at.x << ' ' << at.y << ' ' << z;
                EXPECT_LT(glm::length(left - at), 2e-5);
            }
        }
    }
}

// The promise that removes window violations: no vertex before the screen is within the picture for one eye alone.
TEST(ParallaxFade, ShowsAVertexToBothEyesOrToNone) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> at(-1.3, 1.3), depth(0.0, 0.89), width(0.0, 0.5);
    int seen = 0, cut_before = 0;
    for (int i = 0; i < 40000; ++i) {
        // Eyes parallel to the wall and not: heads turned by up to a radian.
        const Stage stage({{at(random), 1.2 + 0.5 * at(random), 1.0 + depth(random)},
                           turned(at(random) / 1.3, 0.5 * at(random), at(random))});
        const Vec3 p = point_seen_at(stage, at(random), at(random), depth(random) * stage.middle.z);
        const float band = static_cast<float>(width(random));
        const auto within = [&](const glm::vec4& c, double margin) {
            const Vec2 n = stage.on_screen(c);
            return std::abs(n.x) <= 1.0 + margin && std::abs(n.y) <= 1.0 + margin;
        };
        const bool middle = within(stage.clip(stage.middle, p), 0.0);
        for (const Vec3& eye : {stage.eyes.left_world, stage.eyes.right_world}) {
            if (eye.z - p.z < 0.1 * stage.middle.z) continue;  // n below 1
            if (middle) {
                EXPECT_TRUE(within(stage.faded(eye, p, 1.0f, band), 1e-5));
            } else {
                EXPECT_FALSE(within(stage.faded(eye, p, 1.0f, band), -1e-5));
            }
            cut_before += within(stage.clip(eye, p), 0.0) != middle ? 1 : 0;
        }
        seen += middle ? 1 : 0;
    }
    EXPECT_GT(seen, 10000);
    EXPECT_GT(cut_before, 1000) << "without the fade there would be nothing to see";
}

// Along a hundred random lines through the room, steps on the screen shrink with the steps in the room.
TEST(ParallaxFade, IsContinuous) {
    const Stage stage(kHead);
    std::mt19937 random(3);
    for (int line = 0; line < 100; ++line) {
        const Vec3 from = Vec3{0, 1.1, 0.6} + random_vector(random, 1.7),
                   to = Vec3{0, 1.1, 0.6} + random_vector(random, 1.7);
        if (from.z > 1.85 || to.z > 1.85) continue;  // beside the eyes a place on the screen runs off to infinity
        for (const Vec3& eye : {stage.eyes.left_world, stage.eyes.right_world}) {
            constexpr int kSteps = 4000;
            Vec2 before = stage.on_screen(stage.faded(eye, from)),
                 plain_before = stage.on_screen(stage.clip(eye, from));
            for (int i = 1; i <= kSteps; ++i) {
                const Vec3 p = from + (to - from) * (static_cast<double>(i) / kSteps);
                const Vec2 now = stage.on_screen(stage.faded(eye, p)), plain = stage.on_screen(stage.clip(eye, p));
                // The fade's slope is at most 1.5 / band times the parallax; parallax and its slope are bounded here.
                ASSERT_LT(glm::length(now - before), 5.0 * glm::length(plain - plain_before) + 5e-3);
                before = now, plain_before = plain;
            }
        }
    }
}

// Where the eyes are nearly in the vertex's plane the fade goes out, so that what the near plane cuts is left alone.
TEST(ParallaxFade, GoesOutBeforeTheEyes) {
    const Stage stage({{0.2, 1.2, 2.0}, turned(0, 0, 0)});
    for (const double z : {1.9001, 1.95, 1.999, 2.0, 2.3}) {
        const Vec3 p{1.6, 1.2, z};
        EXPECT_EQ(stage.faded(stage.eyes.left_world, p), stage.clip(stage.eyes.left_world, p)) << z;
    }
    const Vec3 p = point_seen_at(stage, 0.99, 0.0, 1.79);
    EXPECT_NE(stage.faded(stage.eyes.left_world, p), stage.clip(stage.eyes.left_world, p));
}

TEST(ParallaxFade, KeepsDepth) {
    const Stage stage(kHead);
    const Vec3 p = point_seen_at(stage, 0.97, 0.2, 0.5);
    const glm::vec4 a = stage.clip(stage.eyes.left_world, p), b = stage.faded(stage.eyes.left_world, p);
    EXPECT_NE(a.x, b.x);
    EXPECT_EQ(a.z, b.z);
    EXPECT_EQ(a.w, b.w);
}

}  // namespace burin::wall
