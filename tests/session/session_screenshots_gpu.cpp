// SPDX-License-Identifier: MIT
// The session that the README shows, step by step, against pictures that people have looked at (tests/app/golden/session). They hold at a
// quarter of the size, so that they weigh little; mean FLIP is what a viewer notices between two pictures (bench/flip.hpp).
// BURIN_UPDATE_GOLDEN=1 writes them anew: look at them before you commit them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "bench/flip.hpp"
#include "gpu/device.hpp"
#include "renderer/png.hpp"
#include "tests/app/run_command.hpp"
#include "tests/renderer/output_pictures.hpp"

namespace burin {
namespace {

constexpr std::uint32_t kSmaller = 4;
constexpr double kNoticed = 0.02;  // the same step of a session that went another way has 0.05 and more

Image smaller(const Image& image) {
    Image small{{image.size.width / kSmaller, image.size.height / kSmaller}, {}};
    small.rgba.reserve(std::size_t{4} * small.size.width * small.size.height);
    for (std::uint32_t y = 0; y < small.size.height; ++y) {
        for (std::uint32_t x = 0; x < small.size.width; ++x) {
            for (std::size_t c = 0; c < 4; ++c) {
                unsigned sum = 0;
                for (std::uint32_t k = 0; k < kSmaller * kSmaller; ++k)
                    sum += image.pixel(x * kSmaller + k % kSmaller, y * kSmaller + k / kSmaller)[c];
                small.rgba.push_back(static_cast<std::uint8_t>(sum / (kSmaller * kSmaller)));
            }
        }
    }
    return small;
}

std::filesystem::path golden_of(const std::string& step) {
    return std::filesystem::path("tests/app/golden/session") / (step + ".png");
}

}  // namespace

TEST(SessionScreenshots, LookAsTheyDidWhenSomebodyLooked) {
    if (const auto devices = gpu::list_devices(); !devices)
        GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    const Workplace place;
    const auto outcome = place.run(std::string("BURIN_VULKAN_VALIDATION=1 ") + BURIN_COMMAND +
                                   " sculpt --workpiece ball:0.1 --tool ball:0.01 --offscreen --input " +
                                   BURIN_SESSIONS + "/first-carve.txt");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(outcome.output.find("Vulkan validation"), std::string::npos) << outcome.output;
    std::vector<Image> steps;
    for (const std::string step : {"1-start", "2-carving", "3-carved", "4-undone", "5-painted", "6-anaglyph",
                                   "7-side-by-side", "8-workspace-box", "9-workspace-moved", "10-turned"}) {
        ASSERT_TRUE(std::filesystem::exists(place / (step + ".png"))) << step << "\n" << outcome.output;
        steps.push_back(smaller(read_png(place / (step + ".png"))));
        if (std::getenv("BURIN_UPDATE_GOLDEN") != nullptr) {  // NOLINT(concurrency-mt-unsafe)
            ASSERT_TRUE(write_png(golden_of(step), steps.back()));
        }
        const auto difference = bench::flip(read_png(golden_of(step)), steps.back());
        ASSERT_TRUE(difference) << step;
        EXPECT_LE(difference->mean, kNoticed) << step;
    }
    // That these pictures can tell one step from another.
    for (std::size_t i = 1; i < steps.size(); ++i) {
        if (steps[i].size != steps[i - 1].size) continue;
        EXPECT_GT(bench::flip(steps[i - 1], steps[i])->mean, 1e-4) << i;
    }
}

}  // namespace burin
