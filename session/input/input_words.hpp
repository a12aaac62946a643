// SPDX-License-Identifier: MIT
// Splits a line into words: separated by blanks; a word in double quotes may hold anything, with \" \\ \n \t \r and
// \xHH; # begins a comment. Pure; any thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace burin::session {

[[nodiscard]] std::string quoted(std::string_view text);
// Returns the word unchanged where that reads back, else quoted.
[[nodiscard]] std::string as_word(std::string_view text);
[[nodiscard]] Result<std::vector<std::string>> words_of(std::string_view line, const std::string& where);

}  // namespace burin::session
