// SPDX-License-Identifier: MIT
// The streams that the options of a session ask for (session/stream/lsl_streams.hpp), between its hands, its recording
// and its frames. Frame's thread; what taker() returns is called on the recording's.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "record/record_writer.hpp"

namespace burin::session {

struct RecordSetup;    // session/options/session_setup.hpp
class LslStreams;      // session/stream/lsl_streams.hpp
class Session;         // session/live/session.hpp
struct StreamFigures;  // session/stream/lsl_streams.hpp
class TickPump;        // session/stream/tick_pump.hpp

// Fails where a session of these options cannot have the streams that they ask for: a text log has the ring that a
// stream would read, markers have no recording to go into, or there is no library.
[[nodiscard]] Result<void> check_streams(const RecordSetup& record);

class SessionStreams {
public:
    // Opens them for a session whose threads have not started; null: none are asked for. Session and clock must
    // outlive them.
    [[nodiscard]] static Result<std::unique_ptr<SessionStreams>> open(const RecordSetup& record, Session& session,
                                                                      Clock& clock);
    ~SessionStreams();
    SessionStreams(const SessionStreams&) = delete;
    SessionStreams& operator=(const SessionStreams&) = delete;

    // Returns what the recording of the session gives its ticks to; null: nothing goes out.
    [[nodiscard]] record::OnRecord taker();
    // Reads the rings of ticks itself, of a session that is not recorded.
    void read_rings();
    [[nodiscard]] LslStreams& lsl() { return *lsl_; }
    // Gives the rest to the library, ends the streams, and returns what they were.
    StreamFigures finish();

private:
    SessionStreams(Session& session, std::unique_ptr<LslStreams> lsl, bool gives);

    Session& session_;
    std::unique_ptr<LslStreams> lsl_;
    bool gives_;  // ticks and events
    std::unique_ptr<TickPump> pump_;
};

}  // namespace burin::session
