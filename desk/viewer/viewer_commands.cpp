// SPDX-License-Identifier: MIT
// Applies commands about how a session is seen. All others are the session's (session/state/session_commands.cpp).
#include <numbers>
#include <string>
#include <utility>

#include "base/try.hpp"
#include "desk/input/input_wand.hpp"
#include "desk/viewer/framed_world.hpp"
#include "desk/viewer/viewer_lead.hpp"
#include "session/objects/world_objects.hpp"
#include "session/state/session_commands.hpp"

namespace burin::session {
namespace {

constexpr double kTurnStep_rad = std::numbers::pi / 12.0;

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

// Applies one command.
class ViewerRunner {
public:
    ViewerRunner(Viewer& viewer, SessionState& state, const DeskRoom& desk, SessionOrders& orders)
        : viewer_(viewer), state_(state), desk_(desk), orders_(orders) {}

    // Has the session run every command that is not a viewer's.
    template <typename Command>
    Result<void> operator()(const Command& command) {
        return run_command(state_, orders_, SessionCommand(command));
    }
    Result<void> operator()(const RunAction& run);
    Result<void> operator()(const SetStereoMode& set) {
        viewer_.output.mode = set.mode;
        return {};
    }
    Result<void> operator()(const SetTestPattern& set) {
        viewer_.output.test_pattern = set.pattern;
        return {};
    }
    Result<void> operator()(const SetEyeSwap& set) {
        viewer_.output.swap_eyes = set.on;
        return {};
    }
    Result<void> operator()(const SetForceShown& set) {
        viewer_.force_shown = set.on;
        return {};
    }
    Result<void> operator()(const SetEdgeComfort& set) {
        viewer_.edge_comfort = set.comfort;
        return {};
    }
    Result<void> operator()(const SetQuantity& set) {
        if (set.quantity == Quantity::eye_distance)
            viewer_.interpupillary_m = set.value;
        else if (set.quantity == Quantity::strength)
            viewer_.desk.strength = set.value;
        else
            return run_command(state_, orders_, set);
        return {};
    }
    Result<void> operator()(const SelectObject& wanted) {
        BURIN_TRY(id, object_of(wanted.object));
        viewer_.selected = id;
        return uncover(id);
    }
    Result<void> operator()(const EditObject& wanted) {
        BURIN_TRY_DO(run_command(state_, orders_, wanted));
        if (!moves_or_grows(wanted.property)) return {};
        BURIN_TRY(id, object_of(wanted.object));
        return uncover(id);
    }
    Result<void> operator()(const LeadHand& wanted) { return lead(wanted); }
    Result<void> operator()(const SetMouse& set) {
        if (set.mode == MouseMode::surface && !desk_.no_surface.empty())
            return fail("mouse surface", desk_.no_surface, "fly freely");
        if (state_.mouse != set.mode || !state_.mouse_chosen) {
            viewer_.desk.on_surface = {};
            viewer_.desk.buttons = 0;
            viewer_.desk.drag.reset();
        }
        return run_command(state_, orders_, set);
    }

private:
    [[nodiscard]] Result<scene::ObjectId> object_of(const std::string& name) const {
        const WorldObjects none;
        return object_named(state_.world ? *state_.world : none, name);
    }
    // Leads another hand with mouse and keys: each stays where it was led.
    Result<void> lead(const SessionCommand& command) {
        const std::size_t before = state_.hand;
        const DeskState& desk = viewer_.desk;
        HandState& hand = state_.led();
        hand.target = {desk.target_device_m, Vec3(0.0), {}, desk.buttons};
        hand.target_turn_device = desk.target_turn_device;
        BURIN_TRY_DO(run_command(state_, orders_, command));
        if (state_.hand != before) take_hand(viewer_, state_);
        return {};
    }
    Result<void> toggle(bool Viewer::* flag) {
        viewer_.*flag = !(viewer_.*flag);
        return {};
    }
    Result<void> place(const Similarity& world_from_object) {
        state_.world_from_object = world_from_object;
        orders_.parameters = true;
        return {};
    }
    // Shows all of the workpiece in the free part of the picture, turned as it is.
    Result<void> show() {
        BURIN_TRY_DO(may_turn());
        return place(fitted(viewer_.seen_from, state_.world_from_object.orientation));
    }
    // Shows the chosen object of a world likewise, with some of what is around it.
    Result<void> show_object() {
        const scene::SceneObject* object = chosen_object(state_, viewer_);
        if (object == nullptr || !desk_.frames_world) return {};
        return place(fitted_to(*object, viewer_.seen_from, state_.world_from_object.orientation));
    }
    // Moves the scene where the panel would cover an object at work.
    Result<void> uncover(scene::ObjectId id) {
        const scene::SceneObject* object = state_.world ? state_.world->find(id) : nullptr;
        if (object == nullptr || !desk_.frames_world) return {};
        return place(beside_panel(*object, viewer_.seen_from, state_.world_from_object));
    }
    // Straight on, turned from how it stood at first, about an axis of the screen.
    Result<void> show_from(double angle_rad, const Vec3& axis_screen) {
        BURIN_TRY_DO(may_turn());
        const Quat home = state_.home_world_from_object.orientation;
        return place(fitted_straight(viewer_.seen_from, home * glm::angleAxis(angle_rad, axis_screen)));
    }
    // Turns the scene about its middle, about an axis of the screen as the workpiece stood along it at first.
    Result<void> turn(double angle_rad, const Vec3& axis_screen) {
        BURIN_TRY_DO(may_turn());
        Similarity now = state_.world_from_object;
        const Vec3 axis_world = state_.home_world_from_object.orientation * axis_screen;
        now = turned_about({}, now * state_.middle_object, glm::angleAxis(angle_rad, axis_world)) * now;
        now.orientation = glm::normalize(now.orientation);
        return place(now);
    }
    Result<void> go_home() {
        BURIN_TRY_DO(may_turn());
        // The window may have another shape by now.
        if (desk_.frames_world && state_.mouse == MouseMode::free)
            return place(fitted(viewer_.seen_from, state_.home_world_from_object.orientation));
        return place(state_.home_world_from_object);
    }
    // What the tool works on stays.
    [[nodiscard]] Result<void> may_turn() const {
        if (!viewer_.desk.on_surface.pressed) return {};
        return fail("the scene", "stays while the tool works on it", "let go of the left button first");
    }

    Viewer& viewer_;
    SessionState& state_;
    const DeskRoom& desk_;
    SessionOrders& orders_;
};

Result<void> ViewerRunner::operator()(const RunAction& run) {
    constexpr Vec3 kRight{1.0, 0.0, 0.0}, kUp{0.0, 1.0, 0.0};
    constexpr double kQuarter_rad = 0.5 * std::numbers::pi;
    switch (run.action) {
        case Action::next_stereo_mode: viewer_.output.mode = next_mode(viewer_.output.mode); return {};
        case Action::swap_eyes: viewer_.output.swap_eyes = !viewer_.output.swap_eyes; return {};
        case Action::toggle_panel: return toggle(&Viewer::panel);
        case Action::toggle_help:
            viewer_.devices = false;  // one page at a time
            return toggle(&Viewer::help);
        case Action::toggle_frame_figures: return toggle(&Viewer::figures);
        case Action::toggle_devices: viewer_.help = false; return toggle(&Viewer::devices);
        case Action::toggle_full_screen: viewer_.wants_full_screen_exchanged = true; return {};
        case Action::reset_view: return go_home();
        case Action::fit_view: return show();
        case Action::fit_object: return show_object();
        case Action::view_front: return show_from(0.0, kUp);
        case Action::view_side: return show_from(-kQuarter_rad, kUp);
        case Action::view_top: return show_from(kQuarter_rad, kRight);
        case Action::view_back: return show_from(std::numbers::pi, kUp);
        case Action::view_left: return show_from(kQuarter_rad, kUp);
        case Action::view_bottom: return show_from(-kQuarter_rad, kRight);
        case Action::turn_left: return turn(-kTurnStep_rad, kUp);
        case Action::turn_right: return turn(kTurnStep_rad, kUp);
        case Action::turn_up: return turn(-kTurnStep_rad, kRight);
        case Action::turn_down: return turn(kTurnStep_rad, kRight);
        case Action::roll_left: viewer_.desk.roll_rad += kTurnStep_rad; return {};
        case Action::roll_right: viewer_.desk.roll_rad -= kTurnStep_rad; return {};
        case Action::first_steps: viewer_.help = false; return toggle(&Viewer::first_steps);
        case Action::put_away: viewer_.first_steps = false; return run_command(state_, orders_, run);
        case Action::next_hand: return lead(run);
        default: return run_command(state_, orders_, run);
    }
}

}  // namespace

Result<void> run_command(Viewer& viewer, SessionState& state, const DeskRoom& desk, SessionOrders& orders,
                         const SessionCommand& command) {
    return std::visit(ViewerRunner(viewer, state, desk, orders), command);
}

}  // namespace burin::session
