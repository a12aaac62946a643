// SPDX-License-Identifier: MIT
#include "desk/present/display_watch.hpp"

#include "desk/live/desk.hpp"
#include "desk/present/presenter.hpp"
#include "desk/present/session_output.hpp"
#include "desk/view/session_head.hpp"
#include "wall/head_prediction.hpp"

namespace burin::session {

DisplayWatch::DisplayWatch(double refresh_Hz) : pacing_(begin_pacing({.period_ns = nanoseconds(1.0 / refresh_Hz)})) {}

FramePlan DisplayWatch::plan(Nanoseconds now_ns) {
    const PlannedFrame planned = plan_frame(pacing_, now_ns);
    pacing_ = planned.state;
    return planned.plan;
}

void DisplayWatch::look(const Presenter& stage, Nanoseconds now_ns) {
    const auto was_shown = [&](std::uint64_t picture) { return stage.was_shown(picture); };
    for (const FrameMeasure& measure : frames_.look(now_ns, was_shown)) pacing_ = after_frame(pacing_, measure);
}

void DisplayWatch::finished(Presenter& stage, const FramePlan& plan, Nanoseconds sampled_ns, Nanoseconds now_ns) {
    const SessionOutput::Blocked blocked = stage.take_blocked();
    FrameMeasure measure;
    measure.plan = plan;
    measure.sampled_ns = sampled_ns;
    measure.finished_ns = now_ns - blocked.for_ns;  // waiting is not work
    measure.blocked_ns = blocked.for_ns;
    measure.flip_ns = blocked.until_ns;
    pacing_ = frame_finished(pacing_, plan, now_ns);
    frames_.handed(measure, stage.presented(), now_ns);
    look(stage, now_ns);
}

void DisplayWatch::shown_at(double refresh_Hz) {
    const Nanoseconds period_ns = nanoseconds(1.0 / refresh_Hz);
    if (period_ns != pacing_.settings.period_ns) pacing_ = display_changed(pacing_, period_ns);
}

DisplayBeat DisplayWatch::beat(const Desk& desk) const {
    DisplayBeat beat;
    const SessionWall& wall = desk.room().wall;
    const wall::EyeTimes eyes = wall::eye_times(timing_in(wall.setup, desk.output_on(wall.main).mode), 0);
    beat.right_eye_later_ns = eyes.right_ns - eyes.left_ns;
    beat.period_ns = static_cast<Nanoseconds>(pacing_.period_ns);
    if (pacing_.flips_seen) beat.vblank_ns = pacing_.vblank_ns;
    return beat;
}

}  // namespace burin::session
