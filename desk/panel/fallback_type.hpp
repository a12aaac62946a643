// SPDX-License-Identifier: MIT
// Finds an installed font that has letters which the panel's own lacks: people name files in all scripts. Asks
// fontconfig, which knows what is installed. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace burin::session::panel {

struct FallbackType {
    std::string file;
    int index = 0;  // of the font in the file
};

// Returns the font that has the most of these letters (Unicode); nothing where none has any of them.
[[nodiscard]] std::optional<FallbackType> type_with(std::span<const std::uint32_t> letters);

}  // namespace burin::session::panel
