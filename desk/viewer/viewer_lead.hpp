// SPDX-License-Identifier: MIT
// How a viewer leads a session: by the head, by mouse and keys, by a tracker's wands, and by commands about how it is
// seen. A pure step: the same events give the same states.
#pragma once

#include <tuple>
#include <vector>

#include "desk/input/seen_surface.hpp"
#include "desk/viewer/viewer.hpp"
#include "session/state/leader.hpp"
#include "session/state/session_step.hpp"

namespace burin::session {

// Input that the panel captures.
struct Captured {
    bool mouse = false, keyboard = false;
};

// What a viewer's step must know besides the session.
struct ViewerLook {
    Nanoseconds display_ns = 0;  // when the picture is to be seen
    ImageSize eye_size = {};     // of the main screen
    Captured captured = {};
    wall::OutputPlace output = {};         // of the main screen
    const SeenSurface* surface = nullptr;  // null: none is known, and the mouse flies freely
};

// Leads one step.
class ViewerLead : public Leader {
public:
    // All must outlive it; the viewer is changed.
    ViewerLead(Viewer& viewer, const Room& room, const DeskRoom& desk, const ViewerLook& look)
        : viewer_(viewer), room_(room), desk_(desk), look_(look), governed_(governed_part()) {}

    [[nodiscard]] std::uint32_t buttons() const override { return viewer_.desk.buttons; }
    [[nodiscard]] Led lead(const SessionState& state, const Room& room, std::span<const InputEvent> events,
                           const StepView& view) override;
    void meet(const InputEvent& event) override;
    [[nodiscard]] Result<void> run(SessionState& state, SessionOrders& orders, const SessionCommand& command) override;
    bool keep_governed() override;

protected:
    [[nodiscard]] ViewedSession seen(const SessionState& state) const { return {state, room_, viewer_, desk_}; }

    Viewer& viewer_;
    const Room& room_;
    const DeskRoom& desk_;
    const ViewerLook& look_;

private:
    // The one list of what an activity governs of a viewer (governed.hpp): what is compared is what is put back.
    using Governed = std::tuple<bool, wall::StereoMode, bool, wall::TestPattern, EdgeComfort>;
    [[nodiscard]] Governed governed_part() const {
        return {viewer_.force_shown, viewer_.output.mode, viewer_.output.swap_eyes, viewer_.output.test_pattern,
                viewer_.edge_comfort};
    }

    Governed governed_;  // as it was before the step
};

// Runs a command: the viewer's own, or the session's, and what the viewer then does about it.
[[nodiscard]] Result<void> run_command(Viewer& viewer, SessionState& state, const DeskRoom& desk, SessionOrders& orders,
                                       const SessionCommand& command);

// One step of a viewed session.
struct ViewedStep : SessionStep {
    Viewer viewer;
};
[[nodiscard]] ViewedStep step_viewed(SessionState state, Viewer viewer, const Room& room, const DeskRoom& desk,
                                     std::span<const InputEvent> events, const StepView& view, const ViewerLook& look);

}  // namespace burin::session
