// SPDX-License-Identifier: MIT
// Where a session's frames go: outputs on screens, of which pictures are drawn. Presenter (presenter.hpp) has a
// graphics device for it; OffscreenOutput (offscreen_output.hpp) opens one with the first picture that is asked for.
//
// The session has this device alone: it draws with one lane of it and carves with another (gpu/device.hpp), where a
// device is to carve. When it is lost, the processor goes on carving until recover() has opened another, of which the
// engine is then offered a lane by an order of the scene.
// Thread: the frame's.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "compute/vulkan/engine_choice.hpp"
#include "scene/scene_order.hpp"
#include "session/input/input_event.hpp"
#include "session/options/session_setup.hpp"
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

    // Returns what makes the session's engine, on a lane of the outputs' device where one is to carve; the device is
    // opened for it where there is none yet. Once, before the session is opened; the maker may be called on any thread.
    [[nodiscard]] compute::EngineMaker engine_maker(compute::EngineChoice choice);
    // Returns what offers the engine a lane of the device that recover() has opened; nothing where it hears no offers.
    [[nodiscard]] std::optional<scene::SceneOrder> offer();

protected:
    // Opens another lane of the outputs' device, and the device where there is none.
    [[nodiscard]] virtual Result<gpu::Device> lane() = 0;

private:
    std::shared_ptr<compute::OfferedDevice> offered_;  // null: no device carves. What it holds is the scene's thread's
};

// Has the session of these options carve with an output's device, unless they have a maker of its engine.
[[nodiscard]] SessionSetup carving_with(FrameOutput& output, SessionSetup options);

}  // namespace burin::session
