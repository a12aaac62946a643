// SPDX-License-Identifier: MIT
#include "picture/png.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <fstream>
#include <random>

namespace burin::picture {

namespace {

Image noise(std::uint32_t width, std::uint32_t height) {
    std::mt19937 random(3);
    Image image{{width, height}, std::vector<std::uint8_t>(std::size_t{4} * width * height, 255)};
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = static_cast<std::uint8_t>(random());
    }
    return image;
}

std::filesystem::path scratch_folder() {
    const auto folder =
        std::filesystem::temp_directory_path() / ("burin_png_" + std::to_string(std::random_device{}()));
    std::filesystem::create_directory(folder);
    return folder;
}

std::size_t files_in(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

}  // namespace

TEST(Png, ReadsBackWhatWasWritten) {
    const auto folder = scratch_folder();
    const auto path = folder / "noise.png";
    const Image image = noise(37, 21);
    const auto written = write_png(path, image);
    ASSERT_TRUE(written) << written.error().line();
    EXPECT_EQ(files_in(folder), 1u) << "a temporary file was left behind";

    png_image reader{};
    reader.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&reader, path.c_str()), 0);
    ASSERT_EQ(reader.width, 37u);
    ASSERT_EQ(reader.height, 21u);
    reader.format = PNG_FORMAT_RGBA;
    std::vector<std::uint8_t> rgba(PNG_IMAGE_SIZE(reader));
    ASSERT_NE(png_image_finish_read(&reader, nullptr, rgba.data(), 0, nullptr), 0);
    EXPECT_EQ(rgba, image.rgba);
    std::filesystem::remove_all(folder);
}

TEST(Png, GivesTheSameBytesForTheSamePicture) {
    const auto a = encode_png(noise(64, 48)), b = encode_png(noise(64, 48));
    ASSERT_TRUE(a && b);
    EXPECT_EQ(*a, *b);
}

TEST(Png, NamesTheFileItCannotWriteAndLeavesNothingBehind) {
    const auto folder = scratch_folder();
    const auto path = folder / "missing" / "a.png";
    const auto refused = write_png(path, noise(2, 2));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("a.png"), std::string::npos) << refused.error().line();
    EXPECT_EQ(files_in(folder), 0u);
    std::filesystem::remove_all(folder);
}

TEST(Png, RefusesAPictureWithoutPixelsAndKeepsTheOldFile) {
    const auto folder = scratch_folder();
    const auto path = folder / "kept.png";
    std::ofstream(path) << "old";
    EXPECT_FALSE(write_png(path, Image{}));
    EXPECT_FALSE(write_png(path, Image{{10, 10}, {1, 2, 3}}));
    EXPECT_EQ(std::filesystem::file_size(path), 3u);
    std::filesystem::remove_all(folder);
}

TEST(SideBySide, PutsTheLeftEyesViewOnTheLeft) {
    StereoImage stereo{{{2, 2}, std::vector<std::uint8_t>(16, 10)}, {{2, 2}, std::vector<std::uint8_t>(16, 200)}};
    const Image both = side_by_side(stereo);
    ASSERT_EQ(both.size.width, 4u);
    ASSERT_EQ(both.size.height, 2u);
    for (std::uint32_t y = 0; y < 2; ++y) {
        for (std::uint32_t x = 0; x < 4; ++x) EXPECT_EQ(*both.pixel(x, y), x < 2 ? 10 : 200);
    }
}

}  // namespace burin::picture
