// SPDX-License-Identifier: MIT
// One event as one line of text, and back, exactly: numbers in their shortest form that reads back to the same bits. The
// format is described in docs/formats.md, "The input log". Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/session/input_event.hpp"
#include "base/error.hpp"

namespace burin {

inline constexpr std::size_t kMostLineBytes = 128 * 1024;  // more than the longest sensible event takes

// Without the line end. The event is sensible and its time is from 0 to kLongestSession_ns (BURIN_CHECK).
[[nodiscard]] std::string line_of(const InputEvent& event);

// Nothing for an empty line or a comment. An Error names the place given and the remedy; an unknown kind, key, button or
// modifier is answered with the nearest that exists. Allocates no more than a few times the line's size.
[[nodiscard]] Result<std::optional<InputEvent>> parse_line(std::string_view line, const std::string& where);

// "0.016666667" for seconds with at most nine decimals; the exact nanoseconds. Nothing for anything else.
[[nodiscard]] std::string text_of_time(Nanoseconds time_ns);
[[nodiscard]] std::optional<Nanoseconds> time_of_text(std::string_view text);

}  // namespace burin
