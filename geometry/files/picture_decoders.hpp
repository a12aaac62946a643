// SPDX-License-Identifier: MIT
// Decodes PNG and JPEG through libpng and libjpeg. Internal to geometry/files/; picture.hpp is the way in. Pure; any
// thread. Failure: the Error says what is wrong, without a place. Memory: 4 bytes a pixel while it works.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.hpp"

namespace burin::geometry {

struct DecodedPicture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb;  // rows from the top
    bool is_grey = false;           // it has one channel
};

[[nodiscard]] Result<DecodedPicture> decode_png(std::span<const std::byte> bytes);
[[nodiscard]] Result<DecodedPicture> decode_jpeg(std::span<const std::byte> bytes);

}  // namespace burin::geometry
