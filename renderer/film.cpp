// SPDX-License-Identifier: MIT
#include "renderer/film.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "base/try.hpp"
#include "picture/png.hpp"

namespace burin::renderer {
namespace {

constexpr std::size_t kSignatureBytes = 8, kHeaderBytes = 25, kChunkFrame = 12;  // length, name and checksum

std::uint32_t crc_of(std::span<const std::byte> bytes) {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> made{};
        for (std::uint32_t n = 0; n < 256; ++n) {
            std::uint32_t c = n;
            for (int k = 0; k < 8; ++k) c = (c & 1u) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
            made.at(n) = c;
        }
        return made;
    }();
    std::uint32_t c = 0xffffffffu;
    for (const std::byte b : bytes) c = table.at((c ^ std::to_integer<std::uint32_t>(b)) & 0xffu) ^ (c >> 8);
    return c ^ 0xffffffffu;
}

void append_number(std::vector<std::byte>& to, std::uint32_t number, int bytes = 4) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) to.push_back(static_cast<std::byte>(number >> shift));
}

std::uint32_t number_at(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i) number = (number << 8) | std::to_integer<std::uint32_t>(bytes[at + i]);
    return number;
}

void append_chunk(std::vector<std::byte>& to, std::string_view name, std::span<const std::byte> content) {
    append_number(to, static_cast<std::uint32_t>(content.size()));
    const std::size_t begin = to.size();
    for (const char c : name) to.push_back(static_cast<std::byte>(c));
    to.insert(to.end(), content.begin(), content.end());
    append_number(to, crc_of(std::span(to).subspan(begin)));
}

Image part_of(const Image& image, const PixelRect& rect) {
    Image part{{rect.width, rect.height}, {}};
    part.rgba.reserve(std::size_t{4} * rect.width * rect.height);
    for (std::uint32_t y = 0; y < rect.height; ++y) {
        const std::uint8_t* row = image.pixel(rect.x, rect.y + y);
        part.rgba.insert(part.rgba.end(), row, row + std::size_t{4} * rect.width);
    }
    return part;
}

// Calls a function for each chunk of a PNG file, with its name and its content.
template <typename Use>
void for_each_chunk(std::span<const std::byte> png, Use use) {
    for (std::size_t at = kSignatureBytes; at + kChunkFrame <= png.size();) {
        const std::size_t length = number_at(png, at);
        const std::string_view name(reinterpret_cast<const char*>(png.data() + at + 4), 4);
        use(name, png.subspan(at + 8, length));
        at += kChunkFrame + length;
    }
}

}  // namespace

PixelRect difference(const Image& a, const Image& b) {
    PixelRect rect;
    for (std::uint32_t y = 0; y < a.size.height; ++y) {
        const std::uint8_t *row = a.pixel(0, y), *other = b.pixel(0, y);
        if (std::memcmp(row, other, std::size_t{4} * a.size.width) == 0) continue;
        std::uint32_t from = 0, to = a.size.width;
        while (std::memcmp(row + 4 * from, other + 4 * from, 4) == 0) ++from;
        while (std::memcmp(row + 4 * (to - 1), other + 4 * (to - 1), 4) == 0) --to;
        rect = around(rect, {from, y, to - from, 1});
    }
    return rect;
}

// A picture that equals the one before lengthens its time.
Result<void> Film::add(const Image& picture) {
    if (last_ && picture.size != last_->size)
        return fail("film", "its pictures have different sizes", "give pictures of one session at one size");
    const PixelRect changed = last_ ? difference(*last_, picture) : all_of(picture.size);
    ++pictures_;
    if (changed.empty() && (waits_ + 1u) * each_ms_ <= 0xffffu) {
        ++waits_;
        return {};
    }
    if (last_) BURIN_TRY_DO(append_frame());
    last_ = picture;
    // Where there is nothing new one pixel stands for the picture.
    waiting_ = changed.empty() ? PixelRect{0, 0, 1, 1} : changed;
    waits_ = 1;
    return {};
}

Result<void> Film::append_frame() {
    BURIN_TRY(png, picture::encode_png(part_of(*last_, waiting_)));
    std::vector<std::byte> control;
    append_number(control, numbered_++);
    for (const std::uint32_t n : {waiting_.width, waiting_.height, waiting_.x, waiting_.y}) append_number(control, n);
    append_number(control, waits_ * each_ms_, 2);
    append_number(control, 1000, 2);
    append_number(control, 0, 2);  // left as it is, and drawn over
    append_chunk(frames_bytes_, "fcTL", control);
    for_each_chunk(png, [&](std::string_view name, std::span<const std::byte> content) {
        if (frames_ == 0 && (name == "IHDR" || name == "sRGB")) append_chunk(head_, name, content);
        if (name != "IDAT") return;
        if (frames_ == 0) return append_chunk(frames_bytes_, "IDAT", content);
        std::vector<std::byte> data;
        append_number(data, numbered_++);
        data.insert(data.end(), content.begin(), content.end());
        append_chunk(frames_bytes_, "fdAT", data);
    });
    ++frames_;
    return {};
}

Result<std::vector<std::byte>> Film::finish() {
    if (!last_) return fail("film", "has no pictures", "give a folder with pictures as PNG files");
    BURIN_TRY_DO(append_frame());
    constexpr std::array<unsigned char, kSignatureBytes> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    std::vector<std::byte> file;
    for (const unsigned char c : kSignature) file.push_back(static_cast<std::byte>(c));
    std::vector<std::byte> animation;
    append_number(animation, frames_);
    append_number(animation, 0);                                           // for ever
    file.insert(file.end(), head_.begin(), head_.begin() + kHeaderBytes);  // IHDR is the first
    append_chunk(file, "acTL", animation);
    file.insert(file.end(), head_.begin() + kHeaderBytes, head_.end());
    file.insert(file.end(), frames_bytes_.begin(), frames_bytes_.end());
    append_chunk(file, "IEND", {});
    return file;
}

}  // namespace burin::renderer
