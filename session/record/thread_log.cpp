// SPDX-License-Identifier: MIT
#include "session/record/thread_log.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "session/input/input_event.hpp"
#include "session/input/input_words.hpp"

namespace burin::session {
namespace {

constexpr double kSlightestPace = 1e-3, kGreatestPace = 1e3;
constexpr std::size_t kMostPartsOfHands = 16;
constexpr Nanoseconds kLatestStart_ns = Nanoseconds{1} << 60;  // 36 years after a machine's start

struct LogKind {
    std::string_view name, arguments;
};
constexpr std::array kLogKinds = {
    LogKind{"clock", "START_NS TICK_PERIOD_NS RESOLUTION_M [PACE]"},
    LogKind{"ticks", "FIRST TICK;TICK;..."},
    LogKind{"updates", "FIRST UPDATE;UPDATE;..."},
    LogKind{"output", "SCREEN WIDTH_PX HEIGHT_PX X_PX Y_PX"},
    LogKind{"plotted", "TICK_US FRAME_MS FRAME_LIMIT_MS"},
    LogKind{"figures", "FIGURES OF THE PANEL, AND ITS WARNINGS"},
    LogKind{"kept", "TICK"},
    LogKind{"activity", "CHECK"},
    LogKind{"saw", "TICK UPDATES CHECK [TICK OF EACH FURTHER PART...]"},
    LogKind{"refused", "STEREO_MODE"},
    LogKind{"said", "\"MESSAGE\""},
    LogKind{"end", "CHECK"},
};

template <typename T>
std::optional<T> number(const std::string& word) {
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(value)) return std::nullopt;
    }
    return value;
}

template <typename T>
std::string shortest_text(T number) {
    std::array<char, 32> digits;
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

// Visits the panel's figures in the order of their line; a missing one is written as '-'.
template <typename Figures, typename Visit>
void visit_figures(Figures& f, Visit&& visit) {
    visit(f.head_age_ms);
    visit(f.motion_to_photon_ms);
    visit(f.touch_before_sight_ms);
    visit(f.draw_ms);
    visit(f.tick_us);
    visit(f.frame_ms);
    visit(f.carve_age_ms);
}

template <typename Savings, typename Visit>
void visit_savings(Savings& s, Visit&& visit) {
    visit(s.patches);
    visit(s.drawn);
    visit(s.beside);
    visit(s.turned_away);
    visit(s.behind);
    visit(s.coarser);
    visit(s.redrawn_percent);
    visit(s.frames_skipped);
}
// Words of a figures line: its kind, frames per second, and those of the two functions above.
constexpr std::size_t kFigureWords = 1 + 1 + 7 + 8;

// Takes a line of ticks or updates, after checking that all of it can be read.
template <typename Text>
bool take_lines(const std::vector<std::string>& words, std::size_t line, Text& text, ThreadLines& into) {
    if (words.size() != 3 || number<std::size_t>(words[1]) != into.count + 1) return false;
    for (std::string_view rest = words[2]; !rest.empty(); ++into.count) {
        if (!text.read(rest)) return false;
    }
    into.lines.push_back({line, words[2]});
    return true;
}

}  // namespace

// ---- Writing

std::string text_of(const ThreadClock& clock) {
    return "clock " + shortest_text(clock.start_ns) + " " + shortest_text(clock.period_ns) + " " +
           shortest_text(clock.resolution_m) + " " + shortest_text(clock.pace);
}

std::string text_of(const OutputSeen& output) {
    const wall::OutputPlace& p = output.place;
    return "output " + shortest_text(output.screen) + " " + shortest_text(p.size.width) + " " +
           shortest_text(p.size.height) + " " + shortest_text(p.monitor_x) + " " + shortest_text(p.monitor_y);
}

std::string text_of(const PanelPlotted& p) {
    return "plotted " + shortest_text(p.tick_us) + " " + shortest_text(p.frame_ms) + " " +
           shortest_text(p.frame_limit_ms);
}

std::string text_of(const PanelNumbers& numbers) {
    std::string line = "figures " + shortest_text(numbers.figures.frames_per_s);
    visit_figures(numbers.figures,
                  [&](const std::optional<double>& x) { line += " " + (x ? shortest_text(*x) : "-"); });
    visit_savings(numbers.savings, [&](const auto& x) { line += " " + shortest_text(x); });
    for (const std::string& warning : numbers.warnings) line += " " + burin::session::quoted(warning);
    return line;
}

std::string text_of(const FrameSeen& frame) {
    std::string line = "saw " + shortest_text(frame.ticks.front()) + " " + shortest_text(frame.updates) + " " +
                       shortest_text(frame.check);
    for (std::size_t part = 1; part < frame.ticks.size(); ++part) line += " " + shortest_text(frame.ticks[part]);
    return line;
}

std::string activity_text(std::uint64_t check) { return "activity " + shortest_text(check); }
std::string kept_text(std::uint64_t acknowledged) { return "kept " + shortest_text(acknowledged); }
std::string refused_text(wall::StereoMode mode) { return "refused " + std::string(file_name_of(mode)); }
std::string message_text(const std::string& message) { return "said " + burin::session::quoted(message); }
std::string end_text(std::uint64_t check) { return "end " + shortest_text(check); }

// ---- Reading

bool ThreadLogReader::knows(std::string_view kind) {
    return std::ranges::find(kLogKinds, kind, &LogKind::name) != kLogKinds.end();
}

Result<void> ThreadLogReader::take(const std::vector<std::string>& words, std::size_t line, const std::string& where) {
    const std::string& kind = words.front();
    const auto wrong = [&](const std::string& what) {
        const LogKind& known = *std::ranges::find(kLogKinds, std::string_view(kind), &LogKind::name);
        return fail(where, kind + ": " + what,
                    "write: TIME_S " + kind + " " + std::string(known.arguments) +
                        "; or take such lines out, all of them: the rest is a log of the input alone");
    };
    if (!log_ && kind != "clock") return wrong("what the threads did comes before the line with their clock");
    bool right = false;
    if (kind == "clock") right = take_clock(words);
    if (kind == "ticks") right = take_lines(words, line, *ticks_, log_->ticks);
    if (kind == "updates") right = take_lines(words, line, *updates_, log_->updates);
    if (kind == "saw") right = take_saw(words, line);
    if (kind == "output") right = take_output(words);
    if (kind == "plotted") right = take_plotted(words);
    if (kind == "figures") right = take_figures(words);
    if (kind == "refused" || kind == "said" || kind == "end" || kind == "kept" || kind == "activity")
        right = take_rest(words);
    if (!right) return wrong("an argument is missing, not understood, or at odds with the lines before");
    return {};
}

bool ThreadLogReader::take_clock(const std::vector<std::string>& words) {
    if (log_ || words.size() < 4 || words.size() > 5) return false;
    const auto start = number<Nanoseconds>(words[1]);
    const auto period = number<Nanoseconds>(words[2]);
    const auto resolution = number<double>(words[3]);
    // Older recordings have none.
    const auto pace = words.size() == 5 ? number<double>(words[4]) : std::optional(1.0);
    if (!start || *start < 0 || *start > kLatestStart_ns) return false;
    if (!period || *period < 1 || *period > kNanosecondsPerSecond) return false;
    if (!resolution || !std::isfinite(*resolution) || *resolution < 0.0) return false;
    if (!pace || *pace < kSlightestPace || *pace > kGreatestPace) return false;
    log_.emplace().clock = {*start, *period, *resolution, *pace};
    ticks_.emplace(log_->clock);
    updates_.emplace(log_->clock);
    return true;
}

// Takes the `saw` line of the frame that has begun; each frame has one.
bool ThreadLogReader::take_saw(const std::vector<std::string>& words, std::size_t line) {
    if (words.size() < 4 || words.size() > 3 + kMostPartsOfHands || log_->frames.size() + 1 != begun_) return false;
    const auto updates = number<std::uint64_t>(words[2]), check = number<std::uint64_t>(words[3]);
    if (!updates || !check) return false;
    std::vector<std::uint64_t> ticks;
    for (std::size_t word = 1; word < words.size(); word = word == 1 ? 4 : word + 1) {
        const auto tick = number<std::uint64_t>(words[word]);
        if (!tick) return false;
        ticks.push_back(*tick);
    }
    if (!log_->frames.empty()) {
        const FrameSeen& before = log_->frames.back();
        if (ticks.size() != before.ticks.size() || *updates < before.updates) return false;
        for (std::size_t part = 0; part < ticks.size(); ++part)
            if (ticks[part] < before.ticks[part]) return false;
        if (!frame_.activity) frame_.activity = before.activity;  // as it was
    }
    FrameSeen& frame = log_->frames.emplace_back(std::exchange(frame_, {}));
    frame.ticks = std::move(ticks);
    frame.updates = *updates;
    frame.check = *check;
    frame.line = line;
    return true;
}

bool ThreadLogReader::take_output(const std::vector<std::string>& words) {
    if (words.size() != 6) return false;
    const auto screen = number<std::size_t>(words[1]);
    const auto width = number<std::uint32_t>(words[2]), height = number<std::uint32_t>(words[3]);
    const auto x = number<int>(words[4]), y = number<int>(words[5]);
    if (!screen || !width || !height || !x || !y || *width > kMostWindow_px || *height > kMostWindow_px) return false;
    frame_.outputs.push_back({*screen, {.size = {*width, *height}, .monitor_x = *x, .monitor_y = *y}});
    return true;
}

bool ThreadLogReader::take_plotted(const std::vector<std::string>& words) {
    if (words.size() != 4) return false;
    const auto tick = number<double>(words[1]), frame = number<double>(words[2]), limit = number<double>(words[3]);
    if (!tick || !frame || !limit) return false;
    frame_.measured.plotted = {*tick, *frame, *limit};
    return true;
}

bool ThreadLogReader::take_figures(const std::vector<std::string>& words) {
    if (words.size() < kFigureWords) return false;
    bool right = true;
    std::size_t next = 1;
    const auto take = [&](auto& x) {
        const auto value = number<std::remove_reference_t<decltype(x)>>(words[next++]);
        right = right && value;
        if (value) x = *value;
    };
    PanelNumbers numbers;
    take(numbers.figures.frames_per_s);
    visit_figures(numbers.figures, [&](std::optional<double>& x) {
        if (words[next] == "-") {
            ++next;
        } else {
            take(x.emplace());
        }
    });
    visit_savings(numbers.savings, take);
    numbers.warnings.assign(words.begin() + static_cast<std::ptrdiff_t>(next), words.end());
    frame_.measured.numbers = std::move(numbers);
    return right;
}

bool ThreadLogReader::take_rest(const std::vector<std::string>& words) {
    if (words.size() != 2) return false;
    const bool before = log_->frames.empty();
    if (words[0] == "said") {
        (before ? log_->messages_before : log_->frames.back().messages).push_back(words[1]);
        return true;
    }
    if (words[0] == "kept") {
        frame_.measured.acknowledged = number<std::uint64_t>(words[1]);
        return frame_.measured.acknowledged.has_value();
    }
    if (words[0] == "activity") {
        frame_.activity = number<std::uint64_t>(words[1]);
        return frame_.activity.has_value();
    }
    if (words[0] == "end") {
        log_->end_check = number<std::uint64_t>(words[1]);
        return log_->end_check.has_value();
    }
    const auto mode = wall::parse_stereo_mode(words[1]);
    if (!mode || before) return false;
    log_->frames.back().refused = *mode;
    return true;
}

}  // namespace burin::session
