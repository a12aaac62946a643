// SPDX-License-Identifier: MIT
// Where results go: looked at before hours of work, and not after.
#pragma once

#include <span>
#include <string>

#include "base/error.hpp"
#include "base/json.hpp"
#include "compute/lattice.hpp"

namespace burin {

// Whether meshes of a known format and a report (empty: none) can appear there.
[[nodiscard]] Result<void> check_outputs(std::span<const std::string> exports, const std::string& report);
// Whether the formats hold the lattice's details; only a mesh's coordinates tell, so this is found out after loading it.
[[nodiscard]] Result<void> check_precision(std::span<const std::string> exports, const Lattice& lattice);
[[nodiscard]] Result<void> write_text(const std::string& path, const std::string& text);
[[nodiscard]] Result<void> write_report(const std::string& path, const Json& report);

}  // namespace burin
