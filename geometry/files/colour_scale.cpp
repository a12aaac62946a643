// SPDX-License-Identifier: MIT
#include "geometry/files/colour_scale.hpp"

#include <algorithm>
#include <cmath>

namespace burin::geometry {
namespace {

bool is_finite(const Vec3& colour) {
    return std::isfinite(colour.x) && std::isfinite(colour.y) && std::isfinite(colour.z);
}

}  // namespace

void ColourScale::see(const Vec3& colour) {
    if (!is_finite(colour)) return;
    for (int k = 0; k < 3; ++k) {
        whole_ = whole_ && colour[k] == std::floor(colour[k]);
        brightest_ = std::max(brightest_, colour[k]);
    }
}

Colour ColourScale::bytes_of(const Vec3& colour, const std::string& place) {
    if (!is_finite(colour)) {
        if (no_numbers_++ == 0) first_no_number_ = place;
        return kPlainColour;
    }
    const double most = runs_to_255() ? 255.0 : 1.0;
    if (glm::clamp(colour, 0.0, most) != colour && clamped_++ == 0) first_clamped_ = place;
    const Vec3 scaled = glm::clamp(colour, 0.0, most) * (255.0 / most);
    Colour bytes;
    for (int k = 0; k < 3; ++k) bytes[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(scaled[k]));
    return bytes;
}

Colour ColourScale::bytes_of(const Vec3& colour, std::uint64_t line) {
    return bytes_of(colour, "line " + std::to_string(line));
}

std::vector<std::string> ColourScale::remarks(const std::string& what) const {
    std::vector<std::string> told;
    if (clamped_ > 0)
        told.push_back(std::to_string(clamped_) + " " + what + " lie outside 0 to " + (runs_to_255() ? "255" : "1") +
                       " and were clamped, the first in " + first_clamped_);
    if (no_numbers_ > 0)
        told.push_back(std::to_string(no_numbers_) + " " + what + " are not numbers and were left out, the first in " +
                       first_no_number_);
    return told;
}

}  // namespace burin::geometry
