// SPDX-License-Identifier: MIT
#include "session/state/session_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/try.hpp"
#include "haptics/tick_parameters.hpp"
#include "session/held/held_handle.hpp"
#include "session/held/held_tool.hpp"
#include "session/objects/world_objects.hpp"
#include "session/state/session_room.hpp"
#include "toolbox/tool_mesh.hpp"
#include "workpiece/carve_order.hpp"

namespace burin::session {
namespace {

// Size of the hand's workspace as a multiple of the workpiece's width and height.
constexpr double kWorkspaceCovers = 1.1;
// Distance of the resting hand from the workspace's border.
constexpr double kClearsBorder_m = 0.0005;

double longest_of(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

// Returns the feel of the workpiece; with infinite hardness when it can only be touched.
haptics::TouchMaterial material_under_tool(const SessionState& state, const HandState& hand) {
    constexpr double kCannotBeCut = std::numeric_limits<double>::infinity();
    return toolbox::touch_material(hand.only_touch || !state.carves ? toolbox::with_hardness(state.feel, kCannotBeCut)
                                                                    : state.feel);
}

// Returns the radius of a ball about as wide as the tool.
double tool_radius_m(const HandState& hand) { return hand.held->half_width_m(); }

// The stiffness of the surface for a mouse, which nobody feels and the arm limits to what it renders: a stroke is as
// deep as it is set.
constexpr double kMouseStiffness_N_per_m = 1e5;

// Where a hand of several stands beside the others at the start, as a share of its workspace's width.
constexpr double kBeside = 0.22;

// Gives each hand its workspace, and where it rests in there: of several the first to the right, the second to the
// left.
HandState begun_hand(const Room& room, std::size_t number, std::size_t count, HandState hand,
                     const Similarity& world_from_object) {
    const HandRoom& own = room.hands[number];
    if (own.placed) {
        hand.world_from_device = world_from_object * own.placed->scene_from_device;
        hand.target.position_device_m = own.placed->rest_device.position_m;
        return hand;
    }
    hand.world_from_device = world_from_workspace(room, own, world_from_object, hand.handle.get());
    hand.target.position_device_m = resting_hand_device(own, hand.handle.get(), kClearsBorder_m);
    if (count < 2) return hand;
    const Quat device_from_scene = hand.handle ? hand.handle->device_from_scene_turn() : Quat(1.0, 0.0, 0.0, 0.0);
    const double side = number % 2 == 0 ? 1.0 : -1.0;
    hand.target.position_device_m += device_from_scene * Vec3(side * kBeside * own.workspace_device_m.x, 0.0, 0.0);
    return hand;
}

}  // namespace

Similarity world_from_workspace(const Room& room, const HandRoom& hand, const Similarity& world_from_object,
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

Similarity object_from_device_on_surface(const Room& room) {
    constexpr double kRoomForTool = 0.3;  // of the longest side
    const Box& all = room.workpiece_object;
    const Vec3 needed = all.extent() + 2.0 * kRoomForTool * longest_of(all.extent());
    return {all.center(), Quat(1.0, 0.0, 0.0, 0.0), longest_of(needed / room.hands.front().workspace_device_m)};
}

Vec3 resting_hand_device(const HandRoom& hand, const HeldHandle* held, double before_front_m) {
    const Vec3 front = held != nullptr ? held->front_device() : Vec3(0.0, 0.0, 1.0);
    return (0.5 * glm::dot(glm::abs(front), hand.workspace_device_m) - before_front_m) * front;
}

Similarity object_from_device(const SessionState& state, const Room& room, std::size_t number) {
    if (const auto& placed = room.hands[number].placed) return placed->scene_from_device;
    const HandState& hand = state.hands[number];
    Similarity world_from_device = hand.world_from_device;
    world_from_device.scale *= hand.workspace_gain;
    Similarity mapped = inverse(state.world_from_object) * world_from_device;
    if (number == state.hand && state.mouse == MouseMode::surface) mapped = object_from_device_on_surface(room);
    if (!hand.handle) return mapped;
    return mapped * Similarity{hand.device_from_read.position_m, hand.device_from_read.orientation};
}

SessionState begin_session(const Room& room, const toolbox::ToolSettings& tool, const toolbox::FeelSettings& feel,
                           const Similarity& world_from_object, std::shared_ptr<const ToolMeshes> meshes,
                           std::span<const std::shared_ptr<const HeldHandle>> handles,
                           std::span<const std::string> hands) {
    SessionState state;
    state.meshes = std::move(meshes);
    state.world_from_object = state.home_world_from_object = world_from_object;
    state.middle_object = room.workpiece_object.center();
    state.led().tool = tool;
    static_cast<void>(take_up(state));  // tool_of() says why it has none
    state.feel = feel;
    state.mouse = room.mouse;
    state.mouse_chosen = room.mouse_chosen;
    const HandState first = state.hands.front();
    state.hands.assign(std::max<std::size_t>(hands.size(), 1), first);
    for (std::size_t i = 0; i < state.hands.size(); ++i) {
        HandState& hand = state.hands[i];
        if (state.hands.size() > 1) hand.hand_name = hands[i];
        if (i < handles.size()) hand.handle = handles[i];
        hand = begun_hand(room, i, state.hands.size(), std::move(hand), world_from_object);
    }
    return state;
}

Result<void> lead_hand(SessionState& state, const std::string& name) {
    const bool one = state.hands.size() == 1;
    const auto at = one ? state.hands.end() : std::ranges::find(state.hands, name, &HandState::hand_name);
    if (at == state.hands.end()) {
        std::string known;
        for (const HandState& hand : state.hands) known += (known.empty() ? "" : " or ") + hand.hand_name;
        return fail("hand " + name, one ? "the session has one hand" : "there is no hand of that name",
                    one ? "open it with --device right=simulated --device left=simulated" : "name " + known);
    }
    state.hand = static_cast<std::size_t>(at - state.hands.begin());
    return {};
}

Result<void> take_up(SessionState& state) {
    HandState& hand = state.led();
    if (hand.held && hand.held->spec == hand.tool.shape) return {};
    const ToolMeshes none;
    BURIN_TRY(held, take_up(hand.tool.shape, state.meshes ? *state.meshes : none));
    hand.held = std::move(held);
    return {};
}

haptics::TickParameters parameters_of(const SessionState& state, const Room& room, std::size_t number) {
    const HandState& hand = state.hands[number];
    haptics::TickParameters p;
    const double radius_m = tool_radius_m(hand);
    const bool on_surface = number == state.hand && state.mouse == MouseMode::surface;
    p.workspace.technique = on_surface ? haptics::WorkspaceTechnique::fixed : hand.technique;
    p.workspace.object_from_device = object_from_device(state, room, number);
    p.workspace.placed = state.placed;
    p.workspace.workspace_device_m = room.hands[number].workspace_device_m;
    p.workspace.reach_object = room.workpiece_object;
    const Vec3 around = Vec3(2.0 * radius_m) + 0.25 * room.workpiece_object.extent();
    p.workspace.reach_object.lo -= around;
    p.workspace.reach_object.hi += around;
    const toolbox::FeltTool& felt = hand.held->felt;
    p.probe = felt.probe;
    p.shape = felt.shape;
    p.tool = felt.surface;
    p.action = state.carves ? toolbox::action_of(hand.tool.operation) : haptics::ToolAction::touch;
    p.materials.fill(material_under_tool(state, hand));
    if (on_surface)
        for (haptics::TouchMaterial& material : p.materials) material.stiffness_N_per_m = kMouseStiffness_N_per_m;
    p.touches_while_pressed = on_surface;
    p.fills = room.hands[number].fills;
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

haptics::TickParameters parameters_of(const SessionState& state, const Room& room, std::size_t hand,
                                      const devices::DeviceDescription& device) {
    haptics::TickParameters parameters = parameters_of(state, room, hand);
    parameters.limits.max_force_N = device.max_force_N;
    return parameters;
}

haptics::TickParameters parameters_of(const SessionState& state, const Room& room) {
    return parameters_of(state, room, state.hand);
}

Result<workpiece::UseTool> tool_of(const SessionState& state) {
    const toolbox::ToolSettings& tool = state.led().tool;
    BURIN_TRY_DO(toolbox::check_tool(tool));
    BURIN_TRY_DO(toolbox::check_feel(state.feel));
    if (state.led().handle && tool.shape.kind != toolbox::ToolKind::ball)
        return fail("tool " + toolbox::text_of(tool.shape), "is no ball, and balls are at the points of a wand",
                    "take a ball, such as ball:0.004");
    const ToolMeshes none;
    BURIN_TRY(shape, (state.meshes ? *state.meshes : none).shape_of(tool.shape));
    toolbox::Tool made = toolbox::make_tool(tool, std::move(shape));
    made.fills_at_hand = state.mouse == MouseMode::surface;
    return workpiece::UseTool{std::move(made), toolbox::material_of(tool),
                              material_under_tool(state, state.led()).hardness_Ns_per_m3};
}

}  // namespace burin::session
