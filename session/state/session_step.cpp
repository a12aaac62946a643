// SPDX-License-Identifier: MIT
#include "session/state/session_step.hpp"

#include <utility>
#include <vector>

#include "base/try.hpp"
#include "session/input/input_event.hpp"
#include "session/state/command_table.hpp"
#include "session/state/leader.hpp"
#include "session/state/session_commands.hpp"
#include "session/state/session_room.hpp"

namespace burin::session {
namespace {

// Returns the pose that the device read in the tick of a tool.
Pose read_pose(const haptics::ToolState& tool) {
    return {tool.position_device_m,
            glm::conjugate(tool.workspace.object_from_device.orientation) * tool.orientation_object};
}

// Returns where a hand has its device in the world, in the tick of a tool.
Similarity world_from_hand(const HandState& hand, const haptics::ToolState& tool) {
    Similarity world_from_device = hand.world_from_device;
    world_from_device.scale *= hand.workspace_gain;
    const Pose read = read_pose(tool);
    Similarity placed = world_from_device * Similarity{read.position_m, read.orientation, 1.0};
    placed.scale = 1.0;
    return placed;
}

// Has a hand whose second button is down take the scene along, where there are several: one holds and turns the
// workpiece, and another carves it. Returns whether a hold has begun or ended.
bool hold_scene(SessionState& state, std::span<const haptics::ToolState> tools) {
    constexpr std::uint32_t kHolds = 2;
    if (!state.carves || tools.size() < 2) return false;
    bool changed = false, is_held = false;
    for (std::size_t i = 0; i < tools.size(); ++i) {
        HandState& hand = state.hands[i];
        // A workspace that is moved by the hand takes the button for itself.
        const bool presses = hand.technique == haptics::WorkspaceTechnique::fixed && tools[i].tick > 0 &&
                             (tools[i].buttons & kHolds) != 0;
        if (!presses || is_held) {
            changed = changed || hand.holds.has_value();
            hand.holds.reset();
            continue;
        }
        const Similarity now = world_from_hand(hand, tools[i]);
        is_held = true;
        if (hand.holds) {
            state.world_from_object = now * inverse(hand.holds->world_from_hand) * hand.holds->world_from_scene;
        } else {
            hand.holds = {now, state.world_from_object};
            changed = true;
        }
    }
    return changed;
}

// Returns the mappings of all hands.
std::vector<Similarity> mappings_of(const SessionState& state, const Room& room) {
    std::vector<Similarity> all;
    for (std::size_t hand = 0; hand < state.hands.size(); ++hand) all.push_back(object_from_device(state, room, hand));
    return all;
}

}  // namespace

SessionStep step_session(SessionState state, const Room& room, std::span<const InputEvent> events, const StepView& view,
                         Leader& leader) {
    SessionStep step;
    step.led_hand = state.hand;
    const bool works = ((view.tool.buttons | leader.buttons()) & 1u) != 0;
    state.asked.rests_s = works ? 0.0 : state.asked.rests_s + view.dt_s;
    state.edits.rest(view.dt_s);
    if (state.led().handle) state.led().handle_reads_device = read_pose(view.tool);
    step.led = leader.lead(state, room, events, view);
    const Similarity before = std::exchange(state.world_from_object, step.led.world_from_object);
    if (hold_scene(state, view.tools)) step.orders.parameters = true;
    if (!step.led.message.empty()) step.orders.messages.push_back({step.led.message, 0});
    if (state.world_from_object != before) {
        state.world_from_object.orientation = glm::normalize(state.world_from_object.orientation);
        step.orders.parameters = true;  // the workpiece has moved under the hand
    }
    forget_undone(state, step.orders);
    const auto run = [&](const CommandInput& command, std::size_t line) {
        if (const auto done = run_command(state, step.orders, command, leader); !done)
            step.orders.messages.push_back({done.error().line(), line});
    };
    const std::vector<Similarity> mapped = mappings_of(state, room);
    step.orders.line = events.empty() ? 0 : events.back().line;
    if (const auto done = follow_smooth_stroke(state, step.orders, step.led, view); !done)
        step.orders.messages.push_back({done.error().line(), 0});
    for (const Action action : step.led.actions) run({std::string(name_of(action)), {}}, 0);
    for (const InputEvent& event : events) {
        step.orders.line = event.line;
        leader.meet(event);
        if (const auto* command = std::get_if<CommandInput>(&event.input)) run(*command, event.line);
        if (std::holds_alternative<WindowClose>(event.input)) ask_or_quit(state);
    }
    // What a command has changed is no motion of the piece: the ticks do not follow it.
    if (mappings_of(state, room) != mapped) ++state.placed;
    // Once a step; a tool that a command accepted can be made.
    if (const auto taken = take_up(state); !taken) step.orders.messages.push_back({taken.error().line(), 0});
    step.state = std::move(state);
    return step;
}

Result<void> run_command(SessionState& state, SessionOrders& orders, const CommandInput& command, Leader& leader) {
    BURIN_TRY(parsed, parse_command(command));
    return leader.run(state, orders, parsed);
}

}  // namespace burin::session
