// SPDX-License-Identifier: MIT
// Few rectangles hold many and little else, whatever these are.
#include "renderer/frame/redraw.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace burin::renderer {
namespace {

bool part_holds(const PixelRect& part, std::uint32_t x, std::uint32_t y) {
    return x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height;
}

std::uint64_t area(const std::vector<PixelRect>& parts) {
    std::uint64_t sum = 0;
    for (const PixelRect& part : parts) sum += std::uint64_t{part.width} * part.height;
    return sum;
}

TEST(FewParts, HoldEveryPixelOfManyAndStayWithinThePicture) {
    std::mt19937 random{3};
    for (int round = 0; round < 300; ++round) {
        const ImageSize size{20 + static_cast<std::uint32_t>(random() % 300),
                             20 + static_cast<std::uint32_t>(random() % 300)};
        std::vector<PixelRect> rects(random() % 12);
        for (PixelRect& r : rects) {
            r.x = static_cast<std::uint32_t>(random() % size.width);
            r.y = static_cast<std::uint32_t>(random() % size.height);
            r.width = std::min<std::uint32_t>(static_cast<std::uint32_t>(random() % 60), size.width - r.x);
            r.height = std::min<std::uint32_t>(static_cast<std::uint32_t>(random() % 60), size.height - r.y);
        }
        const std::vector<PixelRect> parts = damage_rectangles(rects, size);
        for (const PixelRect& part : parts) {
            ASSERT_FALSE(part.empty());
            ASSERT_TRUE(part.x + part.width <= size.width && part.y + part.height <= size.height);
        }
        for (const PixelRect& r : rects)
            for (std::uint32_t y = r.y; y < r.y + r.height; ++y)
                for (std::uint32_t x = r.x; x < r.x + r.width; ++x)
                    ASSERT_TRUE(
                        std::ranges::any_of(parts, [&](const PixelRect& part) { return part_holds(part, x, y); }))
                        << "round " << round << ": " << x << ", " << y;
    }
}

TEST(FewParts, AreApartWhereMuchElseLiesBetween) {
    const ImageSize size{1280, 720};
    const std::vector<PixelRect> far{{10, 10, 50, 50}, {900, 600, 60, 60}};
    EXPECT_EQ(damage_rectangles(far, size).size(), 2u);
    const std::vector<PixelRect> near{{10, 10, 50, 50}, {50, 40, 40, 40}};
    EXPECT_EQ(damage_rectangles(near, size).size(), 1u);
    // A slanting rod: one rectangle around it would be ten times as much.
    std::vector<PixelRect> rod;
    for (std::uint32_t i = 0; i < 20; ++i) rod.push_back({100 + 25 * i, 100 + 25 * i, 30, 30});
    const std::vector<PixelRect> parts = damage_rectangles(rod, size);
    EXPECT_LE(parts.size(), 10u);
    EXPECT_LT(3 * area(parts), 500u * 500u);
}

TEST(FewParts, OfNothingAreNoneAndOfMostOfItAreAll) {
    const ImageSize size{200, 100};
    EXPECT_TRUE(damage_rectangles({}, size).empty());
    const std::vector<PixelRect> nothing{{5, 5, 0, 3}};
    EXPECT_TRUE(damage_rectangles(nothing, size).empty());
    const std::vector<PixelRect> most{{0, 0, 190, 95}};
    EXPECT_EQ(damage_rectangles(most, size), std::vector<PixelRect>{all_of(size)});
}

}  // namespace
}  // namespace burin::renderer
