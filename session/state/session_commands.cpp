// SPDX-License-Identifier: MIT
// Applies the session's own commands to it. A viewer's are the desk's (desk/viewer/viewer_commands.cpp).
#include "session/state/session_commands.hpp"

#include <cmath>
#include <functional>
#include <utility>

#include "session/state/command_table.hpp"
#include "session/state/session_command.hpp"
#include "session/state/session_orders.hpp"
#include "session/state/session_state.hpp"

#include "base/try.hpp"
#include "session/held/held_handle.hpp"
#include "session/objects/world_objects.hpp"
#include "workpiece/carve_order.hpp"

namespace burin::session {
namespace {

constexpr double kRadiusStep = 1.122462;  // six steps double it
constexpr const char* kScreenshotName = "burin.png";

// Applies one command to a session.
class Runner {
public:
    Runner(SessionState& state, SessionOrders& orders) : state_(state), orders_(orders) {}

    // A viewer's: none comes here.
    template <typename Command>
    Result<void> operator()(const Command&) {
        return {};
    }
    Result<void> operator()(const RunAction& run);
    Result<void> operator()(const SetTool& set) {
        return change_tool([&](SessionState& s) { s.led().tool.shape = set.tool; });
    }
    Result<void> operator()(const SetOperation& set) { return use(set.operation); }
    Result<void> operator()(const SetColour& set) {
        std::array<std::uint8_t, 3> colour{};
        for (std::size_t k = 0; k < 3; ++k) colour[k] = static_cast<std::uint8_t>(std::lround(255.0 * set.srgb[k]));
        return change_tool([&](SessionState& s) { s.led().tool.colour = colour; });
    }
    Result<void> operator()(const SetMaterial& set) {
        return change_tool([&](SessionState& s) { s.feel = toolbox::with_preset(s.feel, set.preset); });
    }
    Result<void> operator()(const SetQuantity& set);
    Result<void> operator()(const SetTechnique& set) {
        state_.led().technique = set.technique;
        return update_touch();
    }
    Result<void> operator()(const SetForce& set) {
        state_.led().force_on = set.on;
        return update_touch();
    }
    // Only the device knows whether they can be switched.
    Result<void> operator()(const SetAmplifiers& set) {
        orders_.amplifiers.push_back({set.on, orders_.line});
        return {};
    }
    Result<void> operator()(const SetMirror& set) {
        BURIN_TRY_DO(order(workpiece::MirrorStrokes{set.mirror}));
        state_.mirror = set.mirror;
        return {};
    }
    Result<void> operator()(const SetCatchDrill& set) {
        state_.led().catch_drill = set.on;
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
        BURIN_TRY_DO(may_save());
        save_and_quit(state_, orders_);
        return {};
    }
    Result<void> operator()(const QuitStay&) {
        stay(state_);
        return {};
    }
    Result<void> operator()(const SaveTo& wanted) {
        BURIN_TRY_DO(may_save());
        if (wanted.path.empty())
            save_or_name(state_, orders_);
        else
            order_save(state_, orders_, wanted.path, false);
        return {};
    }
    Result<void> operator()(const SaveAs& wanted) {
        BURIN_TRY_DO(may_save());
        save_as(state_, orders_, wanted.path, wanted.is);
        return {};
    }
    Result<void> operator()(const TellDocument& is) {
        take_told(state_, is.told);
        return {};
    }
    Result<void> operator()(const CalibrateHandle& wanted);
    Result<void> operator()(const LeadHand& wanted) { return lead_hand(state_, wanted.hand); }
    Result<void> operator()(const SetMouse& set) {
        const bool was_chosen = std::exchange(state_.mouse_chosen, true);
        if (state_.mouse == set.mode && was_chosen) return {};
        state_.mouse = set.mode;
        return change_tool([](SessionState&) {});  // how it adds material depends on who leads it
    }
    Result<void> operator()(const EditObject& wanted) {
        const WorldObjects none;
        BURIN_TRY(edited, session::edited(state_.world ? *state_.world : none, wanted));
        const scene::ObjectId id = edited.order.object;
        const auto before = state_.world->objects[id - 1];
        state_.world = std::move(edited.world);
        if (state_.saves) note_edit(before, state_.world->objects[id - 1], wanted.property);
        orders_.world.push_back(std::move(edited.order));
        return {};
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
        if (state_.saves || state_.saves_brought) return {};
        return fail("the scene", "belongs to what is done in it, and is not saved",
                    "open a world or a workpiece by itself: burin world FILE, burin sculpt FILE");
    }
    // Changes the tool, after checking the result; keeps the old one when something is wrong with it.
    Result<void> change_tool(const std::function<void(SessionState&)>& change) {
        SessionState changed = state_;
        change(changed);
        BURIN_TRY(use, tool_of(changed));
        state_ = std::move(changed);
        orders_.carving.emplace_back(std::move(use));
        return update_touch();
    }
    Result<void> use(compute::Operation operation, bool only_touch = false) {
        return change_tool([&](SessionState& s) {
            s.led().tool.operation = operation;
            s.led().only_touch = only_touch;
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
    Result<void> order(workpiece::CarveOrder order) {
        if (!state_.carves)
            return fail("the world", "holds no workpiece that could be carved", "open it with a --workpiece");
        orders_.carving.push_back(std::move(order));
        return {};
    }
    void note_edit(const std::shared_ptr<const scene::SceneObject>& before,
                   const std::shared_ptr<const scene::SceneObject>& after, scene::ObjectProperty property) {
        const std::uint32_t part = state_.objects_part();
        const document::StepName newest{part, state_.edits.steps().done};
        state_.edits.note(before, after, property, state_.history.back() == newest);
        state_.history.follow(part, state_.edits.steps());
        forget_undone(state_, orders_);
    }
    // Steps of all parts go back, and forward, in the order in which they were made. A stroke may have begun of which
    // nobody knows here yet: where no other step is known, the workpiece is asked.
    Result<void> undo() {
        const auto step = state_.history.back();
        if (step ? step->part != state_.objects_part() : state_.carves)
            return go(step ? step->part : SessionState::kWorkpiecePart, scene::StepWay::back);
        const scene::ObjectStep* const edit = step ? state_.edits.back() : nullptr;
        if (edit == nullptr) return fail("undo", "there is nothing to take back", "");
        BURIN_TRY_DO(restore(edit->before));
        state_.edits.went_back();
        state_.history.follow(step->part, state_.edits.steps());
        return {};
    }
    Result<void> redo() {
        const auto step = state_.history.forward();
        if (step ? step->part != state_.objects_part() : state_.carves)
            return go(step ? step->part : SessionState::kWorkpiecePart, scene::StepWay::forward);
        const scene::ObjectStep* const edit = step ? state_.edits.forward() : nullptr;
        if (edit == nullptr) return fail("redo", "there is nothing to repeat", "");
        BURIN_TRY_DO(restore(edit->after));
        state_.edits.went_forward();
        state_.history.follow(step->part, state_.edits.steps());
        return {};
    }
    Result<void> go(std::uint32_t part, scene::StepWay way) {
        state_.history.ordered(part, way);
        orders_.goes.push_back({part, way, orders_.carving.size()});
        return {};
    }
    Result<void> restore(std::shared_ptr<const scene::SceneObject> object) {
        BURIN_TRY(changed, restored(*state_.world, std::move(object)));
        state_.world = std::move(changed.world);
        orders_.world.push_back(std::move(changed.order));
        return {};
    }
    Result<void> export_to(const std::string& path) {
        return order(workpiece::ExportSurface{
            .path = path, .unit = state_.export_unit, .crumbs_m = state_.crumbs_m, .asked_by = orders_.line});
    }
    SessionState& state_;
    SessionOrders& orders_;
};

haptics::WorkspaceTechnique next_technique(haptics::WorkspaceTechnique technique) {
    return techniques()[(static_cast<std::size_t>(technique) + 1) % techniques().size()].technique;
}

Result<void> Runner::operator()(const CalibrateHandle& wanted) {
    if (!state_.led().handle)
        return fail("calibrate", "there is no wand", "open the session with --device simulated-wand and --points");
    BURIN_TRY(done, wanted.reset ? HandleCalibrated{}
                                 : calibrated(state_.led().handle->description, state_.led().handle_reads_device));
    state_.led().device_from_read = done.device_from_read;
    if (!done.message.empty()) orders_.messages.push_back({done.message, 0});
    return update_touch();
}

Result<void> Runner::operator()(const SetQuantity& set) {
    const QuantityDescriptor& quantity = descriptor_of(set.quantity);
    if (set.quantity == Quantity::radius && state_.led().tool.shape.kind == toolbox::ToolKind::mesh) {
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
        case Action::next_workspace_technique:
            state_.led().technique = next_technique(state_.led().technique);
            return update_touch();
        case Action::take_screenshot: orders_.screenshots.push_back({kScreenshotName, orders_.line}); return {};
        case Action::export_mesh: return export_to(state_.export_path);
        case Action::save_session: return (*this)(SaveTo{});
        case Action::save_as:
            BURIN_TRY_DO(may_save());
            if (!state_.asked.told) return fail("save-as", "has nobody to ask for a name", "write save-as FILE.burin");
            open_or_close_naming(state_);
            return {};
        case Action::next_hand:
            return lead_hand(state_, state_.hands.size() < 2
                                         ? "next"
                                         : state_.hands[(state_.hand + 1) % state_.hands.size()].hand_name);
        case Action::put_away: orders_.put_away = true; return {};
        case Action::quit: ask_or_quit(state_); return {};
        default: return {};  // a viewer's
    }
}

}  // namespace

void forget_undone(SessionState& state, SessionOrders& orders) {
    if (state.history.take_forgotten(state.objects_part())) state.edits.forget_undone();
    for (const std::uint32_t part : state.history.take_forgotten())
        orders.goes.push_back({part, scene::StepWay::forget, orders.carving.size()});
}

Result<void> run_command(SessionState& state, SessionOrders& orders, const CommandInput& command) {
    BURIN_TRY(parsed, parse_command(command));
    return run_command(state, orders, parsed);
}

Result<void> run_command(SessionState& state, SessionOrders& orders, const SessionCommand& command) {
    if (is_of_a_viewer(command))
        return fail(as_input(command).name, "is about how the session is seen, and nobody sees it", "leave it out");
    return std::visit(Runner(state, orders), command);
}

}  // namespace burin::session
