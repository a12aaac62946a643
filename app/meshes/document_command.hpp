// SPDX-License-Identifier: MIT
// Documents outside a session (docs/formats.md, "Documents").
//   burin info FILE.burin [--json OUT]       what is in it, from where it came, and what of it is damaged
//   burin convert FILE.burin part.ply        its solid as a mesh, as the session that saved it would export it
#pragma once

#include "app/cli/command_table.hpp"
#include "app/meshes/convert.hpp"
#include "base/error.hpp"

namespace burin::app {

// Fails, after all that can be told, where a page is damaged.
[[nodiscard]] CommandRow info_row();

[[nodiscard]] Result<void> convert_document(const ConvertOptions& options);

}  // namespace burin::app
