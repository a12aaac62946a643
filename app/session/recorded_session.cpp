// SPDX-License-Identifier: MIT
#include "app/session/recorded_session.hpp"

#include <cstdio>

#include "app/session/input_source.hpp"
#include "app/session/session_stage.hpp"
#include "app/session/thread_replay.hpp"

namespace burin {
namespace {

// One replay on its way, and where it first went another way than the recording.
class Replaying {
public:
    Replaying(LiveSession& session, SessionStage& stage, const ThreadLog& log, const std::string& name)
        : session_(session), stage_(stage), threads_(session, log, name), name_(name) {
        session_.hear_again(log.said_before);
    }

    Result<void> frame(const FrameInput& input, const FrameSeen& seen) {
        if (const auto put = put_outputs(seen); !put) return put;
        const Result<ToolState> tool = threads_.tool_of(seen);
        if (!tool) return std::unexpected(tool.error());
        session_.measure_again(seen.measured);
        session_.step(input, stage_.place(), *tool, [&](CarvingOrder order) { threads_.order(std::move(order)); });
        auto news = threads_.news_of(seen);
        if (!news) return std::unexpected(news.error());
        if (*news) session_.take(std::move(**news));
        if (!threads_.is_as_recorded(seen)) note_departure(seen.line);
        if (seen.refused) session_.go_back_to(*seen.refused);
        if (stage_.shows()) static_cast<void>(stage_.inputs(0.0));  // the recording has the say
        // Also what nobody sees: what a frame draws anew depends on the one before.
        if (const auto drawn = stage_.draw(session_, input.display_ns); !drawn) return std::unexpected(drawn.error());
        session_.hear_again(seen.said);
        return {};
    }

    // What the threads did after the last frame.
    Result<void> finish(const ThreadLog& log) {
        auto news = threads_.finish();
        if (!news) return std::unexpected(news.error());
        session_.desk().finish_export();
        add(*news, session_.desk().take_news());
        if (*news) session_.take(std::move(**news));
        if (log.end_check && *log.end_check != check_of(session_.surface()) && !departed_) {
            departed_ = Error{"the replay leaves another surface than the recording did", name_, kRemedy};
        }
        return {};
    }

    [[nodiscard]] bool log_ends() const { return threads_.log_ends(); }
    [[nodiscard]] const std::optional<Error>& departed() const { return departed_; }

private:
    static constexpr const char* kRemedy = "replay it with the program and the options that recorded it";

    Result<void> put_outputs(const FrameSeen& seen) {
        for (const OutputSeen& output : seen.outputs) {
            if (output.screen >= stage_.screens())
                return fail(name_ + ":" + std::to_string(seen.line),
                            "the recording has " + std::to_string(output.screen + 1) +
                                " screens or more, this session " + std::to_string(stage_.screens()),
                            "give the --wall that it was recorded with");
            stage_.put(output.screen, output.place);
        }
        return {};
    }

    void note_departure(std::size_t line) {
        if (departed_) return;
        departed_ = Error{"the replay departs from the recording here", name_ + ":" + std::to_string(line), kRemedy};
        std::fprintf(stderr, "burin: %s; going on\n", departed_->line().c_str());
    }

    LiveSession& session_;
    SessionStage& stage_;
    ThreadReplay threads_;
    std::string name_;
    std::optional<Error> departed_;
};

Result<void> check_device(LiveSession& session, const ThreadLog& log, const std::string& name) {
    if (log.clock.period_ns == session.loop().period_ns()) return {};
    return fail(name,
                "its ticks are " + std::to_string(log.clock.period_ns) + " ns apart, this device's " +
                    std::to_string(session.loop().period_ns()),
                "replay it with the device that it was recorded with");
}

}  // namespace

Result<void> replay_as_recorded(const SculptOptions& options, const SessionWall& wall, InputLog log) {
    const ThreadLog threads = std::move(*log.threads);
    const std::string& name = options.live.input;
    InputSource input = InputSource::replay(std::move(log));
    SimulatedClock clock;
    clock.sleep_until(threads.clock.start_ns);  // so that all times are the same, to the bit
    auto session = LiveSession::create(options, wall, clock);
    if (!session) return std::unexpected(session.error());
    LiveSession& s = **session;
    if (const auto fits = check_device(s, threads, name); !fits) return fits;
    Result<SessionStage> stage = SessionStage::open(options.live, wall);
    if (!stage) return std::unexpected(stage.error());
    if (auto news = s.desk().take_news()) s.take(std::move(*news));

    Replaying replaying(s, *stage, threads, name);
    Result<void> done;
    for (const FrameSeen& seen : threads.frames) {
        const auto frame = input.begin_frame(0, 0);
        if (!frame) break;
        done = replaying.frame(*frame, seen);
        if (!done || s.state().quit) break;
    }
    if (done) done = replaying.finish(threads);
    if (!done && !replaying.log_ends()) return done;
    if (!done) std::fprintf(stderr, "burin: %s\n", done.error().line().c_str());
    if (replaying.departed()) return std::unexpected(*replaying.departed());
    return {};
}

}  // namespace burin
