// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "picture/panel_stand.hpp"

namespace burin::picture {
namespace {

double between(double least, double most) {
    return least + (most - least) * (*rc::gen::inRange(0, 1'000'001)) / 1'000'000.0;
}

Quat any_turn() {
    const Quat q(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
    return glm::length(q) > 0.1 ? glm::normalize(q) : Quat(1.0, 0.0, 0.0, 0.0);
}

// A wand there, whose -Z goes along that direction; turned about it in any way.
Pose pointing(const Vec3& from, const Vec3& along) {
    const Vec3 z = -glm::normalize(along);
    const Vec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0), z));
    return {from, glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z))};
}

constexpr ImageSize kPixels{340, 1080};

// The other way round: a pixel's place in the world is worked out first, then a wand is held somewhere before it.
RC_GTEST_PROP(PanelRay, FindsThePixelThatAWandWasPointedAt, ()) {
    const PanelStand stand{{{between(-2.0, 2.0), between(0.0, 2.0), between(-2.0, 2.0)}, any_turn()},
                           {between(0.2, 1.0), between(0.2, 2.0)}};
    const Vec2 pixel(between(0.001, 339.999), between(0.001, 1079.999));
    const Vec3 on_panel((pixel.x / 340.0 - 0.5) * stand.size_m.x, (0.5 - pixel.y / 1080.0) * stand.size_m.y, 0.0);
    const Vec3 hand_panel = on_panel + Vec3(between(-1.0, 1.0), between(-1.0, 1.0), between(0.1, 3.0));
    const Vec3 hand = stand.world_from_panel * hand_panel;
    const auto hit = panel_ray(stand, kPixels, pointing(hand, stand.world_from_panel * on_panel - hand));
    RC_ASSERT(hit.has_value());
    RC_ASSERT(glm::length(*hit - pixel) < 1e-6);
    // Pointed the other way, and from behind, it meets nothing.
    RC_ASSERT(!panel_ray(stand, kPixels, pointing(hand, hand - stand.world_from_panel * on_panel)));
    const Vec3 behind = stand.world_from_panel * Vec3(hand_panel.x, hand_panel.y, -hand_panel.z);
    RC_ASSERT(!panel_ray(stand, kPixels, pointing(behind, stand.world_from_panel * on_panel - behind)));
}

TEST(PanelRay, MissesBesideThePanelAndAlongIt) {
    const PanelStand stand = stand_of_width({{0.0, 1.5, 0.0}, Quat(1.0, 0.0, 0.0, 0.0)}, 0.34, kPixels);
    EXPECT_DOUBLE_EQ(stand.size_m.y, 1.08);
    const Vec3 ahead(0.0, 0.0, -1.0);
    EXPECT_TRUE(panel_ray(stand, kPixels, pointing({0.169, 1.5, 1.0}, ahead)));
    EXPECT_FALSE(panel_ray(stand, kPixels, pointing({0.171, 1.5, 1.0}, ahead)));
    EXPECT_FALSE(panel_ray(stand, kPixels, pointing({0.0, 2.05, 1.0}, ahead)));
    EXPECT_FALSE(panel_ray(stand, kPixels, pointing({-1.0, 1.5, 0.001}, {1.0, 0.0, 0.0})));
    EXPECT_FALSE(panel_ray(stand, kPixels, pointing({-1.0, 1.5, 0.0}, {1.0, 0.0, 0.0})));
}

TEST(PanelRay, PutsTheFirstPixelAtTheReadersUpperLeft) {
    const PanelStand stand = stand_of_width({{0.0, 1.5, 0.0}, Quat(1.0, 0.0, 0.0, 0.0)}, 0.34, kPixels);
    const auto hit = panel_ray(stand, kPixels, pointing({-0.1699, 1.5 + 0.5399, 1.0}, {0.0, 0.0, -1.0}));
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->x, 0.1, 1e-9);
    EXPECT_NEAR(hit->y, 0.1, 1e-9);
}

TEST(PanelRay, MissesWhenANumberIsNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const PanelStand stand = stand_of_width({}, 0.34, kPixels);
    EXPECT_FALSE(panel_ray(stand, kPixels, {{0.0, nan, 1.0}, Quat(1.0, 0.0, 0.0, 0.0)}));
    EXPECT_FALSE(panel_ray(stand, kPixels, {{0.0, 0.0, nan}, Quat(1.0, 0.0, 0.0, 0.0)}));
    EXPECT_FALSE(panel_ray(stand, kPixels, {{0.0, 0.0, 1.0}, Quat(nan, 0.0, 0.0, 0.0)}));
}

}  // namespace
TEST(PanelStand, HasItsCornersWhereTheRaysThroughTheCornersOfItsPictureMeetIt) {
    const PanelStand stand{{{0.3, 1.2, -0.4}, glm::angleAxis(0.7, glm::normalize(Vec3(1, 2, 3)))}, {0.5, 0.3}};
    const std::array corners = corners_world(stand);
    const ImageSize pixels{50, 30};
    const Vec3 ahead = stand.world_from_panel.orientation * Vec3(0, 0, 1);
    for (std::size_t i = 0; i < 4; ++i) {
        // A little inside, so that the ray meets it.
        const Vec3 inside = glm::mix(corners[i], stand.world_from_panel.position_m, 1e-6);
        const auto px = panel_ray(stand, pixels, {inside + 0.1 * ahead, stand.world_from_panel.orientation});
        ASSERT_TRUE(px) << i;
        EXPECT_NEAR(px->x, i % 2 == 0 ? 0.0 : 50.0, 1e-3);
        EXPECT_NEAR(px->y, i < 2 ? 30.0 : 0.0, 1e-3);
    }
}

}  // namespace burin::picture
