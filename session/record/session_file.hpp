// SPDX-License-Identifier: MIT
// What the session file of a live session is known by, for who reads one and for who writes one
// (session/record/session_recording.hpp). Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "record/columns.hpp"
#include "scene/object_id.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::session {

// The facts of a session file by which a live session is known, and the first line of its log.
inline constexpr const char* kActivityFact = "activity";
inline constexpr const char* kLiveActivity = "session";
inline constexpr const char* kDeviceFact = "device";
// By how much the latest of a played log's events came late, where that is noticeable; written at the end.
inline constexpr const char* kInputLateFact = "input late";
// Says that table `event` has what hands touch, what becomes of devices, and what the activity writes.
inline constexpr const char* kEventsFact = "events";
// The event that says why a log ended.
inline constexpr const char* kLogEndedEvent = "log ended";

// Number of the carved workpiece in the columns of touched objects; the objects of a world count from 1; 0: nothing.
inline constexpr std::uint32_t kWorkpieceObject = static_cast<std::uint32_t>(scene::kCarvedObject);

// Returns a tick's values in the order of record::columns_for() and record::touched_columns().
[[nodiscard]] std::vector<record::Word> session_row(const haptics::TickRecord& tick, const record::RowShape& shape);

// Returns whether a recording of this name is a session file: it ends in .session. Any other name is a text log's.
[[nodiscard]] bool is_session_file(const std::string& path);

}  // namespace burin::session
