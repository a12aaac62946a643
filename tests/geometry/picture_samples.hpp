// SPDX-License-Identifier: MIT
// Pictures as files for the tests of geometry/, written by the libraries' own encoders.
#pragma once

#include <png.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <jpeglib.h>

namespace burin::geometry::test {

// Rows from the top, 3 bytes a pixel; with `grey` 1 byte.
inline std::string png_file(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& pixels,
                            bool grey = false) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = grey ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB;
    png_alloc_size_t size = 0;
    png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr);
    std::string bytes(size, '\0');
    png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr);
    return bytes;
}

inline std::string jpeg_file(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> pixels) {
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &bytes, &size);
    info.image_width = width;
    info.image_height = height;
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_start_compress(&info, TRUE);
    while (info.next_scanline < height) {
        JSAMPROW row = pixels.data() + std::size_t{3} * width * info.next_scanline;
        jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    std::string file(reinterpret_cast<const char*>(bytes), size);
    std::free(bytes);
    return file;
}

// 16 by 16 pixels of four colours: red, green above; blue, white below.
inline std::vector<std::uint8_t> four_colours() {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const bool right = x >= 8, below = y >= 8;
            pixels.push_back(right == below ? 255 : 0);
            pixels.push_back(right ? 255 : 0);
            pixels.push_back(below ? 255 : 0);
        }
    }
    return pixels;
}

}  // namespace burin::geometry::test
