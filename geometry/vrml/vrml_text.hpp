// SPDX-License-Identifier: MIT
// Makes text of a VRML file's bytes: unpacks what gzip has packed, and turns Latin-1 (ISO 8859-1) into UTF-8, which
// the parser reads. Internal to geometry/vrml/. Pure; any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace burin::geometry {

// Returns whether these are bytes of a gzip file.
[[nodiscard]] bool is_gzip(std::string_view bytes);
// Unpacks a gzip file (RFC 1952). Fails where it is damaged, cut short, or has more than `most` bytes in it, before
// these take memory. `name` stands for the file in messages.
[[nodiscard]] Result<std::string> gunzipped(std::string_view bytes, std::size_t most, const std::string& name);

// Returns whether the bytes are UTF-8 without surrogates and forms that are longer than need be (RFC 3629).
[[nodiscard]] bool is_utf8(std::string_view bytes);
// Returns Latin-1 as UTF-8.
[[nodiscard]] std::string utf8_of_latin1(std::string_view bytes);

}  // namespace burin::geometry
