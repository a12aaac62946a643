// SPDX-License-Identifier: MIT
// Who leads a session besides its commands: a viewer at a desk or before a wall, with keys, a mouse and trackers
// (desk/viewer/viewer_lead.hpp). A session asks its leader in each step, in this order:
//
//   lead() -> where the hand in use and the scene are led
//   for each event: meet(), and run() where it is a command
//   later_commands() -> what widgets gave in the step
//   keep_governed(), where an activity governs what is felt and seen
//   watch() -> messages
//
// The base leads nowhere: a session by itself has commands alone. Thread: the frame's.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"
#include "devices/hand/hand_target.hpp"
#include "haptics/tool_state.hpp"
#include "session/input/actions.hpp"
#include "session/input/command_input.hpp"
#include "session/state/session_command.hpp"

namespace burin::session {

struct InputEvent;     // session/input/input_event.hpp
struct Room;           // session/state/session_room.hpp
struct SessionOrders;  // session/state/session_orders.hpp
struct SessionState;   // session/state/session_state.hpp

// What a step must know of the rest of the session.
struct StepView {
    double dt_s = 0.0;                               // since the step before
    haptics::ToolState tool;                         // of the hand in use
    std::span<const haptics::ToolState> tools = {};  // of each hand; empty: of the only one
};

// Where a leader has led the session since the step before.
struct Led {
    Similarity world_from_object;                       // the scene
    std::optional<devices::HandTarget> hand;            // where the hand in use is to go, at the end; none: where it is
    std::vector<devices::SteeredTarget> hand_way = {};  // and meanwhile, at the times of the events
    std::vector<bool> strokes =
        {};                       // of each stroke on the surface that began: it is to smooth, whatever the tool does
    bool strokes_now = false;     // one goes on
    double stroke_depth_m = 0.0;  // as the mouse leads it
    bool turns_scene = false;     // a button is down that turns it
    std::string message = {};     // for the user; empty: none
    std::vector<Action> actions = {};  // of keys and of the view's own widgets, in order
};

class Leader {
public:
    Leader() = default;
    virtual ~Leader() = default;
    Leader(const Leader&) = delete;
    Leader& operator=(const Leader&) = delete;

    // Returns the buttons of the hand in use that are held down, as of the step before.
    [[nodiscard]] virtual std::uint32_t buttons() const { return 0; }
    [[nodiscard]] virtual Led lead(const SessionState& state, const Room& room, std::span<const InputEvent> events,
                                   const StepView& view);
    virtual void meet(const InputEvent& /*event*/) {}
    // Runs a command: the leader's own, or the session's.
    [[nodiscard]] virtual Result<void> run(SessionState& state, SessionOrders& orders, const SessionCommand& command);
    [[nodiscard]] virtual std::vector<CommandInput> later_commands(const SessionState& /*state*/) { return {}; }
    // Puts what an activity governs of its own back as it was before the step; returns whether anything was changed.
    virtual bool keep_governed() { return false; }
    [[nodiscard]] virtual std::vector<std::string> watch(const SessionState& /*state*/,
                                                         const haptics::ToolState& /*tool*/) {
        return {};
    }
};

}  // namespace burin::session
