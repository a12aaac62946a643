// SPDX-License-Identifier: MIT
// The units of length that options and files name. Inside the program every length is in metres; these convert at its
// borders, and write lengths for people, who think of workpieces in millimetres.
// Pure; any thread; the texts allocate.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/space.hpp"

namespace burin {

enum class LengthUnit : std::uint8_t { m, cm, mm, inch, ft };

// A unit is numerator / denominator metres. Both are whole numbers, so that a conversion rounds as rarely as it can:
// 12.3 mm become the double nearest to 12.3 / 1000.
struct LengthUnitDescriptor {
    LengthUnit unit = LengthUnit::m;
    const char *name = "", *plural = "";  // "mm", "millimetres"
    double numerator = 1.0, denominator = 1.0;
};
// Lists all units in the order of LengthUnit.
[[nodiscard]] std::span<const LengthUnitDescriptor> length_units();
[[nodiscard]] const LengthUnitDescriptor& descriptor_of(LengthUnit unit);
[[nodiscard]] const char* name_of(LengthUnit unit);  // "m", "cm", "mm", "in", "ft"
[[nodiscard]] std::optional<LengthUnit> length_unit(std::string_view name);

[[nodiscard]] double metres_in(LengthUnit unit);
[[nodiscard]] double to_metres(double length, LengthUnit unit);
[[nodiscard]] double from_metres(double length_m, LengthUnit unit);
[[nodiscard]] Vec3 to_metres(const Vec3& lengths, LengthUnit unit);
[[nodiscard]] Vec3 from_metres(const Vec3& lengths_m, LengthUnit unit);

// Writes a length with four significant digits and without an exponent: "50 mm", "0.0125 mm".
[[nodiscard]] std::string in_millimetres(double length_m);
// Writes the sizes of a box: "50 x 50 x 20 mm".
[[nodiscard]] std::string in_millimetres(const Vec3& size_m);

}  // namespace burin
