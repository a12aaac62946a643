// SPDX-License-Identifier: MIT
// SHA-256 (FIPS 180-4). Pure; any thread; one pass.
#pragma once

#include <string>
#include <string_view>

namespace burin {

// 64 hexadecimal digits, small letters.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace burin
