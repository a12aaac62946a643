// SPDX-License-Identifier: MIT
#include "app/session/thread_recorder.hpp"

namespace burin {
namespace {

ThreadClock clock_of(LiveSession& session) {
    return {session.start_ns(), session.loop().period_ns(), session.device().resolution_m};
}

bool same(const OutputPlace& a, const OutputPlace& b) {
    return a.size == b.size && a.monitor_x == b.monitor_x && a.monitor_y == b.monitor_y;
}

}  // namespace

ThreadRecorder::ThreadRecorder(InputSource& input, LiveSession& session)
    : input_(input),
      session_(session),
      clock_(clock_of(session)),
      tick_text_(clock_),
      update_text_(clock_),
      recording_(input.records()) {
    input_.record_threads(text_of(clock_));
}

void ThreadRecorder::outside() {
    const LiveSession::Outside outside = session_.take_outside();
    if (recording_ && !input_.records()) session_.say(input_.recording_error()->line());
    recording_ = input_.records();
    if (!recording_) return;
    if (outside.refused) input_.record_threads(refused_text(*outside.refused));
    for (const std::string& message : outside.heard) input_.record_threads(said_text(message));
}

void ThreadRecorder::frame(std::uint64_t tick, const std::vector<UpdateSeen>& updates,
                           const std::vector<OutputPlace>& places) {
    if (!input_.records()) return;
    write_ticks();  // a tick is in the ring before its tool can be seen
    write_updates(updates);
    write_places(places);
    const PanelMeasured& measured = session_.measured();
    if (measured.plotted) input_.record_threads(text_of(*measured.plotted));
    if (measured.numbers) input_.record_threads(text_of(*measured.numbers));
    FrameSeen frame;
    frame.tick = tick;
    frame.updates = updates_;
    frame.check = check_.frame(tick, session_.state());
    input_.record_threads(text_of(frame));
}

void ThreadRecorder::finish(const std::vector<UpdateSeen>& updates) {
    outside();
    if (!recording_) return;
    write_ticks();
    write_updates(updates);
    if (input_.records()) input_.record_threads(end_text(check_of(session_.surface())));
    outside();
}

void ThreadRecorder::write_ticks() {
    std::vector<TickSeen> ticks;
    TickRecord record;
    while (session_.channels().records.pop(record)) {
        if (record.tick != ticks_ + ticks.size() + 1 || (record.flags & kTickSampleDropped) != 0) {
            input_.stop_recording({"the frames or the carving stood still for so long that ticks were lost",
                                   "the recording ends here: it",
                                   "what is in the file is whole and can be replayed; record the rest anew"});
            return;
        }
        check_.tick(record);
        ticks.push_back({record.time_ns, record.sample, record.surface_sequence, record.parameter_sequence,
                         (record.flags & kTickLate) != 0});
        if (ticks.size() == kMostTicksALine) write_ticks(std::exchange(ticks, {}));
    }
    write_ticks(ticks);
}

void ThreadRecorder::write_ticks(const std::vector<TickSeen>& ticks) {
    if (ticks.empty()) return;
    std::string text = "ticks " + std::to_string(ticks_ + 1) + " ";
    for (const TickSeen& tick : ticks) tick_text_.write(text, tick);
    input_.record_threads(text);
    ticks_ += ticks.size();
}

void ThreadRecorder::write_updates(const std::vector<UpdateSeen>& updates) {
    if (updates.empty()) return;
    std::string text = "updates " + std::to_string(updates_ + 1) + " ";
    for (const UpdateSeen& update : updates) update_text_.write(text, update);
    input_.record_threads(text);
    updates_ += updates.size();
}

void ThreadRecorder::write_places(const std::vector<OutputPlace>& places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i < places_.size() && same(places[i], places_[i])) continue;
        input_.record_threads(text_of(OutputSeen{i, places[i]}));
    }
    places_ = places;
}

}  // namespace burin
