// SPDX-License-Identifier: MIT
#include "geometry/files/picture_decoders.hpp"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <string>

// jpeglib.h needs the types of stdio.h.
#include <jpeglib.h>

#include "geometry/files/picture.hpp"

namespace burin::geometry {
namespace {

constexpr const char* kTooManyPixels = "has more than 64 million pixels";
constexpr int kMostJpegScans = 100;  // a progressive file of thousands would take for ever

// ---- JPEG
// libjpeg reports errors by a function that must not return. Nothing with a destructor stands in what it leaves.

struct JpegFailure {
    jpeg_error_mgr manager;
    std::jmp_buf back;
    char what[JMSG_LENGTH_MAX];
};

void leave_jpeg(j_common_ptr info) {
    auto* failure = reinterpret_cast<JpegFailure*>(info->err);
    failure->manager.format_message(info, failure->what);
    std::longjmp(failure->back, 1);
}

void ignore_jpeg_message(j_common_ptr) {}

void count_jpeg_scans(j_common_ptr info) {
    if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= kMostJpegScans) return;
    auto* failure = reinterpret_cast<JpegFailure*>(info->err);
    std::snprintf(failure->what, sizeof(failure->what), "it has more than %d scans", kMostJpegScans);
    std::longjmp(failure->back, 1);
}

struct JpegReader {
    jpeg_decompress_struct info{};
    JpegFailure failure{};
    jpeg_progress_mgr progress{};
};

bool begin_jpeg(JpegReader& reader, std::span<const std::byte> bytes) {
    if (setjmp(reader.failure.back) != 0) return false;
    jpeg_create_decompress(&reader.info);
    reader.progress.progress_monitor = count_jpeg_scans;
    reader.info.progress = &reader.progress;
    jpeg_mem_src(&reader.info, reinterpret_cast<const unsigned char*>(bytes.data()),
                 static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&reader.info, TRUE);
    reader.info.out_color_space = JCS_RGB;
    // What will be halved anyway need not be decoded whole.
    const unsigned widest = std::max(reader.info.image_width, reader.info.image_height);
    reader.info.scale_num = 1;
    reader.info.scale_denom = widest > 4 * kWidestPicture ? 4 : widest > 2 * kWidestPicture ? 2 : 1;
    jpeg_calc_output_dimensions(&reader.info);
    return true;
}

bool read_jpeg(JpegReader& reader, std::uint8_t* to) {
    if (setjmp(reader.failure.back) != 0) return false;
    jpeg_start_decompress(&reader.info);
    while (reader.info.output_scanline < reader.info.output_height) {
        JSAMPROW row = to + std::size_t{3} * reader.info.output_width * reader.info.output_scanline;
        jpeg_read_scanlines(&reader.info, &row, 1);
    }
    jpeg_finish_decompress(&reader.info);
    return true;
}

}  // namespace

Result<DecodedPicture> decode_png(std::span<const std::byte> bytes) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    const auto refuse = [&](const std::string& what) {
        png_image_free(&png);
        return fail("", what);
    };
    if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0)
        return refuse(std::string("cannot be read as PNG: ") + png.message);
    if (std::uint64_t{png.width} * png.height > kMostPicturePixels) return refuse(kTooManyPixels);
    const bool is_grey = (png.format & PNG_FORMAT_FLAG_COLOR) == 0;
    png.format = PNG_FORMAT_RGBA;  // alpha is read, since libpng would mix a background into the colours
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
    if (png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr) == 0)
        return refuse(std::string("is a damaged PNG: ") + png.message);
    const std::size_t count = std::size_t{png.width} * png.height;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c) pixels[3 * i + c] = pixels[4 * i + c];
    pixels.resize(3 * count);
    return DecodedPicture{png.width, png.height, std::move(pixels), is_grey};
}

Result<DecodedPicture> decode_jpeg(std::span<const std::byte> bytes) {
    JpegReader reader;
    reader.info.err = jpeg_std_error(&reader.failure.manager);
    reader.failure.manager.error_exit = leave_jpeg;
    reader.failure.manager.output_message = ignore_jpeg_message;
    const auto refuse = [&](const std::string& what) {
        jpeg_destroy_decompress(&reader.info);
        return fail("", what);
    };
    if (!begin_jpeg(reader, bytes)) return refuse(std::string("is a damaged JPEG: ") + reader.failure.what);
    if (std::uint64_t{reader.info.image_width} * reader.info.image_height > kMostPicturePixels)
        return refuse(kTooManyPixels);
    if (reader.info.num_components > 3) return refuse("is a JPEG of four colours, for print");
    DecodedPicture picture;
    picture.width = reader.info.output_width;
    picture.height = reader.info.output_height;
    picture.is_grey = reader.info.num_components == 1;
    picture.rgb.resize(std::size_t{3} * picture.width * picture.height);
    if (!read_jpeg(reader, picture.rgb.data())) return refuse(std::string("is a damaged JPEG: ") + reader.failure.what);
    // The library makes up what is missing, and warns.
    if (reader.failure.manager.num_warnings > 0) return refuse("is a damaged JPEG: parts of it are missing");
    jpeg_destroy_decompress(&reader.info);
    return picture;
}

}  // namespace burin::geometry
