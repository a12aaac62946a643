// SPDX-License-Identifier: MIT
#include "session/options/edge_comfort.hpp"

#include <algorithm>
#include <array>

#include "base/text.hpp"

namespace burin::session {
namespace {

constexpr std::array<std::string_view, 3> kNames{"auto", "on", "off"};

}  // namespace

std::string_view name_of(EdgeComfort comfort) { return kNames[static_cast<std::size_t>(comfort)]; }

Result<EdgeComfort> parse_edge_comfort(const std::string& text, const std::string& where) {
    const auto at = std::ranges::find(kNames, text);
    if (at == kNames.end())
        return fail(where, "is none of auto, on and off",
                    "did you mean " + std::string(nearest_name(text, kNames)) + "?");
    return static_cast<EdgeComfort>(at - kNames.begin());
}

}  // namespace burin::session
