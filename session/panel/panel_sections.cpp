// SPDX-License-Identifier: MIT
#include "app/session/panel_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace burin::panel {

namespace {

ImDrawList& draw() { return *ImGui::GetWindowDrawList(); }

std::string millimetres(double length_m) {
    const double mm = 1e3 * length_m;
    return written(mm < 9.95 ? "%.1f mm" : "%.0f mm", mm);
}

// What the tool looks like from the side, its tip below.
void draw_icon(ToolKind kind, ImVec2 m, float r, ImU32 colour, ImU32 edge) {
    ImDrawList& d = draw();
    switch (kind) {
        case ToolKind::ball:
            d.AddCircleFilled(m, r, colour, 32);
            d.AddCircleFilled({m.x - 0.32f * r, m.y - 0.34f * r}, 0.24f * r, edge, 16);
            break;
        case ToolKind::cylinder:
            d.AddRectFilled({m.x - 0.62f * r, m.y - r}, {m.x + 0.62f * r, m.y + r}, colour, 0.1f * r);
            d.AddRectFilled({m.x - 0.4f * r, m.y - 0.85f * r}, {m.x - 0.2f * r, m.y + 0.85f * r}, edge, 0.1f * r);
            break;
        case ToolKind::cone:
            d.AddTriangleFilled({m.x - 0.9f * r, m.y - 0.9f * r}, {m.x + 0.9f * r, m.y - 0.9f * r}, {m.x, m.y + r},
                                colour);
            d.AddTriangleFilled({m.x - 0.5f * r, m.y - 0.75f * r}, {m.x - 0.22f * r, m.y - 0.75f * r},
                                {m.x - 0.12f * r, m.y + 0.35f * r}, edge);
            break;
        case ToolKind::bullnose:
            d.AddRectFilled({m.x - 0.7f * r, m.y - r}, {m.x + 0.7f * r, m.y + r}, colour, 0.45f * r,
                            ImDrawFlags_RoundCornersBottom);
            d.AddRectFilled({m.x - 0.46f * r, m.y - 0.85f * r}, {m.x - 0.24f * r, m.y + 0.6f * r}, edge, 0.1f * r);
            break;
        case ToolKind::box:
            d.AddRectFilled({m.x - 0.85f * r, m.y - 0.85f * r}, {m.x + 0.85f * r, m.y + 0.85f * r}, colour, 0.12f * r);
            d.AddRectFilled({m.x - 0.65f * r, m.y - 0.65f * r}, {m.x - 0.4f * r, m.y + 0.65f * r}, edge, 0.1f * r);
            break;
        case ToolKind::mesh: break;
    }
}

void show_tool_kinds(Kit& kit, const PanelModel& model) {
    constexpr std::size_t kShown = 5;  // a mesh comes from the command line or a script
    std::array<Item, kShown> items;
    for (std::size_t i = 0; i < kShown; ++i)
        items[i].label = "tool " + std::string(file_name_of(static_cast<ToolKind>(i)));
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const auto selected = static_cast<std::size_t>(model.tool.kind);
    const float each = kit.width() / kShown, height = kit.px(42.0f);
    const auto chosen = kit.segments(items, selected, 42.0f);
    for (std::size_t i = 0; i < kShown; ++i) {
        const ImVec2 middle{start.x + each * (static_cast<float>(i) + 0.5f), start.y + 0.5f * height};
        const bool on = i == selected;
        draw_icon(static_cast<ToolKind>(i), middle, kit.px(11.0f), on ? kOnAccent : kDim,
                  on ? with_alpha(kAccent, 130) : with_alpha(kField, 130));
    }
    if (chosen && *chosen != selected) kit.give(SetTool{tool_like(model.tool, static_cast<ToolKind>(*chosen))});
}

void show_sizes(Kit& kit, const PanelModel& model) {
    const auto names = size_names(model.tool.kind);
    const QuantityRange& range = range_of(Quantity::radius);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double size = model.tool.sizes_m[i];
        const bool may_be_zero = model.tool.kind == ToolKind::cone && i < 2;
        std::string title(names[i]);
        title[0] = static_cast<char>(title[0] - 'a' + 'A');
        const double to = 2.0 * range.to;
        const bool radius = names[i] == "radius";
        const std::string label = radius ? "radius" : "tool " + std::string(names[i]);
        const auto part = kit.slider(label, title, part_of(size, range.from, to, true), millimetres(size));
        if (!part) continue;
        const double wanted = *part <= 0.0 && may_be_zero ? 0.0 : value_at(*part, range.from, to, true);
        if (wanted == size) continue;
        if (model.tool.kind == ToolKind::ball) {
            kit.give_held(SetQuantity{Quantity::radius, wanted});
        } else {
            kit.give_held(SetTool{with_size(model.tool, i, wanted)});
        }
    }
}

std::string hardness_text(double hardness) {
    if (hardness <= 0.0) return "none";
    if (hardness < 999.5e3) return written("%.3g kN s/m\xC2\xB3", 1e-3 * hardness);
    return written("%.3g MN s/m\xC2\xB3", 1e-6 * hardness);
}

// At 1 kHz (haptics/signals/smoothing.hpp).
std::string filter_text(double a) {
    return a <= 0.0 ? "off" : written("%.2f", a) + written(" \xC2\xB7 %.0f ms", a / (1.0 - a));
}

constexpr std::array<std::array<double, 3>, 8> kSwatches{{{0.80, 0.76, 0.70},
                                                          {0.88, 0.56, 0.21},
                                                          {0.70, 0.34, 0.22},
                                                          {0.62, 0.22, 0.30},
                                                          {0.38, 0.62, 0.48},
                                                          {0.26, 0.41, 0.77},
                                                          {0.44, 0.38, 0.64},
                                                          {0.36, 0.38, 0.40}}};

ImU32 packed(const std::array<double, 3>& srgb) {
    return ImGui::ColorConvertFloat4ToU32(
        {static_cast<float>(srgb[0]), static_cast<float>(srgb[1]), static_cast<float>(srgb[2]), 1.0f});
}

void show_swatches(Kit& kit, const PanelModel& model) {
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const float height = kit.px(30.0f), each = kit.width() / (kSwatches.size() + 1), r = kit.px(9.5f);
    const auto swatch = [&](std::size_t i, const std::string& label, const std::array<double, 3>& srgb, bool own) {
        ImGui::SetCursorScreenPos({start.x + each * static_cast<float>(i), start.y});
        const bool clicked = ImGui::InvisibleButton(label.c_str(), {each, height});
        kit.note(label);
        const ImVec2 m{start.x + each * (static_cast<float>(i) + 0.5f), start.y + 0.5f * height};
        const bool here = srgb == model.colour_srgb;
        if (here && !own) draw().AddCircle(m, r + kit.px(3.0f), kText, 32, kit.px(1.5f));
        if (own) {
            draw().AddRectFilled({m.x - r, m.y - r}, {m.x + r, m.y + r}, packed(srgb), kit.px(4.0f));
            draw().AddRect({m.x - r, m.y - r}, {m.x + r, m.y + r}, ImGui::IsItemHovered() ? kText : kDim, kit.px(4.0f),
                           0, kit.px(1.2f));
        } else {
            draw().AddCircleFilled(m, ImGui::IsItemHovered() ? r + kit.px(1.0f) : r, packed(srgb), 32);
        }
        return clicked;
    };
    for (std::size_t i = 0; i < kSwatches.size(); ++i) {
        if (swatch(i, "colour " + std::to_string(i + 1), kSwatches[i], false)) kit.give(SetColour{kSwatches[i]});
    }
    if (swatch(kSwatches.size(), "colour", model.colour_srgb, true)) {
        ImGui::OpenPopup("colour circle");
        kit.again = true;
    }
    const ImVec2 corner = ImGui::GetItemRectMax();
    const float wide = kit.px(236.0f), tall = kit.px(216.0f);
    ImGui::SetNextWindowPos(
        {corner.x - wide, std::max(0.0f, std::min(corner.y + kit.px(4.0f), ImGui::GetIO().DisplaySize.y - tall))});
    ImGui::SetNextWindowSize({wide, tall});
    if (!ImGui::BeginPopup("colour circle", ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoScrollbar)) return;
    std::array<float, 3> parts{};
    for (std::size_t k = 0; k < 3; ++k) parts[k] = static_cast<float>(model.colour_srgb[k]);
    ImGui::SetNextItemWidth(wide - kit.px(16.0f));
    if (ImGui::ColorPicker3("##circle", parts.data(),
                            ImGuiColorEditFlags_PickerHueWheel | ImGuiColorEditFlags_NoInputs |
                                ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoOptions |
                                ImGuiColorEditFlags_NoAlpha)) {
        SetColour colour;
        for (std::size_t k = 0; k < 3; ++k) colour.srgb[k] = rounded(std::clamp(double{parts[k]}, 0.0, 1.0), 3);
        kit.give_held(colour);
    }
    ImGui::EndPopup();
}

template <typename Enum, std::size_t N>
std::array<Item, N> items_of(std::string_view command, const std::array<const char*, N>& titles) {
    std::array<Item, N> items;
    for (std::size_t i = 0; i < N; ++i) {
        items[i] = {std::string(command) + " " + std::string(file_name_of(static_cast<Enum>(i))), titles[i], true};
    }
    return items;
}

}  // namespace

ToolSpec tool_like(const ToolSpec& tool, ToolKind kind) {
    double r = tool.sizes_m[tool.kind == ToolKind::cone ? 1 : 0];
    if (tool.kind == ToolKind::box) r *= 0.5;
    if (tool.kind == ToolKind::mesh || !(r > 0.0)) r = 0.005;
    r = rounded(std::min(r, 1.0), 3);
    const auto sizes = [](double a, double b, double c) {
        return std::array{rounded(a, 4), rounded(b, 4), rounded(c, 4)};
    };
    switch (kind) {
        case ToolKind::ball: return {kind, sizes(r, 0.0, 0.0), {}};
        case ToolKind::cylinder: return {kind, sizes(r, 4.0 * r, 0.0), {}};
        case ToolKind::cone: return {kind, sizes(0.0, r, 3.0 * r), {}};
        case ToolKind::bullnose: return {kind, sizes(r, 0.25 * r, 4.0 * r), {}};
        case ToolKind::box: return {kind, sizes(2.0 * r, 2.0 * r, 2.0 * r), {}};
        case ToolKind::mesh: break;
    }
    return tool;
}

ToolSpec with_size(ToolSpec tool, std::size_t index, double size_m) {
    auto& s = tool.sizes_m;
    s.at(index) = size_m;
    if (tool.kind == ToolKind::cone && s[0] + s[1] <= 0.0) s[1 - index] = range_of(Quantity::radius).from;
    // The corner of a bull-nose is at most its radius and its length: what was not moved gives way.
    if (tool.kind == ToolKind::bullnose && index == 1) {
        s[0] = std::max(s[0], s[1]);
        s[2] = std::max(s[2], s[1]);
    } else if (tool.kind == ToolKind::bullnose) {
        s[1] = std::min({s[0], s[1], s[2]});
    }
    return tool;
}

void show_tool(Kit& kit, const PanelModel& model) {
    const std::string aside =
        model.tool.kind == ToolKind::mesh ? model.tool.file : std::string(file_name_of(model.tool.kind));
    if (kit.begin_card("Tool", aside)) {
        show_tool_kinds(kit, model);
        kit.gap(4.0f);
        auto items = items_of<Operation, kOperations>("operation", {"Cut", "Fill", "Paint", "Smooth"});
        items[3].enabled = model.tool.kind == ToolKind::ball;  // as parse_tool has it
        const auto chosen = kit.segments(items, static_cast<std::size_t>(model.operation));
        if (chosen) kit.give(SetOperation{static_cast<Operation>(*chosen)});
        show_sizes(kit, model);
    }
    kit.end_card();
}

void show_material(Kit& kit, const PanelModel& model) {
    if (kit.begin_card("Material")) {
        show_swatches(kit, model);
        kit.quantity(Quantity::hardness, "Hardness", model.hardness_Ns_per_m3, hardness_text(model.hardness_Ns_per_m3));
    }
    kit.end_card();
}

void show_touch(Kit& kit, const PanelModel& model) {
    if (kit.begin_card("Touch")) {
        if (kit.toggle("force", "Force", model.touch.force_on)) kit.give(SetForce{!model.touch.force_on});
        kit.quantity(Quantity::stiffness, "Stiffness", model.stiffness_N_per_m,
                     written("%.0f N/m", model.stiffness_N_per_m));
        kit.quantity(Quantity::friction, "Friction", model.friction, written("%.2f", model.friction));
        kit.quantity(Quantity::velocity_filter, "Velocity filter", model.velocity_filter,
                     filter_text(model.velocity_filter));
        kit.quantity(Quantity::force_filter, "Force filter", model.force_filter, filter_text(model.force_filter));
    }
    kit.end_card();
}

void show_workspace(Kit& kit, const PanelModel& model) {
    const std::string phase = text(model.phase);  // up to the colon it says what, and then what to do
    const bool fits = phase.size() < 30;
    if (kit.begin_card("Workspace", fits ? phase : phase.substr(0, phase.find_first_of(":;")))) {
        if (!fits) kit.paragraph(kDim, phase);
        const auto items = items_of<WorkspaceTechnique, kTechniques>(
            "technique", {"Fixed", "Moving box", "Scaling", "Clutching", "Bubble", "Drift"});
        const auto chosen = kit.list("technique", "Technique", items, static_cast<std::size_t>(model.technique));
        if (chosen) kit.give(SetTechnique{static_cast<WorkspaceTechnique>(*chosen)});
        kit.quantity(Quantity::scale, "Scale", model.scale, written("\xC3\x97 %.3g", model.scale));
    }
    kit.end_card();
}

void show_view(Kit& kit, const PanelModel& model) {
    if (kit.begin_card("View")) {
        std::array<Item, kStereoModes> modes;
        for (const StereoMode mode : stereo_modes()) {
            std::string title(title_of(mode));
            title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
            modes[static_cast<std::size_t>(mode)] = {"stereo-mode " + std::string(file_name_of(mode)), title, true};
        }
        const auto mode = kit.list("stereo-mode", "Stereo", modes, static_cast<std::size_t>(model.stereo_mode));
        if (mode) kit.give(SetStereoMode{static_cast<StereoMode>(*mode)});
        kit.paragraph(kDim, purpose_of(model.stereo_mode));
        if (kit.toggle("swap-eyes", "Exchange eyes", model.eyes_swapped)) kit.give(SetEyeSwap{!model.eyes_swapped});
        if (kit.toggle("show-force", "Arrow of the force", model.force_shown)) {
            kit.give(SetForceShown{!model.force_shown});
        }
        kit.quantity(Quantity::eye_distance, "Eye distance", model.eye_distance_m,
                     written("%.1f mm", 1e3 * model.eye_distance_m));
        const auto patterns = items_of<TestPattern, 4>("test-pattern", {"Scene", "Eyes", "Ghosts", "Grid"});
        const auto pattern = kit.segments(patterns, static_cast<std::size_t>(model.test_pattern));
        if (pattern) kit.give(SetTestPattern{static_cast<TestPattern>(*pattern)});
    }
    kit.end_card();
}

namespace {

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
    const bool ready = !model.export_progress && !memory.path.empty();
    const bool pressed = kit.button("export", "Export", button, ready, true);
    if (pressed || (entered && ready)) kit.give(ExportTo{memory.path});
}

}  // namespace

void show_history(Kit& kit, const PanelModel& model) {
    if (kit.begin_card("History and export")) {
        const float half = 0.5f * (kit.width() - kit.px(6.0f));
        const auto counted = [](const char* name, std::uint32_t count) {
            return count > 0 ? std::string(name) + "  " + std::to_string(count) : std::string(name);
        };
        if (kit.button("undo", counted("Undo", model.undo_count), half, model.undo_count > 0)) {
            kit.give(RunAction{Action::undo});
        }
        ImGui::SameLine(0.0f, kit.px(6.0f));
        if (kit.button("redo", counted("Redo", model.redo_count), half, model.redo_count > 0)) {
            kit.give(RunAction{Action::redo});
        }
        show_path(kit, model);
        if (model.export_progress) {
            kit.progress(*model.export_progress, written("exporting, %.0f %%", 100.0 * *model.export_progress));
        }
        if (!model.message.empty()) kit.paragraph(kDim, model.message);
    }
    kit.end_card();
}

}  // namespace burin::panel
