// SPDX-License-Identifier: MIT
#include "session/input/input_line.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "session/input/input_keys.hpp"
#include "session/input/input_words.hpp"

namespace burin::session {
namespace {

// Takes a line's arguments one by one. The first error is kept; after it everything taken is a default.
class LineArguments {
public:
    explicit LineArguments(std::span<const std::string> words) : words_(words) {}

    [[nodiscard]] bool more() const { return !complaint_ && next_ < words_.size(); }
    std::string word() {
        if (complaint_) return {};
        if (next_ == words_.size()) {
            complaint_ = "an argument is missing";
            return {};
        }
        return words_[next_++];
    }
    double number() {
        const std::string text = word();
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
            refuse("'" + text + "' is no finite number");
        return value;
    }
    std::uint32_t count() {
        const std::string text = word();
        std::uint32_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size()) refuse("'" + text + "' is no whole number");
        return value;
    }
    // Returns the index of the next word among the names.
    std::size_t one_of(std::span<const std::string_view> names, const std::string& what) {
        const std::string text = word();
        for (std::size_t i = 0; i < names.size(); ++i)
            if (names[i] == text) return i;
        refuse("'" + text + "' is no " + what + "; the nearest is '" + std::string(nearest_name(text, names)) + "'");
        return 0;
    }
    // Reads modifiers at the end of a line; none when absent.
    Modifiers modifiers() {
        if (!more()) return {};
        const std::string text = word();
        const auto held = modifiers_named(text);
        if (!held) refuse("'" + text + "' is no modifier; write ctrl, alt, shift or super, joined by +");
        return held.value_or(Modifiers{});
    }
    // Reads a flag at the end of a line; false when absent.
    bool flag(std::string_view name) {
        if (!more()) return false;
        one_of({&name, 1}, "word that may stand here");
        return true;
    }
    Vec2 vec2() {
        const double x = number();
        return {x, number()};
    }
    Pose pose() {
        std::array<double, 7> n{};
        for (double& value : n) value = number();
        return {{n[0], n[1], n[2]}, rotation(Quat(n[6], n[3], n[4], n[5]))};
    }
    void refuse(std::string what) {
        if (!complaint_) complaint_ = std::move(what);
    }
    [[nodiscard]] std::optional<std::string> complaint() const {
        if (!complaint_ && next_ != words_.size()) return "'" + words_[next_] + "' is one argument too many";
        return complaint_;
    }

private:
    // Brings a quaternion to unit length that is off by a few of its decimals. What is closer than that stays to the
    // bit, so that a log that is written and read stays the same.
    Quat rotation(const Quat& q) {
        constexpr double kRounded = 0.01, kUnit = 1e-6;
        const double length = glm::length(q);
        if (complaint_ || std::abs(length - 1.0) <= kUnit) return q;
        if (std::abs(length - 1.0) <= kRounded) return q / length;
        refuse(formatted("its quaternion, of length %.12g, is out of its range: %g to %g, which is brought to 1",
                         length, 1.0 - kRounded, 1.0 + kRounded));
        return Quat(1.0, 0.0, 0.0, 0.0);
    }

    std::span<const std::string> words_;
    std::size_t next_ = 0;
    std::optional<std::string> complaint_;
};

constexpr std::array<std::string_view, 3> kMotions = {"press", "release", "repeat"};
constexpr std::span<const std::string_view> kPressOrRelease(kMotions.data(), 2);
constexpr std::array<std::string_view, 2> kFocus = {"gained", "lost"};

Input read_key(LineArguments& a) {
    const auto motion = static_cast<KeyMotion>(a.one_of(kMotions, "motion of a key"));
    const auto key = static_cast<Key>(a.one_of(key_names(), "key"));
    return KeyInput{key, motion, a.modifiers()};
}
Input read_mouse(LineArguments& a) { return MouseMove{a.vec2()}; }
Input read_button(LineArguments& a) {
    const bool pressed = a.one_of(kPressOrRelease, "motion of a button") == 0;
    const auto button = static_cast<MouseButton>(a.one_of(mouse_button_names(), "mouse button"));
    return MouseClick{button, pressed, a.modifiers()};
}
Input read_scroll(LineArguments& a) {
    const Vec2 steps = a.vec2();
    return Scroll{steps, a.modifiers()};
}
Input read_text(LineArguments& a) { return TextInput{a.word()}; }
Input read_resize(LineArguments& a) {
    const std::uint32_t width_px = a.count();
    return WindowResize{width_px, a.count()};
}
Input read_focus(LineArguments& a) { return WindowFocus{a.one_of(kFocus, "change of focus") == 0}; }
Input read_close(LineArguments&) { return WindowClose{}; }
Input read_head(LineArguments& a) {
    const Pose pose = a.pose();
    return HeadInput{pose, !a.flag("lost")};
}
Input read_wand(LineArguments& a) {
    const std::uint32_t wand = a.count();
    const Pose pose = a.pose();
    return WandInput{wand, pose, !a.flag("lost")};
}
Input read_wand_button(LineArguments& a) {
    const std::uint32_t wand = a.count();
    const bool pressed = a.one_of(kPressOrRelease, "motion of a button") == 0;
    return WandClick{wand, a.count(), pressed};
}
Input read_wand_stick(LineArguments& a) {
    const std::uint32_t wand = a.count();
    return WandStick{wand, a.vec2()};
}
Input read_command(LineArguments& a) {
    CommandInput command{a.word(), {}};
    while (a.more()) command.arguments.push_back(a.word());
    return command;
}
Input read_frame(LineArguments& a) {
    if (!a.more()) return FrameStart{-1};  // shown when drawn; the caller knows the time
    const std::string text = a.word();
    const auto display_ns = time_of_text(text);
    if (!display_ns) a.refuse("'" + text + "' is no time");
    return FrameStart{display_ns.value_or(0)};
}

struct Kind {
    std::string_view name;
    std::string_view arguments;
    Input (*read)(LineArguments&);
};
constexpr std::array kInputKinds = {
    // in the order of Input's alternatives
    Kind{"key", "press|release|repeat KEY [MODIFIERS]", read_key},
    Kind{"mouse", "X_PX Y_PX", read_mouse},
    Kind{"button", "press|release left|right|middle|back|forward [MODIFIERS]", read_button},
    Kind{"scroll", "X Y [MODIFIERS]", read_scroll},
    Kind{"text", "\"CHARACTERS\"", read_text},
    Kind{"resize", "WIDTH_PX HEIGHT_PX", read_resize},
    Kind{"focus", "gained|lost", read_focus},
    Kind{"close", "", read_close},
    Kind{"head", "X Y Z QX QY QZ QW [lost]", read_head},
    Kind{"wand", "WAND X Y Z QX QY QZ QW [lost]", read_wand},
    Kind{"wand-button", "WAND press|release BUTTON", read_wand_button},
    Kind{"wand-stick", "WAND X Y", read_wand_stick},
    Kind{"command", "NAME [ARGUMENTS]", read_command},
    Kind{"frame", "[DISPLAY_TIME_S]", read_frame},
};
static_assert(kInputKinds.size() == std::variant_size_v<Input>);

struct Writer {
    std::string line;

    void word(std::string_view text) {
        line += ' ';
        line += text;
    }
    void number(double x) {
        std::array<char, 32> digits;
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr;
        word({digits.data(), end});
    }
    void count(std::uint32_t n) { word(std::to_string(n)); }
    void numbers(const Vec2& v) {
        number(v.x);
        number(v.y);
    }
    void modifiers(const Modifiers& m) {
        if (m != Modifiers{}) word(name_of(m));
    }
    void pose(const Pose& pose, bool tracked) {
        const Quat& q = pose.orientation;
        for (const double x : {pose.position_m.x, pose.position_m.y, pose.position_m.z, q.x, q.y, q.z, q.w}) number(x);
        if (!tracked) word("lost");
    }

    void operator()(const KeyInput& in) {
        word(kMotions.at(static_cast<std::size_t>(in.motion)));
        word(name_of(in.key));
        modifiers(in.modifiers);
    }
    void operator()(const MouseMove& in) { numbers(in.position_px); }
    void operator()(const MouseClick& in) {
        word(in.pressed ? "press" : "release");
        word(name_of(in.button));
        modifiers(in.modifiers);
    }
    void operator()(const Scroll& in) {
        numbers(in.steps);
        modifiers(in.modifiers);
    }
    void operator()(const TextInput& in) { word(burin::session::quoted(in.utf8)); }
    void operator()(const WindowResize& in) {
        count(in.width_px);
        count(in.height_px);
    }
    void operator()(const WindowFocus& in) { word(kFocus[in.gained ? 0 : 1]); }
    void operator()(const WindowClose&) {}
    void operator()(const HeadInput& in) { pose(in.pose_world, in.tracked); }
    void operator()(const WandInput& in) {
        count(in.wand);
        pose(in.pose_world, in.tracked);
    }
    void operator()(const WandClick& in) {
        count(in.wand);
        word(in.pressed ? "press" : "release");
        count(in.button);
    }
    void operator()(const WandStick& in) {
        count(in.wand);
        numbers(in.position);
    }
    void operator()(const CommandInput& in) {
        word(as_word(in.name));
        for (const std::string& argument : in.arguments) word(as_word(argument));
    }
    void operator()(const FrameStart& in) { word(text_of_time(in.display_ns)); }
};

std::string usage(const Kind& kind) {
    std::string text = "write: TIME_S " + std::string(kind.name);
    if (!kind.arguments.empty()) text += " " + std::string(kind.arguments);
    return text;
}

Result<const Kind*> kind_named(const std::string& name, const std::string& where) {
    std::array<std::string_view, kInputKinds.size()> names;
    for (std::size_t i = 0; i < kInputKinds.size(); ++i) {
        names[i] = kInputKinds[i].name;
        if (names[i] == name) return &kInputKinds[i];
    }
    return fail(where,
                "'" + name + "' is no kind of input; the nearest is '" + std::string(nearest_name(name, names)) + "'",
                "write one of " + joined(names));
}

Result<InputEvent> make_event(Nanoseconds time_ns, const Kind& kind, std::span<const std::string> words,
                              const std::string& where) {
    LineArguments arguments(words);
    InputEvent event{time_ns, kind.read(arguments)};
    if (const auto complaint = arguments.complaint())
        return fail(where, std::string(kind.name) + ": " + *complaint, usage(kind));
    if (auto* frame = std::get_if<FrameStart>(&event.input); frame != nullptr && frame->display_ns < 0)
        frame->display_ns = time_ns;
    if (const auto* frame = std::get_if<FrameStart>(&event.input); frame != nullptr && frame->display_ns < time_ns)
        return fail(where, "the frame is seen before it is drawn", "give a display time that is not before the line's");
    if (!is_sensible(event.input))
        return fail(where, std::string(kind.name) + ": a number, name or text is out of its range",
                    usage(kind) +
                        ", with numbers up to 1e9, unit quaternions, sticks from -1 to 1, text of valid UTF-8 up to " +
                        std::to_string(kMostTextBytes) + " bytes");
    return event;
}

}  // namespace

std::string text_of_time(Nanoseconds time_ns) {
    std::string text = std::to_string(time_ns / kNanosecondsPerSecond);
    std::string decimals = std::to_string(kNanosecondsPerSecond + time_ns % kNanosecondsPerSecond);
    decimals.front() = '.';
    while (decimals.back() == '0') decimals.pop_back();
    if (decimals.size() > 1) text += decimals;
    return text;
}

std::optional<Nanoseconds> time_of_text(std::string_view text) {
    const std::size_t point = text.find('.');
    const std::string_view whole = text.substr(0, point);
    const std::string_view decimals = point == std::string_view::npos ? "0" : text.substr(point + 1);
    const auto digits = [](std::string_view s, std::size_t most) {
        return !s.empty() && s.size() <= most && s.find_first_not_of("0123456789") == std::string_view::npos;
    };
    if (!digits(whole, 7) || !digits(decimals, 9)) return std::nullopt;
    Nanoseconds time_ns = 0;
    for (const char c : whole) time_ns = 10 * time_ns + (c - '0');
    for (std::size_t i = 0; i < 9; ++i) time_ns = 10 * time_ns + (i < decimals.size() ? decimals[i] - '0' : 0);
    if (time_ns > kLongestSession_ns) return std::nullopt;
    return time_ns;
}

std::string line_of(const InputEvent& event) {
    BURIN_CHECK(event.time_ns >= 0 && event.time_ns <= kLongestSession_ns && is_sensible(event.input));
    Writer writer{text_of_time(event.time_ns)};
    writer.word(kInputKinds.at(event.input.index()).name);
    std::visit(writer, event.input);
    return writer.line;
}

Result<std::optional<InputEvent>> parse_line(std::string_view line, const std::string& where) {
    if (line.size() > kMostLineBytes)
        return fail(where, "the line is longer than any event", "split it, or is this an input log?");
    BURIN_TRY(words, words_of(line, where));
    if (words.empty()) return std::nullopt;
    const auto time_ns = time_of_text(words.front());
    if (!time_ns)
        return fail(
            where, "'" + words.front().substr(0, 40) + "' is no time",
            "begin the line with seconds since the session's start, up to 1000000 and with at most nine decimals");
    if (words.size() < 2) return fail(where, "nothing follows the time", "write: TIME_S KIND ARGUMENTS");
    BURIN_TRY(kind, kind_named(words[1], where));
    BURIN_TRY(event, make_event(*time_ns, *kind, std::span(words).subspan(2), where));
    return std::optional(std::move(event));
}

Result<std::optional<devices::TrackerInput>> parse_tracker_line(std::string_view line) {
    if (line.empty()) return std::nullopt;
    BURIN_TRY(event, parse_line("0 " + std::string(line), "tracker"));
    if (!event) return std::nullopt;
    return std::visit(
        [](auto&& input) -> Result<std::optional<devices::TrackerInput>> {
            using Kind = std::remove_cvref_t<decltype(input)>;
            if constexpr (std::is_constructible_v<devices::TrackerInput, Kind>) {
                return devices::TrackerInput(std::move(input));
            } else {
                return fail("tracker", "only head, wand, wand-button and wand-stick come from there");
            }
        },
        std::move(event->input));
}

}  // namespace burin::session
