// SPDX-License-Identifier: MIT
#include "geometry/files/picture.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/files/picture_decoders.hpp"

namespace burin::geometry {
namespace {

// A face this many pixels wide is sampled in the level as it is: each corner then has its own pixels.
constexpr double kPixelsAcross = 4.0;

constexpr const char* kPictureRemedy = "save it as PNG or JPEG";

bool begins_with(std::span<const std::byte> bytes, std::initializer_list<int> start) {
    return bytes.size() >= start.size() &&
           std::ranges::equal(bytes.first(start.size()), start, {}, [](std::byte b) { return static_cast<int>(b); });
}

bool has_a_colour(const std::vector<std::uint8_t>& rgb) {
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
        if (rgb[i] != rgb[i + 1] || rgb[i] != rgb[i + 2]) return true;
    return false;
}

double within_picture(double coordinate, bool repeats) {
    if (!std::isfinite(coordinate)) return 0.0;
    return repeats ? coordinate - std::floor(coordinate) : std::clamp(coordinate, 0.0, 1.0);
}

}  // namespace

Result<Picture> Picture::decode(std::span<const std::byte> bytes, const std::string& name) {
    Result<DecodedPicture> decoded = begins_with(bytes, {0x89, 'P', 'N', 'G'}) ? decode_png(bytes)
                                     : begins_with(bytes, {0xFF, 0xD8, 0xFF})  ? decode_jpeg(bytes)
                                                                               : fail(name, "is neither PNG nor JPEG");
    if (!decoded) return fail(name, decoded.error().what, kPictureRemedy);
    return Picture(decoded->width, decoded->height, std::move(decoded->rgb), decoded->is_grey);
}

Picture::Picture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgb, bool is_grey) {
    is_grey_ = is_grey || !has_a_colour(rgb);
    levels_.push_back({width, height, std::move(rgb)});
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        const Level& from = levels_.back();
        Level half{std::max(1u, from.width / 2), std::max(1u, from.height / 2), {}};
        half.rgb.reserve(std::size_t{3} * half.width * half.height);
        const std::uint32_t dx = from.width > 1 ? 1 : 0, dy = from.height > 1 ? 1 : 0;
        for (std::uint32_t y = 0; y < half.height; ++y) {
            for (std::uint32_t x = 0; x < half.width; ++x) {
                const std::size_t left = 2u * x * dx, top = 2u * y * dy;
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto pixel = [&](std::size_t px, std::size_t py) {
                        return unsigned{from.rgb[3 * (py * from.width + px) + c]};
                    };
                    const unsigned sum =
                        pixel(left, top) + pixel(left + dx, top) + pixel(left, top + dy) + pixel(left + dx, top + dy);
                    half.rgb.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
                }
            }
        }
        const bool is_too_wide = std::max(from.width, from.height) > kWidestPicture;
        levels_.push_back(std::move(half));
        if (is_too_wide) levels_.erase(levels_.begin());
    }
}

std::vector<Colour> Picture::colours_of(std::span<const Vec2> corners, PictureWrap wrap) const {
    const Level& finest = levels_.front();
    Vec2 lo = corners.front(), hi = lo, sum(0.0);
    for (const Vec2& c : corners) {
        lo = glm::min(lo, c);
        hi = glm::max(hi, c);
        sum += c;
    }
    const Vec2 middle = sum / static_cast<double>(corners.size());
    const double across = std::max((hi.x - lo.x) * finest.width, (hi.y - lo.y) * finest.height);
    const double finer = std::isfinite(across) && across > kPixelsAcross ? std::log2(across / kPixelsAcross) : 0.0;
    const auto level = std::min(static_cast<std::size_t>(finer), levels_.size() - 1);
    std::vector<Colour> colours;
    colours.reserve(corners.size());
    // A third of the way to the middle: on the face itself, not on what lies beside it in the picture.
    for (const Vec2& c : corners) colours.push_back(sampled(levels_[level], c + (middle - c) / 3.0, wrap));
    return colours;
}

Colour Picture::mean() const {
    const std::vector<std::uint8_t>& rgb = levels_.back().rgb;
    return {rgb[0], rgb[1], rgb[2]};
}

// The pixel itself, without its neighbours: with them a face at the rim of a quarter of one colour would have a share
// of the quarter beside it, and at the picture's rim one of the other side.
Colour Picture::sampled(const Level& level, const Vec2& at, PictureWrap wrap) const {
    const auto pixel_at = [](double share, std::uint32_t count) {
        return std::min(static_cast<std::size_t>(share * count), std::size_t{count} - 1);
    };
    const std::size_t x = pixel_at(within_picture(at.x, wrap.s), level.width);
    const std::size_t y = pixel_at(1.0 - within_picture(at.y, wrap.t), level.height);
    const std::uint8_t* const pixel = level.rgb.data() + 3 * (y * level.width + x);
    return {pixel[0], pixel[1], pixel[2]};
}

Colour darkened(const Colour& own, const Colour& grey) {
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] = static_cast<std::uint8_t>((unsigned{own[c]} * unsigned{grey[c]} + 127) / 255);
    return colour;
}

}  // namespace burin::geometry
