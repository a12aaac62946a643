// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "session/input/input_keys.hpp"
#include "session/input/input_line.hpp"
#include "session/input/input_words.hpp"
#include "session/record/input_log.hpp"
#include "session/record/input_source.hpp"

namespace burin::session {
namespace {

const std::string kHeader = "burin-input 1 test\n";

std::string complaint(const std::string& lines) {
    const auto log = parse_input_log(kHeader + lines, "in.log");
    return log ? "" : log.error().line();
}

bool line_has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::filesystem::path fresh_file(const std::string& name) {
    const auto path = std::filesystem::temp_directory_path() / ("burin-" + std::to_string(getpid()) + "-" + name);
    std::filesystem::remove(path);
    return path;
}

std::string content(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

template <typename T>
const T& only(const InputLog& log, std::size_t i = 0) {
    return std::get<T>(log.events.at(i).input);
}

// Any double of the range, odd ones among them: from random bits, not from a nice distribution.
double any_number() {
    const int odd = *rc::gen::inRange(0, 8);
    if (odd == 0) return -0.0;
    if (odd == 1) return std::numeric_limits<double>::denorm_min();
    if (odd == 2) return 1e9;
    if (odd == 3) return 0.1 + 0.2;
    const double x = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
    return std::abs(x) <= 1e9 ? x : std::ldexp(x / std::numeric_limits<double>::max(), 20);  // NaN is asked again below
}
double number() {
    for (;;)
        if (const double x = any_number(); std::abs(x) <= 1e9) return x;
}
Pose pose() {
    const Vec3 axis(number(), number(), number());
    const double angle = 1e-3 * *rc::gen::inRange(-4000, 4000);
    const double l = glm::length(axis);
    const Vec3 unit = l > 1e-100 && std::isfinite(l) ? axis / l : Vec3(0.0, 1.0, 0.0);
    return {{number(), number(), number()},
            Quat(std::cos(angle), unit.x * std::sin(angle), unit.y * std::sin(angle), unit.z * std::sin(angle))};
}
Modifiers modifiers() {
    const unsigned bits = *rc::gen::inRange(0u, 16u);
    return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
}
std::string text() {
    std::string s;
    const int length = *rc::gen::inRange(0, 12);
    const std::vector<std::string> odd = {"é", "\u20ac", "\U0001F600", " ",  "\"",   "\\",
                                          "#", "\n",     "\t",         "\r", "\x01", "\x7f"};
    for (int i = 0; i < length; ++i) {
        if (*rc::gen::inRange(0, 3) == 0)
            s += *rc::gen::elementOf(odd);
        else
            s += static_cast<char>(*rc::gen::inRange(0x20, 0x7f));
    }
    if (length == 0 && *rc::gen::inRange(0, 2) == 0) return std::string("a\0b", 3);
    return s;
}
Input any_input() {
    const auto wand = *rc::gen::inRange(0u, kMostWands);
    switch (*rc::gen::inRange<std::size_t>(0, std::variant_size_v<Input>)) {
        case 0:
            return KeyInput{static_cast<Key>(*rc::gen::inRange<std::size_t>(0, kKeyCount)),
                            static_cast<KeyMotion>(*rc::gen::inRange(0, 3)), modifiers()};
        case 1: return MouseMove{{number(), number()}};
        case 2:
            return MouseClick{static_cast<MouseButton>(*rc::gen::inRange(0, 5)), *rc::gen::arbitrary<bool>(),
                              modifiers()};
        case 3: return Scroll{{number(), number()}, modifiers()};
        case 4: return TextInput{"x" + text()};
        case 5: return WindowResize{*rc::gen::inRange(0u, 65537u), *rc::gen::inRange(0u, 65537u)};
        case 6: return WindowFocus{*rc::gen::arbitrary<bool>()};
        case 7: return WindowClose{};
        case 8: return HeadInput{pose(), *rc::gen::arbitrary<bool>()};
        case 9: return WandInput{wand, pose(), *rc::gen::arbitrary<bool>()};
        case 10: return WandClick{wand, *rc::gen::inRange(0u, kMostWandButtons), *rc::gen::arbitrary<bool>()};
        case 11: return WandStick{wand, {1e-3 * *rc::gen::inRange(-1000, 1001), 1e-3 * *rc::gen::inRange(-1000, 1001)}};
        case 12: {
            CommandInput command{"c" + text(), {}};
            const int count = *rc::gen::inRange(0, 5);
            for (int i = 0; i < count; ++i) command.arguments.push_back(text());
            return command;
        }
        default: return FrameStart{kLongestSession_ns};
    }
}
std::vector<InputEvent> any_events(int count) {
    std::vector<InputEvent> events;
    Nanoseconds time_ns = 0;
    for (int i = 0; i < count; ++i) {
        time_ns += *rc::gen::elementOf(std::vector<Nanoseconds>{0, 1, 999, 1'000'000, 16'666'667, 123'456'789'012});
        events.push_back({time_ns, any_input()});
    }
    return events;
}

}  // namespace

TEST(InputLog, ReadsWhatAUserWritesByHand) {
    const auto log = parse_input_log(
        "burin-input 1 sculpt --engine cpu\r\n"
        "# a user with a script\n"
        "0 resize 1280 720\n"
        "\n"
        "  0.5   key press z ctrl+shift   # redo\n"
        "0.5 mouse 640.5 -3\n"
        "1 command tool ball:0.004\n"
        "1.25 command screenshot \"the first cut.png\"\n"
        "2 head 0 1.6 2 0 0 0 1 lost\n"
        "2 wand-button 1 press 2\n"
        "2 frame\n"
        "2.000000001 frame 2.016\n"
        "3 close\n",
        "in.log");
    ASSERT_TRUE(log) << log.error().line();
    EXPECT_EQ(log->settings, "sculpt --engine cpu");
    EXPECT_FALSE(log->torn_line);
    ASSERT_EQ(log->events.size(), 10u);
    EXPECT_EQ(only<WindowResize>(*log), (WindowResize{1280, 720}));
    EXPECT_EQ(log->events[1].time_ns, 500'000'000);
    EXPECT_EQ(only<KeyInput>(*log, 1), (KeyInput{Key::z, KeyMotion::press, {.shift = true, .ctrl = true}}));
    EXPECT_EQ(only<MouseMove>(*log, 2), (MouseMove{{640.5, -3.0}}));
    EXPECT_EQ(only<CommandInput>(*log, 3), (CommandInput{"tool", {"ball:0.004"}}));
    EXPECT_EQ(only<CommandInput>(*log, 4), (CommandInput{"screenshot", {"the first cut.png"}}));
    EXPECT_EQ(only<HeadInput>(*log, 5), (HeadInput{{{0.0, 1.6, 2.0}, {1.0, 0.0, 0.0, 0.0}}, false}));
    EXPECT_EQ(only<WandClick>(*log, 6), (WandClick{1, 2, true}));
    EXPECT_EQ(only<FrameStart>(*log, 7).display_ns, 2'000'000'000);
    EXPECT_EQ(log->events[8].time_ns, 2'000'000'001);
    EXPECT_EQ(only<FrameStart>(*log, 8).display_ns, 2'016'000'000);
}

TEST(InputLog, GivesEveryEventBackExactly) {
    EXPECT_TRUE(rc::check("lines read back to the same events and the same lines", [] {
        const std::vector<InputEvent> events = any_events(*rc::gen::inRange(0, 20));
        std::string text = "burin-input 1 a \"b\" # c\n";
        for (const InputEvent& event : events) {
            RC_ASSERT(is_sensible(event.input));
            text += line_of(event) + '\n';
        }
        const auto log = parse_input_log(text, "random");
        if (!log) RC_FAIL(log.error().line());
        RC_ASSERT(log->settings == "a \"b\" # c");
        RC_ASSERT(log->events == events);
        for (std::size_t i = 0; i < events.size(); ++i) {  // -0.0 == 0.0, but not as text
            RC_ASSERT(line_of(log->events[i]) == line_of(events[i]));
        }
    }));
}

TEST(InputLog, WritesNumbersBitForBit) {
    EXPECT_TRUE(rc::check("doubles", [] {
        const double x = number();
        const auto event = parse_line(line_of({0, MouseMove{{x, 0.0}}}), "n");
        RC_ASSERT(event.has_value() && event->has_value());
        RC_ASSERT(std::bit_cast<std::uint64_t>(std::get<MouseMove>((*event)->input).position_px.x) ==
                  std::bit_cast<std::uint64_t>(x));
    }));
}

TEST(InputLog, TimesAreExactToTheNanosecond) {
    EXPECT_EQ(text_of_time(0), "0");
    EXPECT_EQ(text_of_time(1), "0.000000001");
    EXPECT_EQ(text_of_time(16'666'667), "0.016666667");
    EXPECT_EQ(text_of_time(12'500'000'000), "12.5");
    EXPECT_EQ(time_of_text("1000000"), kLongestSession_ns);
    for (const Nanoseconds t :
         {Nanoseconds{0}, Nanoseconds{1}, Nanoseconds{999'999'999}, Nanoseconds{86'400'000'000'123}})
        EXPECT_EQ(time_of_text(text_of_time(t)), t);
    for (const char* bad :
         {"", ".", "1.", ".5", "-1", "+1", "1e3", "0x1", "1.0000000001", "1000000.1", "99999999", "nan"})
        EXPECT_EQ(time_of_text(bad), std::nullopt) << bad;
}

TEST(InputLog, NamesFileLineAndRemedyOfEveryMistake) {
    const auto expect = [](const std::string& line, const std::string& part) {
        const std::string text = complaint("0 close\n" + line + "\n");
        EXPECT_TRUE(line_has(text, "in.log:3: ")) << line << " -> " << text;
        EXPECT_TRUE(line_has(text, part)) << line << " -> " << text;
        EXPECT_TRUE(line_has(text, "; ")) << "no remedy: " << text;
    };
    expect("1 mose 3 4", "'mose' is no kind of input; the nearest is 'mouse'");
    expect("1 comand undo", "the nearest is 'command'");
    expect("1 key press ctl", "'ctl' is no key; the nearest is 'ctrl'");
    expect("1 key push z", "'push' is no motion of a key");
    expect("1 key press z control", "'control' is no modifier");
    expect("1 key press z ctrl+ctrl", "is no modifier");
    expect("1 button press midle", "the nearest is 'middle'");
    expect("1 mouse 3", "an argument is missing");
    expect("1 mouse 3 4 5", "'5' is one argument too many");
    expect("1 mouse 3 4x", "'4x' is no finite number");
    expect("1 mouse inf 4", "no finite number");
    expect("1 mouse nan 4", "no finite number");
    expect("1 mouse 1e10 4", "out of its range");
    expect("1 resize -1 4", "no whole number");
    expect("1 resize 70000 4", "out of its range");
    expect("1 resize 99999999999999999999 4", "no whole number");
    expect("1 head 0 0 0 0 0 0 2", "its quaternion, of length 2, is out of its range: 0.99 to 1.01");
    expect("1 head 0 0 0 0 0 0 1.0101", "of length 1.0101, is out of its range: 0.99 to 1.01, which is brought to 1");
    expect("1 head 0 0 0 0 0 0 0.98999999", "of length 0.98999999, is out of its range");
    expect("1 wand 0 0 0 0 0 0.7 0 0.7", "its quaternion, of length 0.989949493661, is out of its range");
    expect("1 head 0 0 0 0 0 0 0", "its quaternion, of length 0, is out of its range");
    expect("1 head 0 0 0 0 0 0 1 found", "the nearest is 'lost'");
    expect("1 wand 9 0 0 0 0 0 0 1", "out of its range");
    expect("1 wand-stick 0 0 1.5", "out of its range");
    expect("1 frame 0.5", "before it is drawn");
    expect("1 frame soon", "'soon' is no time");
    expect("1 text \"\xff\"", "out of its range");
    expect("1 text \"\xc0\x80\"", "out of its range");      // overlong
    expect("1 text \"\xed\xa0\x80\"", "out of its range");  // a surrogate
    expect("1 text \"\"", "out of its range");
    expect("1 text \"abc", "quotation mark is missing");
    expect("1 text \"a\\q\"", "backslash");
    expect("1 text \"a\\x1\"", "backslash");
    expect("1 text \"a\"b", "blank");
    expect("1 text a\"b", "quotes");
    expect("1", "nothing follows the time");
    expect("soon close", "'soon' is no time");
    expect("-1 close", "'-1' is no time");
    EXPECT_TRUE(line_has(complaint("2 close\n1 close\n"), "in.log:3: its time 1 is before 2"));
}

TEST(InputLog, RefusesWhatIsNoLogOrOfAnotherVersion) {
    for (const std::string bad : {"", "\n", "time_s,x\n", "burin-input\n", "burin-inputs 1\n", "burin-input one\n",
                                  "burin-input 1x\n", "burin-input 1"}) {
        const auto log = parse_input_log(bad, "in.log");
        ASSERT_FALSE(log) << bad;
        EXPECT_TRUE(line_has(log.error().line(), "in.log:1: ")) << log.error().line();
    }
    const auto newer = parse_input_log("burin-input 3 x\n", "in.log");
    ASSERT_FALSE(newer);
    EXPECT_TRUE(line_has(newer.error().line(), "version 3"));
    for (const std::string known : {"burin-input 1\n", "burin-input 2\n"})
        EXPECT_TRUE(parse_input_log(known, "in.log"));
}

TEST(InputLog, MakesNothingOfLinesThatOnlyClaimMuch) {
    const std::string words = "1 command" + std::string(100, ' ') + "a";
    EXPECT_TRUE(parse_line(words, "w"));
    std::string many = "1 command x";
    for (int i = 0; i < 1000; ++i) many += " a";
    EXPECT_TRUE(line_has(parse_line(many, "w").error().line(), "more than 64 words"));
    EXPECT_TRUE(
        line_has(parse_line(std::string(kMostLineBytes + 1, 'a'), "w").error().line(), "longer than any event"));
    EXPECT_TRUE(line_has(complaint("1 text \"" + std::string(kMostTextBytes + 1, 'a') + "\"\n"), "out of its range"));
}

TEST(InputLog, ReportsATornLastLineAndLeavesItOut) {
    const std::string whole = kHeader + "0 close\n1 mouse 123 456\n2 mouse 7 8\n";
    const auto all = parse_input_log(whole, "in.log");
    ASSERT_TRUE(all);
    // Cut anywhere behind the header: never an error, never an event that was not in the file, at most one lost.
    for (std::size_t cut = kHeader.size(); cut <= whole.size(); ++cut) {
        const auto log = parse_input_log(whole.substr(0, cut), "in.log");
        ASSERT_TRUE(log) << cut << ": " << log.error().line();
        const auto lines =
            static_cast<std::size_t>(std::count(whole.begin(), whole.begin() + static_cast<long>(cut), '\n'));
        ASSERT_EQ(log->events.size(), lines - 1);
        for (std::size_t i = 0; i < log->events.size(); ++i) EXPECT_EQ(log->events[i], all->events[i]);
        EXPECT_EQ(log->torn_line.has_value(), whole[cut - 1] != '\n');
        EXPECT_TRUE(!log->torn_line || line_has(*log->torn_line, "in.log:" + std::to_string(lines + 1)));
    }
}

TEST(InputLogWriter, KeepsAllThatWasAppendedAtEveryMoment) {
    const auto path = fresh_file("crash.log");
    auto writer = InputLogWriter::create(path, "settings of this run");
    ASSERT_TRUE(writer) << writer.error().line();
    std::vector<InputEvent> sent;
    for (int i = 0; i < 20; ++i) {
        sent.push_back({i * 1000, MouseMove{{0.1 * i, -0.3 * i}}});
        ASSERT_TRUE(writer->append(sent.back()));
        const auto log = read_input_log(path);  // as after a crash at this moment: nothing was closed
        ASSERT_TRUE(log) << log.error().line();
        EXPECT_EQ(log->settings, "settings of this run");
        EXPECT_EQ(log->events, sent);
    }
    std::filesystem::remove(path);
}

TEST(InputLogWriter, LeavesAnExistingFileAlone) {
    const auto path = fresh_file("mine.log");
    std::ofstream(path) << "precious";
    const auto writer = InputLogWriter::create(path, "");
    ASSERT_FALSE(writer);
    EXPECT_TRUE(line_has(writer.error().line(), path.string())) << writer.error().line();
    EXPECT_EQ(content(path), "precious");
    std::filesystem::remove(path);
    EXPECT_FALSE(InputLogWriter::create("no/such/folder/in.log", ""));
    EXPECT_FALSE(InputLogWriter::create(path, "two\nlines"));
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(InputLogWriter, RefusesWhatWouldNotReadBack) {
    const auto path = fresh_file("order.log");
    auto writer = InputLogWriter::create(path, "");
    ASSERT_TRUE(writer);
    EXPECT_TRUE(writer->append({10, WindowClose{}}));
    EXPECT_FALSE(writer->append({9, WindowClose{}}));
    EXPECT_FALSE(writer->append({11, MouseMove{{NAN, 0.0}}}));
    EXPECT_FALSE(writer->append({12, CommandInput{"", {}}}));
    EXPECT_FALSE(writer->append({13, KeyInput{static_cast<Key>(250), KeyMotion::press, {}}}));
    EXPECT_TRUE(writer->append({14, WindowClose{}}));
    EXPECT_EQ(content(path), "burin-input 2\n0.00000001 close\n0.000000014 close\n");
    std::filesystem::remove(path);
}

TEST(InputLogWriter, AFullDiskEndsTheLogButNotTheSession) {
    const auto path = fresh_file("full.log");
    auto writer = InputLogWriter::create(path, "");
    ASSERT_TRUE(writer);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    InputSource source = InputSource::live(std::move(*writer));
    for (int i = 0; i < 20; ++i) {
        source.push(i, MouseMove{{1.0 * i, 0.0}});
        EXPECT_EQ(source.begin_frame(i, i)->events.size(), 1u);
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, ignored);
    ASSERT_TRUE(source.recording_error());
    EXPECT_TRUE(line_has(source.recording_error()->line(), path.string()));
    const auto log = read_input_log(path);
    ASSERT_TRUE(log) << log.error().line();
    EXPECT_TRUE(log->torn_line);
    EXPECT_GT(log->events.size(), 0u);
    std::filesystem::remove(path);
}

TEST(InputSource, AReplayGivesTheFramesOfTheLiveSession) {
    EXPECT_TRUE(rc::check("frames and events", [] {
        const auto path = fresh_file("replayed.log");
        std::vector<std::pair<FrameInput, std::vector<InputEvent>>> seen;
        {
            auto writer = InputLogWriter::create(path, "");
            RC_ASSERT(writer.has_value());
            InputSource live = InputSource::live(std::move(*writer));
            Nanoseconds now_ns = 0;
            for (int frame = 0; frame < 8; ++frame) {
                const int count = *rc::gen::inRange(0, 4);
                for (int i = 0; i < count; ++i) {
                    now_ns += *rc::gen::inRange(-500, 5000);  // window systems' times may fall
                    live.push(now_ns, any_input());
                }
                now_ns += *rc::gen::inRange(-500, 2000);  // events may have later times
                const auto input = live.begin_frame(now_ns, now_ns + 8000);
                RC_ASSERT(input.has_value());
                seen.emplace_back(*input, std::vector(input->events.begin(), input->events.end()));
            }
            live.push(now_ns, WindowClose{});  // seen by no frame
        }
        auto log = read_input_log(path);
        RC_ASSERT(log.has_value());
        InputSource replay = InputSource::replay(std::move(*log));
        for (const auto& [frame, events] : seen) {
            replay.push(1, WindowClose{});  // a window may go on pushing
            const auto again = replay.begin_frame(77, 78);
            RC_ASSERT(again.has_value());
            RC_ASSERT(again->time_ns == frame.time_ns);
            RC_ASSERT(again->display_ns == frame.display_ns);
            RC_ASSERT(std::vector(again->events.begin(), again->events.end()) == events);
            for (const InputEvent& event : events) RC_ASSERT(event.time_ns <= frame.time_ns);
        }
        RC_ASSERT(!replay.begin_frame(0, 0));
        std::filesystem::remove(path);
    }));
}

TEST(InputSource, MakesUpFramesForALogWrittenByHand) {
    auto log = parse_input_log(kHeader + "0 close\n0.1 text a\n0.1 text b\n0.25 text c\n", "in.log");
    ASSERT_TRUE(log);
    InputSource source = InputSource::replay(*log, 100'000'000);
    std::vector<std::size_t> counts;
    std::vector<Nanoseconds> times;
    while (const auto frame = source.begin_frame(0, 0)) {
        counts.push_back(frame->events.size());
        times.push_back(frame->time_ns);
        EXPECT_EQ(frame->display_ns, frame->time_ns);
    }
    EXPECT_EQ(counts, (std::vector<std::size_t>{1, 2, 0, 1}));
    EXPECT_EQ(times, (std::vector<Nanoseconds>{0, 100'000'000, 200'000'000, 300'000'000}));
}

// However late a frame is: a picture shows what it was asked of. And a recording of it has its events in their order.
TEST(InputSource, PlayingEndsAFrameAtAScreenshot) {
    const auto path = fresh_file("played.log");
    const auto log = parse_input_log(
        kHeader + "0.1 mouse 1 1\n0.2 command screenshot a.png\n0.3 mouse 3 3\n0.4 command quit\n", "in.log");
    ASSERT_TRUE(log) << log.error().line();
    auto writer = InputLogWriter::create(path, "");
    ASSERT_TRUE(writer) << writer.error().line();
    InputSource source = InputSource::play(*log, std::move(*writer));
    const auto first = source.begin_frame(kNanosecondsPerSecond, kNanosecondsPerSecond);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->events.size(), 2u);
    const auto second = source.begin_frame(kNanosecondsPerSecond, kNanosecondsPerSecond);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->events.size(), 2u);
    EXPECT_EQ(second->events[0].time_ns, kNanosecondsPerSecond);
    EXPECT_FALSE(source.begin_frame(kNanosecondsPerSecond, kNanosecondsPerSecond));
    EXPECT_FALSE(source.recording_error());
    const auto recorded = read_input_log(path);
    ASSERT_TRUE(recorded) << recorded.error().line();
    EXPECT_EQ(recorded->events.size(), 4u + 2u);
    std::filesystem::remove(path);
}

TEST(InputSource, PlaysALogAtItsTimes) {
    const auto log =
        parse_input_log(kHeader + "0.1 mouse 1 1\n0.2 frame 0.3\n0.2 mouse 2 2\n0.25 mouse 3 3\n", "in.log");
    ASSERT_TRUE(log) << log.error().line();
    InputSource source = InputSource::play(*log);
    EXPECT_FALSE(source.replays());
    source.push(0, MouseMove{{9.0, 9.0}});  // whoever is in front of it
    constexpr Nanoseconds kMs = 1'000'000;
    EXPECT_EQ(source.next_event_ns(), 100 * kMs);
    const auto early = source.begin_frame(99 * kMs, 105 * kMs);
    ASSERT_TRUE(early);
    EXPECT_TRUE(early->events.empty());
    EXPECT_EQ(early->time_ns, 99 * kMs);
    EXPECT_EQ(early->display_ns, 105 * kMs);
    EXPECT_EQ(source.begin_frame(100 * kMs, 105 * kMs)->events.size(), 1u);
    EXPECT_EQ(source.begin_frame(98 * kMs, 105 * kMs)->time_ns, 100 * kMs) << "never before the frame before";
    EXPECT_EQ(source.next_event_ns(), 200 * kMs);
    EXPECT_EQ(source.latest_by_ns(), 0);
    const auto late = source.begin_frame(400 * kMs, 405 * kMs);
    ASSERT_TRUE(late);
    ASSERT_EQ(late->events.size(), 2u) << "the recording's own frame is left out";
    EXPECT_EQ(std::get<MouseMove>(late->events[1].input).position_px.x, 3.0);
    EXPECT_EQ(source.latest_by_ns(), 200 * kMs) << "of the first of the two";
    EXPECT_FALSE(source.next_event_ns());
    EXPECT_FALSE(source.begin_frame(401 * kMs, 405 * kMs));
}

TEST(InputSource, AHeadIsSampledByItsTrackerOrElseWithTheFrame) {
    const std::vector<InputEvent> events{{3, HeadInput{}}, {5, HeadInput{}}, {8, MouseMove{}}};
    EXPECT_EQ(head_sampled_ns({10, 20, events}), 5);
    EXPECT_EQ(head_sampled_ns({10, 20, std::span(events).subspan(2)}), 10);
}

TEST(InputSource, PassesOverNonsenseOfATracker) {
    InputSource source = InputSource::live();
    source.push(1, HeadInput{{{NAN, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, true});
    source.push(2, HeadInput{{Vec3(0.0), {0.0, 0.0, 0.0, 0.0}}, true});
    source.push(3, FrameStart{3});
    EXPECT_FALSE(source.has_waiting_input());
    source.push(4, WindowClose{});
    EXPECT_TRUE(source.has_waiting_input());
    EXPECT_EQ(source.refused(), 3u);
    EXPECT_EQ(source.begin_frame(5, 6)->events.size(), 1u);
    EXPECT_EQ(source.begin_frame(5, 6)->events.size(), 0u);
}

TEST(InputKeys, EveryKeyHasAnUnmistakableName) {
    for (std::size_t i = 0; i < kKeyCount; ++i) {
        const std::string_view name = name_of(static_cast<Key>(i));
        EXPECT_EQ(key_named(name), static_cast<Key>(i)) << name;  // so no two are alike
        EXPECT_EQ(as_word(name), name);
    }
    EXPECT_EQ(key_named("home"), Key::home);
    EXPECT_EQ(key_named("7"), Key::digit_7);
    EXPECT_EQ(key_named("right-bracket"), Key::right_bracket);
    EXPECT_EQ(key_named("keypad-add"), Key::keypad_add);
    EXPECT_EQ(key_named("f12"), Key::f12);
    EXPECT_EQ(key_named("Home"), std::nullopt);
}

}  // namespace burin::session
