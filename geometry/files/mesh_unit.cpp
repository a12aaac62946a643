// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_unit.hpp"

#include "base/text.hpp"

namespace burin::geometry {
namespace {

const char* plural_of(LengthUnit unit) { return descriptor_of(unit).plural; }

}  // namespace

FileUnit choose_unit(std::optional<LengthUnit> given, const std::optional<StatedUnit>& stated, double longest_side) {
    if (!given && !stated)
        return {longest_side > kLongestInMetres ? LengthUnit::mm : LengthUnit::m, UnitSource::guessed, {}, {}};
    FileUnit chosen{given ? *given : stated->unit, given ? UnitSource::given : UnitSource::stated, {}, {}};
    if (stated) chosen.stated = stated->unit, chosen.place = stated->place;
    return chosen;
}

std::string comment_of(LengthUnit unit) { return std::string("units ") + name_of(unit); }

std::string describe_size(const std::string& file, const Vec3& size_m, const FileUnit& unit) {
    const std::string size = file + ": " + in_millimetres(size_m), in = plural_of(unit.unit);
    switch (unit.source) {
        case UnitSource::given:
            return size + " (read as " + in + ", as --units or the recording says" +
                   (unit.stated && *unit.stated != unit.unit
                        ? std::string("; the file itself says ") + plural_of(*unit.stated) + " " + unit.place
                        : "") +
                   ")";
        case UnitSource::stated: return size + " (its numbers are " + in + ", as the file says " + unit.place + ")";
        case UnitSource::guessed: break;
    }
    const LengthUnit other = unit.unit == LengthUnit::m ? LengthUnit::mm : LengthUnit::m;
    return size + formatted(
                      " (no unit that Burin knows is given in the file; read as %s, since its longest side is %s %g; "
                      "--units %s "
                      "reads it as %s)",
                      in.c_str(), unit.unit == LengthUnit::m ? "at most" : "above", kLongestInMetres, name_of(other),
                      plural_of(other));
}

}  // namespace burin::geometry
