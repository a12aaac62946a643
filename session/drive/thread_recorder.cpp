// SPDX-License-Identifier: MIT
#include "session/drive/thread_recorder.hpp"

#include <bit>
#include <span>

namespace burin::session {
namespace {

class Fnv {
public:
    explicit Fnv(std::uint64_t seed = 0) : sum_(14695981039346656037u ^ seed) {}
    void add(std::uint64_t bits) {
        for (int i = 0; i < 64; i += 8) add_byte(static_cast<unsigned char>(bits >> i));
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const Vec3& v) {
        for (int i = 0; i < 3; ++i) add(v[i]);
    }
    void add(const Quat& q) {
        for (const double x : {q.w, q.x, q.y, q.z}) add(x);
    }
    void add_bytes(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) add_byte(static_cast<unsigned char>(byte));
    }
    [[nodiscard]] std::uint64_t sum() const { return sum_; }

private:
    void add_byte(unsigned char byte) { sum_ = (sum_ ^ byte) * 1099511628211u; }
    std::uint64_t sum_;
};

ThreadClock clock_of(LiveSession& session) {
    return {session.start_ns(), session.loop().period_ns(), session.device().resolution_m, session.pace()};
}

bool same(const wall::OutputPlace& a, const wall::OutputPlace& b) {
    return a.size == b.size && a.monitor_x == b.monitor_x && a.monitor_y == b.monitor_y;
}

}  // namespace

// ---- Checksums

void SessionCheck::tick(const haptics::TickRecord& record) {
    Fnv fnv(check_);
    fnv.add(static_cast<std::uint64_t>(record.time_ns));
    fnv.add(static_cast<std::uint64_t>(record.sample.time_ns));
    fnv.add(record.surface_sequence);
    fnv.add(record.parameter_sequence);
    for (const Vec3& v :
         {record.sample.position_device_m, record.deepest().hip_object_m, record.deepest().proxy_object_m,
          record.contact.cut_object_m, record.gate.given.force_device_N, record.gate.given.torque_device_Nm})
        fnv.add(v);
    fnv.add(record.sample.orientation_device);
    fnv.add(std::uint64_t{record.flags} << 32 | record.sample.buttons);
    check_ = fnv.sum();
    ticks_.push_back({record.tick, check_});
}

std::uint64_t SessionCheck::frame(std::uint64_t tick, const SessionState& state) {
    while (ticks_.size() > 1 && ticks_[1].tick <= tick) ticks_.pop_front();
    Fnv fnv(!ticks_.empty() && ticks_.front().tick <= tick ? ticks_.front().check : 0);
    for (const Similarity& pose : {state.world_from_object, state.world_from_device}) {
        fnv.add(pose.position_m);
        fnv.add(pose.orientation);
        fnv.add(pose.scale);
    }
    for (const Pose& head : {state.head.poses.left_tracker, state.head.poses.right_tracker}) {
        fnv.add(head.position_m);
        fnv.add(head.orientation);
    }
    fnv.add(state.desk.target_device_m);
    fnv.add(static_cast<std::uint64_t>(state.output.mode));
    return fnv.sum();
}

std::uint64_t check_of(const LiveSession& session) {
    Fnv fnv;
    const compute::Surface* surface = session.surface();
    for (std::uint32_t i = 0; surface != nullptr && i < surface->tile_count(); ++i) {
        const auto tile = surface->shared_tile(i);
        if (!tile) continue;
        fnv.add(std::uint64_t{i});
        fnv.add_bytes(std::as_bytes(std::span(tile->vertices)));
        fnv.add_bytes(std::as_bytes(std::span(tile->indices)));
    }
    const scene::MeshPart* objects = session.objects();
    for (scene::ObjectId id = 1; objects != nullptr && id <= objects->size(); ++id) {
        fnv.add(objects->pose(id).position_m);
        fnv.add(objects->pose(id).orientation);
    }
    return fnv.sum();
}

// ---- Recorder

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
    if (recording_ && !input_.records()) session_.notify_of_loss(input_.recording_error()->line());
    recording_ = input_.records();
    if (!recording_) return;
    if (outside.refused) input_.record_threads(refused_text(*outside.refused));
    for (const std::string& message : outside.heard) input_.record_threads(message_text(message));
}

void ThreadRecorder::frame(std::uint64_t tick, const std::vector<scene::SceneUpdate>& updates,
                           const std::vector<wall::OutputPlace>& places) {
    if (!input_.records()) return;
    write_ticks();  // a tick is in the ring before its tool is published
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

void ThreadRecorder::finish(const std::vector<scene::SceneUpdate>& updates) {
    outside();
    if (!recording_) return;
    write_ticks();
    write_updates(updates);
    if (input_.records()) input_.record_threads(end_text(check_of(session_)));
    outside();
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
        check_.tick(record);
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
