// SPDX-License-Identifier: MIT
#include "geometry/files/mtl.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

// Reads the numbers of a Kd statement. A single number means grey.
std::optional<Colour> diffuse(TextScanner& scan) {
    Colour colour;
    std::size_t count = 0;
    for (std::string_view word = scan.token_in_line('#'); !word.empty() && count < 3; word = scan.token_in_line('#')) {
        const auto value = number_from(word);
        if (!value || !(*value >= 0.0 && *value <= 1.0)) return std::nullopt;
        colour[count++] = static_cast<std::uint8_t>(std::lround(*value * 255.0));
    }
    if (count == 1) return Colour{colour[0], colour[0], colour[0]};
    return count == 3 ? std::optional(colour) : std::nullopt;
}

}  // namespace

MaterialLibrary read_mtl(std::string_view text, const std::string& name) {
    MaterialLibrary library;
    Colour* current = nullptr;
    std::size_t faults = 0;
    std::uint64_t first_fault = 0;
    for (TextScanner scan(text); !scan.at_end(); scan.next_line()) {
        const std::string_view keyword = scan.token_in_line('#');
        if (equals_ignoring_case(keyword, "newmtl")) {
            current = &library.colours.insert_or_assign(std::string(scan.rest_of_line()), kPlainColour).first->second;
        } else if (equals_ignoring_case(keyword, "kd")) {
            const auto colour = diffuse(scan);
            if (colour && current != nullptr) {
                *current = *colour;
            } else if (faults++ == 0) {
                first_fault = scan.line();
            }
        }
    }
    if (faults > 0) {
        library.remarks.push_back(std::to_string(faults) + " colours of material file " + in_quotes(name) +
                                  " could not be understood, the first in line " + std::to_string(first_fault));
    }
    return library;
}

}  // namespace burin::geometry
