// SPDX-License-Identifier: MIT
// Where a session's frames go: outputs on screens, of which pictures are drawn. Presenter (presenter.hpp) has a
// graphics device for it; OffscreenOutput (offscreen_output.hpp) opens one with the first picture that is asked for.
// Thread: the frame's.
#pragma once

#include <cstddef>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "session/input/input_event.hpp"
#include "wall/output_settings.hpp"

namespace burin::session {

class Desk;

class FrameOutput {
public:
    FrameOutput() = default;
    virtual ~FrameOutput() = default;
    FrameOutput(const FrameOutput&) = delete;
    FrameOutput& operator=(const FrameOutput&) = delete;
    FrameOutput(FrameOutput&&) = default;
    FrameOutput& operator=(FrameOutput&&) = default;

    // Reads the outputs' positions and sizes, which hold until the next call; once a frame.
    virtual void look() = 0;
    // Returns the places of all screens' outputs.
    [[nodiscard]] virtual std::vector<wall::OutputPlace> places() const = 0;
    // Overrides a screen's position and size with those to draw for, whatever the output is like.
    virtual void put(std::size_t screen, const wall::OutputPlace& place) = 0;
    [[nodiscard]] virtual std::size_t screens() const = 0;
    // Returns whether any screen has an output that somebody sees; else there are screenshots alone.
    [[nodiscard]] virtual bool shows() const = 0;
    // Returns whether the outputs' display is gone for good.
    [[nodiscard]] virtual bool has_lost_display() const = 0;
    // Returns what happened in the windows, waiting for at most so long (0: not at all).
    [[nodiscard]] virtual std::vector<Input> inputs(double wait_s) = 0;
    // Draws one frame, if anything is new; returns whether it was. frame_ns: when it is to be seen, in session time.
    [[nodiscard]] virtual Result<bool> draw(Desk& desk, Nanoseconds frame_ns) = 0;
    // Goes on after a failed draw where that can be: replaces a lost device. Returns any other error.
    [[nodiscard]] virtual Result<void> recover(Desk& desk, const Error& error) = 0;
    // Has the session refuse a stereo mode that cannot be shown, in a frame that is not drawn, once has_drawn().
    [[nodiscard]] virtual Result<void> fit_modes(Desk& desk) = 0;
    [[nodiscard]] virtual bool has_drawn() const = 0;
};

}  // namespace burin::session
