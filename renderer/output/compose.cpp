// SPDX-License-Identifier: MIT
#include "renderer/output/compose.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders/shared/output_rules.h"
#include "wall/output_settings.hpp"

namespace burin::renderer {

namespace {

using shared::OutputCell;

static_assert(static_cast<int>(wall::StereoMode::side_by_side) == shared::kModeSideBySide);
static_assert(static_cast<int>(wall::StereoMode::side_by_side_half) == shared::kModeSideBySideHalf);
static_assert(static_cast<int>(wall::StereoMode::top_bottom) == shared::kModeTopBottom);
static_assert(static_cast<int>(wall::StereoMode::top_bottom_half) == shared::kModeTopBottomHalf);
static_assert(static_cast<int>(wall::StereoMode::row_interlaced) == shared::kModeRows);
static_assert(static_cast<int>(wall::StereoMode::column_interlaced) == shared::kModeColumns);
static_assert(static_cast<int>(wall::StereoMode::checkerboard) == shared::kModeCheckerboard);
static_assert(static_cast<int>(wall::StereoMode::anaglyph_red_cyan) == shared::kModeRedCyan);
static_assert(static_cast<int>(wall::StereoMode::anaglyph_green_magenta) == shared::kModeGreenMagenta);
static_assert(static_cast<int>(wall::StereoMode::anaglyph_amber_blue) == shared::kModeAmberBlue);

// Returns the linear light of a pixel's three sRGB bytes: red, green, blue.
Vec3 light_of_bytes(const std::uint8_t* pixel) { return shared::linear_of(Vec3{pixel[0], pixel[1], pixel[2]} / 255.0); }

wall::Eye eye_of(int number) { return number == 0 ? wall::Eye::left : wall::Eye::right; }

bool shows_right_eye(const wall::OutputSettings& settings, const wall::OutputPlace& place) {
    return settings.mode == wall::StereoMode::right ||
           (wall::shows_one_eye_at_a_time(settings.mode) && place.eye == wall::Eye::right);
}

class Composer {
public:
    Composer(const Image& left, const Image& right, const wall::OutputSettings& settings,
             const wall::OutputPlace& place, const Overlay* overlay)
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

    OutputCell cell_of(std::uint32_t x, std::uint32_t y) const {
        return shared::output_cell(mode_, flags_, static_cast<int>(x), static_cast<int>(y),
                                   static_cast<int>(place_.size.width), static_cast<int>(place_.size.height));
    }

    // Returns the linear light of a pixel of an eye's picture, with the overlay over it.
    Vec3 pixel(wall::Eye eye, std::uint32_t x, std::uint32_t y) const {
        const std::uint8_t* p = pictures_[static_cast<std::size_t>(eye)]->pixel(x, y);
        return over_picture(light_of_bytes(p), x, y);
    }

    Vec3 over_picture(const Vec3& light, std::uint32_t x, std::uint32_t y) const {
        if (overlay_ == nullptr || overlay_->place.width <= 0 || overlay_->place.height <= 0) return light;
        const wall::OverlayPlace& at = overlay_->place;
        const std::int64_t ox = std::int64_t{x} - at.x, oy = std::int64_t{y} - at.y;
        if (ox < 0 || oy < 0 || ox >= at.width || oy >= at.height) return light;
        const ImageSize size = overlay_->image.size;
        const std::uint8_t* p = overlay_->image.pixel(
            static_cast<std::uint32_t>(shared::fitted(static_cast<int>(ox), at.width, static_cast<int>(size.width))),
            static_cast<std::uint32_t>(shared::fitted(static_cast<int>(oy), at.height, static_cast<int>(size.height))));
        const double alpha = p[3] / 255.0;
        const Vec3 panel = overlay_->colour == wall::OverlayColour::coded
                               ? shared::light_of_coded(Vec3{p[0], p[1], p[2]} / 255.0, alpha)
                               : light_of_bytes(p);
        return shared::laid_over(panel, alpha, light);
    }

    Vec3 pixel_or_black(wall::Eye eye, std::int64_t x, std::int64_t y) const {
        const ImageSize size = pictures_[0]->size;
        if (x < 0 || y < 0 || x >= size.width || y >= size.height) return Vec3{0.0};
        return pixel(eye, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    }

    // Interpolates between the four pixels around a position in the picture; pixels outside it are black.
    Vec3 light_at(wall::Eye eye, const Vec2& uv) const {
        const ImageSize size = pictures_[0]->size;
        const double x = shared::between_pixels(uv.x, static_cast<int>(size.width));
        const double y = shared::between_pixels(uv.y, static_cast<int>(size.height));
        const double x0 = std::floor(x), y0 = std::floor(y);
        Vec3 sum{0.0};
        for (int k = 0; k < 4; ++k) {
            const int right = k & 1, below = k >> 1;
            sum += shared::weight_between(x - x0, right) * shared::weight_between(y - y0, below) *
                   pixel_or_black(eye, static_cast<std::int64_t>(x0) + right, static_cast<std::int64_t>(y0) + below);
        }
        return sum;
    }

    Vec3 tap(const OutputCell& cell, wall::Eye eye, int tx, int ty) const {
        if (s_.homography) {
            const Vec2 uv{(cell.x * cell.taps_x + tx + 0.5) / (cell.width * cell.taps_x),
                          (cell.y * cell.taps_y + ty + 0.5) / (cell.height * cell.taps_y)};
            return light_at(eye, wall::warped(*s_.homography, uv));
        }
        const ImageSize size = pictures_[0]->size;
        const int x = shared::copied_pixel(cell.x, cell.width, cell.taps_x, tx, static_cast<int>(size.width));
        const int y = shared::copied_pixel(cell.y, cell.height, cell.taps_y, ty, static_cast<int>(size.height));
        return pixel(eye, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    }

    Vec3 light(const OutputCell& cell, wall::Eye eye) const {
        Vec3 sum{0.0};
        for (int ty = 0; ty < cell.taps_y; ++ty) {
            for (int tx = 0; tx < cell.taps_x; ++tx) sum += tap(cell, eye, tx, ty);
        }
        return sum / static_cast<double>(cell.taps_x * cell.taps_y);
    }

    Vec3 shown_light(const OutputCell& cell) const {
        if (!shared::is_anaglyph_mode(mode_)) return light(cell, eye_of(cell.eye));
        const wall::Eye first = s_.swap_eyes ? wall::Eye::right : wall::Eye::left;
        return glm::clamp(shared::anaglyph_light(mode_, 0, light(cell, first)) +
                              shared::anaglyph_light(mode_, 1, light(cell, wall::other(first))),
                          Vec3{0.0}, Vec3{1.0});
    }

    Vec3 value_at(std::uint32_t x, std::uint32_t y) const {
        const OutputCell cell = cell_of(x, y);
        if (!cell.shown) return Vec3{0.0};
        const Vec3 light = shown_light(cell);
        Vec3 value = shared::srgb_of(light);
        if (s_.blend.in_use()) {
            // By the projector's own gamma, as the projectors' light must add up.
            const Vec2 uv{(cell.x + 0.5) / cell.width, (cell.y + 0.5) / cell.height};
            value *= std::pow(wall::light_share(s_.blend, uv), 1.0 / s_.blend.gamma);
        }
        return value;
    }

    std::array<const Image*, 2> pictures_;
    const wall::OutputSettings& s_;
    const wall::OutputPlace& place_;
    const Overlay* overlay_;
    int mode_ = mode_number(s_.mode);
    int flags_ = mode_flags(s_, place_);
};

}  // namespace

int mode_number(wall::StereoMode mode) { return std::min(static_cast<int>(mode), shared::kModeOneEye); }

int mode_flags(const wall::OutputSettings& settings, const wall::OutputPlace& place) {
    int flags = 0;
    if ((place.monitor_x & 1) != 0) flags ^= shared::kOutputPhaseX;
    if ((place.monitor_y & 1) != 0) flags ^= shared::kOutputPhaseY;
    if (settings.first_eye == wall::Eye::right) {
        flags ^= settings.mode == wall::StereoMode::column_interlaced ? shared::kOutputPhaseX : shared::kOutputPhaseY;
    }
    if (settings.swap_eyes && settings.mode != wall::StereoMode::mono) flags |= shared::kOutputSwap;
    if (shows_right_eye(settings, place)) flags |= shared::kOutputRightEye;
    return flags;
}

Image compose(const Image& left, const Image& right, const wall::OutputSettings& settings,
              const wall::OutputPlace& place, const Overlay* overlay) {
    BURIN_CHECK(left.size.width == right.size.width && left.size.height == right.size.height);
    BURIN_CHECK(left.size.width > 0 && left.size.height > 0);
    return Composer(left, right, settings, place, overlay).picture();
}

Image compose_all(const Image& left, const Image& right, const wall::OutputSettings& settings) {
    if (!wall::shows_one_eye_at_a_time(settings.mode)) {
        return compose(left, right, settings, {.size = wall::output_size(settings.mode, left.size)});
    }
    StereoImage both;
    both.left = compose(left, right, settings, {.size = left.size, .eye = wall::Eye::left});
    both.right = compose(left, right, settings, {.size = left.size, .eye = wall::Eye::right});
    return side_by_side(both);
}

ChangedParts changed_parts(const PixelRect& changed, ImageSize eye, const wall::OutputSettings& settings,
                           const wall::OutputPlace& place) {
    const ImageSize expected = wall::output_size(settings.mode, eye);
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
        case wall::StereoMode::side_by_side: second = {first.x + half_width, first.y, first.width, first.height}; break;
        case wall::StereoMode::top_bottom: second = {first.x, first.y + half_height, first.width, first.height}; break;
        case wall::StereoMode::side_by_side_half:
            first = part(changed.x / 2, changed.y, std::min((right + 1) / 2, half_width), bottom);
            second = {first.x + half_width, first.y, first.width, first.height};
            break;
        case wall::StereoMode::top_bottom_half:
            first = part(changed.x, changed.y / 2, right, std::min((bottom + 1) / 2, half_height));
            second = {first.x, first.y + half_height, first.width, first.height};
            break;
        default: break;
    }
    if (first.empty()) return {};
    return {{first, second}, second.empty() ? 1 : 2};
}

}  // namespace burin::renderer
