// SPDX-License-Identifier: MIT
#include "desk/present/window_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace burin::session {

// The lower row of a cave's windows once hung below the monitor.
TEST(WindowRows, ACavesFourWindowsAreWhollyOnOneMonitorAndKeepTheirShape) {
    for (const ImageSize monitor : {ImageSize{1280, 720}, {1920, 1080}, {3840, 2160}, {1080, 1920}}) {
        const std::vector<ImageSize> cave{{960, 720}, {1280, 720}, {960, 720}, {1280, 960}};
        const auto placed = side_by_side(cave, monitor);
        ASSERT_EQ(placed.size(), cave.size());
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const auto [x, y, size] = placed[i];
            EXPECT_GE(x, 0);
            EXPECT_GE(y, 20) << "its title is seen as well";
            EXPECT_LE(x + static_cast<int>(size.width), static_cast<int>(monitor.width));
            EXPECT_LE(y + static_cast<int>(size.height), static_cast<int>(monitor.height));
            EXPECT_NEAR(static_cast<double>(size.width) / size.height,
                        static_cast<double>(cave[i].width) / cave[i].height, 0.02);
            for (std::size_t k = 0; k < i; ++k) {
                const bool apart = placed[k].x + static_cast<int>(placed[k].size.width) <= x ||
                                   placed[k].y + static_cast<int>(placed[k].size.height) <= y;
                EXPECT_TRUE(apart) << k << " lies under " << i;
            }
        }
    }
    const std::vector<ImageSize> two{{900, 700}, {900, 700}};
    for (const PlacedWindow& one : side_by_side(two, {1920, 1080})) EXPECT_EQ(one.size, (ImageSize{900, 700}));
}

}  // namespace burin::session
