// SPDX-License-Identifier: MIT
// Pictures that a mesh or a world wears as its colours: decoded, and sampled to the colours of corners. There is no
// texture beyond that: where a mesh is coarser than its picture, corners take the mean colour of what lies around them,
// and where it is finer, that of the pixel they lie in.
//
// Coordinates: s to the right, t upwards, both from 0 to 1 across the picture; beyond, it repeats or its rim goes on.
// Colours are sRGB, 8 bits a channel; alpha is ignored. Pictures come from strangers: kMostPicturePixels are decoded,
// and what is larger than kWidestPicture is halved until it is not. Pure; any thread. Failure: what is neither PNG nor
// JPEG, is damaged, too large, or a JPEG of four colours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"
#include "geometry/files/colour_scale.hpp"

namespace burin::geometry {

inline constexpr std::uint64_t kMostPicturePixels = 64u << 20;
inline constexpr std::uint32_t kWidestPicture = 2048;

struct PictureWrap {
    bool s = true, t = true;  // repeats
};

class Picture {
public:
    // Decodes a PNG or a JPEG, whichever the bytes are. `name` stands for it in messages.
    [[nodiscard]] static Result<Picture> decode(std::span<const std::byte> bytes, const std::string& name);
    // Takes over the pixels, rows from the top, 3 bytes each.
    Picture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgb, bool is_grey);

    // It has no colour of its own, however many channels its file has: it darkens what wears it.
    [[nodiscard]] bool is_grey() const { return is_grey_; }
    // Returns the colours of the corners of a face that has these coordinates.
    [[nodiscard]] std::vector<Colour> colours_of(std::span<const Vec2> corners, PictureWrap wrap) const;
    [[nodiscard]] Colour mean() const;

private:
    struct Level {
        std::uint32_t width = 0, height = 0;
        std::vector<std::uint8_t> rgb;
    };
    [[nodiscard]] Colour sampled(const Level& level, const Vec2& at, PictureWrap wrap) const;

    std::vector<Level> levels_;  // each half as wide and high as the one before; the last is one pixel
    bool is_grey_ = false;
};

// Returns the colour of what has that colour by itself and wears a grey picture.
[[nodiscard]] Colour darkened(const Colour& own, const Colour& grey);

}  // namespace burin::geometry
