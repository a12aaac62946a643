// SPDX-License-Identifier: MIT
#include "base/length_unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"

namespace burin {
namespace {

// The inch is 25.4 mm exactly (1959), the foot twelve inches.
constexpr std::array<LengthUnitDescriptor, 5> kLengthUnits{{{LengthUnit::m, "m", "metres", 1.0, 1.0},
                                                            {LengthUnit::cm, "cm", "centimetres", 1.0, 100.0},
                                                            {LengthUnit::mm, "mm", "millimetres", 1.0, 1000.0},
                                                            {LengthUnit::inch, "in", "inches", 127.0, 5000.0},
                                                            {LengthUnit::ft, "ft", "feet", 381.0, 1250.0}}};

// Writes a number of millimetres with four significant digits, trailing zeros left out.
std::string four_digits(double mm) {
    if (!(std::abs(mm) > 0.0) || !std::isfinite(mm)) return formatted("%g", mm);
    const int before_point = static_cast<int>(std::floor(std::log10(std::abs(mm)))) + 1;
    std::string text = formatted("%.*f", std::clamp(4 - before_point, 0, 12), mm);
    if (!text.contains('.')) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

}  // namespace

std::span<const LengthUnitDescriptor> length_units() { return kLengthUnits; }

const LengthUnitDescriptor& descriptor_of(LengthUnit unit) { return kLengthUnits.at(static_cast<std::size_t>(unit)); }

const char* name_of(LengthUnit unit) { return descriptor_of(unit).name; }

std::optional<LengthUnit> length_unit(std::string_view name) {
    const auto found = std::ranges::find_if(kLengthUnits, [&](const auto& u) { return name == u.name; });
    return found == kLengthUnits.end() ? std::nullopt : std::optional(found->unit);
}

double metres_in(LengthUnit unit) { return descriptor_of(unit).numerator / descriptor_of(unit).denominator; }

double to_metres(double length, LengthUnit unit) {
    const LengthUnitDescriptor& in = descriptor_of(unit);
    return length * in.numerator / in.denominator;
}

double from_metres(double length_m, LengthUnit unit) {
    const LengthUnitDescriptor& in = descriptor_of(unit);
    return length_m * in.denominator / in.numerator;
}

Vec3 to_metres(const Vec3& lengths, LengthUnit unit) {
    return {to_metres(lengths.x, unit), to_metres(lengths.y, unit), to_metres(lengths.z, unit)};
}

Vec3 from_metres(const Vec3& lengths_m, LengthUnit unit) {
    return {from_metres(lengths_m.x, unit), from_metres(lengths_m.y, unit), from_metres(lengths_m.z, unit)};
}

std::string in_millimetres(double length_m) { return four_digits(1e3 * length_m) + " mm"; }

std::string in_millimetres(const Vec3& size_m) {
    return four_digits(1e3 * size_m.x) + " x " + four_digits(1e3 * size_m.y) + " x " + in_millimetres(size_m.z);
}

}  // namespace burin
