// SPDX-License-Identifier: MIT
#include "desk/panel/panel_sections.hpp"

#include "session/input/input_event.hpp"
#include "session/state/command_table.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace burin::session::panel {

namespace {

ImDrawList& canvas() { return *ImGui::GetWindowDrawList(); }

std::string millimetres(double length_m) {
    const double mm = 1e3 * length_m;
    return written(mm < 0.995 ? "%.3g mm" : mm < 9.95 ? "%.1f mm" : "%.0f mm", mm);
}

// Draws the tool from the side, its tip below.
void draw_icon(toolbox::ToolKind kind, ImVec2 m, float r, ImU32 colour, ImU32 edge) {
    ImDrawList& d = canvas();
    switch (kind) {
        case toolbox::ToolKind::ball:
            d.AddCircleFilled(m, r, colour, 32);
            d.AddCircleFilled({m.x - 0.32f * r, m.y - 0.34f * r}, 0.24f * r, edge, 16);
            break;
        case toolbox::ToolKind::cylinder:
            d.AddRectFilled({m.x - 0.62f * r, m.y - r}, {m.x + 0.62f * r, m.y + r}, colour, 0.1f * r);
            d.AddRectFilled({m.x - 0.4f * r, m.y - 0.85f * r}, {m.x - 0.2f * r, m.y + 0.85f * r}, edge, 0.1f * r);
            break;
        case toolbox::ToolKind::cone:
            d.AddTriangleFilled({m.x - 0.9f * r, m.y - 0.9f * r}, {m.x + 0.9f * r, m.y - 0.9f * r}, {m.x, m.y + r},
                                colour);
            d.AddTriangleFilled({m.x - 0.5f * r, m.y - 0.75f * r}, {m.x - 0.22f * r, m.y - 0.75f * r},
                                {m.x - 0.12f * r, m.y + 0.35f * r}, edge);
            break;
        case toolbox::ToolKind::bullnose:
            d.AddRectFilled({m.x - 0.7f * r, m.y - r}, {m.x + 0.7f * r, m.y + r}, colour, 0.45f * r,
                            ImDrawFlags_RoundCornersBottom);
            d.AddRectFilled({m.x - 0.46f * r, m.y - 0.85f * r}, {m.x - 0.24f * r, m.y + 0.6f * r}, edge, 0.1f * r);
            break;
        case toolbox::ToolKind::box:
            d.AddRectFilled({m.x - 0.85f * r, m.y - 0.85f * r}, {m.x + 0.85f * r, m.y + 0.85f * r}, colour, 0.12f * r);
            d.AddRectFilled({m.x - 0.65f * r, m.y - 0.65f * r}, {m.x - 0.4f * r, m.y + 0.65f * r}, edge, 0.1f * r);
            break;
        case toolbox::ToolKind::mesh: break;
    }
}

std::string capitalised(std::string_view name) {
    std::string title(name);
    title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
    return title;
}

void show_tool_kinds(Kit& kit, const PanelModel& model) {
    std::vector<Item> items;
    std::vector<toolbox::ToolKind> kinds;
    for (const toolbox::ToolDescriptor& kind : toolbox::tool_kinds()) {
        if (!kind.on_panel()) continue;
        kinds.push_back(kind.kind);
        items.push_back({.label = "tool " + std::string(kind.name), .text = {}});
    }
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const auto selected = static_cast<std::size_t>(std::ranges::find(kinds, model.tool.kind) - kinds.begin());
    const float each = kit.width() / static_cast<float>(kinds.size()), height = kit.px(42.0f);
    const auto chosen = kit.segments(items, selected, 42.0f);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const ImVec2 middle{start.x + each * (static_cast<float>(i) + 0.5f), start.y + 0.5f * height};
        const bool on = i == selected;
        draw_icon(kinds[i], middle, kit.px(11.0f), on ? kOnAccent : kDim,
                  on ? with_alpha(kAccent, 130) : with_alpha(kField, 130));
    }
    if (chosen && *chosen != selected) kit.give(SetTool{tool_like(model.tool, kinds[*chosen])});
}

void show_sizes(Kit& kit, const PanelModel& model) {
    const auto sizes = toolbox::descriptor_of(model.tool.kind).used_sizes();
    const double from = model.tool_sizes.from_m, to = 2.0 * model.tool_sizes.radius_to_m;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const double size = model.tool.sizes_m[i];
        const std::string name(sizes[i].name);
        const std::string label = name == "radius" ? name : "tool " + name;
        const auto part = kit.slider(label, capitalised(name), part_of(size, from, to, true), millimetres(size));
        if (!part) continue;
        const double wanted = *part <= 0.0 && sizes[i].may_be_zero ? 0.0 : value_at(*part, from, to, true);
        if (wanted == size) continue;
        if (model.tool.kind == toolbox::ToolKind::ball) {
            kit.give_held(SetQuantity{Quantity::radius, wanted});
        } else {
            kit.give_held(SetTool{with_size(model.tool, i, wanted, from)});
        }
    }
}

std::string hardness_text(double hardness) {
    if (hardness <= 0.0) return "none";
    if (hardness < 999.5e3) return written("%.3g kN s/m\xC2\xB3", 1e-3 * hardness);
    return written("%.3g MN s/m\xC2\xB3", 1e-6 * hardness);
}

// Shows a filter's factor and its delay at 1 kHz (haptics/signals/filters.hpp).
std::string filter_text(double a) {
    return a <= 0.0 ? "off" : written("%.2f", a) + written(" \xC2\xB7 %.0f ms", a / (1.0 - a));
}

Item item_of(std::string_view command, std::string_view name, std::string title) {
    return {std::string(command) + " " + std::string(name), std::move(title), true};
}

}  // namespace

toolbox::ToolSpec tool_like(const toolbox::ToolSpec& tool, toolbox::ToolKind kind) {
    constexpr double kUsual_m = 0.005, kMost_m = 1.0;
    const toolbox::ToolDescriptor& descriptor = toolbox::descriptor_of(kind);
    if (!descriptor.on_panel()) return tool;
    const double r = toolbox::half_width_m(tool);
    const double rounded_m = rounded(r > 0.0 ? std::min(r, kMost_m) : kUsual_m, 3);
    toolbox::ToolSpec like{kind, {}, {}};
    for (std::size_t i = 0; i < like.sizes_m.size(); ++i)
        like.sizes_m[i] = rounded(rounded_m * descriptor.proportions[i], 4);
    return like;
}

toolbox::ToolSpec with_size(toolbox::ToolSpec tool, std::size_t index, double size_m, double least_m) {
    tool.sizes_m.at(index) = size_m;
    const auto adapted = toolbox::descriptor_of(tool.kind).rule.adapted;
    if (adapted != nullptr) tool.sizes_m = adapted(tool.sizes_m, index, least_m);
    return tool;
}

namespace {

void show_operations(Kit& kit, const PanelModel& model) {
    std::vector<Item> items;
    for (const toolbox::OperationDescriptor& operation : toolbox::operations())
        items.push_back(item_of("operation", operation.name, capitalised(operation.name)));
    // None is lit while the tool only touches; a press on one ends that.
    const std::size_t lit = model.only_touch ? items.size() : static_cast<std::size_t>(model.operation);
    const auto chosen = kit.segments(items, lit);
    if (chosen) kit.give(SetOperation{toolbox::operations()[*chosen].operation});
}

// Each plane is switched by a button of its own; one that is on is lit.
void show_mirror(Kit& kit, const PanelModel& model) {
    constexpr std::array<const char*, 3> kTitles{"Mirror X", "Y", "Z"};
    const float gap = kit.px(6.0f), narrow = 0.22f * kit.width(), wide = kit.width() - 2.0f * (narrow + gap);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis > 0) ImGui::SameLine(0.0f, gap);
        const std::string label = std::string("mirror ") + "xyz"[axis];
        if (!kit.button(label, kTitles.at(axis), axis == 0 ? wide : narrow, true, model.mirror.across.at(axis)))
            continue;
        toolbox::Mirror mirror = model.mirror;
        mirror.across.at(axis) = !mirror.across.at(axis);
        kit.give(SetMirror{mirror});
    }
}

}  // namespace

void show_hands(Kit& kit, const PanelModel& model) {
    if (model.hands.size() < 2) return;
    if (kit.begin_card("Hands", "mouse and keys lead")) {
        std::vector<Item> items;
        for (const PanelHand& hand : model.hands) items.push_back(item_of("hand", hand.name, hand.name));
        const auto chosen = kit.segments(items, model.hand);
        if (chosen && *chosen != model.hand) kit.give(LeadHand{model.hands[*chosen].name});
    }
    kit.end_card();
}

void show_tool(Kit& kit, const PanelModel& model) {
    const std::string aside =
        model.tool.file.empty() ? std::string(toolbox::descriptor_of(model.tool.kind).name) : model.tool.file;
    if (kit.begin_card("Tool", aside)) {
        show_tool_kinds(kit, model);
        kit.gap(4.0f);
        if (model.carves) show_operations(kit, model);
        show_sizes(kit, model);
        if (model.carves) show_mirror(kit, model);
    }
    kit.end_card();
}

void show_material(Kit& kit, const PanelModel& model) {
    if (!model.carves) return;
    if (kit.begin_card("Material")) {
        show_swatches(kit, "colour", model.colour_srgb,
                      [&](const std::array<double, 3>& srgb) { kit.give_held(SetColour{srgb}); });
        std::vector<Item> items;
        for (const toolbox::FeelPresetDescriptor& preset : toolbox::feel_presets())
            items.push_back(item_of("material", preset.name, std::string(preset.title)));
        const std::size_t now = model.material ? static_cast<std::size_t>(*model.material) : items.size();
        const auto chosen = kit.list("material", "Feels like", items, now);
        if (chosen) kit.give(SetMaterial{toolbox::feel_presets()[*chosen].preset});
        kit.quantity(Quantity::hardness, "Hardness", model.hardness_Ns_per_m3, hardness_text(model.hardness_Ns_per_m3));
    }
    kit.end_card();
}

void show_touch(Kit& kit, const PanelModel& model) {
    const std::string whose = model.hands.empty() ? std::string() : ", " + model.hands[model.hand].name;
    if (kit.begin_card(("Touch" + whose).c_str())) {
        if (kit.toggle("force", "Force", model.touch.force_on)) kit.give(SetForce{!model.touch.force_on});
        if (model.carves) {  // of the workpiece
            if (model.mouse == MouseMode::surface)
                kit.off(
                    "A mouse leads the tool to a set depth, however stiff the surface is. It counts where the "
                    "mouse flies freely, and with a device that is felt.");
            kit.quantity(Quantity::stiffness, "Stiffness", model.stiffness_N_per_m,
                         written("%.0f N/m", model.stiffness_N_per_m));
            kit.off({});
            kit.quantity(Quantity::friction, "Friction", model.friction, written("%.2f", model.friction));
        }
        kit.quantity(Quantity::velocity_filter, "Velocity filter", model.velocity_filter,
                     filter_text(model.velocity_filter));
        kit.quantity(Quantity::force_filter, "Force filter", model.force_filter, filter_text(model.force_filter));
    }
    kit.end_card();
}

// Below all others, so that what stands above them is where it is with one hand.
void show_touch_of_others(Kit& kit, const PanelModel& model) {
    for (std::size_t i = 0; i < model.hands.size(); ++i) {
        if (i == model.hand) continue;
        const PanelHand& hand = model.hands[i];
        kit.speak_for({hand.name, model.hands[model.hand].name});
        if (kit.begin_card(("Touch, " + hand.name).c_str(), touch_text(hand.touch))) {
            if (kit.toggle("force " + hand.name, "Force", hand.touch.force_on))
                kit.give(SetForce{!hand.touch.force_on});
            kit.quantity(Quantity::velocity_filter, "Velocity filter", hand.velocity_filter,
                         filter_text(hand.velocity_filter));
            kit.quantity(Quantity::force_filter, "Force filter", hand.force_filter, filter_text(hand.force_filter));
        }
        kit.end_card();
        kit.speak_for({});
    }
}

void show_mouse(Kit& kit, const PanelModel& model) {
    if (!model.offers_mouse) return;
    if (kit.begin_card("Mouse")) {
        const std::vector<Item> items{item_of("mouse", "free", "Flies freely"),
                                      item_of("mouse", "surface", "On the surface")};
        const auto chosen = kit.segments(items, static_cast<std::size_t>(model.mouse));
        if (chosen && *chosen != static_cast<std::size_t>(model.mouse))
            kit.give(SetMouse{static_cast<MouseMode>(*chosen)});
        if (model.mouse == MouseMode::surface)
            kit.quantity(Quantity::strength, "Depth", model.strength, millimetres(model.strength * model.half_width_m));
    }
    kit.end_card();
}

void show_workspace(Kit& kit, const PanelModel& model) {
    if (model.mouse == MouseMode::surface) return;
    // The text before the colon says what the phase is; the rest says what to do.
    const std::string phase = haptics::text(model.phase);
    const bool fits = phase.size() < 30;
    if (kit.begin_card("Workspace", fits ? phase : phase.substr(0, phase.find_first_of(":;")))) {
        if (!fits) kit.paragraph(kDim, phase);
        std::vector<Item> items;
        for (const TechniqueDescriptor& technique : techniques())
            items.push_back(item_of("technique", technique.name, std::string(technique.title)));
        const auto chosen = kit.list("technique", "Technique", items, static_cast<std::size_t>(model.technique));
        if (chosen) kit.give(SetTechnique{techniques()[*chosen].technique});
        kit.quantity(Quantity::scale, "Scale", model.scale, written("\xC3\x97 %.3g", model.scale));
    }
    kit.end_card();
}

namespace {

// Where the scene is seen from; beside free flight keys fly the head instead.
void show_sides(Kit& kit, const PanelModel& model) {
    if (model.mouse != MouseMode::surface) return;
    constexpr std::array<std::pair<Action, const char*>, 4> kSides{{{Action::fit_view, "Fit"},
                                                                    {Action::view_front, "Front"},
                                                                    {Action::view_side, "Side"},
                                                                    {Action::view_top, "Top"}}};
    const float gap = kit.px(6.0f), each = 0.25f * (kit.width() - 3.0f * gap);
    for (const auto& [action, text] : kSides) {
        if (action != kSides.front().first) ImGui::SameLine(0.0f, gap);
        if (kit.button(std::string(name_of(action)), text, each, true)) kit.give(RunAction{action});
    }
}

}  // namespace

void show_view(Kit& kit, const PanelModel& model) {
    if (kit.begin_card("View")) {
        show_sides(kit, model);
        std::vector<Item> modes;
        for (const wall::StereoMode mode : wall::stereo_modes())
            modes.push_back(item_of("stereo-mode", file_name_of(mode), capitalised(wall::title_of(mode))));
        const auto mode = kit.list("stereo-mode", "Stereo", modes, static_cast<std::size_t>(model.stereo_mode));
        if (mode) kit.give(SetStereoMode{static_cast<wall::StereoMode>(*mode)});
        kit.paragraph(kDim, wall::purpose_of(model.stereo_mode));
        const bool one_eye = wall::needs_of(model.stereo_mode).one_eye_point;
        if (one_eye) kit.off("Both eyes see one picture now: choose a stereo mode first.");
        if (kit.toggle("swap-eyes", "Exchange eyes", model.eyes_swapped)) kit.give(SetEyeSwap{!model.eyes_swapped});
        if (model.fades_at_edges && kit.toggle("edge-comfort", "Flatter towards the edges", *model.fades_at_edges)) {
            kit.give(SetEdgeComfort{*model.fades_at_edges ? EdgeComfort::off : EdgeComfort::on});
        }
        kit.off({});
        if (kit.toggle("show-force", "Arrow of the force", model.force_shown)) {
            kit.give(SetForceShown{!model.force_shown});
        }
        if (one_eye) kit.off("Both eyes see one picture now: choose a stereo mode first.");
        kit.quantity(Quantity::eye_distance, "Eye distance", model.eye_distance_m,
                     written("%.1f mm", 1e3 * model.eye_distance_m));
        kit.off({});
        constexpr std::array kPatternTitles{"Scene", "Eyes", "Ghosts", "Grid"};
        std::vector<Item> patterns;
        for (std::size_t i = 0; i < kPatternTitles.size(); ++i)
            patterns.push_back(
                item_of("test-pattern", file_name_of(static_cast<wall::TestPattern>(i)), kPatternTitles.at(i)));
        const auto pattern = kit.segments(patterns, static_cast<std::size_t>(model.test_pattern));
        if (pattern) kit.give(SetTestPattern{static_cast<wall::TestPattern>(*pattern)});
    }
    kit.end_card();
}

namespace {

void show_document(Kit& kit, const PanelDocument& document) {
    const float half = 0.5f * (kit.width() - kit.px(6.0f));
    if (document.saving) kit.off("The work is being saved.");
    if (kit.button("save-session", document.saving ? "Saving" : "Save", half))
        kit.give(RunAction{Action::save_session});
    ImGui::SameLine(0.0f, kit.px(6.0f));
    if (kit.button("save-as", "Save as\u2026", half)) kit.give(RunAction{Action::save_as});
    kit.off({});
    kit.figure(document.state, document.kept, document.keeps ? kText : kWarning);
}

void show_path(Kit& kit, const PanelModel& model) {
    Memory& memory = kit.memory;
    if (memory.model_path != model.export_path) memory.path = memory.model_path = model.export_path;
    std::array<char, kMostTextBytes> bytes{};
    memory.path.copy(bytes.data(), bytes.size() - 1);
    const float button = kit.px(84.0f), gap = kit.px(6.0f);
    ImGui::SetNextItemWidth(kit.width() - button - gap);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {kit.px(10.0f), 0.5f * (kit.px(28.0f) - kit.type.text->FontSize)});
    const bool entered = ImGui::InputText("##path", bytes.data(), bytes.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    kit.note("path");
    ImGui::PopStyleVar();
    memory.path = bytes.data();
    ImGui::SameLine(0.0f, gap);
    const bool ready = !model.exporting && !memory.path.empty();
    if (!ready) kit.off(model.exporting ? "The mesh is being written." : "Name a file first, such as part.stl.");
    const bool pressed = kit.button("export", model.exporting ? "Writing" : "Export", button, ready, true);
    kit.off({});
    if (pressed || (entered && ready)) kit.give(ExportTo{memory.path});
}

}  // namespace

void show_history(Kit& kit, const PanelModel& model) {
    if (!model.saves) return;  // there is nothing to undo or to export
    if (kit.begin_card(model.carves ? "History and export" : "History",
                       model.document ? std::string_view(model.document->name) : "")) {
        const float half = 0.5f * (kit.width() - kit.px(6.0f));
        const auto counted = [](const char* name, std::uint32_t count) {
            return count > 0 ? std::string(name) + "  " + std::to_string(count) : std::string(name);
        };
        if (model.undo_count == 0)
            kit.off(model.carves ? "There is no stroke to undo." : "There is no change to undo.");
        if (kit.button("undo", counted("Undo", model.undo_count), half, model.undo_count > 0)) {
            kit.give(RunAction{Action::undo});
        }
        ImGui::SameLine(0.0f, kit.px(6.0f));
        kit.off(model.redo_count > 0 ? ""
                : model.carves       ? "There is no stroke to redo: nothing was undone since the last one."
                                     : "There is no change to redo: nothing was undone since the last one.");
        if (kit.button("redo", counted("Redo", model.redo_count), half, model.redo_count > 0)) {
            kit.give(RunAction{Action::redo});
        }
        kit.off({});
        if (model.document) show_document(kit, *model.document);
        if (model.carves) show_path(kit, model);
    }
    kit.end_card();
}

}  // namespace burin::session::panel
