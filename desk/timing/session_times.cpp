// SPDX-License-Identifier: MIT
#include "desk/timing/session_times.hpp"

#include <time.h>

#include <string_view>
#include <utility>

namespace burin::session {
namespace {

constexpr std::array<std::string_view, kFrameStages> kStageNames = {"wait", "input", "step", "record", "show", "draw"};

}  // namespace

std::string_view name_of(FrameStage stage) { return kStageNames.at(static_cast<std::size_t>(stage)); }

Nanoseconds begins_to_show_ns(Nanoseconds handed_ns, const DisplayBeat& beat) {
    if (!beat.vblank_ns || beat.period_ns <= 0) return handed_ns + beat.period_ns / 2;
    const Nanoseconds past_ns = (handed_ns - *beat.vblank_ns) % beat.period_ns;  // negative before that vblank
    return handed_ns + (past_ns > 0 ? beat.period_ns : 0) - past_ns;
}

Nanoseconds process_cpu_ns() noexcept {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec * kNanosecondsPerSecond + now.tv_nsec;
}

void SessionTimes::begin() {
    begun_ = true;
    frame_ = {};
    frame_.times.frame = drawn_;
    frame_.times.after_pause = skipped_before_;
    last_ns_ = clock_.now_ns();
    processor_at_begin_ns_ = processor_();
}

void SessionTimes::reached(FrameStage stage) {
    if (!begun_) return;
    const Nanoseconds now_ns = clock_.now_ns();
    frame_.stage_ns[static_cast<std::size_t>(stage)] += now_ns - last_ns_;
    last_ns_ = now_ns;
}

void SessionTimes::sampled(Nanoseconds head_ns, Nanoseconds tool_ns) {
    if (head_ns > 0) frame_.times.head_sampled_ns = head_ns;
    if (tool_ns > 0) frame_.times.tool_sampled_ns = tool_ns;
}

void SessionTimes::cut(Nanoseconds cut_ns) {
    if (cut_ns > cut_drawn_ns_) frame_.times.cut_ns = cut_ns;
}

void SessionTimes::moved(const FrameMotion& motion) {
    frame_.motion.view = frame_.motion.view || motion.view;
    frame_.motion.tool = frame_.motion.tool || motion.tool;
    frame_.motion.works = frame_.motion.works || motion.works || frame_.times.cut_ns.has_value();
}

void SessionTimes::finished(bool drawn, const DisplayBeat& beat) {
    if (!begun_) return;
    beat_ = beat;
    skipped_before_ = !drawn;
    if (!drawn) {
        ++skipped_;
        return;
    }
    const Nanoseconds now_ns = clock_.now_ns();
    ++drawn_;
    frame_.times.seen_ns = begins_to_show_ns(now_ns, beat);
    frame_.times.draw_ns = frame_.stage_ns[static_cast<std::size_t>(FrameStage::draw)];
    frame_.processor_ns = processor_() - processor_at_begin_ns_;
    if (frame_.times.cut_ns) cut_drawn_ns_ = *frame_.times.cut_ns;
    if (pressed_ns_ && frame_.times.cut_ns && *frame_.times.cut_ns >= *pressed_ns_)
        frame_.click_ns = frame_.times.seen_ns - *std::exchange(pressed_ns_, std::nullopt);
    history_.use({.display_ns = beat.period_ns / 2, .right_eye_later_ns = beat.right_eye_later_ns});
    history_.add(frame_.times);
    if (keeps_) {
        frame_.ages = history_.ages(history_.size() - 1);
        frames_.push_back(frame_);
    }
    judge(now_ns);
}

void SessionTimes::judge(Nanoseconds now_ns) {
    if (now_ns - judged_ns_ < kJudged_ns) return;
    judged_ns_ = now_ns;
    warnings_ = history_.warnings();
    for (const FrameWarning& warning : warnings_) {
        if (warned_.test(warning.limit)) continue;
        warned_.set(warning.limit);
        new_warnings_.push_back(warning.line);
    }
}

std::vector<std::string> SessionTimes::take_new_warnings() { return std::exchange(new_warnings_, {}); }

FigureSummary summarised(const haptics::Histogram& histogram) {
    FigureSummary summary;
    summary.count = histogram.total();
    if (summary.count == 0) return summary;
    summary.least_ns = histogram.quantile_ns(0.0);
    summary.median_ns = histogram.quantile_ns(0.5);
    summary.p95_ns = histogram.quantile_ns(0.95);
    summary.p99_ns = histogram.quantile_ns(0.99);
    summary.most_ns = histogram.largest_ns();
    return summary;
}

HistogramLook::Seen HistogramLook::look(const haptics::Histogram& histogram) {
    Seen seen;
    for (std::size_t i = 0; i < haptics::Histogram::kBuckets; ++i) {
        const std::uint64_t count = histogram.count(i);
        if (count == before_[i]) continue;
        seen.count += count - before_[i];
        seen.longest_ns =
            i + 1 < haptics::Histogram::kBuckets ? haptics::Histogram::last_of(i) : histogram.largest_ns();
        before_[i] = count;
    }
    return seen;
}

}  // namespace burin::session
