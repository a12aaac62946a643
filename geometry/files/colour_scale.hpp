// SPDX-License-Identifier: MIT
// Turns the colours of a mesh file into bytes. Formats leave open whether numbers run from 0 to 1 or to 255, and only
// the whole file tells: they run to 255 where all of them are whole and one is above 1. What lies outside its range, as
// in pictures of high dynamic range and after interpolation, is clamped, with a remark. Internal to geometry/.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/space.hpp"

namespace burin::geometry {

using Colour = std::array<std::uint8_t, 3>;

class ColourScale {
public:
    // Takes note of a colour, whose numbers must be finite.
    void see(const Vec3& colour);
    // Converts a colour, after all have been seen. `place` is told of the first that was clamped ("line 7").
    [[nodiscard]] Colour bytes_of(const Vec3& colour, const std::string& place);
    [[nodiscard]] Colour bytes_of(const Vec3& colour, std::uint64_t line);
    // Says that colours were clamped, where some were; `what` they are: "vertex colours".
    [[nodiscard]] std::optional<std::string> remark(const std::string& what) const;

private:
    [[nodiscard]] bool runs_to_255() const { return whole_ && brightest_ > 1.0; }

    bool whole_ = true;
    double brightest_ = 0.0;
    std::uint64_t clamped_ = 0;
    std::string first_clamped_;
};

}  // namespace burin::geometry
