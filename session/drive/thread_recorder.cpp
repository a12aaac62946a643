// SPDX-License-Identifier: MIT
#include "session/drive/thread_recorder.hpp"

#include <span>

#include "compute/mesher/surface.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "scene/mesh_part.hpp"
#include "session/live/session.hpp"
#include "session/record/carved_by.hpp"
#include "session/record/input_source.hpp"
#include "session/record/session_recording.hpp"
#include "session/stream/lsl_streams.hpp"

namespace burin::session {
namespace {

bool same(const wall::OutputPlace& a, const wall::OutputPlace& b) {
    return a.size == b.size && a.monitor_x == b.monitor_x && a.monitor_y == b.monitor_y;
}

}  // namespace

ThreadClock clock_of(Session& session) {
    return {session.start_ns(), session.loop().period_ns(), session.hands().device(0).resolution_m,
            session.hands().pace()};
}

std::uint64_t check_of(const Session& session) {
    CheckSum sum;
    const compute::Surface* surface = session.scene_side().surface();
    for (std::uint32_t i = 0; surface != nullptr && i < surface->tile_count(); ++i) {
        const auto tile = surface->shared_tile(i);
        if (!tile) continue;
        sum.add(std::uint64_t{i});
        sum.add_bytes(std::as_bytes(std::span(tile->vertices)));
        sum.add_bytes(std::as_bytes(std::span(tile->indices)));
    }
    const scene::MeshPart* objects = session.scene_side().objects();
    for (scene::ObjectId id = 1; objects != nullptr && id <= objects->size(); ++id) {
        sum.add(objects->pose(id).position_m);
        sum.add(objects->pose(id).orientation);
    }
    return sum.sum();
}

// ---- Recorder

ThreadRecorder::ThreadRecorder(InputSource& input, Session& session)
    : input_(input),
      session_(session),
      clock_(clock_of(session)),
      tick_text_(clock_),
      update_text_(clock_),
      file_(input.recording()),
      recording_(input.records()) {
    input_.record_threads(text_of(clock_));
}

void ThreadRecorder::outside(std::optional<wall::StereoMode> refused) {
    const std::vector<std::string> heard = session_.log().take_events();
    if (recording_ && !input_.records()) session_.files().notify_of_loss(input_.recording_error()->line());
    recording_ = input_.records();
    if (!recording_) return;
    if (refused) input_.record_threads(refused_text(*refused));
    for (const std::string& message : heard) input_.record_threads(message_text(message));
}

std::optional<ThreadRecorder::Kept> ThreadRecorder::kept() const {
    return file_ ? std::optional(Kept{file_->progress().acknowledged, recording_}) : std::nullopt;
}

void ThreadRecorder::frame(std::span<const haptics::ToolState> tools, const std::vector<scene::SceneUpdate>& updates,
                           const FrameOfViewer& viewer) {
    write_notes();
    if (!input_.records()) return;
    if (!file_) write_ticks();  // a tick is in the ring before its tool is published
    write_updates(updates);
    write_places(viewer.places);
    const PanelMeasured& measured = viewer.measured;
    if (measured.plotted) input_.record_threads(text_of(*measured.plotted));
    if (measured.numbers) input_.record_threads(text_of(*measured.numbers));
    if (measured.acknowledged) input_.record_threads(kept_text(*measured.acknowledged));
    const std::uint64_t activity = session_.activity().check();
    if (std::exchange(activity_, activity) != activity) input_.record_threads(activity_text(activity));
    FrameSeen frame;
    frame.ticks.clear();
    for (const haptics::ToolState& tool : tools) frame.ticks.push_back(tool.tick);
    frame.updates = updates_;
    if (file_) {
        input_.record_frame(frame, viewer.words);
        return;
    }
    frame.check = check_.frame(frame.ticks, viewer.words);
    input_.record_threads(text_of(frame));
}

void ThreadRecorder::finish(const std::vector<scene::SceneUpdate>& updates) {
    outside();
    write_notes();
    if (recording_) {
        if (file_) {
            file_->take_ticks();
        } else {
            write_ticks();
        }
        write_updates(updates);
        if (input_.records()) input_.record_threads(end_text(check_of(session_)));
        outside();
    }
    if (!file_) return;
    if (const compute::CarvingEngine* const engine = session_.scene_side().engine())
        file_->fact_of_end(kCarvedByFact, carved_by(*engine));
    // Its ticks go on where its log has ended.
    if (const auto closed = file_->close(); !closed && recording_)
        session_.files().notify_of_loss(closed.error().line());
}

// A text log has no tables of them.
void ThreadRecorder::write_notes() {
    for (EventMark& mark : session_.notices().take_events()) {
        if (streams_ != nullptr) streams_->event(mark);
        if (file_)
            file_->event(std::move(mark));
        else if (keeps_events_)
            events_.push_back(std::move(mark));
    }
    for (TrialMark& mark : session_.activity().take_trials()) {
        if (streams_ != nullptr) streams_->trial(mark);
        if (file_)
            file_->trial(mark);
        else
            trials_.push_back(std::move(mark));
    }
    if (streams_ == nullptr) return;
    for (EventMark& mark : streams_->take_markers())
        if (file_) file_->event(std::move(mark));
}

void ThreadRecorder::write_ticks() {
    std::vector<TickSeen> ticks;
    haptics::TickRecord record;
    while (session_.channels().records.pop(record)) {
        if (record.tick != ticks_ + ticks.size() + 1 || (record.flags & haptics::kTickSampleDropped) != 0) {
            input_.stop_recording({"the frames or the scene stood still for so long that ticks were lost",
                                   "the recording ends here: it",
                                   "what is in the file is whole and can be replayed; record the rest anew"});
            return;
        }
        check_.tick(0, record);
        ticks.push_back({record.time_ns, record.sample, record.surface_sequence, record.parameter_sequence,
                         (record.flags & haptics::kTickLate) != 0});
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

void ThreadRecorder::write_updates(const std::vector<scene::SceneUpdate>& updates) {
    if (updates.empty()) return;
    std::string text = "updates " + std::to_string(updates_ + 1) + " ";
    for (const scene::SceneUpdate& update : updates) update_text_.write(text, update);
    input_.record_threads(text);
    updates_ += updates.size();
}

void ThreadRecorder::write_places(const std::vector<wall::OutputPlace>& places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i < places_.size() && same(places[i], places_[i])) continue;
        input_.record_threads(text_of(OutputSeen{i, places[i]}));
    }
    places_ = places;
}

}  // namespace burin::session
