// SPDX-License-Identifier: MIT
#include "picture/png.hpp"

#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <system_error>

#include "base/file_io.hpp"

namespace burin::picture {

namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
    auto* bytes = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto* first = reinterpret_cast<const std::byte*>(data);
    bytes->insert(bytes->end(), first, first + size);
}

void ignore_flush(png_structp) {}
void ignore_warning(png_structp, png_const_charp) {}

// Constructs nothing with a destructor: libpng reports errors by longjmp.
bool write_rows(png_structp png, png_infop info, const Image& image, std::vector<std::byte>& bytes,
                std::vector<std::uint8_t>& row) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, &bytes, append, ignore_flush);
    png_set_IHDR(png, info, image.size.width, image.size.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (std::uint32_t y = 0; y < image.size.height; ++y) {
        const std::uint8_t* from = image.pixel(0, y);
        for (std::uint32_t x = 0; x < image.size.width; ++x) {
            for (std::uint32_t c = 0; c < 3; ++c) row[3 * x + c] = from[4 * x + c];
        }
        png_write_row(png, row.data());
    }
    png_write_end(png, info);
    return true;
}

}  // namespace

Result<std::vector<std::byte>> encode_png(const Image& image) {
    const std::size_t pixels = std::size_t{image.size.width} * image.size.height;
    if (pixels == 0 || image.rgba.size() != 4 * pixels) return fail("PNG", "the picture has no pixels or a wrong size");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, ignore_warning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    std::vector<std::byte> bytes;
    std::vector<std::uint8_t> row(std::size_t{3} * image.size.width);
    const bool written = info != nullptr && write_rows(png, info, image, bytes, row);
    png_destroy_write_struct(&png, &info);
    if (!written) return fail("PNG", "libpng could not encode the picture", "choose a smaller picture");
    return bytes;
}

Result<Image> load_png(const std::filesystem::path& path) {
    constexpr std::uint64_t kMostPixels = 64u << 20;
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    const auto refuse = [&](const std::string& what) {
        png_image_free(&png);
        return fail(path.string(), what, "give a PNG file, such as a screenshot");
    };
    if (png_image_begin_read_from_file(&png, path.c_str()) == 0)
        return refuse(std::string("cannot be read as PNG: ") + png.message);
    if (std::uint64_t{png.width} * png.height > kMostPixels) return refuse("has more than 64 million pixels");
    png.format = PNG_FORMAT_RGBA;
    Image image{{png.width, png.height}, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
    if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0)
        return refuse(std::string("is damaged: ") + png.message);
    return image;
}

Result<void> write_png(const std::filesystem::path& path, const Image& image) {
    const auto bytes = encode_png(image);
    if (!bytes) return fail(path.string(), bytes.error().what, bytes.error().remedy);
    return write_file_atomically(path, *bytes);
}

}  // namespace burin::picture
