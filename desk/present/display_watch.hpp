// SPDX-License-Identifier: MIT
// Passes what the display reports about presented frames to the pacing (frame_pacing.hpp).
// Thread: that of the frames.
#pragma once

#include "desk/timing/frame_pacing.hpp"
#include "desk/timing/session_times.hpp"
#include "desk/timing/shown_frames.hpp"

namespace burin::session {

class Desk;       // desk/live/desk.hpp
class Presenter;  // desk/present/presenter.hpp

class DisplayWatch {
public:
    explicit DisplayWatch(double refresh_Hz);

    // Plans the next frame, as of now.
    [[nodiscard]] FramePlan plan(Nanoseconds now_ns);
    // Records that a frame has been drawn and presented. sampled_ns: when its input ended.
    void finished(Presenter& stage, const FramePlan& plan, Nanoseconds sampled_ns, Nanoseconds now_ns);
    // Asks which of the presented frames have been seen; ask again at next_look_ns(), if there is one.
    void look(const Presenter& stage, Nanoseconds now_ns);
    [[nodiscard]] std::optional<Nanoseconds> next_look_ns() const { return frames_.next_look_ns(); }
    // Updates the refresh rate; the windows may have moved to another monitor.
    void shown_at(double refresh_Hz);

    [[nodiscard]] DisplayBeat beat(const Desk& desk) const;

private:
    ShownFrames frames_;
    PacingState pacing_;
};

}  // namespace burin::session
