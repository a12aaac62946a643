// SPDX-License-Identifier: MIT
#include "session/drive/headless_session.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/try.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "session/drive/executors.hpp"
#include "session/drive/thread_recorder.hpp"
#include "session/live/session.hpp"
#include "session/record/input_source.hpp"
#include "session/record/session_recording.hpp"

namespace burin::session {
namespace {

class HeadlessFrames final : public FrameSource {
public:
    HeadlessFrames(Session& session, const HeadlessRun& run, InputSource input)
        : session_(session), run_(run), input_(std::move(input)), recorder_(input_, session) {
        session_.log().hear_nothing_from_outside();
        static_cast<void>(session_.take_loaded());
    }

    [[nodiscard]] std::optional<Nanoseconds> next() override {
        const Nanoseconds next_ns = frames_ * kNanosecondsPerSecond / run_.frames_a_second;
        if (session_.state().quit || !has_next(next_ns)) return std::nullopt;
        ++frames_;
        time_ns_ = run_.ends_on_time ? std::min(next_ns, run_.lasts_ns) : next_ns;
        return session_.start_ns() + time_ns_;
    }

    [[nodiscard]] Result<void> make(Executor& executor) override {
        const std::vector<haptics::ToolState> tools = executor.tools();
        static_cast<void>(input_.begin_frame(time_ns_, time_ns_));
        std::vector<scene::SceneUpdate> updates;
        const auto step = [&](std::span<const InputEvent> inputs) -> Result<void> {
            session_.begin_step(time_ns_, tools);
            session_.step({.events = inputs}, nobody_,
                          [&](Executor::Order order) { executor.order(std::move(order)); });
            BURIN_TRY(taken, executor.take_updates());
            static_cast<void>(session_.take_news(taken.collected));
            std::ranges::move(taken.updates, std::back_inserter(updates));
            return {};
        };
        BURIN_TRY_DO(run_.make_frame ? run_.make_frame({time_ns_, tools, step}) : step({}));
        recorder_.frame(tools, updates, {{}, {}, {}});
        BURIN_TRY_DO(take_records());
        return run_.after_frame ? run_.after_frame() : Result<void>{};
    }

    [[nodiscard]] Result<void> finish(Executor& executor) {
        BURIN_TRY(last, executor.take_updates());
        if (!input_.records()) empty_rings();  // of what threads have done since the last frame
        session_.finish_scene();
        recorder_.finish(last.updates);
        if (const auto& failed = input_.recording_error()) return std::unexpected(*failed);
        BURIN_TRY_DO(session_.files().outcome());
        return run_.after_frame ? run_.after_frame() : Result<void>{};
    }

private:
    [[nodiscard]] bool has_next(Nanoseconds next_ns) const {
        return run_.plan ? run_.plan(next_ns) : next_ns == 0 || time_ns_ < run_.lasts_ns;
    }
    // No clock holds simulated time back: the rings would overflow while the recorder writes.
    [[nodiscard]] Result<void> take_records() {
        if (const auto file = input_.recording()) file->take_ticks();
        if (const auto& failed = input_.recording_error()) return std::unexpected(*failed);
        if (!input_.records()) empty_rings();
        return {};
    }

    void empty_rings() {
        haptics::TickRecord tick;
        const std::vector<haptics::HapticChannels*> parts = session_.channels_of_parts();
        for (std::size_t part = 0; part < parts.size(); ++part)
            while (parts[part]->records.pop(tick))
                if (run_.on_tick) run_.on_tick(part, tick);
    }

    Session& session_;
    const HeadlessRun& run_;
    InputSource input_;
    ThreadRecorder recorder_;
    Leader nobody_;
    std::int64_t frames_ = 0;
    Nanoseconds time_ns_ = 0;  // of the present frame, in session time
};

Result<InputSource> input_of(Session& session, const HeadlessRun& run) {
    const std::string& path = session.options().record.path;
    if (path.empty()) return InputSource::live();
    if (run.make_frame)
        return fail(path, "would lack the input that this session's own program gives it", "leave the recording out");
    SessionFacts facts = run.facts;
    facts.emplace_back(kViewerFact, kNoViewer);
    BURIN_TRY(writer, create_recording(session.options(), facts, session, run.on_tick));
    return InputSource::live(std::move(writer));
}

}  // namespace

Result<void> run_headless(Session& session, SimulatedClock& clock, const HeadlessRun& run) {
    BURIN_TRY(input, input_of(session, run));
    HeadlessFrames frames(session, run, std::move(input));
    SteppedExecutor executor(clock, session.loop(), session.channels_of_parts(), session.scene(),
                             [&](const auto& ended) { static_cast<void>(session.collect(ended)); });
    executor.collect_after_updates_alone();
    if (run.tick_ns != nullptr) executor.measure_ticks(*run.tick_ns);
    BURIN_TRY_DO(drive(executor, frames));
    return frames.finish(executor);
}

Result<std::string> run_headless_in_real_time(Session& session, Clock& clock, const HeadlessRun& run) {
    BURIN_TRY(input, input_of(session, run));
    HeadlessRun from_start = run;
    HeadlessFrames frames(session, from_start, std::move(input));
    ThreadedExecutor threads(clock, session.loop(), session.channels_of_parts(), session.scene(),
                             {.lead_ns = haptics::HapticLoop::kLead_ns},
                             [&](const auto& ended) { static_cast<void>(session.collect(ended)); });
    haptics::RealtimeNotice notice = threads.start();
    // Threads take a while to start, above all to lock memory; the hand begins with the first tick.
    from_start.lasts_ns += clock.now_ns() - session.start_ns();
    BURIN_TRY_DO(drive(threads, frames));
    BURIN_TRY_DO(frames.finish(threads));
    return std::move(notice.text);
}

}  // namespace burin::session
