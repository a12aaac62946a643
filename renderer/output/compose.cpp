// SPDX-License-Identifier: MIT
#include "renderer/output/compose.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/output/anaglyph.hpp"
#include "renderer/output/srgb.hpp"
#include "renderer/output/warp.hpp"

namespace burin {

namespace {

// An eye's share of the target, and a pixel's place in it.
struct Cell {
    std::uint32_t x = 0, y = 0;           // within the share
    std::uint32_t width = 0, height = 0;  // of the share
    std::uint32_t taps_x = 1, taps_y = 1;
    Eye eye = Eye::left;
    bool shown = true;
};

// Pixel p of n, fitted to m: whole numbers, p itself when n is m.
std::uint32_t fitted(std::uint32_t p, std::uint32_t n, std::uint32_t m) {
    return static_cast<std::uint32_t>((2ull * p + 1) * m / (2ull * n));
}

bool is_odd(std::int64_t n) { return (n & 1) != 0; }  // also of negative numbers

class Composer {
public:
    Composer(const Image& left, const Image& right, const OutputSettings& settings, const OutputPlace& place,
             const Overlay* overlay)
        : pictures_{&left, &right}, s_(settings), place_(place), overlay_(overlay) {}

    Image picture() const {
        Image out{place_.size, std::vector<std::uint8_t>(std::size_t{4} * place_.size.width * place_.size.height)};
        for (std::uint32_t y = 0; y < place_.size.height; ++y) {
            for (std::uint32_t x = 0; x < place_.size.width; ++x) put(out, x, y, value_at(x, y));
        }
        return out;
    }

private:
    static void put(Image& out, std::uint32_t x, std::uint32_t y, const Vec3& value) {
        std::uint8_t* pixel = out.rgba.data() + 4 * (std::size_t{y} * out.size.width + x);
        for (int c = 0; c < 3; ++c)
            pixel[c] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value[c], 0.0, 1.0)));
        pixel[3] = 255;
    }

    Eye second_if(bool second) const { return second ? other(s_.first_eye) : s_.first_eye; }

    Cell cell_of(std::uint32_t x, std::uint32_t y) const {
        Cell cell{x, y, place_.size.width, place_.size.height};
        const std::int64_t screen_x = std::int64_t{x} + place_.monitor_x, screen_y = std::int64_t{y} + place_.monitor_y;
        switch (s_.mode) {
            case StereoMode::side_by_side_half: cell.taps_x = 2; [[fallthrough]];
            case StereoMode::side_by_side:
                cell.width = std::max(1u, place_.size.width / 2);
                cell.shown = x / cell.width < 2;
                cell.eye = x < cell.width ? Eye::left : Eye::right;
                cell.x = x % cell.width;
                break;
            case StereoMode::top_bottom_half: cell.taps_y = 2; [[fallthrough]];
            case StereoMode::top_bottom:
                cell.height = std::max(1u, place_.size.height / 2);
                cell.shown = y / cell.height < 2;
                cell.eye = y < cell.height ? Eye::left : Eye::right;
                cell.y = y % cell.height;
                break;
            case StereoMode::row_interlaced: cell.eye = second_if(is_odd(screen_y)); break;
            case StereoMode::column_interlaced: cell.eye = second_if(is_odd(screen_x)); break;
            case StereoMode::checkerboard: cell.eye = second_if(is_odd(screen_x + screen_y)); break;
            case StereoMode::right: cell.eye = Eye::right; break;
            case StereoMode::frame_sequential:
            case StereoMode::two_layers:
            case StereoMode::two_windows: cell.eye = place_.eye; break;
            default: break;  // left, mono; anaglyphs show both
        }
        if (s_.swap_eyes && s_.mode != StereoMode::mono) cell.eye = other(cell.eye);
        return cell;
    }

    // Linear light of a pixel of an eye's picture, with the overlay over it.
    Vec3 pixel(Eye eye, std::uint32_t x, std::uint32_t y) const {
        const std::uint8_t* p = pictures_[static_cast<std::size_t>(eye)]->pixel(x, y);
        return over_picture(light_of_bytes(p), x, y);
    }

    Vec3 over_picture(const Vec3& light, std::uint32_t x, std::uint32_t y) const {
        if (overlay_ == nullptr || overlay_->place.width <= 0 || overlay_->place.height <= 0) return light;
        const OverlayPlace& at = overlay_->place;
        const std::int64_t ox = std::int64_t{x} - at.x, oy = std::int64_t{y} - at.y;
        if (ox < 0 || oy < 0 || ox >= at.width || oy >= at.height) return light;
        const std::uint8_t* p = overlay_->image.pixel(
            fitted(static_cast<std::uint32_t>(ox), static_cast<std::uint32_t>(at.width), overlay_->image.size.width),
            fitted(static_cast<std::uint32_t>(oy), static_cast<std::uint32_t>(at.height), overlay_->image.size.height));
        const double alpha = p[3] / 255.0;
        Vec3 panel = light_of_bytes(p);
        if (overlay_->colour == OverlayColour::coded && alpha > 0.0) {
            for (int c = 0; c < 3; ++c) panel[c] = srgb_to_linear(std::min(1.0, p[c] / 255.0 / alpha)) * alpha;
        } else if (overlay_->colour == OverlayColour::coded) {
            panel = Vec3{p[0], p[1], p[2]} / 255.0;
        }
        return panel + (1.0 - alpha) * light;
    }

    Vec3 pixel_or_black(Eye eye, std::int64_t x, std::int64_t y) const {
        const ImageSize size = pictures_[0]->size;
        if (x < 0 || y < 0 || x >= size.width || y >= size.height) return Vec3{0.0};
        return pixel(eye, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    }

    // Between the four pixels around a place of the picture; beyond it they are black.
    Vec3 between_pixels(Eye eye, const Vec2& uv) const {
        const ImageSize size = pictures_[0]->size;
        const double x = std::clamp(uv.x * size.width - 0.5, -2.0, size.width + 1.0);
        const double y = std::clamp(uv.y * size.height - 0.5, -2.0, size.height + 1.0);
        const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
        const auto column = static_cast<std::int64_t>(x0), row = static_cast<std::int64_t>(y0);
        const Vec3 upper = (1.0 - fx) * pixel_or_black(eye, column, row) + fx * pixel_or_black(eye, column + 1, row);
        const Vec3 lower =
            (1.0 - fx) * pixel_or_black(eye, column, row + 1) + fx * pixel_or_black(eye, column + 1, row + 1);
        return (1.0 - fy) * upper + fy * lower;
    }

    Vec3 tap(const Cell& cell, Eye eye, std::uint32_t tx, std::uint32_t ty) const {
        if (s_.homography) {
            const Vec2 uv{(cell.x * cell.taps_x + tx + 0.5) / (cell.width * cell.taps_x),
                          (cell.y * cell.taps_y + ty + 0.5) / (cell.height * cell.taps_y)};
            return between_pixels(eye, warped(*s_.homography, uv));
        }
        const ImageSize size = pictures_[0]->size;
        const std::uint32_t groups_x = std::max(1u, size.width / cell.taps_x);
        const std::uint32_t groups_y = std::max(1u, size.height / cell.taps_y);
        const std::uint32_t x = fitted(cell.x, cell.width, groups_x) * cell.taps_x + tx;
        const std::uint32_t y = fitted(cell.y, cell.height, groups_y) * cell.taps_y + ty;
        return pixel(eye, std::min(x, size.width - 1), std::min(y, size.height - 1));
    }

    Vec3 light(const Cell& cell, Eye eye) const {
        Vec3 sum{0.0};
        for (std::uint32_t ty = 0; ty < cell.taps_y; ++ty) {
            for (std::uint32_t tx = 0; tx < cell.taps_x; ++tx) sum += tap(cell, eye, tx, ty);
        }
        return sum / static_cast<double>(cell.taps_x * cell.taps_y);
    }

    Vec3 shown_light(const Cell& cell) const {
        if (!is_anaglyph(s_.mode)) return light(cell, cell.eye);
        const AnaglyphMatrices m = anaglyph_matrices(s_.mode);
        const Eye first = s_.swap_eyes ? Eye::right : Eye::left;
        return glm::clamp(m.left * light(cell, first) + m.right * light(cell, other(first)), Vec3{0.0}, Vec3{1.0});
    }

    Vec3 value_at(std::uint32_t x, std::uint32_t y) const {
        const Cell cell = cell_of(x, y);
        if (!cell.shown) return Vec3{0.0};
        const Vec3 light = shown_light(cell);
        Vec3 value{linear_to_srgb(light.x), linear_to_srgb(light.y), linear_to_srgb(light.z)};
        if (s_.blend.in_use()) {
            // By the projector's own gamma, as it is the projectors' light that has to add up.
            const Vec2 uv{(cell.x + 0.5) / cell.width, (cell.y + 0.5) / cell.height};
            value *= std::pow(light_share(s_.blend, uv), 1.0 / s_.blend.gamma);
        }
        return value;
    }

    std::array<const Image*, 2> pictures_;
    const OutputSettings& s_;
    const OutputPlace& place_;
    const Overlay* overlay_;
};

}  // namespace

Image compose(const Image& left, const Image& right, const OutputSettings& settings, const OutputPlace& place,
              const Overlay* overlay) {
    BURIN_CHECK(left.size.width == right.size.width && left.size.height == right.size.height);
    BURIN_CHECK(left.size.width > 0 && left.size.height > 0);
    return Composer(left, right, settings, place, overlay).picture();
}

Image compose_all(const Image& left, const Image& right, const OutputSettings& settings) {
    if (!shows_one_eye_at_a_time(settings.mode)) {
        return compose(left, right, settings, {.size = output_size(settings.mode, left.size)});
    }
    StereoImage both;
    both.left = compose(left, right, settings, {.size = left.size, .eye = Eye::left});
    both.right = compose(left, right, settings, {.size = left.size, .eye = Eye::right});
    return side_by_side(both);
}

ChangedParts changed_parts(const PixelRect& changed, ImageSize eye, const OutputSettings& settings,
                           const OutputPlace& place) {
    const ImageSize expected = output_size(settings.mode, eye);
    if (changed.empty()) return {};
    const bool tiny = place.size.width < 2 || place.size.height < 2;
    if (tiny || settings.homography || expected.width != place.size.width || expected.height != place.size.height) {
        return {{all_of(place.size), {}}, 1};
    }
    const std::uint32_t right = std::min(changed.x + changed.width, eye.width);
    const std::uint32_t bottom = std::min(changed.y + changed.height, eye.height);
    const auto part = [&](std::uint32_t x0, std::uint32_t y0, std::uint32_t x1, std::uint32_t y1) {
        return PixelRect{x0, y0, x1 > x0 ? x1 - x0 : 0, y1 > y0 ? y1 - y0 : 0};
    };
    const std::uint32_t half_width = place.size.width / 2, half_height = place.size.height / 2;
    PixelRect first = part(changed.x, changed.y, right, bottom), second;
    switch (settings.mode) {
        case StereoMode::side_by_side: second = {first.x + half_width, first.y, first.width, first.height}; break;
        case StereoMode::top_bottom: second = {first.x, first.y + half_height, first.width, first.height}; break;
        case StereoMode::side_by_side_half:
            first = part(changed.x / 2, changed.y, std::min((right + 1) / 2, half_width), bottom);
            second = {first.x + half_width, first.y, first.width, first.height};
            break;
        case StereoMode::top_bottom_half:
            first = part(changed.x, changed.y / 2, right, std::min((bottom + 1) / 2, half_height));
            second = {first.x, first.y + half_height, first.width, first.height};
            break;
        default: break;
    }
    if (first.empty()) return {};
    return {{first, second}, second.empty() ? 1 : 2};
}

}  // namespace burin
