// SPDX-License-Identifier: MIT
#include "wall/seen_place.hpp"

#include <algorithm>
#include <cmath>

#include "wall/output_settings.hpp"

namespace burin::wall {
namespace {

// An eye's share of the output.
struct Share {
    Vec2 origin_px{0.0};
    Vec2 size_px;
    std::optional<Eye> eye;
};

bool is_odd(double pixel) { return std::fmod(std::floor(pixel), 2.0) != 0.0; }  // also of negative ones

std::optional<Share> share_at(const OutputSettings& s, const OutputPlace& place, const Vec2& px) {
    const Vec2 size(place.size.width, place.size.height);
    Share share{{}, size, std::nullopt};
    const auto second_if = [&](bool second) { return second ? other(s.first_eye) : s.first_eye; };
    const bool odd_column = is_odd(px.x + place.monitor_x), odd_row = is_odd(px.y + place.monitor_y);
    const auto one_of_two = [&](int axis) {
        share.size_px[axis] = std::max(1.0, std::floor(0.5 * size[axis]));
        const bool second = px[axis] >= share.size_px[axis];
        share.eye = second ? Eye::right : Eye::left;
        if (second) share.origin_px[axis] = share.size_px[axis];
        return px[axis] < 2.0 * share.size_px[axis];
    };
    bool shown = true;
    switch (s.mode) {
        case StereoMode::side_by_side:
        case StereoMode::side_by_side_half: shown = one_of_two(0); break;
        case StereoMode::top_bottom:
        case StereoMode::top_bottom_half: shown = one_of_two(1); break;
        case StereoMode::row_interlaced: share.eye = second_if(odd_row); break;
        case StereoMode::column_interlaced: share.eye = second_if(odd_column); break;
        case StereoMode::checkerboard: share.eye = second_if(odd_column != odd_row); break;
        case StereoMode::left: share.eye = Eye::left; break;
        case StereoMode::right: share.eye = Eye::right; break;
        case StereoMode::two_windows:
            share.eye = in_right_window(px) ? Eye::right : Eye::left;
            if (in_right_window(px)) share.origin_px.x = kRightWindow_px;
            break;
        default: break;  // mono; anaglyphs, layers and turns show both eyes
    }
    if (!shown) return std::nullopt;
    if (s.swap_eyes && share.eye) share.eye = other(*share.eye);
    return share;
}

}  // namespace

Vec2 picture_px_per_px(StereoMode mode) {
    return {mode == StereoMode::side_by_side_half ? 2.0 : 1.0, mode == StereoMode::top_bottom_half ? 2.0 : 1.0};
}

std::optional<SeenPlace> seen_at(const OutputSettings& settings, const OutputPlace& place, Vec2 px,
                                 std::optional<Vec2> held_px) {
    if (place.size.width == 0 || place.size.height == 0) return std::nullopt;
    const auto share = share_at(settings, place, held_px.value_or(px));
    if (!share) return std::nullopt;
    const Vec2 in_share = px - share->origin_px;
    if (!settings.homography) {
        const ImageSize eye = eye_size(settings.mode, place.size);
        return SeenPlace{share->eye, in_share * picture_px_per_px(settings.mode) / Vec2(eye.width, eye.height)};
    }
    const Vec2 uv = warped(*settings.homography, in_share / share->size_px);
    const bool inside = uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0;
    if (!inside && !held_px) return std::nullopt;
    return SeenPlace{share->eye, uv};
}

}  // namespace burin::wall
