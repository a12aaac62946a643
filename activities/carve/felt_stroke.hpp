// SPDX-License-Identifier: MIT
// Carves by feel (--hand simulated): a simulated hand leads a simulated Omni along the stroke, feels the surface
// through the haptic loop, and is pushed back by it. The force and the material's hardness set what the tool cuts. An
// activity of a session that nobody sees (session/drive/headless_session.hpp): it brings the hand; tool, material and
// mirror are the session's.
//
//   script -> device -> haptic loop (1 kHz) -> the scene's service (100 Hz) carves -> local surface -> haptic loop
//                            |-> every tick record -> figures, and the recording
//
// In simulated time both sides run in turn on one thread, as fast as they can, and every run gives the same bits; in
// real time haptic loop and scene have a thread each.
// Frame: the object's, metres; forces at the device, newtons. Thread: the frame's.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "haptics/contact/probe.hpp"
#include "sculpt/made_workpiece.hpp"
#include "sculpt/stroke_file.hpp"
#include "session/activity/activity.hpp"
#include "session/activity/brought_hand.hpp"
#include "session/felt/felt_figures.hpp"
#include "session/options/session_setup.hpp"

namespace burin::session {
class Session;  // session/live/session.hpp
}  // namespace burin::session

namespace burin::activities {

class FeltStroke final : public session::Activity {
public:
    static constexpr std::string_view kName = "stroke";

    explicit FeltStroke(session::BroughtHand hand) : hand_(std::move(hand)) {}

    [[nodiscard]] std::string settings() const override { return std::string(kName); }
    [[nodiscard]] Result<void> act(std::span<const std::string> words, session::ActivityOrders& orders) override;
    void step(const session::ActivityView& /*view*/, session::ActivityOrders& /*orders*/) override {}
    void adjust(session::PartOfHand of, haptics::TickParameters& parameters) const override;
    [[nodiscard]] const session::BroughtHand* brought_hand() const override { return &hand_; }
    [[nodiscard]] session::ActivityPanel panel() const override { return {.title = "Stroke"}; }

private:
    session::BroughtHand hand_;
};

// A session in which the hand is at the beginning of its stroke, and the workpiece as it was made.
class OpenedStroke {
public:
    // Opens it in the workspace as fit_into_workspace() has it. Of the options tool, feel, mirror, the memory for undo,
    // where it is recorded and whether time is real count; the tool must be given.
    [[nodiscard]] static Result<std::unique_ptr<OpenedStroke>> create(sculpt::MadeWorkpiece made,
                                                                      const sculpt::Stroke& stroke,
                                                                      const session::SessionSetup& options);
    ~OpenedStroke();

    // Carves the stroke to its end. facts: of the program and the files, for a recording; one that fails ends it.
    [[nodiscard]] Result<session::FeltFigures> run(std::vector<std::pair<std::string, std::string>> facts);

    // Returns what the session has told so far.
    [[nodiscard]] std::vector<std::string> messages() const;

private:
    OpenedStroke(const sculpt::Sculpture& carving, const session::SessionSetup& options);

    const sculpt::Sculpture& carving_;
    bool real_time_;
    std::string record_;  // a new session file; empty: none
    haptics::Probe probe_;
    SimulatedClock simulated_;
    MonotonicClock monotonic_;
    session::FeltFigures figures_;
    std::unique_ptr<session::Session> session_;
};

}  // namespace burin::activities
