// SPDX-License-Identifier: MIT
#include "session/state/session_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sculpt/tool_mesh.hpp"
#include "session/held/staging.hpp"
#include "session/state/framed_world.hpp"
#include "session/state/view_cube.hpp"
#include "wall/projection.hpp"
#include "wall/seen_place.hpp"

namespace burin::session {
namespace {

// Size of the workpiece's longest_of side as a share of the screen's height; it stands with its front about in the
// screen's own plane, where eyes rest best.
constexpr double kHeightOnScreen = 0.52;
// The same of a world, which is wide rather than high.
constexpr double kWorldOnScreen = 0.8;
// Size of a handle's workspace that is shown as large as a world of that size.
constexpr double kOfWorkspace = 0.8;
// Distance of its center behind the screen, as a share of its own longest_of side.
constexpr double kBehindScreen = 0.4;
// Height of its center above the screen's lower edge, as a share of the screen's height.
constexpr double kAboveLowerEdge = 0.55;
// Size of the hand's workspace as a multiple of the workpiece's width and height.
constexpr double kWorkspaceCovers = 1.1;
// Distance of the resting hand from the workspace's border.
constexpr double kClearsBorder_m = 0.0005;

double longest_of(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

// Returns the size that is to fill its share of the screen. With a handle it is at least a share of the workspace: in a
// small world the resting handle would be right before the viewer's nose.
double size_before_viewer_m(const Room& room, const HeldHandle* held) {
    const double size_m = longest_of(room.workpiece_object.extent());
    if (held == nullptr) return size_m;
    const double scale = object_from_device(*held, room.workpiece_object).scale;
    return std::max(size_m, kOfWorkspace * scale * longest_of(room.workspace_device_m));
}

Similarity place_workpiece(const Room& room, const HeldHandle* held) {
    const wall::Screen s = room.screen();
    const Vec3 across = s.lower_right_world - s.lower_left_world, upright = s.upper_left_world - s.lower_left_world;
    const Vec3 out = glm::normalize(glm::cross(across, upright));
    const double height_m = glm::length(upright), size_m = size_before_viewer_m(room, held);
    Similarity world_from_object;
    const double share = room.covers_depth ? kWorldOnScreen : kHeightOnScreen;
    world_from_object.scale = share * height_m / size_m;
    world_from_object.orientation = world_from_screen(s);
    const Vec3 place =
        s.lower_left_world + 0.5 * across + kAboveLowerEdge * upright - kBehindScreen * share * height_m * out;
    const Vec3 middle = room.workpiece_object.center();
    world_from_object.position_m = place - world_from_object.scale * (world_from_object.orientation * middle);
    return world_from_object;
}

// Places the hand's workspace with its center at the workpiece's front, large enough to cover its width and height.
Similarity place_workspace(const Room& room, const HandRoom& hand, const Similarity& world_from_object,
                           const HeldHandle* held) {
    if (held != nullptr) return world_from_object * object_from_device(*held, room.workpiece_object);
    const Box& reached = room.reach_object ? *room.reach_object : room.workpiece_object;
    const Vec3 size = reached.extent() * world_from_object.scale;
    const Vec3 needed = kWorkspaceCovers * size / hand.workspace_device_m;
    Vec3 place = reached.center();
    if (room.covers_depth) return {world_from_object * place, world_from_object.orientation, longest_of(needed)};
    place.z = room.workpiece_object.hi.z;
    return {world_from_object * place, world_from_object.orientation, std::max(needed.x, needed.y)};
}

// Where the hand's workspace is in the workpiece's own frame while the mouse leads the hand along its surface: around
// all of it, with room for the tool on each side, however it is turned before the viewer.
Similarity object_from_device_on_surface(const Room& room) {
    constexpr double kRoomForTool = 0.3;  // of the longest_of side
    const Box& all = room.workpiece_object;
    const Vec3 needed = all.extent() + 2.0 * kRoomForTool * longest_of(all.extent());
    return {all.center(), Quat(1.0, 0.0, 0.0, 0.0), longest_of(needed / room.workspace_device_m)};
}

// Returns where the hand rests: this far before the workspace's front.
Vec3 resting_hand_device(const HandRoom& hand, const HeldHandle* held, double before_front_m) {
    const Vec3 front = held != nullptr ? held->front_device() : Vec3(0.0, 0.0, 1.0);
    return (0.5 * glm::dot(glm::abs(front), hand.workspace_device_m) - before_front_m) * front;
}

SeenFrom seen_from(const SessionState& state, const Room& room) {
    const View sight = view_of(room.wall.setup, room.wall.main, state.head, state.interpupillary_m);
    SeenFrom from{sight.screen, wall::middle_of(wall::eyes_of(sight.viewer)), room.free_width, room.workpiece_object};
    if (room.frames_world && state.handle)
        from.bounds_object = grown(from.bounds_object, size_before_viewer_m(room, state.handle.get()));
    return from;
}

// Before a wall, moves the workpiece back or forth as far as its viewer's eyes require at the start.
void move_into_comfort(SessionState& state, const Room& room) {
    if (room.wall.desk) return;
    const View sight = view_of(room.wall.setup, room.wall.main, state.head, state.interpupillary_m);
    if (!sight.visible) return;
    const double radius_m = 0.5 * state.world_from_object.scale * longest_of(room.workpiece_object.extent());
    const Similarity world_from_device = place_workspace(room, room, state.world_from_object, state.handle.get());
    const std::array<wall::ContentBall, 2> content{
        {{state.world_from_object * room.workpiece_object.center(), radius_m},
         {world_from_device * resting_hand_device(room, state.handle.get(), 0.0),
          0.2 * radius_m}}};  // the tool at rest
    const wall::ComfortFinding finding =
        wall::judge(room.wall.setup.budget, sight.screen, wall::eyes_of(sight.viewer), {content, {}});
    if (!finding.move_m) return;
    state.world_from_object.position_m += *finding.move_m * (world_from_screen(sight.screen) * Vec3(0.0, 0.0, 1.0));
}

// Returns the feel of the workpiece; with infinite hardness when it can only be touched.
haptics::TouchMaterial material_under_tool(const SessionState& state, const HandState& hand) {
    constexpr double kCannotBeCut = std::numeric_limits<double>::infinity();
    return sculpt::touch_material(hand.only_touch || !state.carves ? sculpt::with_hardness(state.feel, kCannotBeCut)
                                                                   : state.feel);
}

// Returns the radius of a ball about as wide as the tool.
double tool_radius_m(const HandState& hand) { return hand.held->half_width_m(); }

// Returns the distance from the main screen to the head; never 0, even where the head is beside or behind it.
double head_distance_m(const SessionState& state, const wall::Screen& screen, const wall::WallSetup& setup) {
    return std::max(wall::distance_in_front(screen, head_world(setup, state.head).position_m), 0.05);
}

DeskSurface surface_of(const SessionState& state, const Room& room, const SessionView& seen) {
    const View sight = view_of(room.wall.setup, room.wall.main, state.head, state.interpupillary_m);
    const Similarity object_from_world = inverse(state.world_from_object);
    DeskSurface on;
    on.seen = seen.surface;
    on.cursor = {output_on(room.wall, room.wall.main, state.output), seen.output, sight.screen,
                 wall::middle_of(wall::eyes_of(sight.viewer)), object_from_world};
    on.tool = {sculpt::tip_m(state.held->shape), tool_radius_m(state), tool_radius_m(state), 0.0};
    on.object_from_device = object_from_device_on_surface(room);
    on.object_from_screen = glm::normalize(object_from_world.orientation * world_from_screen(sight.screen));
    on.middle_object = room.workpiece_object.center();
    return on;
}

DeskView view_of(const SessionState& state, const Room& room, const SessionView& seen) {
    const wall::Screen screen = room.screen();
    const double width_m = glm::length(screen.lower_right_world - screen.lower_left_world);
    const double screen_m_per_px = width_m / std::max(seen.eye_size.width, 1u);
    const double eye_m = head_distance_m(state, screen, room.wall.setup);
    const Vec3 tool_world = state.world_from_object * seen.tool.hip_object_m;
    const double to_tool_m = std::max(eye_m - wall::distance_in_front(screen, tool_world), 0.1);
    DeskView view;
    view.device_m_per_px = device_m_per_px(screen_m_per_px, eye_m, to_tool_m, state.world_from_device.scale);
    view.world_m_per_px = screen_m_per_px;
    view.picture_px_per_px = picture_px_per_px(output_on(room.wall, room.wall.main, state.output).mode);
    view.world_from_screen = world_from_screen(screen);
    // A handle's axes need not be the screen's.
    if (state.handle) view.device_from_screen = state.handle->device_from_scene_turn() * view.device_from_screen;
    view.pivot_world = state.world_from_object * room.workpiece_object.center();
    view.scene_scale = state.world_from_object.scale / state.home_world_from_object.scale;
    view.mouse_captured = seen.captured.mouse;
    view.keyboard_captured = seen.captured.keyboard;
    if (state.mouse == MouseMode::surface && seen.surface != nullptr) view.surface = surface_of(state, room, seen);
    if (state.mouse == MouseMode::free && room.frames_world && room.wall.desk)
        view.cursor = cursor_of(state, room, seen);
    return view;
}

// Returns the pose that the device read in the tick of a tool.
Pose read_pose(const haptics::ToolState& tool) {
    return {tool.position_device_m,
            glm::conjugate(tool.workspace.object_from_device.orientation) * tool.orientation_object};
}

// Returns how the device of a hand is mapped into the workpiece's frame.
Similarity object_from_device(const SessionState& state, const Room& room, std::size_t number) {
    const HandState& hand = hand_of(state, number);
    Similarity world_from_device = hand.world_from_device;
    world_from_device.scale *= hand.workspace_gain;
    Similarity mapped = inverse(state.world_from_object) * world_from_device;
    if (number == state.hand && state.mouse == MouseMode::surface) mapped = object_from_device_on_surface(room);
    if (!hand.handle) return mapped;
    return mapped * Similarity{hand.device_from_read.position_m, hand.device_from_read.orientation};
}

// Returns the mappings of all hands.
std::vector<Similarity> mappings_of(const SessionState& state, const Room& room) {
    std::vector<Similarity> all;
    for (std::size_t hand = 0; hand < hands_of(state); ++hand) all.push_back(object_from_device(state, room, hand));
    return all;
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
        HandState& hand = hand_of(state, i);
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

// The stiffness of the surface for a mouse, which nobody feels and the arm limits to what it renders: a stroke is as
// deep as it is set.
constexpr double kMouseStiffness_N_per_m = 1e5;

// Where a hand of several stands beside the others at the start, as a share of its workspace's width.
constexpr double kBeside = 0.22;

// Gives each hand of several its workspace, and where it rests in there: the first to the right, the second to the
// left.
void begin_hands(SessionState& state, const Room& room, std::span<const std::shared_ptr<const HeldHandle>> handles,
                 std::span<const std::string> names) {
    if (names.size() < 2) return;
    for (std::size_t i = 0; i < names.size(); ++i) {
        HandState hand = state;
        hand.hand_name = names[i];
        hand.handle = i < handles.size() ? handles[i] : nullptr;
        hand.world_from_device = place_workspace(room, room.of(i), state.world_from_object, hand.handle.get());
        hand.target.position_device_m = resting_hand_device(room.of(i), hand.handle.get(), kClearsBorder_m);
        const Quat device_from_scene = hand.handle ? hand.handle->device_from_scene_turn() : Quat(1.0, 0.0, 0.0, 0.0);
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        hand.target.position_device_m +=
            device_from_scene * Vec3(side * kBeside * room.of(i).workspace_device_m.x, 0.0, 0.0);
        state.hands.push_back(std::move(hand));
    }
    static_cast<HandState&>(state) = state.hands.front();
    state.desk.target_device_m = state.target.position_device_m;
}

}  // namespace

SessionState begin_session(const Room& room, const sculpt::ToolSettings& tool, const sculpt::FeelSettings& feel,
                           const wall::OutputSettings& output, std::shared_ptr<const ToolMeshes> meshes,
                           std::span<const std::shared_ptr<const HeldHandle>> handles,
                           std::span<const std::string> hands) {
    SessionState state;
    if (!handles.empty()) state.handle = handles.front();
    state.meshes = std::move(meshes);
    state.desk = desk_at_home(room.desk);
    state.head = follow_head({}, room.wall.setup, room.wall.setup.timing, {}, 0, state.desk.head_world);
    state.interpupillary_m = interpupillary_m(room.wall.setup.eyes);
    state.world_from_object = place_workpiece(room, state.handle.get());
    move_into_comfort(state, room);
    state.seen_from = seen_from(state, room);
    if (room.wall.desk && (room.mouse == MouseMode::surface || room.frames_world))
        state.world_from_object = fitted(state.seen_from, state.world_from_object.orientation);
    state.home_world_from_object = state.world_from_object;
    state.middle_object = room.workpiece_object.center();
    state.world_from_device = place_workspace(room, room, state.world_from_object, state.handle.get());
    // Let the hand rest in front of the workpiece.
    state.desk.target_device_m = resting_hand_device(room, state.handle.get(), kClearsBorder_m);
    state.tool = tool;
    static_cast<void>(take_up(state));  // tool_of() says why it has none
    state.feel = feel;
    state.output = output;
    if (room.carved_object) {
        state.mirror_panes = mirror_panes(*room.carved_object);
        state.mirror_middle_object = room.carved_object->center();
    }
    state.mouse = room.mouse;
    state.mouse_chosen = room.mouse_chosen;
    state.no_surface = room.no_surface;
    state.framed = room.frames_world;
    state.first_steps = room.first_steps;
    begin_hands(state, room, handles, hands);
    return state;
}

Result<void> lead_hand(SessionState& state, const std::string& name) {
    const auto at = std::ranges::find(state.hands, name, &HandState::hand_name);
    if (at == state.hands.end()) {
        std::string known;
        for (const HandState& hand : state.hands) known += (known.empty() ? "" : " or ") + hand.hand_name;
        return fail(
            "hand " + name, state.hands.empty() ? "the session has one hand" : "there is no hand of that name",
            state.hands.empty() ? "open it with --device right=simulated --device left=simulated" : "name " + known);
    }
    const auto next = static_cast<std::size_t>(at - state.hands.begin());
    if (next == state.hand) return {};
    state.target = {state.desk.target_device_m, Vec3(0.0), {}, state.desk.buttons};
    state.target_turn_device = state.desk.target_turn_device;
    HandState& own = state;
    state.hands[state.hand] = own;
    own = state.hands[next];
    state.hand = next;
    state.desk.target_device_m = state.target.position_device_m;
    state.desk.target_turn_device = state.target_turn_device;
    state.desk.buttons = state.target.buttons;
    return {};
}

Result<void> take_up(SessionState& state) {
    if (state.held && state.held->spec == state.tool.shape) return {};
    const ToolMeshes none;
    auto held = take_up(state.tool.shape, state.meshes ? *state.meshes : none);
    if (!held) return std::unexpected(held.error());
    state.held = std::move(*held);
    return {};
}

SessionStep step_session(SessionState state, const Room& room, std::span<const InputEvent> events,
                         const SessionView& view) {
    SessionStep step;
    step.led_hand = state.hand;
    const bool works = ((view.tool.buttons | state.desk.buttons) & 1u) != 0;
    state.asked.rests_s = works ? 0.0 : state.asked.rests_s + view.dt_s;
    state.edits.rest(view.dt_s);
    state.seen_from = seen_from(state, room);
    if (state.handle) state.handle_reads_device = read_pose(view.tool);
    const BesideCube beside = take_presses(state, room, events, view);
    DeskView desk_view = view_of(state, room, view);
    desk_view.mouse_captured = desk_view.mouse_captured || state.over_cube.has_value();
    DeskStep desk = step_desk(state.desk, beside.events, view.dt_s, desk_view, room.of(state.hand).desk);
    state.desk = desk.state;
    const wall::StereoMode mode = output_on(room.wall, room.wall.main, state.output).mode;
    state.head = follow_head(state.head, room.wall.setup, timing_in(room.wall.setup, mode), events, view.display_ns,
                             state.desk.head_world);
    step.hand = desk.target;
    step.hand_way = std::move(desk.way);
    const Similarity before = state.world_from_object;
    if (desk.scene_change != Similarity{}) state.world_from_object = desk.scene_change * before;
    WandStep wands =
        step_wands(state.wands, events, view.dt_s, state.world_from_object, head_world(room.wall.setup, state.head),
                   {.home_world_from_scene = state.home_world_from_object});
    state.wands = wands.state;
    state.world_from_object = wands.world_from_scene;
    if (hold_scene(state, view.tools)) step.orders.parameters = true;
    if (desk.missed)
        step.orders.messages.push_back(
            {"the cursor was beside the workpiece, and nothing was touched: press where the tool stands on it; a drag "
             "beside it turns the scene",
             step.orders.line});
    if (state.world_from_object != before) {
        state.world_from_object.orientation = glm::normalize(state.world_from_object.orientation);
        step.orders.parameters = true;  // the workpiece has moved under the hand
    }
    const auto run = [&](const CommandInput& command, std::size_t line) {
        if (const auto done = run_command(state, step.orders, command); !done)
            step.orders.messages.push_back({done.error().line(), line});
    };
    const std::vector<Similarity> led = mappings_of(state, room);
    step.orders.line = events.empty() ? 0 : events.back().line;
    if (const auto done = follow_smooth_stroke(state, step.orders, desk.strokes, view); !done)
        step.orders.messages.push_back({done.error().line(), 0});
    for (const Action view_from : beside.views) run({std::string(name_of(view_from)), {}}, 0);
    for (const Action action : desk.actions) run({std::string(name_of(action)), {}}, 0);
    for (const InputEvent& event : events) {
        step.orders.line = event.line;
        const auto* click = std::get_if<MouseClick>(&event.input);
        if (click != nullptr && click->pressed) state.first_steps = false;
        if (const auto* command = std::get_if<CommandInput>(&event.input)) run(*command, event.line);
        if (std::holds_alternative<WindowClose>(event.input)) ask_or_quit(state);
    }
    // What a command has changed is no motion of the piece: the ticks do not follow it.
    if (mappings_of(state, room) != led) ++state.placed;
    // Once a step; a tool that a command accepted can be made.
    if (const auto taken = take_up(state); !taken) step.orders.messages.push_back({taken.error().line(), 0});
    step.state = std::move(state);
    return step;
}

haptics::TickParameters parameters_of(const SessionState& state, const Room& room, std::size_t number) {
    const HandState& hand = hand_of(state, number);
    haptics::TickParameters p;
    const double radius_m = tool_radius_m(hand);
    const bool on_surface = number == state.hand && state.mouse == MouseMode::surface;
    p.workspace.technique = on_surface ? haptics::WorkspaceTechnique::fixed : hand.technique;
    p.workspace.object_from_device = object_from_device(state, room, number);
    p.workspace.placed = state.placed;
    p.workspace.workspace_device_m = room.of(number).workspace_device_m;
    p.workspace.reach_object = room.workpiece_object;
    const Vec3 around = Vec3(2.0 * radius_m) + 0.25 * room.workpiece_object.extent();
    p.workspace.reach_object.lo -= around;
    p.workspace.reach_object.hi += around;
    const sculpt::FeltTool& felt = hand.held->felt;
    p.probe = felt.probe;
    p.shape = felt.shape;
    p.tool = felt.surface;
    p.action = state.carves ? sculpt::action_of(hand.tool.operation) : haptics::ToolAction::touch;
    p.materials.fill(material_under_tool(state, hand));
    if (on_surface)
        for (haptics::TouchMaterial& material : p.materials) material.stiffness_N_per_m = kMouseStiffness_N_per_m;
    p.touches_while_pressed = on_surface;
    p.fills = room.of(number).fills;
    if (p.touches_while_pressed || (p.fills == haptics::FillPlace::hand && !state.mouse_chosen))
        p.fills = haptics::FillPlace::surface;
    if (state.world) state.world->materials.write(p.materials);
    if (hand.handle) hand.handle->write(p, radius_m);
    if (hand.handle && !state.carves) p.clearance_ratio = 0.0;  // no groove has to be clear of the ball that cut it
    p.signals.force_alpha = hand.force_filter;
    if (hand.velocity_filter > 0.0) {
        p.signals.velocity = haptics::VelocityMethod::moving_average;
        p.signals.velocity_alpha = hand.velocity_filter;
    }
    p.enabled = hand.force_on;
    p.holds = hand.holds.has_value();
    p.catch_drill = hand.catch_drill;
    return p;
}

Result<sculpt::UseTool> tool_of(const SessionState& state) {
    const sculpt::ToolSettings& tool = state.tool;
    if (const auto good = sculpt::check_tool(tool); !good) return std::unexpected(good.error());
    if (const auto good = sculpt::check_feel(state.feel); !good) return std::unexpected(good.error());
    if (state.handle && tool.shape.kind != sculpt::ToolKind::ball)
        return fail("tool " + sculpt::text_of(tool.shape), "is no ball, and balls are at the points of a wand",
                    "take a ball, such as ball:0.004");
    const ToolMeshes none;
    Result<compute::ToolShape> shape = (state.meshes ? *state.meshes : none).shape_of(tool.shape);
    if (!shape) return std::unexpected(shape.error());
    sculpt::Tool made = sculpt::make_tool(tool, std::move(*shape));
    made.fills_at_hand = state.mouse == MouseMode::surface;
    return sculpt::UseTool{std::move(made), sculpt::material_of(tool),
                           material_under_tool(state, state).hardness_Ns_per_m3};
}

}  // namespace burin::session
