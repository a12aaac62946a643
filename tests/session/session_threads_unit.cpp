// SPDX-License-Identifier: MIT
// What the threads of a live session did, recorded, and done again on one thread.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "app/session/carving_thread.hpp"
#include "app/session/session_settings.hpp"
#include "app/session/thread_recorder.hpp"
#include "app/session/thread_replay.hpp"
#include "haptics/realtime.hpp"
#include "tests/app/run_command.hpp"

namespace burin {
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

SculptOptions options_for(const std::string& record) {
    SculptOptions options;
    options.workpiece.resolution = 32;
    options.tool.shape = "ball:0.012";
    options.engine = EngineChoice::cpu;
    options.threads = 1;
    options.live.record = record;
    return options;
}

// A live session without pictures: its threads, and a frame every 5 ms.
struct Live {
    std::string log;
    std::uint64_t untouched = 0, surface = 0;
    Vec3 force_N{0.0};
    std::uint64_t ticks = 0;
};
Live live(const Workplace& place) {
    const std::string path = (place / "live.log").string();
    MonotonicClock clock;
    const SculptOptions options = options_for(path);
    const auto wall = session_wall(options.live);
    auto session = LiveSession::create(options, *wall, clock);
    auto writer = InputLogWriter::create(path, settings_line(options));
    auto script = parse_input_log(kScript, "script");
    if (!session || !writer || !script) return {};
    LiveSession& s = **session;
    const std::uint64_t untouched = check_of(s.surface());
    InputSource input = InputSource::play(std::move(*script), std::move(*writer));
    ThreadRecorder recorder(input, s);
    CarvingThread carving(s.desk(), clock, [] {});
    HapticThread touch(s.loop(), {});
    static_cast<void>(touch.start());
    carving.start();
    while (!s.state().quit) {
        clock.sleep_until(clock.now_ns() + 5'000'000);
        recorder.outside();
        const Nanoseconds now_ns = clock.now_ns() - s.start_ns();
        const auto frame = input.begin_frame(now_ns, now_ns + 10'000'000);
        if (!frame) break;
        const ToolState tool = s.newest_tool();
        s.step(*frame, {.size = kSize}, tool, [&](CarvingOrder order) { carving.order(std::move(order)); });
        CarvingThread::Taken carved = carving.take_news();
        if (carved.news) s.take(std::move(*carved.news));
        recorder.frame(tool.tick, carved.updates, {{.size = kSize}});
    }
    touch.stop();
    carving.stop();
    recorder.finish(carving.take_news().updates);
    const ToolState& tool = s.newest_tool();
    return {place.read("live.log"), untouched, check_of(s.surface()), tool.given.force_device_N, s.loop().ticks()};
}

// What threads come to now and then, each time: ticks after a frame has asked for its tool see older parameters than that frame sets; and
// ticks whose samples an update has not taken see the surface before it.
Live overtaking(const Workplace& place) {
    const std::string path = (place / "live.log").string();
    SimulatedClock clock;
    const SculptOptions options = options_for(path);
    const auto wall = session_wall(options.live);
    auto session = LiveSession::create(options, *wall, clock);
    auto writer = InputLogWriter::create(path, settings_line(options));
    auto script = parse_input_log(kScript, "script");
    if (!session || !writer || !script) return {};
    LiveSession& s = **session;
    const std::uint64_t untouched = check_of(s.surface());
    InputSource input = InputSource::play(std::move(*script), std::move(*writer));
    ThreadRecorder recorder(input, s);
    const auto tick = [&](int times) {
        for (int i = 0; i < times; ++i) {
            clock.sleep_until(clock.now_ns() + 1'000'000);
            s.loop().step();
        }
    };
    while (const auto frame = input.begin_frame(clock.now_ns(), clock.now_ns())) {
        tick(4);
        const ToolState tool = s.newest_tool();
        tick(3);
        std::size_t orders = 0;
        s.step(*frame, {.size = kSize}, tool, [&](const CarvingOrder& order) {
            s.desk().order(order);
            ++orders;
        });
        tick(5);
        UpdateSeen update{clock.now_ns(), s.loop().ticks() - 3, orders, false};
        if (!s.desk().repeat(update)) return {};
        if (auto news = s.desk().take_news()) s.take(std::move(*news));
        recorder.frame(tool.tick, {update}, {{.size = kSize}});
    }
    recorder.finish({});
    return {place.read("live.log"), untouched, check_of(s.surface()), s.newest_tool().given.force_device_N,
            s.loop().ticks()};
}

// The same again. How many frames were not as recorded; an Error where there is no going on.
struct Again {
    std::size_t frames = 0, departed = 0;
    std::uint64_t surface = 0;
    Vec3 force_N{0.0};
    std::uint64_t ticks = 0;
    std::optional<Error> error;
    bool log_ends = false;
};
Again again(const std::string& text) {
    Again result;
    auto log = parse_input_log(text, "live.log");
    if (!log || !log->threads) {
        result.error = log ? Error{"no threads", "", ""} : log.error();
        return result;
    }
    const ThreadLog threads = *log->threads;
    InputSource input = InputSource::replay(std::move(*log));
    SimulatedClock clock;
    clock.sleep_until(threads.clock.start_ns);
    const SculptOptions options = options_for("");
    const auto wall = session_wall(options.live);
    auto session = LiveSession::create(options, *wall, clock);
    LiveSession& s = **session;
    ThreadReplay replay(s, threads, "live.log");
    const auto stopped = [&](const Error& error) {
        result.error = error;
        result.log_ends = replay.log_ends();
        return result;
    };
    for (const FrameSeen& seen : threads.frames) {
        const auto frame = input.begin_frame(0, 0);
        const auto tool = replay.tool_of(seen);
        if (!tool) return stopped(tool.error());
        s.step(*frame, {.size = kSize}, *tool, [&](CarvingOrder order) { replay.order(std::move(order)); });
        auto news = replay.news_of(seen);
        if (!news) return stopped(news.error());
        if (*news) s.take(std::move(**news));
        ++result.frames;
        if (!replay.is_as_recorded(seen)) ++result.departed;
    }
    if (const auto rest = replay.finish(); !rest) return stopped(rest.error());
    result.surface = check_of(s.surface());
    result.force_N = s.newest_tool().given.force_device_N;
    result.ticks = s.loop().ticks();
    return result;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

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
    EXPECT_TRUE(has(was.log, "o1"));
}

TEST(ThreadReplay, KeepsWhatTicksSawThatTheRestHasOvertaken) {
    const Workplace place;
    const Live was = overtaking(place);
    ASSERT_GT(was.ticks, 500u);
    EXPECT_NE(was.surface, was.untouched);
    const Again is = again(was.log);
    ASSERT_FALSE(is.error) << is.error->line();
    EXPECT_GT(is.frames, 50u);
    EXPECT_EQ(is.departed, 0u);
    EXPECT_EQ(is.surface, was.surface);
    EXPECT_EQ(is.force_N, was.force_N);
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
    EXPECT_TRUE(has(of_settings.error->line(), line_with(settings, "p900000") + ": "));
    EXPECT_TRUE(has(of_settings.error->line(), "parameters")) << of_settings.error->line();
    // An order that nobody gave.
    const std::string orders = replaced(was.log, "o1", "o900");
    const Again of_orders = again(orders);
    ASSERT_TRUE(of_orders.error);
    EXPECT_TRUE(has(of_orders.error->line(), line_with(orders, "o900") + ": ")) << of_orders.error->line();
    EXPECT_FALSE(of_orders.log_ends);
}

TEST(ThreadRecorder, EndsTheRecordingWhenTicksWereLost) {
    const Workplace place;
    const std::string path = (place / "live.log").string();
    const SculptOptions options = options_for(path);
    SimulatedClock clock;
    const auto wall = session_wall(options.live);
    auto session = LiveSession::create(options, *wall, clock);
    ASSERT_TRUE(session);
    auto writer = InputLogWriter::create(path, settings_line(options));
    ASSERT_TRUE(writer);
    InputSource input = InputSource::live(std::move(*writer));
    LiveSession& s = **session;
    ThreadRecorder recorder(input, s);
    const auto frame = [&] {
        const auto begun = input.begin_frame(clock.now_ns(), clock.now_ns());
        const ToolState tool = s.newest_tool();
        s.step(*begun, {.size = kSize}, tool, [](CarvingOrder) {});
        recorder.frame(tool.tick, {}, {{.size = kSize}});
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
    EXPECT_TRUE(has(input.recording_error()->line(), "ticks were lost"));
    testing::internal::CaptureStderr();
    recorder.outside();
    recorder.outside();
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(has(told, "ticks were lost"));
    EXPECT_EQ(told.find("ticks were lost"), told.rfind("ticks were lost"));  // once
    const auto log = read_input_log(path);
    ASSERT_TRUE(log) << log.error().line();
    EXPECT_EQ(log->threads->frames.size(), 1u);
    EXPECT_FALSE(again(place.read("live.log")).error && !again(place.read("live.log")).log_ends);
}

// ---- Lines

TEST(ThreadLog, TicksReadBackToTheSameBits) {
    const ThreadClock clock{5'000'000'000, 1'000'000, 0.000055};
    std::vector<TickSeen> ticks;
    TickSeen tick;
    tick.time_ns = tick.sample.time_ns = clock.start_ns;
    for (const Vec3& position : {Vec3(0.0), Vec3(-0.0, 3 * 0.000055, 1e-300), Vec3(-17 * 0.000055, 0.1, -0.0),
                                 Vec3(std::numeric_limits<double>::infinity(), 0.2, 1e9), Vec3(0.0)}) {
        tick.time_ns += 1'012'345;
        tick.sample.time_ns += 1'050'000;
        tick.sample.position_device_m = position;
        tick.sample.orientation_device = glm::normalize(Quat(1.0, position.y, 0.1, 0.0));
        tick.sample.buttons ^= 5u;
        tick.surface_sequence += 2;
        tick.parameter_sequence += 1;
        tick.late = !tick.late;
        ticks.push_back(tick);
    }
    TickText writer(clock), reader(clock);
    std::string text;
    for (const TickSeen& one : ticks) writer.write(text, one);
    std::string_view rest = text;
    for (const TickSeen& one : ticks) {
        const auto read = reader.read(rest);
        ASSERT_TRUE(read) << text;
        EXPECT_EQ(read->time_ns, one.time_ns);
        EXPECT_EQ(read->sample.time_ns, one.sample.time_ns);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(std::bit_cast<std::uint64_t>(read->sample.position_device_m[axis]),
                      std::bit_cast<std::uint64_t>(one.sample.position_device_m[axis]));
        EXPECT_EQ(read->sample.orientation_device, one.sample.orientation_device);
        EXPECT_EQ(read->sample.buttons, one.sample.buttons);
        EXPECT_EQ(read->surface_sequence, one.surface_sequence);
        EXPECT_EQ(read->parameter_sequence, one.parameter_sequence);
        EXPECT_EQ(read->late, one.late);
    }
    EXPECT_TRUE(rest.empty());
}

TEST(ThreadLog, AQuietTickTakesFewBytes) {
    const ThreadClock clock{0, 1'000'000, 0.000055};
    TickText text(clock);
    TickSeen tick;
    std::string line;
    for (int i = 1; i <= 1000; ++i) {
        tick.time_ns = i * 1'000'000 + (i % 7) * 1234;
        tick.sample.time_ns = i * 1'000'000;
        tick.sample.position_device_m.x = i / 3 * 0.000055;
        tick.surface_sequence = 1u + static_cast<unsigned>(i) / 10u;
        text.write(line, tick);
    }
    EXPECT_LT(line.size(), 10'000u);
}

TEST(ThreadLog, NamesLineAndRemedyOfWhatItDoesNotUnderstand) {
    const std::string start = "burin-input 2 x\n0 clock 5 1000000 0.000055\n0.1 frame\n";
    const auto complaint = [&](const std::string& line) {
        const auto log = parse_input_log(start + line + "\n", "in.log");
        return log ? std::string("none") : log.error().line();
    };
    EXPECT_EQ(complaint("0.1 ticks 1 5;"), "none");
    EXPECT_EQ(complaint("0.1 updates 1 5t1o2e;-7;"), "none");
    EXPECT_EQ(complaint("0.1 saw 0 0 12"), "none");
    EXPECT_EQ(complaint("0.1 output 0 64 64 -1 3"), "none");
    EXPECT_EQ(complaint("0.1 said \"a word\""), "none");
    EXPECT_EQ(complaint("0.1 plotted 1 2 16"), "none");
    for (const std::string bad : {"ticks 2 5;",
                                  "ticks 1 5",
                                  "ticks 1 w;",
                                  "ticks 1 5s0;",
                                  "ticks 1 5b-1;",
                                  "ticks 1 5f77;",
                                  "ticks 1 5q1,2;",
                                  "ticks 1 -2000000;",
                                  "ticks 1 5x9999999999;",
                                  "ticks",
                                  "updates 1 5o0;",
                                  "updates 2 5;",
                                  "updates 1 5et1;",
                                  "saw 1 2",
                                  "saw 1 2 3 restless",
                                  "saw -1 2 3",
                                  "output 0 99999999 1 0 0",
                                  "plotted 1 nan 2",
                                  "figures 1",
                                  "clock 5 1000000 0.000055",
                                  "refused mono",
                                  "end x"}) {
        EXPECT_TRUE(has(complaint("0.1 " + bad), "in.log:4: ")) << bad << " -> " << complaint("0.1 " + bad);
        EXPECT_TRUE(has(complaint("0.1 " + bad), "write: TIME_S ")) << bad;
    }
    EXPECT_TRUE(has(complaint("0.1 saw 0 0 1\n0.1 saw 0 0 1"), "in.log:5: "));  // a frame sees once
    EXPECT_TRUE(has(complaint("0 said \"early\""), "is before"));
    const auto unclocked = parse_input_log("burin-input 2 x\n0 ticks 1 5;\n", "in.log");
    ASSERT_FALSE(unclocked);
    EXPECT_TRUE(has(unclocked.error().line(), "in.log:2: "));
    // In a log of the first kind there is no such line.
    EXPECT_FALSE(parse_input_log("burin-input 1 x\n0 clock 5 1000000 0.000055\n", "in.log"));
    EXPECT_FALSE(parse_input_log("burin-input 2 x\n0 close\n", "in.log")->threads);
}

TEST(ThreadLog, KeepsWhatThePanelShowed) {
    PanelNumbers numbers;
    numbers.figures.frames_per_s = 59.7;
    numbers.figures.head_age_ms = 0.1 + 0.2;
    numbers.figures.carve_age_ms = 1e-9;
    numbers.savings.drawn = 3;
    numbers.savings.redrawn_percent = 12.5;
    numbers.warnings = {"a \"warning\"", "another"};
    const std::string text = "burin-input 2 x\n0 clock 5 1000000 0\n0 frame\n0 " + text_of(numbers) + "\n0 " +
                             text_of(PanelPlotted{1.5, 1.0 / 3.0, 16.7}) + "\n0 saw 0 0 1\n";
    const auto log = parse_input_log(text, "in.log");
    ASSERT_TRUE(log) << log.error().line();
    const PanelMeasured& read = log->threads->frames.at(0).measured;
    ASSERT_TRUE(read.numbers && read.plotted);
    EXPECT_EQ(read.numbers->figures, numbers.figures);
    EXPECT_EQ(read.numbers->savings, numbers.savings);
    EXPECT_EQ(read.numbers->warnings, numbers.warnings);
    EXPECT_EQ(read.plotted->frame_ms, 1.0 / 3.0);
}

// ---- Settings

TEST(SessionSettings, AreThoseOfTheRecording) {
    SculptOptions recorded = options_for("x.log");
    recorded.workpiece.source = "a file, with \"blanks\".stl";
    recorded.workpiece.close_holes = true;
    recorded.tool.operation = Operation::paint;
    recorded.feel.friction = 0.1;
    recorded.live.swap_eyes = true;
    const std::string line = settings_line(recorded);
    const auto same = options_as_recorded(line, SculptOptions{});
    ASSERT_TRUE(same) << same.error().line();
    EXPECT_EQ(settings_line(same->options), line);
    EXPECT_TRUE(same->overruled.empty());  // nothing else was asked for

    SculptOptions other;
    other.tool.shape = "ball:0.02";
    other.live.screenshots = "here";
    const auto overruled = options_as_recorded(line, other);
    ASSERT_TRUE(overruled);
    EXPECT_EQ(settings_line(overruled->options), line);
    EXPECT_EQ(overruled->options.live.screenshots, "here");
    ASSERT_EQ(overruled->overruled.size(), 1u);
    EXPECT_TRUE(has(overruled->overruled[0], "--tool ball:0.012")) << overruled->overruled[0];
    EXPECT_TRUE(has(overruled->overruled[0], "--tool ball:0.02 "));

    EXPECT_EQ(options_as_recorded("somebody's own", other)->options.tool.shape, "ball:0.02");
    EXPECT_FALSE(options_as_recorded(line + " --flavour sweet", other));
    EXPECT_FALSE(options_as_recorded("burin sculpt --resolution many", other));
}

}  // namespace burin
