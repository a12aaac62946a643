// SPDX-License-Identifier: MIT
// Converts one event to one line of text and back, exactly: numbers in their shortest form that reads back to the same
// bits. The format is described in docs/formats.md, "The input log". Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "session/input/input_event.hpp"

namespace burin::session {

inline constexpr std::size_t kMostLineBytes = 128 * 1024;  // more than the longest sensible event takes

// Formats an event, without the line end. The event is sensible and its time is from 0 to kLongestSession_ns
// (BURIN_CHECK).
[[nodiscard]] std::string line_of(const InputEvent& event);

// Parses a line; returns nothing for an empty line or a comment. An Error names the given position and the remedy; for
// an unknown kind, key, button or modifier it suggests the nearest that exists. Allocates no more than a few times the
// line's size.
[[nodiscard]] Result<std::optional<InputEvent>> parse_line(std::string_view line, const std::string& where);

// Parses a line that a tracker sends: a head's, a wand's, a button's or a stick's event without its time. Returns
// nothing for an empty line or a comment.
[[nodiscard]] Result<std::optional<devices::TrackerInput>> parse_tracker_line(std::string_view line);

// Converts times: "0.016666667" is seconds with at most nine decimals, the exact nanoseconds. Parsing returns nothing
// for anything else.
[[nodiscard]] std::string text_of_time(Nanoseconds time_ns);
[[nodiscard]] std::optional<Nanoseconds> time_of_text(std::string_view text);

}  // namespace burin::session
