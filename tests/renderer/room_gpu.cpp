// SPDX-License-Identifier: MIT
// The room's pixels that have neither grid nor shadow look the same when they are drawn by a shader that has neither.
#include <random>

#include "renderer/frame/scene_choice.hpp"
#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {
namespace {

picture::Picture some_room(std::mt19937& random) {
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    picture::Picture picture = bare_scene();
    picture.show_grid = true;
    picture.wall = {between(0.4, 3.0), between(0.3, 2.2)};
    picture.screen = wall::screen_of(picture.wall);
    picture.viewer.head_world.position_m = {between(-0.5, 0.5), between(0.1, 2.0), between(0.3, 2.5)};
    const Vec3 foot{between(-0.6, 0.6), 0.0, between(-2.6, 0.3)};
    const double height_m = between(0.02, 0.8), radius_m = between(0.03, 0.3);
    picture.pedestal = {foot + Vec3(0, height_m, 0), radius_m, {0.7, 0.7, 0.7}, random() % 4 != 0};
    if (random() % 4 != 0) {
        picture.workpiece_object.include(foot + Vec3(-radius_m, height_m, -radius_m));
        picture.workpiece_object.include(foot + Vec3(radius_m, height_m + 2.0 * radius_m, radius_m));
    }
    return picture;
}

}  // namespace

class Room : public gpu::DeviceTest {};

TEST_F(Room, LooksTheSameWhereGridAndShadowsAreLeftOut) {
    std::mt19937 random{11};
    for (const std::uint32_t samples : {1u, 0u}) {
        std::vector<Renderer> made;
        for (const bool plain : {true, false}) {
            auto renderer =
                Renderer::create(device(), kTestSize, {.samples = samples, .savings = {.plain_room = plain}});
            ASSERT_TRUE(renderer);
            made.push_back(std::move(*renderer));
        }
        std::uint64_t spared = 0;
        for (int round = 0; round < 30; ++round) {
            const picture::Picture picture = some_room(random);
            const auto tried = made[0].render(picture), full = made[1].render(picture);
            ASSERT_TRUE(tried && full);
            spared += made[0].stats().plain_room;
            ASSERT_EQ(made[1].stats().plain_room, 0u);
            for (const auto& [a, b] : {std::pair(&tried->left, &full->left), std::pair(&tried->right, &full->right)})
                for (std::size_t i = 0; i < a->rgba.size(); i += 4)
                    ASSERT_TRUE(same_colour(&a->rgba[i], &b->rgba[i], 1))  // rounding
                        << "round " << round << ", pixel " << i / 4 % kTestSize.width << ", "
                        << i / 4 / kTestSize.width;
        }
        EXPECT_GT(spared, std::uint64_t{10} * kTestSize.width * kTestSize.height) << "a third of all";
    }
}

// In every part of a picture a pixel is drawn once, and as in the whole picture.
TEST_F(Room, IsCoveredOnceAndInEachPartAsInTheWhole) {
    std::mt19937 random{12};
    for (int round = 0; round < 50; ++round) {
        const picture::Picture picture = some_room(random);
        const picture::Workpiece workpiece = picture::place_workpiece(picture, {}, 0.0);
        const PixelRect part{static_cast<std::uint32_t>(random() % 200), static_cast<std::uint32_t>(random() % 150),
                             1 + static_cast<std::uint32_t>(random() % 40),
                             1 + static_cast<std::uint32_t>(random() % 30)};
        std::vector<int> whole(std::size_t{kTestSize.width} * kTestSize.height, -1), in_part = whole;
        const auto fill = [&](std::vector<int>& looks, const PixelRect& of) {
            for (const RoomPart& p : room_parts(picture, workpiece, kTestSize, of))
                for (std::uint32_t y = p.rect.y; y < p.rect.y + p.rect.height; ++y)
                    for (std::uint32_t x = p.rect.x; x < p.rect.x + p.rect.width; ++x) {
                        int& look = looks[std::size_t{y} * kTestSize.width + x];
                        ASSERT_EQ(look, -1) << "twice";
                        look = static_cast<int>(p.look);
                    }
        };
        fill(whole, all_of(kTestSize));
        fill(in_part, part);
        for (std::uint32_t y = 0; y < kTestSize.height; ++y)
            for (std::uint32_t x = 0; x < kTestSize.width; ++x) {
                const std::size_t i = std::size_t{y} * kTestSize.width + x;
                const bool inside = x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height;
                ASSERT_GE(whole[i], 0);
                ASSERT_EQ(in_part[i], inside ? whole[i] : -1);
            }
    }
}

}  // namespace burin::renderer
