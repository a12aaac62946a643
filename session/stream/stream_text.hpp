// SPDX-License-Identifier: MIT
// Text on its way into streams and out of them: what a stream's XML, a marker and a row of table `event` can hold, and
// the predicate by which streams of markers are found. Pure; allocates.
#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "session/activity/activity_marks.hpp"

namespace burin::session {

// The longest text of a marker that is kept, in bytes.
inline constexpr std::size_t kLongestMarker = 4096;

// Returns the text as UTF-8 without control characters: each of them, and each byte that is no UTF-8, is a blank; the
// rest beyond `most` bytes is cut off, at a character's end.
[[nodiscard]] std::string streamable(std::string_view text, std::size_t most = kLongestMarker);

// Return what a marker of the stream of events says: "touches: bolt", "trial begins: 3", "trial ends: done".
[[nodiscard]] std::string marker_of(const EventMark& event);
[[nodiscard]] std::string marker_of(const TrialMark& trial);

// Returns the predicate, as XPath 1.0, of the streams of markers that a user asked for: by one of their own, which has
// an = or a parenthesis in it, by a stream's name, or by nothing, for all. Fails on a name that XPath cannot quote.
[[nodiscard]] Result<std::string> marker_predicate(const std::string& asked);

}  // namespace burin::session
