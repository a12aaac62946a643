// SPDX-License-Identifier: MIT
// The unit of a mesh file's numbers. No mesh format has a field for it, so it is, in this order,
//   given    by the user, as --units does;
//   stated   by the file in a comment, as Burin's own exports and some programs write it (unit_statement.hpp);
//   guessed  by the size: longest side above 5 -> millimetres, up to 5 -> metres.
// The guess: parts from CAD programs are 3 to 2000 mm long and in millimetres, scans in metres 0.1 to 2 m, and models
// of no particular size fill a cube of side 1 or 2. A part of up to 5 mm and a building come out wrong; so a guess is
// always told to the user, with the option that overrules it.
// Pure functions; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/length_unit.hpp"

namespace burin::geometry {

// The longest side, in numbers of the file, up to which a guess takes them for metres.
inline constexpr double kLongestInMetres = 5.0;

// A unit that a file states, and where: "in line 3", "in its header".
struct StatedUnit {
    LengthUnit unit = LengthUnit::m;
    std::string place;
};

enum class UnitSource : std::uint8_t { given, stated, guessed };

struct FileUnit {
    LengthUnit unit = LengthUnit::m;
    UnitSource source = UnitSource::given;
    std::optional<LengthUnit> stated = std::nullopt;  // by the file, whatever the user gave
    std::string place = {};                           // where it states it
};
// Decides by the rule above. longest_side: of the mesh, in numbers of the file.
[[nodiscard]] FileUnit choose_unit(std::optional<LengthUnit> given, const std::optional<StatedUnit>& stated,
                                   double longest_side);

// Returns how Burin's own exports state a unit: "units mm".
[[nodiscard]] std::string comment_of(LengthUnit unit);

// Says in one line how large a file's mesh is and how that was found out: "part.stl: 50 x 50 x 50 mm (no unit that
// Burin knows is given in the file; ...)".
[[nodiscard]] std::string describe_size(const std::string& file, const Vec3& size_m, const FileUnit& unit);

}  // namespace burin::geometry
