// SPDX-License-Identifier: MIT
// What a mesh file's comment or header states about the unit of its numbers. A unit stands behind the word "unit" or
// "units", in any case:
//   behind = or :     "UNITS=mm", "File units = inches", "Unit of length: metres", "units in: mm";
//   as a length       "1 unit = 0.001 m", "1,000 drawing units = 1 m", "25.4 units = 1 inch", "1 mm = 1 unit", where
//                     that is one of the units to 20 ppm (39.37 of a metre are inches);
//   alone             "units mm", "the units are mm", "unit mm (millimetres)": only the next clause may follow.
// None is stated
//   where the word goes on: "Unit M-12", "unit cm4", "unit ft-lbs", "unit: m per s";
//   where m, ft or in is not the last word of its clause: "Unit: M 12 bracket", "units: in stock";
//   where two units stand: "unit: mm or in";
//   where it is that of another quantity: "time unit: m", "control unit: M";
//   where a number before "units" or behind "=" is not understood: "1/16 units = 1 in", "two units = 1 m".
// Pure functions; any thread. Internal to geometry/.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "geometry/files/mesh_unit.hpp"

namespace burin::geometry {

// Returns the first unit that a comment states, if any.
[[nodiscard]] std::optional<LengthUnit> unit_in_comment(std::string_view comment);
// Returns that of a header of fixed length, whose last word may have been cut off: no unit is taken from a word that
// touches the end.
[[nodiscard]] std::optional<LengthUnit> unit_in_header(std::string_view header);
// Returns that of a line's comment, with its place.
[[nodiscard]] std::optional<StatedUnit> unit_in_line(std::string_view comment, std::uint64_t line);
// Returns the first unit that the comments near the beginning of a text state: of the whole lines within its first
// 8 KiB. A comment runs from '#' to its line's end.
[[nodiscard]] std::optional<StatedUnit> unit_in_comments(std::string_view text);

}  // namespace burin::geometry
