// SPDX-License-Identifier: MIT
#include "desk/timing/frame_times.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "base/error.hpp"

namespace burin::session {
namespace {

constexpr std::array<std::string_view, kFrameFigures> kFigureNames = {
    "head age", "motion to photon", "tool age", "touch before sight", "carve age", "frame time", "draw time"};

// Published limits of perception, for each figure from strict to lax; the last one that is exceeded is reported.
struct Limit {
    FrameFigure figure;
    bool from_below;  // judges the figure's negative
    Nanoseconds limit_ns;
    std::string_view what;
    std::string_view source;
    const char* title;  // a format for the milliseconds
};
constexpr Nanoseconds kMs = 1'000'000;
constexpr std::array<Limit, 5> kLimits = {
    Limit{FrameFigure::motion_to_photon, false, 17 * kMs, "the scene may be seen to swim when the head moves",
          "Adelstein, Lee, Ellis 2003: 17 ms to be imperceptible", "Picture %.0f ms behind the head; 17 may show"},
    Limit{FrameFigure::motion_to_photon, false, 20 * kMs, "the scene is seen to swim when the head moves",
          "20 ms: what the industry aims at", "Picture %.0f ms behind the head; 20 is noticed"},
    Limit{FrameFigure::motion_to_photon, false, 50 * kMs, "the scene lags behind the head more than is usual",
          "MiddleVR: 50 ms are typical of a CAVE", "Picture %.0f ms behind the head; 50 is usual"},
    Limit{FrameFigure::touch_before_sight, false, 15 * kMs, "contact is felt noticeably before it is seen",
          "Di Luca et al. 2019, doi 10.1109/WHC.2019.8816173: 15 ms", "Picture %.0f ms behind the hand; 15 is noticed"},
    Limit{FrameFigure::touch_before_sight, true, 50 * kMs, "contact is seen noticeably before it is felt",
          "Di Luca et al. 2019, doi 10.1109/WHC.2019.8816173: 50 ms", "Picture %.0f ms before the hand; 50 is noticed"},
};

Nanoseconds of_rank(const std::vector<Nanoseconds>& sorted, double share) {
    const double rank = std::ceil(share * static_cast<double>(sorted.size()) - 1e-9);
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

std::optional<Nanoseconds> worse(const std::array<std::optional<Nanoseconds>, 2>& eyes, bool from_below) {
    if (!eyes[kLeftEye] || !eyes[kRightEye]) return std::nullopt;
    return from_below ? std::min(*eyes[kLeftEye], *eyes[kRightEye]) : std::max(*eyes[kLeftEye], *eyes[kRightEye]);
}

std::string title_of(const Limit& limit, Nanoseconds p95_ns) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), limit.title, 1e3 * seconds(p95_ns));
    return text.data();
}

std::string line_of(const Limit& limit, Nanoseconds p95_ns) {
    std::array<char, 320> text{};
    const std::string_view name = name_of(limit.figure);
    std::snprintf(text.data(), text.size(), "%s%.*s %.1f ms, above %.0f ms: %.*s (%.*s)",
                  limit.from_below ? "minus " : "", static_cast<int>(name.size()), name.data(), 1e3 * seconds(p95_ns),
                  1e3 * seconds(limit.limit_ns), static_cast<int>(limit.what.size()), limit.what.data(),
                  static_cast<int>(limit.source.size()), limit.source.data());
    return text.data();
}

}  // namespace

std::string_view name_of(FrameFigure figure) { return kFigureNames.at(static_cast<std::size_t>(figure)); }

FrameAges ages_of(const FrameTimes& frame, const FrameTimes* before, const LatencySettings& settings) {
    FrameAges ages;
    const auto set = [&](FrameFigure figure, std::size_t eye, Nanoseconds value_ns) {
        ages[static_cast<std::size_t>(figure)][eye] = value_ns;
    };
    for (const std::size_t eye : {kLeftEye, kRightEye}) {
        const Nanoseconds later_ns = eye == kRightEye ? settings.right_eye_later_ns : -settings.right_eye_later_ns;
        const Nanoseconds vblank_ns = frame.seen_ns + std::max<Nanoseconds>(later_ns, 0);
        const Nanoseconds light_ns = vblank_ns + settings.display_ns;
        if (frame.head_sampled_ns) {
            set(FrameFigure::head_age, eye, vblank_ns - *frame.head_sampled_ns);
            set(FrameFigure::motion_to_photon, eye, light_ns - *frame.head_sampled_ns + settings.tracker_ns);
        }
        if (frame.tool_sampled_ns) {
            set(FrameFigure::tool_age, eye, vblank_ns - *frame.tool_sampled_ns);
            set(FrameFigure::touch_before_sight, eye, light_ns - (*frame.tool_sampled_ns + settings.device_ns));
        }
        if (frame.cut_ns) set(FrameFigure::carve_age, eye, vblank_ns - *frame.cut_ns);
        if (before != nullptr && !frame.after_pause) set(FrameFigure::frame_time, eye, frame.seen_ns - before->seen_ns);
        set(FrameFigure::draw_time, eye, frame.draw_ns);
    }
    return ages;
}

FigureSummary summarised(std::vector<Nanoseconds> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    return {values.size(),         values.front(),        of_rank(values, 0.5),
            of_rank(values, 0.95), of_rank(values, 0.99), values.back()};
}

std::optional<Nanoseconds> worse_eye(const FrameAges& ages, FrameFigure figure) {
    return worse(ages[static_cast<std::size_t>(figure)], false);
}

void FrameHistory::add(const FrameTimes& frame) noexcept {
    const FrameTimes* before = count_ > 0 ? &ring_[(count_ - 1) % kFrames].times : nullptr;
    const Entry entry{frame, ages_of(frame, before, settings_)};
    ring_[count_++ % kFrames] = entry;
}

const FrameTimes& FrameHistory::times(std::size_t i) const {
    BURIN_CHECK(i < size());
    return ring_[(count_ - size() + i) % kFrames].times;
}

const FrameAges& FrameHistory::ages(std::size_t i) const {
    BURIN_CHECK(i < size());
    return ring_[(count_ - size() + i) % kFrames].ages;
}

FigureSummary FrameHistory::summary(FrameFigure figure) const { return recent(figure, kFrames); }

FigureSummary FrameHistory::recent(FrameFigure figure, std::size_t frames) const {
    std::vector<Nanoseconds> values;
    for (std::size_t i = size() - std::min(frames, size()); i < size(); ++i)
        if (const auto value = worse_eye(ages(i), figure)) values.push_back(*value);
    return summarised(std::move(values));
}

FigureSummary FrameHistory::summary(FrameFigure figure, std::size_t eye) const {
    std::vector<Nanoseconds> values;
    for (std::size_t i = 0; i < size(); ++i)
        if (const auto& value = ages(i)[static_cast<std::size_t>(figure)].at(eye)) values.push_back(*value);
    return summarised(std::move(values));
}

std::vector<FrameWarning> FrameHistory::warnings() const {
    std::vector<FrameWarning> found;
    const Limit* reported = nullptr;
    for (const Limit& limit : kLimits) {
        std::vector<Nanoseconds> values;
        for (std::size_t i = 0; i < size(); ++i)
            if (const auto v = worse(ages(i)[static_cast<std::size_t>(limit.figure)], limit.from_below))
                values.push_back(limit.from_below ? -*v : *v);
        if (values.size() < kLeastJudged) continue;
        const Nanoseconds p95_ns = summarised(std::move(values)).p95_ns;
        if (p95_ns <= limit.limit_ns) continue;
        const bool replaces =
            reported != nullptr && reported->figure == limit.figure && reported->from_below == limit.from_below;
        if (replaces) found.pop_back();
        found.push_back(
            {static_cast<std::size_t>(&limit - kLimits.data()), title_of(limit, p95_ns), line_of(limit, p95_ns)});
        reported = &limit;
    }
    return found;
}

}  // namespace burin::session
