// SPDX-License-Identifier: MIT
// What the output tests share: pictures whose pixels say where they come from, and PNG files read back.
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <string>

#include "base/image.hpp"
#include "wall/stereo_mode.hpp"

namespace burin::renderer {

inline Image filled(ImageSize size, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    Image image{size, std::vector<std::uint8_t>(std::size_t{4} * size.width * size.height, 255)};
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        image.rgba[i] = r;
        image.rgba[i + 1] = g;
        image.rgba[i + 2] = b;
    }
    return image;
}

inline std::uint8_t* pixel_of(Image& image, std::uint32_t x, std::uint32_t y) {
    return image.rgba.data() + 4 * (std::size_t{y} * image.size.width + x);
}

// Red is the column, green the row, blue the eye. Up to 256 pixels each way.
inline Image map_of(ImageSize size, wall::Eye eye) {
    Image image = filled(size, 0, 0, eye == wall::Eye::left ? 60 : 200);
    for (std::uint32_t y = 0; y < size.height; ++y) {
        for (std::uint32_t x = 0; x < size.width; ++x) {
            pixel_of(image, x, y)[0] = static_cast<std::uint8_t>(x);
            pixel_of(image, x, y)[1] = static_cast<std::uint8_t>(y);
        }
    }
    return image;
}

// The pair of the golden pictures: gradients of all values, with an eye's own mark: a bar on the left or on the right,
// level or upright.
inline Image marked_gradient(ImageSize size, wall::Eye eye) {
    Image image = filled(size, 0, 0, 0);
    for (std::uint32_t y = 0; y < size.height; ++y) {
        for (std::uint32_t x = 0; x < size.width; ++x) {
            std::uint8_t* p = pixel_of(image, x, y);
            p[0] = static_cast<std::uint8_t>(255 * x / (size.width - 1));
            p[1] = static_cast<std::uint8_t>(255 * y / (size.height - 1));
            p[2] = static_cast<std::uint8_t>(255 * (x + y) / (size.width + size.height - 2));
            const bool left_mark = x >= 3 && x < 13 && y >= 4 && y < 7;
            const bool right_mark = x >= size.width - 7 && x < size.width - 4 && y >= 4 && y < 14;
            if (eye == wall::Eye::left ? left_mark : right_mark) p[0] = p[1] = p[2] = 255;
        }
    }
    return image;
}

inline std::filesystem::path golden_path(wall::StereoMode mode) {
    return std::filesystem::path("tests/renderer/golden") / ("output_" + std::string(file_name_of(mode)) + ".png");
}

// An empty picture, and a failed test, where the file cannot be read.
inline Image read_png(const std::filesystem::path& path) {
    png_image reader{};
    reader.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&reader, path.c_str()) == 0) {
        ADD_FAILURE() << path << ": " << reader.message;
        return {};
    }
    reader.format = PNG_FORMAT_RGBA;
    Image image{{reader.width, reader.height}, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(reader))};
    EXPECT_NE(png_image_finish_read(&reader, nullptr, image.rgba.data(), 0, nullptr), 0) << path;
    return image;
}

// The greatest difference of two pictures of one size in any channel; 1000 when the sizes differ.
inline int greatest_difference(const Image& a, const Image& b) {
    if (a.rgba.size() != b.rgba.size() || a.size.width != b.size.width) return 1000;
    int greatest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        greatest = std::max(greatest, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    return greatest;
}

}  // namespace burin::renderer
