// SPDX-License-Identifier: MIT
// Whether parallax fades towards the edge of a lone screen, for what stands in front of it: what the edge cuts off in
// one eye and not in the other strains the eyes, and a fade (shaders/shared/parallax_fade.h) takes that away together
// with the true depth. Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace burin::session {

// Automatic: until a tracker has told where the head is. Whoever has a tracker asked for true depth.
enum class EdgeComfort : std::uint8_t { automatic, on, off };

// Returns "auto", "on" or "off".
[[nodiscard]] std::string_view name_of(EdgeComfort comfort);
// Error: `where`, with the names that there are.
[[nodiscard]] Result<EdgeComfort> parse_edge_comfort(const std::string& text, const std::string& where);

}  // namespace burin::session
