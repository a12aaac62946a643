// SPDX-License-Identifier: MIT
// The lines of a recording that say what the threads of a session did.
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <string>

#include "session/record/input_log.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

bool text_has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST(InputLog, IsReadAfterAByteOrderMarkAndWithAnyLineEnds) {
    const Workplace place;
    const auto read = [&](const std::string& bytes) {
        place.write("marked.log", bytes);
        return read_input_log(place / "marked.log");
    };
    for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
        for (const std::string end : {"\n", "\r\n", "\r"}) {
            const std::string start = mark + "burin-input 1 test" + end + "0 mouse 12 34" + end;
            const auto log = read(start + "1 close" + end);
            ASSERT_TRUE(log) << log.error().line();
            EXPECT_EQ(log->settings, "test");
            EXPECT_EQ(log->events.size(), 2u);
            EXPECT_FALSE(log->torn_line);
            const auto torn = read(start + "1 close");
            ASSERT_TRUE(torn) << torn.error().line();
            EXPECT_EQ(torn->events.size(), 1u);
            EXPECT_TRUE(torn->torn_line);
            EXPECT_TRUE(text_has(read(start + "1 nonsense" + end).error().line(), "marked.log:3"));
        }
    }
    EXPECT_TRUE(text_has(read(std::string("b\0u\0", 4)).error().line(), "is UTF-16 text; save it as UTF-8"));
}

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

TEST(ThreadLog, UpdatesReadBackWithEveryHandAndPart) {
    const ThreadClock clock{5'000'000'000, 1'000'000, 0.0};
    std::vector<scene::SceneUpdate> updates{
        {clock.start_ns + 10'000'000, 0, {12, 0, 7}, {{false}, {true}, {false}}},
        {clock.start_ns + 21'000'000, 3, {12, 30, 19}, {{true}, {false}, {true}}},
        {clock.start_ns + 21'000'000, 0, {40, 30, 19}, {{false, 2}, {false, 0}, {true, 11}}},
        {clock.start_ns + 31'000'000, 0, {40, 30, 19}, {{false}, {false, 1}, {false}}},
    };
    UpdateText writer(clock), reader(clock);
    std::string text;
    for (const scene::SceneUpdate& update : updates) writer.write(text, update);
    std::string_view rest = text;
    for (const scene::SceneUpdate& update : updates) {
        auto read = reader.read(rest);
        ASSERT_TRUE(read) << text;
        read->last_ticks.resize(3);  // what has not been named yet is none
        read->parts.resize(3);
        EXPECT_EQ(*read, update) << text;
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
    EXPECT_EQ(complaint("0.1 updates 1 5t1h2t4o2ee3;-7h2t1;"), "none");
    EXPECT_EQ(complaint("0.1 updates 1 5t1o2e3d1d2p3;-7d4;"), "none");
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
                                  "updates 1 5h99t1;",
                                  "updates 1 5h1;",
                                  "updates 1 5e99;",
                                  "updates 1 5d0;",
                                  "updates 1 5d3p99;",
                                  "saw 1 2",
                                  "saw 1 2 3 restless",
                                  "saw -1 2 3",
                                  "output 0 99999999 1 0 0",
                                  "plotted 1 nan 2",
                                  "figures 1",
                                  "clock 5 1000000 0.000055",
                                  "clock 5 1000000 0.000055 1.5",
                                  "refused mono",
                                  "end x"}) {
        EXPECT_TRUE(text_has(complaint("0.1 " + bad), "in.log:4: ")) << bad << " -> " << complaint("0.1 " + bad);
        EXPECT_TRUE(text_has(complaint("0.1 " + bad), "write: TIME_S ")) << bad;
    }
    EXPECT_TRUE(text_has(complaint("0.1 saw 0 0 1\n0.1 saw 0 0 1"), "in.log:5: "));  // a frame sees once
    EXPECT_TRUE(text_has(complaint("0 said \"early\""), "is before"));
    const auto unclocked = parse_input_log("burin-input 2 x\n0 ticks 1 5;\n", "in.log");
    ASSERT_FALSE(unclocked);
    EXPECT_TRUE(text_has(unclocked.error().line(), "in.log:2: "));
    for (const std::string pace : {"0", "-1", "nan", "inf", "1e9", "1 1"})
        EXPECT_FALSE(parse_input_log("burin-input 2 x\n0 clock 5 1000000 0 " + pace + "\n", "in.log")) << pace;
    // In a log of the first kind there is no such line.
    EXPECT_FALSE(parse_input_log("burin-input 1 x\n0 clock 5 1000000 0.000055\n", "in.log"));
    EXPECT_FALSE(parse_input_log("burin-input 2 x\n0 close\n", "in.log")->threads);
}

TEST(ThreadLog, KeepsTheMachinesPaceToTheBit) {
    const ThreadClock slow{5, 1'000'000, 0.000055, 1.7 + 0.1};
    const auto log = parse_input_log("burin-input 2 x\n0 " + text_of(slow) + "\n", "in.log");
    ASSERT_TRUE(log) << log.error().line();
    EXPECT_EQ(log->threads->clock, slow);
    const auto older = parse_input_log("burin-input 2 x\n0 clock 5 1000000 0.000055\n", "in.log");
    ASSERT_TRUE(older) << older.error().line();
    EXPECT_EQ(older->threads->clock.pace, 1.0);
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

// A frame that measured nothing anew shows what it showed before, and plots no point.
TEST(ThreadLog, GivesEachFrameOnlyWhatItsOwnLinesTell) {
    const std::string text =
        "burin-input 2 x\n0 clock 5 1000000 0\n0 frame\n0 output 0 64 48 3 7\n0 plotted 1 2 16\n"
        "0 figures 60 - - - - - - - 0 0 0 0 0 0 0 0\n0 saw 0 0 1\n0 said \"a word\"\n0.1 frame\n0.1 saw 0 0 2\n"
        "0.2 frame\n0.2 output 0 80 48 3 7\n0.2 saw 0 0 3\n0.2 refused mono\n";
    const auto log = parse_input_log(text, "in.log");
    ASSERT_TRUE(log) << log.error().line();
    const std::vector<FrameSeen>& frames = log->threads->frames;
    ASSERT_EQ(frames.size(), 3u);
    ASSERT_EQ(frames[0].outputs.size(), 1u);
    EXPECT_EQ(frames[0].outputs[0].place.size, (ImageSize{64, 48}));
    EXPECT_EQ(frames[0].outputs[0].place.monitor_x, 3);
    EXPECT_EQ(frames[0].outputs[0].place.monitor_y, 7);
    EXPECT_TRUE(frames[0].measured.plotted && frames[0].measured.numbers);
    EXPECT_EQ(frames[0].messages, std::vector<std::string>{"a word"});
    EXPECT_TRUE(frames[1].outputs.empty());
    EXPECT_FALSE(frames[1].measured.plotted || frames[1].measured.numbers);
    EXPECT_TRUE(frames[1].messages.empty());
    ASSERT_EQ(frames[2].outputs.size(), 1u);
    EXPECT_EQ(frames[2].outputs[0].place.size.width, 80u);
    EXPECT_FALSE(frames[1].refused);
    EXPECT_EQ(frames[2].refused, wall::StereoMode::mono);
}

}  // namespace burin::session
