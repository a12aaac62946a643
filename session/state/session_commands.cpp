// SPDX-License-Identifier: MIT
// Applies the commands of keys, panel and scripts to a session.
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "desk/input/input_wand.hpp"
#include "session/state/framed_world.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {
namespace {

constexpr double kRadiusStep = 1.122462;  // six steps double it
constexpr double kTurnStep_rad = std::numbers::pi / 12.0;
constexpr const char* kScreenshotName = "burin.png";

// Applies one command to a session.
class Runner {
public:
    Runner(SessionState& state, SessionOrders& orders) : state_(state), orders_(orders) {}

    Result<void> operator()(const RunAction& run);
    Result<void> operator()(const SetTool& set) {
        return change_tool([&](SessionState& s) { s.tool.shape = set.tool; });
    }
    Result<void> operator()(const SetOperation& set) { return use(set.operation); }
    Result<void> operator()(const SetColour& set) {
        std::array<std::uint8_t, 3> colour{};
        for (std::size_t k = 0; k < 3; ++k) colour[k] = static_cast<std::uint8_t>(std::lround(255.0 * set.srgb[k]));
        return change_tool([&](SessionState& s) { s.tool.colour = colour; });
    }
    Result<void> operator()(const SetMaterial& set) {
        return change_tool([&](SessionState& s) { s.feel = sculpt::with_preset(s.feel, set.preset); });
    }
    Result<void> operator()(const SetQuantity& set);
    Result<void> operator()(const SetTechnique& set) {
        state_.technique = set.technique;
        return update_touch();
    }
    Result<void> operator()(const SetStereoMode& set) {
        state_.output.mode = set.mode;
        return {};
    }
    Result<void> operator()(const SetTestPattern& set) {
        state_.output.test_pattern = set.pattern;
        return {};
    }
    Result<void> operator()(const SetEyeSwap& set) {
        state_.output.swap_eyes = set.on;
        return {};
    }
    Result<void> operator()(const SetForce& set) {
        state_.force_on = set.on;
        return update_touch();
    }
    // Only the device knows whether they can be switched.
    Result<void> operator()(const SetAmplifiers& set) {
        orders_.amplifiers.push_back({set.on, orders_.line});
        return {};
    }
    Result<void> operator()(const SetMirror& set) {
        if (const auto given = order(sculpt::MirrorStrokes{set.mirror}); !given) return given;
        state_.mirror = set.mirror;
        return {};
    }
    Result<void> operator()(const SetForceShown& set) {
        state_.force_shown = set.on;
        return {};
    }
    Result<void> operator()(const SetEdgeComfort& set) {
        state_.edge_comfort = set.comfort;
        return {};
    }
    Result<void> operator()(const SetCatchDrill& set) {
        state_.catch_drill = set.on;
        return update_touch();
    }
    Result<void> operator()(const ExportTo& wanted) {
        state_.export_path = wanted.path;
        return export_to(wanted.path);
    }
    Result<void> operator()(const QuitDiscard&) {
        state_.quit = state_.discards = true;
        return {};
    }
    Result<void> operator()(const QuitSave&) {
        if (const auto may = may_save(); !may) return may;
        save_and_quit(state_, orders_);
        return {};
    }
    Result<void> operator()(const QuitStay&) {
        stay(state_);
        return {};
    }
    Result<void> operator()(const SaveTo& wanted) {
        if (const auto may = may_save(); !may) return may;
        if (wanted.path.empty())
            save_or_name(state_, orders_);
        else
            order_save(state_, orders_, wanted.path, false);
        return {};
    }
    Result<void> operator()(const SaveAs& wanted) {
        if (const auto may = may_save(); !may) return may;
        save_as(state_, orders_, wanted.path, wanted.is);
        return {};
    }
    Result<void> operator()(const TellDocument& is) {
        take_told(state_, is.told);
        return {};
    }
    Result<void> operator()(const SelectObject& wanted) {
        const WorldObjects none;
        const Result<scene::ObjectId> id = object_named(state_.world ? *state_.world : none, wanted.object);
        if (!id) return std::unexpected(id.error());
        state_.selected = *id;
        return uncover(*id);
    }
    Result<void> operator()(const CalibrateHandle& wanted);
    Result<void> operator()(const LeadHand& wanted) { return lead_hand(state_, wanted.hand); }
    Result<void> operator()(const SetMouse& set) {
        if (set.mode == MouseMode::surface && !state_.no_surface.empty())
            return fail("mouse surface", state_.no_surface, "fly freely");
        const bool was_chosen = std::exchange(state_.mouse_chosen, true);
        if (state_.mouse == set.mode && was_chosen) return {};
        state_.mouse = set.mode;
        state_.desk.on_surface = {};
        state_.desk.buttons = 0;
        state_.desk.drag.reset();
        return change_tool([](SessionState&) {});  // how it adds material depends on who leads it
    }
    Result<void> operator()(const EditObject& wanted) {
        const WorldObjects none;
        Result<EditedWorld> edited = session::edited(state_.world ? *state_.world : none, wanted);
        if (!edited) return std::unexpected(edited.error());
        const scene::ObjectId id = edited->order.object;
        const auto before = state_.world->objects[id - 1];
        state_.world = std::move(edited->world);
        if (state_.saves) state_.edits.note(before, state_.world->objects[id - 1], wanted.property, state_.strokes);
        orders_.world.push_back(std::move(edited->order));
        return moves_or_grows(wanted.property) ? uncover(id) : Result<void>{};
    }
    Result<void> operator()(const DoAct& wanted) {
        orders_.acts.push_back({wanted.words, orders_.line});
        return {};
    }
    Result<void> operator()(const ScreenshotTo& wanted) {
        orders_.screenshots.push_back({wanted.path, orders_.line});
        return {};
    }

private:
    [[nodiscard]] Result<void> may_save() const {
        if (state_.saves) return {};
        return fail("the scene", "belongs to what is done in it, and is not saved",
                    "open a world or a workpiece by itself: burin world FILE, burin sculpt FILE");
    }
    // Changes the tool, after checking the result; keeps the old one when something is wrong with it.
    Result<void> change_tool(const std::function<void(SessionState&)>& change) {
        SessionState changed = state_;
        change(changed);
        Result<sculpt::UseTool> use = tool_of(changed);
        if (!use) return std::unexpected(use.error());
        state_ = std::move(changed);
        orders_.carving.emplace_back(std::move(*use));
        return update_touch();
    }
    Result<void> use(compute::Operation operation, bool only_touch = false) {
        return change_tool([&](SessionState& s) {
            s.tool.operation = operation;
            s.only_touch = only_touch;
            s.smooth_stroke.reset();  // this is the operation from now on
        });
    }
    Result<void> resize_tool(double factor) {
        return (*this)(SetQuantity{Quantity::radius, descriptor_of(Quantity::radius).value(state_) * factor});
    }
    Result<void> update_touch() {
        orders_.parameters = true;
        return {};
    }
    Result<void> order(sculpt::SculptOrder order) {
        if (!state_.carves)
            return fail("the world", "holds no workpiece that could be carved", "open it with a --workpiece");
        orders_.carving.push_back(std::move(order));
        return {};
    }
    // Strokes and edits of objects go back, and forward, in the order in which they were done.
    Result<void> undo() {
        const WorldStep* edit = state_.edits.back();
        if (state_.carves && (edit == nullptr || state_.strokes > edit->strokes)) return order(sculpt::UndoStroke{});
        if (edit == nullptr) return fail("undo", "there is nothing to take back", "");
        if (const auto done = restore(edit->before); !done) return done;
        state_.edits.went_back();
        return {};
    }
    Result<void> redo() {
        const WorldStep* edit = state_.edits.forward();
        if (state_.carves && (edit == nullptr || state_.strokes < edit->strokes)) return order(sculpt::RedoStroke{});
        if (edit == nullptr) return fail("redo", "there is nothing to repeat", "");
        if (const auto done = restore(edit->after); !done) return done;
        state_.edits.went_forward();
        return {};
    }
    Result<void> restore(std::shared_ptr<const scene::SceneObject> object) {
        Result<EditedWorld> changed = restored(*state_.world, std::move(object));
        if (!changed) return std::unexpected(changed.error());
        state_.world = std::move(changed->world);
        orders_.world.push_back(std::move(changed->order));
        return {};
    }
    Result<void> export_to(const std::string& path) {
        return order(sculpt::ExportSurface{
            .path = path, .unit = state_.export_unit, .crumbs_m = state_.crumbs_m, .asked_by = orders_.line});
    }
    Result<void> toggle(bool SessionState::* flag) {
        state_.*flag = !(state_.*flag);
        return {};
    }

    // Shows all of the workpiece in the free part of the picture, turned as it is.
    Result<void> show() {
        if (const auto may = may_turn(); !may) return may;
        state_.world_from_object = fitted(state_.seen_from, state_.world_from_object.orientation);
        return update_touch();
    }
    // Shows the chosen object of a world likewise, with some of what is around it.
    Result<void> show_object() {
        const scene::SceneObject* object = chosen_object(state_);
        if (object == nullptr || !state_.framed) return {};
        state_.world_from_object = fitted_to(*object, state_.seen_from, state_.world_from_object.orientation);
        return update_touch();
    }
    // Moves the scene where the panel would cover an object at work.
    Result<void> uncover(scene::ObjectId id) {
        const scene::SceneObject* object = state_.world ? state_.world->find(id) : nullptr;
        if (object == nullptr || !state_.framed) return {};
        state_.world_from_object = beside_panel(*object, state_.seen_from, state_.world_from_object);
        return update_touch();
    }
    // Straight on, turned from how it stood at first, about an axis of the screen.
    Result<void> show_from(double angle_rad, const Vec3& axis_screen) {
        if (const auto may = may_turn(); !may) return may;
        const Quat home = state_.home_world_from_object.orientation;
        state_.world_from_object = fitted_straight(state_.seen_from, home * glm::angleAxis(angle_rad, axis_screen));
        return update_touch();
    }
    // Turns the scene about its middle, about an axis of the screen as the workpiece stood along it at first.
    Result<void> turn(double angle_rad, const Vec3& axis_screen) {
        if (const auto may = may_turn(); !may) return may;
        Similarity& now = state_.world_from_object;
        const Vec3 axis_world = state_.home_world_from_object.orientation * axis_screen;
        now = turned_about({}, now * state_.middle_object, glm::angleAxis(angle_rad, axis_world)) * now;
        now.orientation = glm::normalize(now.orientation);
        return update_touch();
    }
    // What the tool works on stays.
    [[nodiscard]] Result<void> may_turn() const {
        if (!state_.desk.on_surface.pressed) return {};
        return fail("the scene", "stays while the tool works on it", "let go of the left button first");
    }

    SessionState& state_;
    SessionOrders& orders_;
};

// Returns the next of the modes that one window can show, in their order.
wall::StereoMode next_mode(wall::StereoMode mode) {
    const auto modes = wall::stereo_modes();
    auto i = static_cast<std::size_t>(mode);
    do {
        i = (i + 1) % modes.size();
    } while (wall::shows_one_eye_at_a_time(modes[i]) && modes[i] != wall::StereoMode::left &&
             modes[i] != wall::StereoMode::right);
    return modes[i];
}

haptics::WorkspaceTechnique next_technique(haptics::WorkspaceTechnique technique) {
    return techniques()[(static_cast<std::size_t>(technique) + 1) % techniques().size()].technique;
}

Result<void> Runner::operator()(const CalibrateHandle& wanted) {
    if (!state_.handle)
        return fail("calibrate", "there is no wand", "open the session with --device simulated-wand and --points");
    Result<HandleCalibrated> done =
        wanted.reset ? HandleCalibrated{} : calibrated(state_.handle->description, state_.handle_reads_device);
    if (!done) return std::unexpected(done.error());
    state_.device_from_read = done->device_from_read;
    if (!done->message.empty()) orders_.messages.push_back({done->message, 0});
    return update_touch();
}

Result<void> Runner::operator()(const SetQuantity& set) {
    const QuantityDescriptor& quantity = descriptor_of(set.quantity);
    if (set.quantity == Quantity::radius && state_.tool.shape.kind == sculpt::ToolKind::mesh) {
        return fail("radius", "a tool that is a mesh keeps its size", "take another tool, or scale the mesh's file");
    }
    if (quantity.concern == QuantityConcern::tool_and_touch)
        return change_tool([&](SessionState& s) { quantity.set(s, set.value); });
    quantity.set(state_, set.value);
    return quantity.concern == QuantityConcern::touch ? update_touch() : Result<void>{};
}

Result<void> Runner::operator()(const RunAction& run) {
    switch (run.action) {
        case Action::undo: return undo();
        case Action::redo: return redo();
        case Action::tool_1: return use(compute::Operation::cut);
        case Action::tool_2: return use(compute::Operation::fill);
        case Action::tool_3: return use(compute::Operation::paint);
        case Action::tool_4: return use(compute::Operation::smooth);
        case Action::tool_5: return use(compute::Operation::cut, true);
        case Action::smaller_radius: return resize_tool(1.0 / kRadiusStep);
        case Action::larger_radius: return resize_tool(kRadiusStep);
        case Action::next_stereo_mode: state_.output.mode = next_mode(state_.output.mode); return {};
        case Action::swap_eyes: state_.output.swap_eyes = !state_.output.swap_eyes; return {};
        case Action::next_workspace_technique:
            state_.technique = next_technique(state_.technique);
            return update_touch();
        case Action::toggle_panel: return toggle(&SessionState::panel);
        case Action::toggle_help:
            state_.devices = false;  // one page at a time
            return toggle(&SessionState::help);
        case Action::toggle_frame_figures: return toggle(&SessionState::figures);
        case Action::toggle_devices: state_.help = false; return toggle(&SessionState::devices);
        case Action::toggle_full_screen: orders_.full_screen = true; return {};
        case Action::take_screenshot: orders_.screenshots.push_back({kScreenshotName, orders_.line}); return {};
        case Action::export_mesh: return export_to(state_.export_path);
        case Action::save_session: return (*this)(SaveTo{});
        case Action::save_as:
            if (const auto may = may_save(); !may) return may;
            if (!state_.asked.told) return fail("save-as", "has nobody to ask for a name", "write save-as FILE.burin");
            open_or_close_naming(state_);
            return {};
        case Action::reset_view:
            if (const auto may = may_turn(); !may) return may;
            state_.world_from_object = state_.home_world_from_object;
            // The window may have another shape by now.
            if (state_.framed && state_.mouse == MouseMode::free)
                state_.world_from_object = fitted(state_.seen_from, state_.home_world_from_object.orientation);
            return update_touch();
        case Action::fit_view: return show();
        case Action::fit_object: return show_object();
        case Action::view_front: return show_from(0.0, Vec3(0.0, 1.0, 0.0));
        case Action::view_side: return show_from(-0.5 * std::numbers::pi, Vec3(0.0, 1.0, 0.0));
        case Action::view_top: return show_from(0.5 * std::numbers::pi, Vec3(1.0, 0.0, 0.0));
        case Action::view_back: return show_from(std::numbers::pi, Vec3(0.0, 1.0, 0.0));
        case Action::view_left: return show_from(0.5 * std::numbers::pi, Vec3(0.0, 1.0, 0.0));
        case Action::view_bottom: return show_from(-0.5 * std::numbers::pi, Vec3(1.0, 0.0, 0.0));
        case Action::turn_left: return turn(-kTurnStep_rad, Vec3(0.0, 1.0, 0.0));
        case Action::turn_right: return turn(kTurnStep_rad, Vec3(0.0, 1.0, 0.0));
        case Action::turn_up: return turn(-kTurnStep_rad, Vec3(1.0, 0.0, 0.0));
        case Action::turn_down: return turn(kTurnStep_rad, Vec3(1.0, 0.0, 0.0));
        case Action::roll_left: state_.desk.roll_rad += kTurnStep_rad; return {};
        case Action::roll_right: state_.desk.roll_rad -= kTurnStep_rad; return {};
        case Action::next_hand:
            return lead_hand(state_, state_.hands.empty()
                                         ? "next"
                                         : state_.hands[(state_.hand + 1) % state_.hands.size()].hand_name);
        case Action::put_away:
            state_.first_steps = false;
            orders_.put_away = true;
            return {};
        case Action::first_steps: state_.help = false; return toggle(&SessionState::first_steps);
        case Action::quit: ask_or_quit(state_); return {};
    }
    return {};
}

}  // namespace

Result<void> run_command(SessionState& state, SessionOrders& orders, const CommandInput& command) {
    const Result<SessionCommand> parsed = parse_command(command);
    if (!parsed) return std::unexpected(parsed.error());
    return run_command(state, orders, *parsed);
}

Result<void> run_command(SessionState& state, SessionOrders& orders, const SessionCommand& command) {
    return std::visit(Runner(state, orders), command);
}

}  // namespace burin::session
