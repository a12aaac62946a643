// SPDX-License-Identifier: MIT
#include "session/drive/session_streams.hpp"

#include <unistd.h>

#include <array>
#include <utility>

#include "base/try.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "session/live/session.hpp"
#include "session/options/session_setup.hpp"
#include "session/record/session_recording.hpp"
#include "session/stream/lsl_streams.hpp"
#include "session/stream/stream_text.hpp"
#include "session/stream/tick_pump.hpp"

namespace burin::session {
namespace {

// Of this process and session alone: a stream of this source that comes back is not another session's.
std::string own_source(Nanoseconds now_ns) {
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) host = {"host"};
    return "burin-" + streamable(host.data()) + "-" + std::to_string(::getpid()) + "-" + std::to_string(now_ns);
}

std::vector<StreamedPart> streamed_parts(SessionHands& hands) {
    std::vector<StreamedPart> parts;
    for (std::size_t part = 0; part < hands.parts(); ++part)
        parts.push_back({hands.name_of(part), hands.device(part), hands.channels(part).parameters.newest().probe,
                         1.0 / seconds(hands.loop().period_ns())});
    return parts;
}

}  // namespace

Result<void> check_streams(const RecordSetup& record) {
    if (!wants_streams(record)) return {};
    if (record.lsl && !record.path.empty() && !is_session_file(record.path))
        return fail("--lsl", "has no ticks of a session that is recorded as text, whose log alone reads them",
                    "record into a session file: --record FILE.session");
    if (record.lsl_markers && !record.path.empty() && !is_session_file(record.path))
        return fail("--lsl-markers", "hears markers for the events of a recording, and a log as text has none",
                    "record into a session file: --record FILE.session");
    if (record.lsl_markers && record.path.empty())
        return fail("--lsl-markers", "hears markers for the events of a recording, and there is none",
                    "give --record FILE.session as well");
    if (record.lsl_markers) BURIN_TRY_DO(marker_predicate(*record.lsl_markers));
    const auto api = devices::load_lsl_api();
    return api ? Result<void>{} : std::unexpected(api.error());
}

Result<std::unique_ptr<SessionStreams>> SessionStreams::open(const RecordSetup& record, Session& session,
                                                             Clock& clock) {
    if (!wants_streams(record)) return std::unique_ptr<SessionStreams>();
    BURIN_TRY(api, devices::load_lsl_api());
    StreamPlan plan;
    if (record.lsl) plan.parts = streamed_parts(session.hands());
    if (record.lsl_markers) {
        BURIN_TRY(predicate, marker_predicate(*record.lsl_markers));
        plan.markers = std::move(predicate);
    }
    plan.source = own_source(clock.now_ns());
    BURIN_TRY(lsl, LslStreams::open(api, std::move(plan), clock));
    return std::unique_ptr<SessionStreams>(new SessionStreams(session, std::move(lsl), record.lsl));
}

SessionStreams::SessionStreams(Session& session, std::unique_ptr<LslStreams> lsl, bool gives)
    : session_(session), lsl_(std::move(lsl)), gives_(gives) {}

SessionStreams::~SessionStreams() { pump_.reset(); }

record::OnRecord SessionStreams::taker() {
    if (!gives_) return {};
    return [this](std::size_t part, const haptics::TickRecord& tick) { lsl_->tick(part, tick); };
}

void SessionStreams::read_rings() {
    if (!gives_) return;
    std::vector<Ring<haptics::TickRecord>*> rings;
    for (haptics::HapticChannels* const channels : session_.channels_of_parts()) rings.push_back(&channels->records);
    pump_ = std::make_unique<TickPump>(std::move(rings), taker());
}

StreamFigures SessionStreams::finish() {
    if (pump_) pump_->stop();
    StreamFigures figures = lsl_->close();
    // What a full ring has refused never came this far.
    for (haptics::HapticChannels* const channels : session_.channels_of_parts())
        if (gives_) figures.dropped_ticks += channels->records.refused();
    return figures;
}

}  // namespace burin::session
