// SPDX-License-Identifier: MIT
// A session and its viewer as values, for tests of what is led and seen without a clock, a device or a window.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "desk/viewer/framed_world.hpp"
#include "desk/viewer/state_words.hpp"
#include "desk/viewer/viewed_picture.hpp"
#include "desk/viewer/viewer_lead.hpp"
#include "session/state/command_table.hpp"
#include "session/state/session_room.hpp"

namespace burin::session {

struct Viewed {
    Room room;
    DeskRoom desk;
    SessionState state;
    Viewer viewer;

    [[nodiscard]] ViewedSession seen() const { return {state, room, viewer, desk}; }
    [[nodiscard]] Result<void> run(SessionOrders& orders, const std::string& name,
                                   std::vector<std::string> arguments = {}) {
        const auto command = parse_command({name, std::move(arguments)});
        return command ? run_command(viewer, state, desk, orders, *command) : std::unexpected(command.error());
    }
    // Goes on by one step and returns what it asks of the session's parts.
    SessionOrders step(const std::vector<InputEvent>& events, const StepView& view = {}, const ViewerLook& look = {}) {
        led = {};
        ViewedStep step = step_viewed(std::move(state), std::move(viewer), room, desk, events, view, look);
        state = std::move(step.state);
        viewer = std::move(step.viewer);
        led = std::move(step.led);
        return std::move(step.orders);
    }
    // Returns where the hand of the last step was to go.
    [[nodiscard]] devices::HandTarget hand() const { return led.hand.value(); }

    Led led = {};
};

// Begins as a session before this wall does, with a tool and how the main screen is shown.
[[nodiscard]] inline Viewed begin_viewed(const Room& room, const DeskRoom& desk, const toolbox::ToolSettings& tool,
                                         const wall::OutputSettings& output = {}) {
    Viewed viewed{room, desk, {}, begin_viewer(desk, output)};
    viewed.state = begin_session(room, tool, {}, placed_before(viewed.viewer, room, desk, nullptr));
    take_hand(viewed.viewer, viewed.state);
    viewed.viewer.seen_from = seen_from(viewed.seen());
    return viewed;
}

// Returns a block of 0.2 m before a desk, and the ball that a hand holds there.
[[nodiscard]] inline Room block_room() {
    Room room;
    room.workpiece_object = {Vec3(-0.1), Vec3(0.1)};
    return room;
}
[[nodiscard]] inline DeskRoom desk_of(const SessionWall& wall) {
    DeskRoom desk;
    desk.wall = wall;
    desk.hands.front().home_head_world = {{0.0, 1.6, 2.0}, Quat{1, 0, 0, 0}};
    return desk;
}
[[nodiscard]] inline toolbox::ToolSettings ball_tool() {
    return {.shape = {toolbox::ToolKind::ball, toolbox::ToolSizes{0.01}, {}}};
}
// Returns the block before a wall of a file, with its viewer where the wall's tracker is taken to be without one.
[[nodiscard]] inline Viewed block_before_wall(const SessionWall& wall) {
    DeskRoom desk = desk_of(wall);
    const wall::WallSetup& setup = wall.setup;
    desk.hands.front().home_head_world = {
        setup.world_from_tracker * setup.fallback_head_tracker.position_m,
        setup.world_from_tracker.orientation * setup.fallback_head_tracker.orientation};
    return begin_viewed(block_room(), desk, {}, wall.screens[wall.main].shown);
}
[[nodiscard]] inline Viewed block_before_desk() {
    return begin_viewed(block_room(), desk_of(*session_wall({})), ball_tool());
}

}  // namespace burin::session
