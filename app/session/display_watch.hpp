// SPDX-License-Identifier: MIT
// What the display tells of the frames that it was handed, brought to the pacing (frame_pacing.hpp).
// Thread: that of the frames.
#pragma once

#include "app/session/frame_pacing.hpp"
#include "app/session/session_stage.hpp"
#include "app/session/shown_frames.hpp"

namespace burin {

class DisplayWatch {
public:
    explicit DisplayWatch(double refresh_Hz);

    // The next frame, planned now.
    [[nodiscard]] FramePlan plan(Nanoseconds now_ns);
    // A frame has been drawn and handed over. sampled_ns: when its input ended.
    void finished(SessionStage& stage, const FramePlan& plan, Nanoseconds sampled_ns, Nanoseconds now_ns);
    // Asks which of the frames handed over have been seen; to be asked again at next_look_ns, if there is one.
    void look(const SessionStage& stage, Nanoseconds now_ns);
    [[nodiscard]] std::optional<Nanoseconds> next_look_ns() const { return frames_.next_look_ns(); }
    // The windows may have gone to another monitor.
    void shown_at(double refresh_Hz);

    [[nodiscard]] DisplayBeat beat(const LiveSession& session) const;

private:
    ShownFrames frames_;
    PacingState pacing_;
};

}  // namespace burin
