// SPDX-License-Identifier: MIT
#include "session/stream/lsl_streams.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

#include "base/ring.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "haptics/tick_record.hpp"
#include "session/stream/stream_inlets.hpp"
#include "session/stream/stream_text.hpp"

namespace burin::session {
namespace {

constexpr auto kPushEvery = std::chrono::milliseconds(10);
constexpr auto kLookEvery = std::chrono::milliseconds(500);
constexpr std::uint64_t kLooksUntilTold = 6;
constexpr std::size_t kMostChunk = 512;  // rows of a push
constexpr std::size_t kMostWaitingMarkers = 16384;
// A marker that is stamped further than this from when it came has no stamp of this kind.
constexpr double kFarthestStamp_s = 3600.0;

}  // namespace

// What the session and both threads share, and what a thread that is left behind keeps.
struct LslStreams::Work {
    struct Row {
        Nanoseconds time_ns = 0;
        std::array<float, kMostStreamedColumns> values{};
    };
    struct WaitingMarker {
        double stamp_s = 0.0;
        std::string text;
    };
    struct Rows {
        Rows(StreamedColumns of, std::size_t room) : columns(std::move(of)), ring(room) {}
        StreamedColumns columns;
        Ring<Row> ring;
        std::uint64_t given = 0;       // by tick()
        double last_stamp_s = -1e300;  // the outlets' thread's
    };
    devices::LslApi api;
    StreamClock clock;
    std::optional<StreamOutlets> outlets;  // the outlets' thread's
    std::optional<StreamInlets> inlets;    // the inlets' thread's
    std::string markers;                   // the predicate by which they are looked for
    std::vector<std::unique_ptr<Rows>> rows;

    std::mutex mutex;  // guards what follows; held by nobody who calls the library
    std::condition_variable wake, ended;
    std::deque<WaitingMarker> going;  // events that wait for the library
    std::uint64_t given_events = 0;
    std::vector<EventMark> heard;
    std::vector<std::string> messages;
    StreamFigures figures;
    bool ends = false, outlets_end = false, inlets_end = false;

    void push_all();
    void push_rows(std::size_t part);
    void push_events();
    void pull_all();
    void note_found(std::uint64_t looks);
    void take(const HeardMarker& marker);
    void tell(std::string message) {
        const std::lock_guard lock(mutex);
        messages.push_back(std::move(message));
    }
};

// ---- The outlets' thread

void LslStreams::Work::push_all() {
    for (bool last = false; !last;) {
        {
            std::unique_lock lock(mutex);
            wake.wait_for(lock, kPushEvery, [&] { return ends; });
            last = ends;
        }
        for (std::size_t part = 0; part < rows.size(); ++part) push_rows(part);
        push_events();
    }
    outlets.reset();  // as a push, this may wait
    const std::lock_guard lock(mutex);
    outlets_end = true;
    ended.notify_all();
}

void LslStreams::Work::push_rows(std::size_t part) {
    Rows& from = *rows[part];
    const std::size_t columns = from.columns.all().size();
    std::vector<float> values;
    std::vector<double> stamps_s;
    for (std::size_t left = from.ring.waiting(); left > 0;) {
        values.clear();
        stamps_s.clear();
        std::uint64_t unordered = 0;
        for (; left > 0 && stamps_s.size() < kMostChunk; --left) {
            const Row& row = *from.ring.oldest();
            const double stamp_s = clock.stamp_s(row.time_ns);
            if (stamp_s > from.last_stamp_s) {
                stamps_s.push_back(from.last_stamp_s = stamp_s);
                values.insert(values.end(), row.values.begin(),
                              row.values.begin() + static_cast<std::ptrdiff_t>(columns));
            } else {
                ++unordered;
            }
            from.ring.drop();
        }
        const bool is_given = stamps_s.empty() || outlets->push(part, values, stamps_s);
        std::string why = is_given ? std::string() : api.why();
        const std::lock_guard lock(mutex);
        figures.unordered += unordered;
        (is_given ? figures.ticks : figures.refused_ticks) += stamps_s.size();
        if (!is_given && figures.refused_ticks == stamps_s.size())
            messages.push_back("streams: " + api.library + " refuses ticks: " + why +
                               "; those are lost to its streams");
    }
}

void LslStreams::Work::push_events() {
    std::deque<WaitingMarker> markers;
    {
        const std::lock_guard lock(mutex);
        markers.swap(going);
    }
    for (const WaitingMarker& marker : markers) {
        const bool is_given = outlets->push_event(marker.text, marker.stamp_s);
        const std::lock_guard lock(mutex);
        figures.events += is_given ? 1 : 0;
    }
}

// ---- The inlets' thread

void LslStreams::Work::pull_all() {
    constexpr double kWait_s = 0.05;
    auto looked = std::chrono::steady_clock::now() - kLookEvery;
    std::uint64_t looks = 0;
    for (;;) {
        {
            std::unique_lock lock(mutex);
            if (wake.wait_for(lock, kPushEvery, [&] { return ends; })) break;
        }
        if (std::chrono::steady_clock::now() - looked >= kLookEvery) {
            inlets->look();
            looked = std::chrono::steady_clock::now();
            note_found(++looks);
        }
        for (const HeardMarker& marker : inlets->pull(kWait_s)) take(marker);
        for (std::string& message : inlets->take_messages()) tell("streams: " + std::move(message));
    }
    inlets.reset();
    const std::lock_guard lock(mutex);
    inlets_end = true;
    ended.notify_all();
}

// Tells once that there is nothing to hear: a name may be misspelt.
void LslStreams::Work::note_found(std::uint64_t looks) {
    const std::size_t found = inlets->found();
    if (found == 0 && looks == kLooksUntilTold)
        tell("streams: no stream of markers is found yet by " + markers + "; it is looked for until the session ends");
    const std::lock_guard lock(mutex);
    figures.marker_streams = found;
}

void LslStreams::Work::take(const HeardMarker& marker) {
    const double now_s = api.local_clock();
    const bool is_sound = std::abs(marker.stamp_s - now_s) <= kFarthestStamp_s;  // false of one that is no number
    EventMark mark{clock.time_ns(is_sound ? marker.stamp_s : now_s), kMarkerEvent, marker.stream + ": " + marker.text};
    if (!is_sound)
        mark.value += " (stamped when it came)";
    else if (!marker.is_corrected)
        mark.value += " (by its sender's clock)";
    const std::lock_guard lock(mutex);
    if (heard.size() >= kMostWaitingMarkers) {
        ++figures.dropped_markers;
        return;
    }
    ++figures.markers;
    heard.push_back(std::move(mark));
}

// ---- The session's threads

Result<std::unique_ptr<LslStreams>> LslStreams::open(const devices::LslApi& api, StreamPlan plan, Clock& clock) {
    auto work = std::make_shared<Work>();
    work->api = api;
    work->clock = measure_stream_clock(api, clock);
    if (!std::isfinite(work->clock.offset_s))
        return fail("liblsl " + api.library, "has a clock that is no number",
                    "name another library by BURIN_LIBLSL, or leave out --lsl and --lsl-markers");
    if (!plan.parts.empty()) {
        BURIN_TRY(outlets, StreamOutlets::open(api, plan.parts, work->clock, plan.source));
        work->outlets.emplace(std::move(outlets));
        for (std::size_t part = 0; part < plan.parts.size(); ++part)
            work->rows.push_back(std::make_unique<Work::Rows>(work->outlets->columns(part), plan.rows));
    }
    if (plan.markers) {
        BURIN_TRY(inlets, StreamInlets::open(api, *plan.markers, plan.source));
        work->inlets.emplace(std::move(inlets));
        work->markers = *plan.markers;
    }
    work->tell(formatted("streams: by liblsl %s, whose clock is %.9f s ahead of the session's, to within %.3f us",
                         api.version().c_str(), work->clock.offset_s, work->clock.within_s * 1e6));
    std::unique_ptr<LslStreams> streams(new LslStreams(work));
    streams->clock_ = &clock;
    streams->patience_ns_ = plan.patience_ns;
    work->outlets_end = !work->outlets;
    work->inlets_end = !work->inlets;
    if (work->outlets) streams->outlets_ = std::thread([work] { work->push_all(); });
    if (work->inlets) streams->inlets_ = std::thread([work] { work->pull_all(); });
    return streams;
}

LslStreams::~LslStreams() { static_cast<void>(close()); }

void LslStreams::tick(std::size_t part, const haptics::TickRecord& tick) {
    if (part >= work_->rows.size()) return;
    Work::Rows& rows = *work_->rows[part];
    Work::Row row{tick.time_ns, {}};
    rows.columns.write(tick, std::span(row.values).first(rows.columns.all().size()));
    ++rows.given;
    static_cast<void>(rows.ring.push(row));  // the ring counts what it refuses
}

void LslStreams::event(const EventMark& event) { give(marker_of(event), event.time_ns); }
void LslStreams::trial(const TrialMark& trial) { give(marker_of(trial), trial.time_ns); }

void LslStreams::give(std::string marker, Nanoseconds time_ns) {
    if (work_->rows.empty()) return;
    const std::lock_guard lock(work_->mutex);
    ++work_->given_events;
    if (work_->going.size() >= kMostWaitingMarkers) return;
    work_->going.push_back({work_->clock.stamp_s(time_ns), std::move(marker)});
}

std::vector<EventMark> LslStreams::take_markers() {
    const std::lock_guard lock(work_->mutex);
    return std::exchange(work_->heard, {});
}

std::vector<std::string> LslStreams::take_messages() {
    std::vector<std::string> messages;
    {
        const std::lock_guard lock(work_->mutex);
        messages = std::exchange(work_->messages, {});
    }
    const std::uint64_t dropped = dropped_ticks();
    // Each time that there are ten times as many.
    if (dropped > 0 && dropped >= 10 * told_drops_) {
        told_drops_ = dropped;
        messages.push_back("streams: " + std::to_string(dropped) +
                           " ticks were dropped, since the library does not take them in time; the session and its "
                           "recording have them");
    }
    return messages;
}

std::uint64_t LslStreams::dropped_ticks() const {
    std::uint64_t dropped = 0;
    for (const auto& rows : work_->rows) dropped += rows->ring.refused();
    return dropped;
}

StreamFigures LslStreams::close() {
    if (closed_) return *closed_;
    bool is_over = false;
    {
        std::unique_lock lock(work_->mutex);
        work_->ends = true;
        work_->wake.notify_all();
        is_over = work_->ended.wait_for(lock, std::chrono::nanoseconds(patience_ns_),
                                        [&] { return work_->outlets_end && work_->inlets_end; });
    }
    for (std::thread* const thread : {&outlets_, &inlets_})
        if (thread->joinable()) is_over ? thread->join() : thread->detach();
    StreamFigures figures;
    {
        const std::lock_guard lock(work_->mutex);
        figures = work_->figures;
        figures.dropped_events = work_->given_events - figures.events;
    }
    std::uint64_t given = 0;
    for (const auto& rows : work_->rows) given += rows->given;
    figures.dropped_ticks = given - figures.ticks - figures.refused_ticks - figures.unordered;
    figures.is_left_behind = !is_over;
    if (is_over) figures.drift_s = measure_stream_clock(work_->api, *clock_).offset_s - work_->clock.offset_s;
    closed_ = figures;
    return figures;
}

std::string StreamFigures::text() const {
    std::string text = std::to_string(ticks) + " ticks and " + std::to_string(events) + " events streamed, " +
                       std::to_string(dropped_ticks + refused_ticks + unordered) + " ticks and " +
                       std::to_string(dropped_events) + " events lost, " + std::to_string(markers) + " markers heard" +
                       (marker_streams == std::size_t{0} ? " since no stream of any was found" : "") +
                       (dropped_markers > 0 ? " and " + std::to_string(dropped_markers) + " lost" : "");
    if (is_left_behind) return text + "; the library does not return, and is left behind";
    return text + formatted("; the clocks drifted by %.1f us", drift_s * 1e6);
}

}  // namespace burin::session
