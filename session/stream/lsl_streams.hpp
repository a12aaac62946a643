// SPDX-License-Identifier: MIT
// A session's streams by Lab Streaming Layer: its ticks and events go out, markers come in.
//
// Data flow:
//   haptic thread -> ring of tick records of each part, as always: it knows nothing of streams
//     -> its one reader, the recording's writer or a TickPump -> tick(): the values of a tick -> rows of the part
//       -> the outlets' thread -> the library, in chunks of what has come within 10 ms
//   frame's thread -> event(), trial() -> a queue of markers -> the same thread
//   the library -> the inlets' thread -> a queue -> take_markers() on the frame's thread -> the recording's events
// Stamps: each sample has its tick's own time, by an offset between both clocks that is measured when the streams are
// opened and told (stream_clock.hpp); what it has drifted by then is told at the end.
//
// The hardest failure: a library that does not return from a push. Nothing of the session may wait for it, and what it
// works on may not be the session's. So both threads own what they touch together with this class; a ring of rows that
// is full drops rows, which are counted and told; and a thread that has not ended within `patience_ns` of close() is
// left behind, with what it owns, and told.
//
// Threads: open() and close() on one; tick() of a part on one; event(), trial(), take_...() on the frame's.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "session/activity/activity_marks.hpp"
#include "session/stream/stream_outlets.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::session {

// The name of a marker that was heard, in table `event`; its value is "STREAM: TEXT".
inline constexpr const char* kMarkerEvent = "lsl marker";

// Rows that wait for the library: eight seconds at 1 kHz.
inline constexpr std::size_t kStreamRows = 8192;

struct StreamPlan {
    std::vector<StreamedPart> parts;     // none: nothing goes out
    std::optional<std::string> markers;  // a predicate of those that come in (marker_predicate()); none: none do
    std::string source;                  // begins the identifiers of its streams, unlike any other session's
    std::size_t rows = kStreamRows;
    Nanoseconds patience_ns = 2 * kNanosecondsPerSecond;
};

struct StreamFigures {
    std::uint64_t ticks = 0;          // given to the library
    std::uint64_t dropped_ticks = 0;  // the library was too slow, or did not return
    std::uint64_t refused_ticks = 0;  // the library has said no
    std::uint64_t unordered = 0;      // ticks no later than the one before, which were left out
    std::uint64_t events = 0, dropped_events = 0;
    std::uint64_t markers = 0, dropped_markers = 0;
    double drift_s = 0.0;                       // of the offset between the clocks, since the streams were opened
    std::optional<std::size_t> marker_streams;  // found; nothing where none was looked for
    bool is_left_behind = false;                // the library did not return
    [[nodiscard]] std::string text() const;
};

class LslStreams {
public:
    [[nodiscard]] static Result<std::unique_ptr<LslStreams>> open(const devices::LslApi& api, StreamPlan plan,
                                                                  Clock& clock);
    ~LslStreams();
    LslStreams(const LslStreams&) = delete;
    LslStreams& operator=(const LslStreams&) = delete;

    void tick(std::size_t part, const haptics::TickRecord& tick);
    void event(const EventMark& event);
    void trial(const TrialMark& trial);
    // Returns the markers that were heard since the last call, as events on the session's clock.
    [[nodiscard]] std::vector<EventMark> take_markers();
    // Returns what there is to tell since the last call.
    [[nodiscard]] std::vector<std::string> take_messages();
    // Gives the library what it has not had, as far as it takes it, and ends the streams. A second call returns the
    // same.
    StreamFigures close();

private:
    struct Work;
    explicit LslStreams(std::shared_ptr<Work> work) : work_(std::move(work)) {}
    void give(std::string marker, Nanoseconds time_ns);
    [[nodiscard]] std::uint64_t dropped_ticks() const;

    std::shared_ptr<Work> work_;
    Clock* clock_ = nullptr;
    Nanoseconds patience_ns_ = 0;
    std::thread outlets_, inlets_;
    std::uint64_t told_drops_ = 0;
    std::optional<StreamFigures> closed_;
};

}  // namespace burin::session
