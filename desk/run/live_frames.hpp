// SPDX-License-Identifier: MIT
// The frames of a session in real time: of one that somebody sees, as late as the display allows and only when
// something has changed, and of one that nobody sees, at the pace of a common display. Thread: the frame's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "desk/input/event_times.hpp"
#include "desk/present/display_watch.hpp"
#include "desk/present/presenter.hpp"
#include "desk/run/session_frames.hpp"
#include "desk/timing/session_times.hpp"
#include "devices/trackers/tracker.hpp"
#include "session/live/session_watch.hpp"

namespace burin::session {

// Base of both kinds: input comes from windows, a tracker, the devices' own buttons, the document and a log.
class RealTimeFrames : public SessionFrames {
public:
    // Begins to measure; call it right before drive(). The first frames follow the display.
    void begin() {
        began_ = now();
        changed_ns_ = began_.time_ns;
    }
    // Summarises the frames.
    [[nodiscard]] SessionRecord record() const;

protected:
    // tracker: null where there is none. All must outlive it.
    RealTimeFrames(Desk& desk, FrameOutput& output, InputSource input, Clock& clock, devices::Tracker* tracker,
                   const std::string& tracker_name)
        : SessionFrames(desk, output, std::move(input)), clock_(clock), tracker_(tracker), first_word_(tracker_name) {}

    // The next frame: when it is to be seen, on the clock, and what has happened in the windows.
    struct Turn {
        Nanoseconds display_ns = 0;
        std::vector<InputEvent> happened;
    };
    // Waits until it is time for it.
    [[nodiscard]] virtual Turn wait_for_frame() = 0;
    // Returns what the display showed.
    [[nodiscard]] virtual DisplayBeat beat() { return {}; }

    [[nodiscard]] std::optional<FrameInput> next_input() override;
    void stepped() override;
    void finished(const FrameInput& frame, bool anew) override;

    Clock& clock_;
    Nanoseconds changed_ns_ = 0;  // when something new was drawn last

private:
    [[nodiscard]] std::vector<InputEvent> take_tracker_input();

    // Time on the clock, and processor time of all threads.
    struct Moment {
        Nanoseconds time_ns = 0, processor_ns = 0;
    };
    [[nodiscard]] Moment now() const { return {clock_.now_ns(), process_cpu_ns()}; }

    devices::Tracker* tracker_;
    FirstWordWatch first_word_;
    Moment began_, turn_;  // when the session began, and when the wait for this frame did
    Moment lasted_;        // from the beginning to the end of the last frame
    Moment rested_;        // spent in turns without anything new, once the session had settled
};

// Makes a frame when the display wants the next one, or, at rest, when something happens.
class LiveFrames final : public RealTimeFrames {
public:
    LiveFrames(Desk& desk, Presenter& presenter, InputSource input, Clock& clock, devices::Tracker* tracker,
               const std::string& tracker_name)
        : RealTimeFrames(desk, presenter, std::move(input), clock, tracker, tracker_name),
          presenter_(presenter),
          display_(presenter.refresh_Hz()) {}

private:
    [[nodiscard]] Turn wait_for_frame() override;
    [[nodiscard]] DisplayBeat beat() override { return display_.beat(desk_); }
    void stepped() override;
    [[nodiscard]] bool wants_picture() override { return true; }
    void finished(const FrameInput& frame, bool anew) override;

    [[nodiscard]] std::vector<InputEvent> wait_for_refresh();
    [[nodiscard]] std::vector<InputEvent> wait_for_input(Nanoseconds until_ns);

    Presenter& presenter_;
    DisplayWatch display_;
    EventTimes event_times_;
    FramePlan plan_;     // of the frame in progress
    std::string named_;  // what the windows' titles say of the document
};

// Makes a frame every 60th of a second, and a picture only where one is asked for.
class UnseenFrames final : public RealTimeFrames {
public:
    UnseenFrames(Desk& desk, FrameOutput& output, InputSource input, Clock& clock, devices::Tracker* tracker,
                 const std::string& tracker_name)
        : RealTimeFrames(desk, output, std::move(input), clock, tracker, tracker_name) {}

private:
    [[nodiscard]] Turn wait_for_frame() override;
    [[nodiscard]] bool wants_picture() override { return session_.files().wants_pictures(); }

    Nanoseconds next_ns_ = 0;  // when the next frame is due
};

}  // namespace burin::session
