// SPDX-License-Identifier: MIT
// Documents outside a session (docs/formats.md, "Documents").
//   burin info FILE.burin [--json OUT]       what is in it, from where it came, and what of it is damaged
//   burin convert FILE.burin part.ply        its solid as a mesh, as the session that saved it would export it
#pragma once

#include <string>

#include "app/cli/command_line.hpp"
#include "app/cli/commands.hpp"
#include "base/error.hpp"

namespace burin::app {

struct InfoOptions {
    std::string file;
    std::string json;  // a file for all of it; empty: none
};
void add_info_options(Command command, InfoOptions& options);
// Fails, after all that can be told, where a page is damaged.
[[nodiscard]] Result<void> document_info(const InfoOptions& options);

[[nodiscard]] Result<void> convert_document(const ConvertOptions& options);

}  // namespace burin::app
