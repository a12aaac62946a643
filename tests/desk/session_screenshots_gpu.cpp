// SPDX-License-Identifier: MIT
// The session that the README shows, step by step, against pictures that people have looked at
// (tests/session/golden/session). They hold at a quarter of the size, so that they weigh little; mean FLIP is what a
// viewer notices between two pictures (bench/measure/flip.hpp). BURIN_UPDATE_GOLDEN=1 writes them anew: look at them
// before you commit them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "bench/measure/flip.hpp"
#include "gpu/device.hpp"
#include "picture/png.hpp"
#include "tests/renderer/output/output_pictures.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

constexpr std::uint32_t kSmaller = 4;
constexpr double kNoticed =
    0.02;  // in the whole picture: another panel, or another place of the scene, has 0.03 and more
// In the workpiece's rectangle alone. A stroke fills little of the picture: with and without the groove of step 3 whole
// pictures differ by 0.005, the rectangle by 0.04.
constexpr double kNoticedOnWorkpiece = 0.01;

// The ball, seen from the front in a picture of a quarter of the size, at the same place in all modes that show one
// picture.
constexpr PixelRect kWorkpiece{118, 36, 84, 84};
// Side by side, where a picture is half as wide.
constexpr PixelRect kLeftWorkpiece{59, 36, 42, 84}, kRightWorkpiece{160 + 59, 36, 42, 84};

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

Image part_of(const Image& image, const PixelRect& part) {
    Image cut{{part.width, part.height}, {}};
    cut.rgba.reserve(std::size_t{4} * part.width * part.height);
    for (std::uint32_t y = 0; y < part.height; ++y) {
        const std::uint8_t* row = image.pixel(part.x, part.y + y);
        cut.rgba.insert(cut.rgba.end(), row, row + std::size_t{4} * part.width);
    }
    return cut;
}

// 1, which no two pictures have, where they cannot be compared.
double difference(const Image& one, const Image& other) {
    const auto map = bench::flip(one, other);
    return map ? map->mean : 1.0;
}

std::vector<PixelRect> workpieces_in(const std::string& step) {
    if (step == "7-side-by-side") return {kLeftWorkpiece, kRightWorkpiece};
    return {kWorkpiece};
}

std::filesystem::path golden_of(const std::string& step) {
    return std::filesystem::path("tests/session/golden/session") / (step + ".png");
}

}  // namespace

TEST(SessionScreenshots, LookAsTheyDidWhenSomebodyLooked) {
    if (const auto devices = gpu::list_devices(); !devices)
        GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    const Workplace place;
    const auto outcome = place.run(std::string("BURIN_VULKAN_VALIDATION=1 ") + kBurinCommand +
                                   " sculpt --workpiece ball:0.1 --tool ball:0.01 --samples 1 --offscreen" +
                                   " --outputs . --input " + kSessionsFolder + "/first-carve.txt");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(outcome.output.find("Vulkan validation"), std::string::npos) << outcome.output;
    std::vector<Image> steps;
    for (const std::string step : {"1-start", "2-carving", "3-carved", "4-undone", "5-painted", "6-anaglyph",
                                   "7-side-by-side", "8-workspace-box", "9-workspace-moved", "10-turned"}) {
        ASSERT_TRUE(std::filesystem::exists(place / (step + ".png"))) << step << "\n" << outcome.output;
        steps.push_back(smaller(renderer::read_png(place / (step + ".png"))));
        if (std::getenv("BURIN_UPDATE_GOLDEN") != nullptr) {  // NOLINT(concurrency-mt-unsafe)
            ASSERT_TRUE(picture::write_png(golden_of(step), steps.back()));
        }
        const Image golden = renderer::read_png(golden_of(step));
        ASSERT_EQ(golden.size, steps.back().size) << step;
        EXPECT_LE(difference(golden, steps.back()), kNoticed) << step;
        for (const PixelRect& part : workpieces_in(step)) {
            EXPECT_LE(difference(part_of(golden, part), part_of(steps.back(), part)), kNoticedOnWorkpiece) << step;
        }
    }
    // That these pictures can tell one step from another.
    for (std::size_t i = 1; i < steps.size(); ++i) {
        if (steps[i].size != steps[i - 1].size) continue;
        EXPECT_GT(bench::flip(steps[i - 1], steps[i])->mean, 1e-4) << i;
    }
}

// A session in which nothing is carved, nothing comes back by an undo or nothing is painted shows in place of one step
// the picture of another one.
TEST(SessionScreenshots, TellAWorkpieceFromTheSameWithOneStrokeLess) {
    const auto workpiece = [](const char* step) { return part_of(renderer::read_png(golden_of(step)), kWorkpiece); };
    for (const auto& [with, without] :
         {std::pair{"2-carving", "1-start"}, {"3-carved", "4-undone"}, {"5-painted", "3-carved"}}) {
        EXPECT_GT(difference(workpiece(with), workpiece(without)), 3 * kNoticedOnWorkpiece) << with;
    }
}

}  // namespace burin::session
