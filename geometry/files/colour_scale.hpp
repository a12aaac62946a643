// SPDX-License-Identifier: MIT
// Turns the colours of a mesh file into bytes. Formats leave open whether numbers run from 0 to 1 or to 255, and only
// the whole file tells: they run to 255 where all of them are whole and one is above 1. What lies outside its range, as
// in pictures of high dynamic range and after interpolation, is clamped, with a remark; what is no number (nan) is no
// colour, and the plain one takes its place, with a remark. Internal to geometry/.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/space.hpp"

namespace burin::geometry {

using Colour = std::array<std::uint8_t, 3>;

// For surfaces without a colour in the file; equals Material{}.colour.
inline constexpr Colour kPlainColour{200, 200, 200};

class ColourScale {
public:
    // Takes note of a colour.
    void see(const Vec3& colour);
    // Converts a colour, after all have been seen. `place` ("line 7") is told of the first clamped or no number.
    [[nodiscard]] Colour bytes_of(const Vec3& colour, const std::string& place);
    [[nodiscard]] Colour bytes_of(const Vec3& colour, std::uint64_t line);
    // Says that colours were clamped or left out, where some were; `what` they are: "vertex colours".
    [[nodiscard]] std::vector<std::string> remarks(const std::string& what) const;

private:
    [[nodiscard]] bool runs_to_255() const { return whole_ && brightest_ > 1.0; }

    bool whole_ = true;
    double brightest_ = 0.0;
    std::uint64_t clamped_ = 0, no_numbers_ = 0;
    std::string first_clamped_, first_no_number_;
};

}  // namespace burin::geometry
