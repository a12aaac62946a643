// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "desk/present/offscreen_output.hpp"
#include "desk/run/session.hpp"
#include "desk/run/session_frames.hpp"
#include "session/drive/thread_replay.hpp"
#include "session/record/log_outputs.hpp"
#include "session/record/tick_source.hpp"

namespace burin::session {
namespace {

constexpr const char* kRemedy = "replay it with the program and the options that recorded it";

// The frames of a recording, each with the places, messages and measured times that it had, and the first place at
// which the session departed from the recording.
class RecordedFrames final : public SessionFrames {
public:
    // All must outlive it. name: the log's file name.
    RecordedFrames(Desk& desk, FrameOutput& output, InputSource input, const ThreadLog& log, const std::string& name,
                   ThreadReplay& replay, const ReplayManner& manner)
        : SessionFrames(desk, output, std::move(input)), log_(log), name_(name), replay_(replay), manner_(manner) {
        session_.log().replay_events(log.messages_before);
        if (manner.notes != nullptr) recorder_.keep_events();
    }

    // Replays what the threads did after the last frame, and checks the surface.
    [[nodiscard]] Result<void> finish_as_recorded() {
        BURIN_TRY_DO(replay_.run_to_end());
        BURIN_TRY_DO(finish(replay_));
        if (manner_.notes != nullptr) *manner_.notes = {recorder_.take_trials(), recorder_.take_events()};
        if (log_.end_check && *log_.end_check != check_of(session_) && !departed_)
            departed_ = Error{"the replay leaves another scene than the recording did", name_, kRemedy};
        return {};
    }
    [[nodiscard]] const std::optional<Error>& departed() const { return departed_; }

private:
    [[nodiscard]] std::optional<FrameInput> next_input() override {
        if (next_ == log_.frames.size() || look_for_signal()) return std::nullopt;
        const auto input = input_.begin_frame(0, 0);
        if (!input) return std::nullopt;
        const FrameSeen& seen = log_.frames[next_++];
        for (const OutputSeen& output : seen.outputs) shown_on_.put(output.screen, output.place);
        desk_.measure_again(seen.measured);
        replay_.begin_frame(seen);
        time_ns_ = input->time_ns;
        return input;
    }

    void stepped() override {
        const FrameSeen& seen = log_.frames[next_ - 1];
        if (!replay_.is_as_recorded(desk_.words()) && !manner_.another_view) note_departure(seen.line);
        if (seen.refused) desk_.go_back_to(*seen.refused);
        if (shown_on_.shows()) static_cast<void>(shown_on_.inputs(0.0));  // ignored: the recording decides
        if (manner_.picture_every_ns <= 0 || time_ns_ < next_picture_ns_) return;
        session_.files().ask_for_picture(formatted("%08.3f.png", seconds(time_ns_)));
        next_picture_ns_ = (time_ns_ / manner_.picture_every_ns + 1) * manner_.picture_every_ns;
    }

    // Draws also what nobody sees: what a frame redraws depends on the previous one.
    [[nodiscard]] bool wants_picture() override { return manner_.draws; }

    void finished(const FrameInput&, bool) override {
        session_.log().replay_events(log_.frames[next_ - 1].messages);
        if (!manner_.draws) static_cast<void>(desk_.take_surface_updates());  // else the picture has taken them
    }

    // Where every tick is compared, the first that differs says more than this does, and stands in a table and no line.
    void note_departure(std::size_t line) {
        if (departed_) return;
        if (manner_.witness != nullptr) {
            departed_ = Error{formatted("the replay departs from the recording at %.3f s: object, device or head are "
                                        "placed otherwise then, though every tick before is equal",
                                        seconds(time_ns_)),
                              name_, kRemedy};
            return;
        }
        departed_ = Error{"the replay departs from the recording here", name_ + ":" + std::to_string(line), kRemedy};
        std::fprintf(stderr, "burin: %s; going on\n", departed_->line().c_str());
    }

    const ThreadLog& log_;
    std::string name_;
    ThreadReplay& replay_;
    ReplayManner manner_;
    Nanoseconds time_ns_ = 0, next_picture_ns_ = 0;  // of the present frame
    std::size_t next_ = 0;                           // index of the next frame
    std::optional<Error> departed_;
};

// Returns what has the recording's ticks, and checks that they are of this session's hands.
Result<std::unique_ptr<TickSource>> ticks_for(const Session& session, const ThreadLog& log, const std::string& name,
                                              const ReplayManner& manner) {
    std::unique_ptr<TickSource> source;
    if (log.ticks.count > 0 || manner.ticks == nullptr) {
        source = ticks_of_lines(log, name);
    } else {
        auto columns = ticks_of_columns(*manner.ticks);
        if (!columns) return columns;
        source = std::move(*columns);
    }
    const std::size_t parts = session.hands().parts();
    const auto other =
        std::ranges::find_if(log.frames, [&](const FrameSeen& seen) { return seen.ticks.size() != source->parts(); });
    if (other != log.frames.end())
        return fail(name + ":" + std::to_string(other->line),
                    "names the ticks of so many parts of hands: " + std::to_string(other->ticks.size()) +
                        ", and the recording has " + std::to_string(source->parts()),
                    "replay it as it was recorded: a text log holds one part, a session file all");
    if (source->parts() == parts) return source;
    return fail(name,
                "has the ticks of so many parts of hands: " + std::to_string(source->parts()) +
                    ", and this session's devices have " + std::to_string(parts),
                "replay it with the --device that it was recorded with");
}

Result<void> check_screens(const FrameOutput& outputs, const ThreadLog& log, const std::string& name) {
    for (const FrameSeen& seen : log.frames) {
        for (const OutputSeen& output : seen.outputs) {
            if (output.screen < outputs.screens()) continue;
            return fail(name + ":" + std::to_string(seen.line),
                        "the recording has " + std::to_string(output.screen + 1) + " screens or more, this session " +
                            std::to_string(outputs.screens()),
                        "give the --wall that it was recorded with");
        }
    }
    return {};
}

}  // namespace

Result<void> replay_as_recorded(const SessionSetup& given, const SessionWall& wall, InputLog log,
                                const ReplayManner& manner) {
    SessionSetup options = given;
    options.record.stands_in = true;
    const LogNeeds needs = needs_of(log.events);
    const ThreadLog threads = std::move(*log.threads);
    const std::string& name = options.record.input;
    InputSource input = InputSource::replay(std::move(log));
    SimulatedClock clock;
    const bool asks_for_pictures = manner.draws && (needs.pictures || manner.picture_every_ns > 0);
    BURIN_TRY(output, open_output(options.desk, wall, asks_for_pictures));
    BURIN_TRY(opened, Desk::create_as_recorded(carving_with(*output, options), wall, threads, name, clock));
    Desk& desk = *opened;
    Session& session = desk.session();
    if (options.desk.offscreen && !needs.panel && !asks_for_pictures) desk.leave_panel_out();
    BURIN_TRY_DO(check_screens(*output, threads, name));

    BURIN_TRY(ticks, ticks_for(session, threads, name, manner));
    ThreadReplay replay(session, threads, std::move(ticks), name);
    replay.judge_ticks(manner.witness);
    RecordedFrames frames(desk, *output, std::move(input), threads, name, replay, manner);
    Result<void> done = drive(replay, frames);
    if (done && !frames.cut_short()) done = frames.finish_as_recorded();
    if (!done && !replay.log_ends()) return done;
    if (!done) std::fprintf(stderr, "burin: %s\n", done.error().line().c_str());
    // An export may be under way where the log breaks off.
    session.finish_scene();
    if (frames.departed()) return std::unexpected(*frames.departed());
    return manner.only_compares ? Result<void>{} : session.files().outcome();
}

}  // namespace burin::session
