// SPDX-License-Identifier: MIT
#include "desk/run/session_frames.hpp"

#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "desk/present/offscreen_output.hpp"
#include "desk/run/session.hpp"
#include "session/drive/executors.hpp"
#include "session/record/log_outputs.hpp"
#include "session/record/session_recording.hpp"

namespace burin::session {
namespace {

constexpr Nanoseconds kLate_ns = 100'000'000;  // a few frames on a machine that keeps up

}  // namespace

Result<void> step_frame(Desk& desk, Executor& executor, ThreadRecorder& recorder, const FrameInput& input,
                        const std::vector<wall::OutputPlace>& places) {
    const std::vector<haptics::ToolState> tools = executor.tools();
    const SessionWall& wall = desk.room().wall;
    desk.step(
        input, places[wall.main], tools, [&](Executor::Order order) { executor.order(std::move(order)); },
        wall.has_panel_window() ? places.back().size : ImageSize{});
    BURIN_TRY(taken, executor.take_updates());
    desk.take_news(taken.collected);
    recorder.frame(tools, taken.updates, {places, desk.measured(), desk.words()});
    return {};
}

SessionFrames::SessionFrames(Desk& desk, FrameOutput& output, InputSource input)
    : desk_(desk), session_(desk.session()), shown_on_(output), input_(std::move(input)), recorder_(input_, session_) {
    desk.take_loaded();
}

std::optional<Nanoseconds> SessionFrames::next() {
    if (session_.state().quit) {
        tell_of_what_follows();
        return std::nullopt;
    }
    const std::optional<FrameInput> input = next_input();
    if (!input) return std::nullopt;
    frame_ = *input;
    return session_.start_ns() + frame_.time_ns;
}

// A script goes on after what ends the session only by mistake.
void SessionFrames::tell_of_what_follows() {
    const InputEvent* const next = input_.next_command();
    if (next == nullptr) return;
    session_.notify_of_event(
        formatted("the session has ended at %.2f s: command %s of %.2f s, and all that follows in "
                  "the log, was not done",
                  seconds(frame_.time_ns), std::get<CommandInput>(next->input).name.c_str(), seconds(next->time_ns)),
        MessageKind::warning);
}

Result<void> SessionFrames::make(Executor& executor) {
    BURIN_TRY_DO(step_frame(desk_, executor, recorder_, frame_, shown_on_.places()));
    stepped();
    BURIN_TRY(anew, draw(executor));
    finished(frame_, anew);
    return {};
}

// Returns whether there was anything new. A device that was lost is replaced, the new one is offered to the engine, and
// the frame is drawn again.
Result<bool> SessionFrames::draw(Executor& executor) {
    while (wants_picture()) {
        Result<bool> anew = shown_on_.draw(desk_, frame_.display_ns);
        if (anew) return anew;
        if (shown_on_.has_lost_display()) return false;  // the next turn ends the session
        BURIN_TRY_DO(shown_on_.recover(desk_, anew.error()));
        if (auto offer = shown_on_.offer()) executor.order(std::move(*offer));
    }
    return false;
}

Result<void> SessionFrames::finish(Executor& executor) {
    BURIN_TRY(last, executor.take_updates());
    session_.finish_scene();
    tell_of_late_input();
    recorder_.finish(last.updates);
    return {};
}

// A hand that a log leads does something else where the log's events come late, and nothing else shows that.
void SessionFrames::tell_of_late_input() {
    if (input_.latest_by_ns() < kLate_ns) return;
    const std::string late = formatted("%.2f s", 1e-9 * static_cast<double>(input_.latest_by_ns()));
    session_.notify_of_event(
        "the input came up to " + late +
            " late, since frames took long: what was done is not what it says; without a recording "
            "or streams it is done in simulated time",
        MessageKind::warning);
    if (const auto recording = input_.recording()) recording->fact_of_end(kInputLateFact, late);
}

bool SessionFrames::look_for_signal() {
    if (!end_.came()) return false;
    cut_short_ = true;
    session_.files().notify_of_loss("the session was ended by a signal; what follows in the log was not done");
    return true;
}

// ---- A script

std::optional<FrameInput> ScriptedFrames::next_input() {
    if (look_for_signal()) return std::nullopt;
    const std::optional<FrameInput> input = input_.begin_frame(0, 0);
    if (input) shown_on_.look();
    return input;
}

void ScriptedFrames::stepped() {
    if (shown_on_.shows()) static_cast<void>(shown_on_.inputs(0.0));  // ignored: the script decides
    // Fails where the device is lost, which the next picture meets.
    const bool is_drawn = shown_on_.shows() || session_.files().wants_pictures();
    if (!is_drawn && shown_on_.has_drawn()) static_cast<void>(shown_on_.fit_modes(desk_));
}

Result<void> run_in_simulated_time(const SessionSetup& options, const SessionWall& wall, InputLog log) {
    SimulatedClock clock;
    const LogNeeds needs = needs_of(log.events);
    BURIN_TRY(output, open_output(options.desk, wall, needs.pictures));
    BURIN_TRY(opened, Desk::create(carving_with(*output, options), wall, clock));
    Desk& desk = *opened;
    Session& session = desk.session();
    if (options.desk.offscreen && !needs.panel) desk.leave_panel_out();
    ScriptedFrames frames(desk, *output, InputSource::replay(std::move(log)));
    SteppedExecutor executor(clock, session.loop(), session.channels_of_parts(), session.scene(),
                             [&](const auto& ended) { static_cast<void>(session.collect(ended)); });
    BURIN_TRY_DO(drive(executor, frames));
    session.finish_scene();
    return session.files().outcome();
}

}  // namespace burin::session
