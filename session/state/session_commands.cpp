// SPDX-License-Identifier: MIT
// What the commands of keys, panel and scripts do to a session.
#include <array>
#include <cstdio>
#include <functional>

#include "app/session/session_state.hpp"

namespace burin {
namespace {

constexpr double kRadiusStep = 1.122462;         // six steps double it
constexpr double kHardnessUnit_Ns_per_m3 = 1e6;  // kPa per mm/s, as FeelOptions has it
constexpr const char* kScreenshotName = "burin.png";

std::string number_text(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.9g", value);
    return text.data();
}

// One command on its way through a session.
class Runner {
public:
    Runner(SessionState& state, SessionOrders& orders) : state_(state), orders_(orders) {}

    Result<void> operator()(const RunAction& run);
    Result<void> operator()(const SetTool& set) {
        return change_tool([&](SessionState& s) { s.tool.shape = text_of(set.tool); });
    }
    Result<void> operator()(const SetOperation& set) { return use(set.operation); }
    Result<void> operator()(const SetColour& set) {
        return change_tool([&](SessionState& s) { s.tool.material = material_text(set); });
    }
    Result<void> operator()(const SetQuantity& set);
    Result<void> operator()(const SetTechnique& set) {
        state_.technique = set.technique;
        return tell_touch();
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
        return tell_touch();
    }
    Result<void> operator()(const SetForceShown& set) {
        state_.force_shown = set.on;
        return {};
    }
    Result<void> operator()(const ExportTo& wanted) {
        state_.export_path = wanted.path;
        return order(ExportSurface{wanted.path});
    }
    Result<void> operator()(const ScreenshotTo& wanted) {
        orders_.screenshots.push_back(wanted.path);
        return {};
    }

private:
    // Tries the tool as it would be; keeps the old one when something is wrong with it.
    Result<void> change_tool(const std::function<void(SessionState&)>& change) {
        SessionState changed = state_;
        change(changed);
        Result<UseTool> use = tool_of(changed);
        if (!use) return std::unexpected(use.error());
        state_ = std::move(changed);
        orders_.carving.emplace_back(std::move(*use));
        return tell_touch();
    }
    Result<void> use(Operation operation, bool only_touch = false) {
        return change_tool([&](SessionState& s) {
            s.tool.operation = operation;
            s.only_touch = only_touch;
        });
    }
    Result<void> resize_tool(double factor) {
        const Result<Tool> tool = parse_tool(state_.tool);
        if (!tool) return std::unexpected(tool.error());
        return (*this)(SetQuantity{Quantity::radius, tool->ball_radius_m() * factor});
    }
    Result<void> tell_touch() {
        orders_.parameters = true;
        return {};
    }
    Result<void> order(CarvingOrder order) {
        orders_.carving.push_back(std::move(order));
        return {};
    }
    Result<void> toggle(bool SessionState::* flag) {
        state_.*flag = !(state_.*flag);
        return {};
    }

    SessionState& state_;
    SessionOrders& orders_;
};

// The modes that one window can show, in their order.
StereoMode next_mode(StereoMode mode) {
    const auto modes = stereo_modes();
    auto i = static_cast<std::size_t>(mode);
    do {
        i = (i + 1) % modes.size();
    } while (shows_one_eye_at_a_time(modes[i]) && modes[i] != StereoMode::left && modes[i] != StereoMode::right);
    return modes[i];
}

Result<void> Runner::operator()(const SetQuantity& set) {
    switch (set.quantity) {
        case Quantity::radius:
            return change_tool([&](SessionState& s) { s.tool.shape = "ball:" + number_text(set.value); });
        case Quantity::hardness:
            return change_tool(
                [&](SessionState& s) { s.feel.hardness = number_text(set.value / kHardnessUnit_Ns_per_m3); });
        case Quantity::friction: return change_tool([&](SessionState& s) { s.feel.friction = set.value; });
        case Quantity::stiffness: return change_tool([&](SessionState& s) { s.feel.stiffness_N_per_m = set.value; });
        case Quantity::velocity_filter: state_.velocity_filter = set.value; return tell_touch();
        case Quantity::force_filter: state_.force_filter = set.value; return tell_touch();
        case Quantity::scale: state_.workspace_gain = set.value; return tell_touch();
        case Quantity::eye_distance: state_.interpupillary_m = set.value; return {};
    }
    return {};
}

Result<void> Runner::operator()(const RunAction& run) {
    switch (run.action) {
        case Action::undo: return order(UndoStroke{});
        case Action::redo: return order(RedoStroke{});
        case Action::tool_1: return use(Operation::cut);
        case Action::tool_2: return use(Operation::fill);
        case Action::tool_3: return use(Operation::paint);
        case Action::tool_4: return use(Operation::smooth);
        case Action::tool_5: return use(Operation::cut, true);
        case Action::smaller_radius: return resize_tool(1.0 / kRadiusStep);
        case Action::larger_radius: return resize_tool(kRadiusStep);
        case Action::next_stereo_mode: state_.output.mode = next_mode(state_.output.mode); return {};
        case Action::swap_eyes: state_.output.swap_eyes = !state_.output.swap_eyes; return {};
        case Action::next_workspace_technique:
            state_.technique =
                static_cast<WorkspaceTechnique>((static_cast<std::size_t>(state_.technique) + 1) % kTechniques);
            return tell_touch();
        case Action::toggle_panel: return toggle(&SessionState::panel);
        case Action::toggle_help: return toggle(&SessionState::help);
        case Action::toggle_frame_figures: return toggle(&SessionState::figures);
        case Action::toggle_full_screen: orders_.full_screen = true; return {};
        case Action::take_screenshot: orders_.screenshots.emplace_back(kScreenshotName); return {};
        case Action::export_mesh: return order(ExportSurface{state_.export_path});
        case Action::save_session:
            return fail("save-session", "sessions cannot be saved yet", "export the mesh (export FILE, Ctrl+E)");
        case Action::reset_view: state_.world_from_object = state_.home_world_from_object; return tell_touch();
        case Action::quit: state_.quit = true; return {};
    }
    return {};
}

}  // namespace

Result<void> run_command(SessionState& state, SessionOrders& orders, const CommandInput& command) {
    const Result<SessionCommand> parsed = parse_command(command);
    if (!parsed) return std::unexpected(parsed.error());
    return std::visit(Runner(state, orders), *parsed);
}

}  // namespace burin
