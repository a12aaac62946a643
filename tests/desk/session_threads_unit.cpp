// SPDX-License-Identifier: MIT
// What the threads of a live session did, recorded, and done again on one thread.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <vector>

#include "desk/run/session_frames.hpp"
#include "session/drive/thread_replay.hpp"
#include "session/record/tick_source.hpp"
#include "session/state/session_settings.hpp"
#include "tests/desk/threads_seen.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

constexpr ImageSize kSize{640, 360};

// Into the ball's front and along it, an undo and another tool between two strokes.
const std::string kScript = R"(burin-input 1 test
0.02 mouse 320 180
0.05 scroll 0 15
0.25 button press left
0.27 scroll 0 8
0.4 mouse 330 184
0.5 mouse 350 190
0.6 mouse 370 196
0.7 button release left
0.72 command undo
0.74 command tool ball:0.015
0.76 button press left
0.8 mouse 350 190
0.9 mouse 330 184
1 mouse 320 170
1.1 button release left
1.15 close
)";

SessionSetup options_for(const std::string& record) {
    SessionSetup options = carving_setup();
    options.carve.workpiece.resolution = 32;
    options.hands.tool.shape = "ball:0.012";
    options.carve.engine = compute::EngineChoice::cpu;
    options.threads = 1;
    options.record.path = record;
    return options;
}

// A session that is recorded, without pictures, and what came of it.
struct Live {
    std::string log;
    std::uint64_t untouched = 0, surface = 0, ticks = 0;
    Vec3 force_N{0.0};
};

class RecordedSession {
public:
    RecordedSession(const Workplace& place, Clock& clock, double pace = 1.0) : place_(place) {
        const std::string path = (place / "live.log").string();
        const SessionSetup options = options_for(path);
        desk = Desk::create(options, *session_wall(options.desk), clock, pace).value();
        auto writer = InputLogWriter::create(path, settings_line(options));
        auto script = parse_input_log(kScript, "script");
        if (!writer || !script) throw std::runtime_error("the session does not open");
        untouched_ = check_of(desk->session());
        input.emplace(InputSource::play(std::move(*script), std::move(*writer)));
        recorder.emplace(*input, desk->session());
    }
    Live finish(Executor& executor) {
        recorder->finish(executor.take_updates()->updates);
        return {place_.read("live.log"), untouched_, check_of(desk->session()), desk->session().loop().ticks(),
                desk->session().newest_tool().given.force_device_N};
    }

    std::unique_ptr<Desk> desk;
    std::optional<InputSource> input;
    std::optional<ThreadRecorder> recorder;

private:
    const Workplace& place_;
    std::uint64_t untouched_ = 0;
};

// Its frames, one each period of its clock, when its threads are ready for it.
class UndrawnFrames final : public FrameSource {
public:
    UndrawnFrames(RecordedSession& of, Clock& clock, Nanoseconds period_ns, ThreadsSeen* threads = nullptr)
        : of_(of), clock_(clock), period_ns_(period_ns), threads_(threads) {}
    [[nodiscard]] std::optional<Nanoseconds> next() override {
        if (of_.desk->session().state().quit) return ended();
        clock_.sleep_until(clock_.now_ns() + period_ns_);
        if (threads_ != nullptr) threads_->wait(period_ns_);
        of_.recorder->outside();
        const Nanoseconds now_ns = clock_.now_ns() - of_.desk->session().start_ns();
        const auto input = of_.input->begin_frame(now_ns, now_ns + 10'000'000);
        if (!input) return ended();
        frame_ = *input;
        return clock_.now_ns();
    }
    [[nodiscard]] Result<void> make(Executor& executor) override {
        const auto done = step_frame(*of_.desk, executor, *of_.recorder, frame_, {{.size = kSize}});
        if (!done) static_cast<void>(ended());
        return done;
    }

private:
    std::optional<Nanoseconds> ended() {
        if (threads_ != nullptr) threads_->frames_end();
        return std::nullopt;
    }

    RecordedSession& of_;
    Clock& clock_;
    Nanoseconds period_ns_;
    ThreadsSeen* threads_;
    FrameInput frame_;
};

// With its threads, and a frame every 5 ms, at the machine's pace.
Live live(const Workplace& place) {
    PacedClock clock(2);  // the hand's thread and the frames
    RecordedSession recorded(place, clock);
    Session& s = recorded.desk->session();
    ThreadsSeen seen(s, clock, 300);
    UndrawnFrames frames(recorded, clock, 5'000'000, &seen);
    ThreadedExecutor threads(clock, s.loop(), s.channels_of_parts(), s.scene(), {},
                             [&](const auto& ended) { seen.update_ended(ended); });
    static_cast<void>(threads.start());
    EXPECT_TRUE(drive(threads, frames));
    return recorded.finish(threads);
}

// Does what threads come to now and then, each time: ticks after a frame has asked for its tool see older parameters
// than that frame sets; ticks whose samples an update has not taken see the surface before it; and in every other frame
// the tool is of a tick before the last that an earlier update has taken.
class OvertakingExecutor final : public Executor {
public:
    OvertakingExecutor(Session& session, SimulatedClock& clock) : session_(session), clock_(clock) {}
    [[nodiscard]] Result<void> advance_to(Nanoseconds) override {
        late_ = !late_;
        tick(4);
        tool_ = late_ ? before_update_ : session_.newest_tool();
        tick(3);
        return {};
    }
    [[nodiscard]] std::vector<haptics::ToolState> tools() override { return {tool_}; }
    void order(Order order) override {
        order();
        ++orders_;
    }
    [[nodiscard]] Result<Taken> take_updates() override {
        tick(1);
        before_update_ = session_.newest_tool();
        tick(4);
        const scene::SceneUpdate update{
            clock_.now_ns(), std::exchange(orders_, 0), {session_.loop().ticks() - 3}, {scene::PartSeen{}}};
        if (const auto done = session_.scene().repeat(update); !done) return std::unexpected(done.error());
        static_cast<void>(session_.collect({}));
        return Taken{{update}};
    }

private:
    void tick(int times) {
        for (int i = 0; i < times; ++i) {
            clock_.sleep_until(clock_.now_ns() + 1'000'000);
            session_.loop().step();
        }
    }
    Session& session_;
    SimulatedClock& clock_;
    haptics::ToolState tool_, before_update_;
    bool late_ = true;
    std::size_t orders_ = 0;
};

Live overtaking(const Workplace& place, double pace = 1.0) {
    SimulatedClock clock;
    RecordedSession recorded(place, clock, pace);
    UndrawnFrames frames(recorded, clock, 0);
    OvertakingExecutor executor(recorded.desk->session(), clock);
    EXPECT_TRUE(drive(executor, frames));
    return recorded.finish(executor);
}

// The same again. How many frames were not as recorded; an Error where there is no going on.
struct Again {
    std::size_t frames = 0, departed = 0;
    std::uint64_t surface = 0;
    Vec3 force_N{0.0};
    std::uint64_t ticks = 0;
    double pace = 0.0;
    std::optional<Error> error;
    bool log_ends = false;
};

class FramesAgain final : public FrameSource {
public:
    FramesAgain(Desk& desk, InputSource input, const ThreadLog& log, ThreadReplay& replay, Again& result)
        : desk_(desk), input_(std::move(input)), log_(log), replay_(replay), result_(result) {}
    [[nodiscard]] std::optional<Nanoseconds> next() override {
        if (result_.frames == log_.frames.size()) return std::nullopt;
        frame_ = input_.begin_frame(0, 0).value();
        replay_.begin_frame(log_.frames[result_.frames]);
        return frame_.time_ns;
    }
    [[nodiscard]] Result<void> make(Executor& executor) override {
        if (const auto done = step_frame(desk_, executor, recorder_, frame_, {{.size = kSize}}); !done) return done;
        const bool same_tool = replay_.tools().front().tick == log_.frames[result_.frames++].ticks.front();
        if (!same_tool || !replay_.is_as_recorded(desk_.words())) ++result_.departed;
        return {};
    }

private:
    Desk& desk_;
    InputSource input_;
    const ThreadLog& log_;
    ThreadReplay& replay_;
    Again& result_;
    ThreadRecorder recorder_{input_, desk_.session()};
    FrameInput frame_;
};

Again again(const std::string& text) {
    Again result;
    auto log = parse_input_log(text, "live.log");
    if (!log || !log->threads) {
        result.error = log ? Error{"no threads", "", ""} : log.error();
        return result;
    }
    const ThreadLog threads = *log->threads;
    SimulatedClock clock;
    const SessionSetup options = options_for("");
    auto desk = Desk::create_as_recorded(options, *session_wall(options.desk), threads, "live.log", clock);
    if (!desk) {
        result.error = desk.error();
        return result;
    }
    Session& s = (*desk)->session();
    ThreadReplay replay(s, threads, ticks_of_lines(threads, "live.log"), "live.log");
    FramesAgain frames(**desk, InputSource::replay(std::move(*log)), threads, replay, result);
    Result<void> done = drive(replay, frames);
    if (done) done = replay.run_to_end();
    if (!done) {
        result.error = done.error();
        result.log_ends = replay.log_ends();
        return result;
    }
    result.surface = check_of(s);
    result.force_N = s.newest_tool().given.force_device_N;
    result.ticks = s.loop().ticks();
    result.pace = s.channels().parameters.newest().work.pace;
    return result;
}

bool log_has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// A tick in the middle of the log that moves, moved otherwise.
std::string with_another_move(const std::string& text) {
    std::size_t at = text.find(" ticks ", text.size() / 3);
    at = text.find('z', at);
    EXPECT_NE(at, std::string::npos);
    std::string changed = text;
    changed.replace(at, changed[at + 1] == '-' ? 3 : 2, "z7");
    return changed;
}

}  // namespace

// ---- A whole session

TEST(ThreadReplay, DoesTheSameAsTheThreadsDid) {
    const Workplace place;
    const Live was = live(place);
    ASSERT_GT(was.ticks, 500u);
    const Again is = again(was.log);
    ASSERT_FALSE(is.error) << is.error->line();
    EXPECT_GT(is.frames, 50u);
    EXPECT_EQ(is.departed, 0u);
    EXPECT_EQ(is.ticks, was.ticks);
    EXPECT_EQ(is.surface, was.surface);
    EXPECT_EQ(is.force_N, was.force_N);
    EXPECT_NE(was.surface, was.untouched);  // it carved
    EXPECT_TRUE(log_has(was.log, "o1"));
}

TEST(ThreadReplay, KeepsWhatTicksSawThatTheRestHasOvertaken) {
    const Workplace place;
    const Live was = overtaking(place);
    EXPECT_EQ(parse_input_log(was.log, "live.log")->threads->frames.at(1).ticks.front(), 8u)
        << "not the executor's tool";
    ASSERT_GT(was.ticks, 500u);
    EXPECT_NE(was.surface, was.untouched);
    const Again is = again(was.log);
    ASSERT_FALSE(is.error) << is.error->line();
    EXPECT_GT(is.frames, 50u);
    EXPECT_EQ(is.departed, 0u);
    EXPECT_EQ(is.surface, was.surface);
    EXPECT_EQ(is.force_N, was.force_N);
}

// What a tick may compute depends on how fast the machine of the recording was, not on that of the replay.
TEST(ThreadReplay, BoundsTheTicksWorkByThePaceOfTheRecording) {
    const Workplace place, another;
    const Again as_recorded = again(overtaking(place, 1.7).log);
    ASSERT_FALSE(as_recorded.error);
    EXPECT_EQ(as_recorded.pace, 1.7);
    EXPECT_EQ(as_recorded.departed, 0u);
    // So slow that no tick finishes its contact.
    const std::string slow = overtaking(another, 900.0).log;
    ASSERT_TRUE(log_has(slow, " 900\n"));
    EXPECT_EQ(again(slow).departed, 0u);
    EXPECT_GT(again(replaced(slow, " 900\n", " 1\n")).departed, 0u);
}

TEST(ThreadReplay, NoticesWhatIsNotAsItWas) {
    const Workplace place;
    const Live was = live(place);
    const Again is = again(with_another_move(was.log));
    ASSERT_FALSE(is.error) << is.error->line();
    EXPECT_GT(is.departed, 0u);
    EXPECT_LT(is.departed, is.frames);  // until then it was
}

TEST(ThreadReplay, GoesAsFarAsATornLogDoes) {
    const Workplace place;
    const Live was = live(place);
    const std::size_t whole = again(was.log).frames;
    for (const double part : {0.3, 0.501, 0.75}) {
        const Again is = again(was.log.substr(0, static_cast<std::size_t>(part * static_cast<double>(was.log.size()))));
        if (is.error) {
            EXPECT_TRUE(is.log_ends) << is.error->line();
        }
        EXPECT_GT(is.frames, 0u);
        EXPECT_LT(is.frames, whole);
        EXPECT_EQ(is.departed, 0u);
    }
}

TEST(ThreadReplay, NamesTheLineThatContradictsTheOthers) {
    const Workplace place;
    const Live was = live(place);
    const auto line_with = [](const std::string& text, const std::string& part) {
        const std::size_t at = text.find(part);
        return "live.log:" + std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
    };
    // Parameters that no frame sets.
    const std::string settings = replaced(was.log, "p1", "p900000");
    const Again of_settings = again(settings);
    ASSERT_TRUE(of_settings.error);
    EXPECT_TRUE(log_has(of_settings.error->line(), line_with(settings, "p900000") + ": "));
    EXPECT_TRUE(log_has(of_settings.error->line(), "parameters")) << of_settings.error->line();
    // An order that nobody gave.
    const std::string orders = replaced(was.log, "o1", "o900");
    const Again of_orders = again(orders);
    ASSERT_TRUE(of_orders.error);
    EXPECT_TRUE(log_has(of_orders.error->line(), line_with(orders, "o900") + ": ")) << of_orders.error->line();
    EXPECT_FALSE(of_orders.log_ends);
}

TEST(ThreadRecorder, EndsTheRecordingWhenTicksWereLost) {
    const Workplace place;
    const std::string path = (place / "live.log").string();
    const SessionSetup options = options_for(path);
    SimulatedClock clock;
    const auto wall = session_wall(options.desk);
    auto desk = Desk::create(options, *wall, clock);
    ASSERT_TRUE(desk);
    auto writer = InputLogWriter::create(path, settings_line(options));
    ASSERT_TRUE(writer);
    InputSource input = InputSource::live(std::move(*writer));
    Session& s = (*desk)->session();
    ThreadRecorder recorder(input, s);
    const auto frame = [&] {
        const auto begun = input.begin_frame(clock.now_ns(), clock.now_ns());
        const haptics::ToolState tool = s.newest_tool();
        (*desk)->step(*begun, {.size = kSize}, tool, [](Executor::Order) {});
        recorder.frame(std::span(&tool, 1), {}, {{{.size = kSize}}, (*desk)->measured(), (*desk)->words()});
    };
    const auto tick = [&](int times) {
        for (int i = 0; i < times; ++i) {
            clock.sleep_until(clock.now_ns() + 1'000'000);
            s.loop().step();
        }
    };
    tick(10);
    frame();
    ASSERT_FALSE(input.recording_error());
    tick(10'000);
    frame();
    ASSERT_TRUE(input.recording_error());
    EXPECT_TRUE(log_has(input.recording_error()->line(), "ticks were lost"));
    testing::internal::CaptureStderr();
    recorder.outside();
    recorder.outside();
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(log_has(told, "ticks were lost"));
    EXPECT_EQ(told.find("ticks were lost"), told.rfind("ticks were lost"));  // once
    const auto log = read_input_log(path);
    ASSERT_TRUE(log) << log.error().line();
    EXPECT_EQ(log->threads->frames.size(), 1u);
    EXPECT_FALSE(again(place.read("live.log")).error && !again(place.read("live.log")).log_ends);
}

// A replay has other displays, which may refuse nothing.
TEST(ThreadRecorder, WritesTheModeThatAScreenWentBackTo) {
    const Workplace place;
    SimulatedClock clock;
    RecordedSession recorded(place, clock);
    Desk& s = *recorded.desk;
    const auto frame = [&] {
        recorded.recorder->outside(s.take_refused());
        clock.sleep_until(clock.now_ns() + 5'000'000);
        const Nanoseconds now_ns = clock.now_ns() - s.session().start_ns();
        const auto begun = recorded.input->begin_frame(now_ns, now_ns);
        s.step(*begun, {.size = kSize}, s.session().newest_tool(), [](Executor::Order) {});
        const haptics::ToolState drawn = s.session().newest_tool();
        recorded.recorder->frame(std::span(&drawn, 1), {}, {{{.size = kSize}}, s.measured(), s.words()});
    };
    frame();
    testing::internal::CaptureStderr();
    s.refuse_mode(wall::StereoMode::left, {"it cannot be shown", "screen", ""});
    EXPECT_TRUE(log_has(testing::internal::GetCapturedStderr(), "it cannot be shown"));
    EXPECT_EQ(s.viewer().output.mode, wall::StereoMode::left);
    frame();
    frame();
    const auto log = read_input_log(place / "live.log");
    ASSERT_TRUE(log) << log.error().line();
    ASSERT_EQ(log->threads->frames.size(), 3u);
    EXPECT_EQ(log->threads->frames[0].refused, wall::StereoMode::left) << "the frame whose drawing refused it";
    EXPECT_FALSE(log->threads->frames[1].refused) << "once";
}

// ---- Settings

TEST(SessionSettings, AreThoseOfTheRecording) {
    SessionSetup recorded = options_for("x.log");
    recorded.carve.workpiece.source = "a file, with \"blanks\".stl";
    recorded.carve.workpiece.close_holes = true;
    recorded.hands.tool.operation = compute::Operation::paint;
    recorded.carve.feel.friction = 0.1;
    recorded.desk.swap_eyes = true;
    recorded.carve.workpiece.units = LengthUnit::mm;
    recorded.carve.exports.units = LengthUnit::inch;
    const std::string line = settings_line(recorded);
    const SessionSetup defaults;
    const auto same = options_as_recorded(line, defaults);
    ASSERT_TRUE(same) << same.error().line();
    EXPECT_EQ(settings_line(same->options), line);
    EXPECT_TRUE(same->overruled.empty());  // nothing else was asked for

    SessionSetup other = carving_setup();
    other.hands.tool.shape = "ball:0.02";
    other.desk.screenshots = "here";
    const auto overruled = options_as_recorded(line, other);
    ASSERT_TRUE(overruled);
    EXPECT_EQ(settings_line(overruled->options), line);
    EXPECT_EQ(overruled->options.desk.screenshots, "here");
    ASSERT_EQ(overruled->overruled.size(), 1u);
    EXPECT_TRUE(log_has(overruled->overruled[0], "--tool ball:0.012")) << overruled->overruled[0];
    EXPECT_TRUE(log_has(overruled->overruled[0], "--tool ball:0.02 "));

    EXPECT_EQ(options_as_recorded("somebody's own", other)->options.hands.tool.shape, "ball:0.02");
    EXPECT_FALSE(options_as_recorded(line + " --flavour sweet", other));
    EXPECT_FALSE(options_as_recorded("burin sculpt --resolution many", other));
    EXPECT_FALSE(options_as_recorded("burin sculpt --units yards", other));
}

TEST(Recordings, FromBeforeThereWereUnitsAreReadInMetresWhateverTheFileLooksLike) {
    const SessionSetup none;
    SessionSetup given = carving_setup();
    given.carve.workpiece.units = LengthUnit::mm;
    for (const std::string line : {"burin sculpt --workpiece part.stl --tool ball:0.02", "somebody's own"}) {
        const auto old = options_as_recorded(line, none);
        ASSERT_TRUE(old) << old.error().line();
        EXPECT_EQ(old->options.carve.workpiece.units, LengthUnit::m) << line;
        EXPECT_TRUE(old->options.record.from_before_units) << line;
    }
    const auto old = options_as_recorded("burin sculpt --workpiece part.stl", given);
    ASSERT_TRUE(old) << old.error().line();
    EXPECT_EQ(old->options.carve.workpiece.units, LengthUnit::m);
    EXPECT_EQ(old->options.hands.tool.shape, "ball:0.01");  // the tool of that time
    EXPECT_EQ(old->overruled.size(), 1u);
    const auto one_of_today =
        options_as_recorded("burin sculpt --workpiece part.stl --units mm --tool ball:0.02", none);
    ASSERT_TRUE(one_of_today);
    EXPECT_EQ(one_of_today->options.carve.workpiece.units, LengthUnit::mm);
    EXPECT_FALSE(one_of_today->options.record.from_before_units);
}

}  // namespace burin::session
