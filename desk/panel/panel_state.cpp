// SPDX-License-Identifier: MIT
// Shows the state of the session on the panel: header, devices, causes, plots, figures.
#include <cmath>

#include "desk/panel/panel_sections.hpp"
#include "haptics/channels.hpp"

namespace burin::session::panel {

namespace {

struct FlagText {
    std::uint32_t flag;
    const char* text;
};
// Names the flags that a user can do something about or may wonder at.
constexpr std::array<FlagText, 11> kFlags{{{haptics::kTickCutting, "cutting"},
                                           {haptics::kTickSticking, "sticking"},
                                           {haptics::kTickPaused, "modelling pauses"},
                                           {haptics::kTickGuided, "guided"},
                                           {haptics::kTickRamping, "fading in"},
                                           {haptics::kTickForceSaturated, "at the force limit"},
                                           {haptics::kTickSlewLimited, "force rises at its limit"},
                                           {haptics::kTickStiffnessLimited, "stiffness limited for stability"},
                                           {haptics::kTickPassivityActs, "damped for stability"},
                                           {haptics::kTickNoSurface, "no surface yet"},
                                           {haptics::kTickStaleSurface, "surface out of date"}}};

std::string flags_text(const PanelTouch& touch) {
    std::string text = touch.in_contact ? "in contact" : "in free space";
    for (const FlagText& f : kFlags) {
        if ((touch.flags & f.flag) != 0) text += std::string(", ") + f.text;
    }
    return text;
}

std::string in_ms(const std::optional<double>& ms) { return ms ? written("%.1f ms", *ms) : "-"; }

void show_source(Kit& kit, const PanelSource& source) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float whole = kit.width(), height = kit.px(22.0f);
    ImGui::Dummy({whole, height});
    const float middle = at.y + 0.5f * height, top = middle - 0.5f * kit.type.small->FontSize;
    kit.lamp({at.x + kit.px(6.0f), middle}, source.condition);
    kit.write({at.x + kit.px(20.0f), top}, kText, source.name, kit.type.small);
    kit.write_right(at.x + whole, top, source.condition == Condition::fault ? kFault : kDim, source.detail,
                    kit.type.small);
}

std::string percent_of(std::uint32_t part, std::uint32_t whole) {
    return std::to_string(part) + (whole > 0 ? written("  (%.0f %%)", 100.0 * part / whole) : "");
}

void show_savings(Kit& kit, const PanelSavings& s) {
    kit.gap(4.0f);
    kit.figure("Patches drawn", percent_of(s.drawn, s.patches));
    kit.figure("beside the view", percent_of(s.beside, s.patches));
    kit.figure("turned away", percent_of(s.turned_away, s.patches));
    kit.figure("behind others", percent_of(s.behind, s.patches));
    kit.figure("drawn more coarsely", percent_of(s.coarser, s.patches));
    kit.figure("Picture redrawn", written("%.1f %%", s.redrawn_percent));
    kit.figure("Frames not drawn", std::to_string(s.frames_skipped));
}

}  // namespace

std::string sentence_of(std::string text) {
    constexpr std::string_view kPrefix = "no force: ";
    if (text.starts_with(kPrefix)) text.erase(0, kPrefix.size());
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text + ".";
}

std::string touch_text(const PanelTouch& touch) {
    if (!touch.force_on) return "force is off";
    return touch.cause != haptics::GateCause::none ? text(touch.cause) : flags_text(touch);
}

void show_header(Kit& kit, const PanelModel& model) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float whole = ImGui::GetContentRegionAvail().x, height = kit.px(36.0f);
    ImGui::Dummy({whole, height});
    const float name = kit.write({at.x + kit.px(2.0f), at.y + kit.px(4.0f)}, kText, model.title, kit.type.title);
    const float left = at.x + name + kit.px(12.0f), right = at.x + whole - kit.px(2.0f);
    const float upper = at.y + kit.px(2.0f), lower = at.y + kit.px(18.0f);
    const PanelFigures& f = model.figures;
    std::string fps = f.frames_per_s > 0.0 ? written("%.0f fps", f.frames_per_s) : std::string();
    // What a hand or a head does is seen so much later.
    if (f.frames_per_s > 0.0 && f.motion_to_photon_ms) fps = written("%.0f ms \xC2\xB7 ", *f.motion_to_photon_ms) + fps;
    kit.write_right(right, upper, model.warnings.empty() ? kDim : kWarning, fps, kit.type.small);
    const float room = right - left, beside_fps = room - kit.size_of(fps, kit.type.small).x - kit.px(8.0f);
    kit.write({left, upper}, kText, kit.shortened(model.workpiece.name, beside_fps, kit.type.small), kit.type.small);
    kit.write({left, lower}, kDim, kit.shortened(model.workpiece.size, room, kit.type.small), kit.type.small);
}

void show_state(Kit& kit, const PanelModel& model) {
    if (kit.begin_card("State", flags_text(model.touch).size() < 30 ? flags_text(model.touch) : std::string())) {
        for (const PanelSource& source : model.sources) show_source(kit, source);
        if (flags_text(model.touch).size() >= 30) kit.paragraph(kDim, sentence_of(flags_text(model.touch)));
    }
    kit.end_card();
}

void show_plots(Kit& kit, const PanelModel& model) {
    const float gap = kit.px(8.0f), each = std::floor((ImGui::GetContentRegionAvail().x - 2.0f * gap) / 3.0f);
    kit.plot("Force", written("%.2f N", model.touch.force_N), model.force_N, kAccent, 1.0f, each);
    ImGui::SameLine(0.0f, gap);
    const std::optional<double>&tick_us = model.figures.tick_us, &frame_ms = model.figures.frame_ms;
    kit.plot("Tick", tick_us ? written("%.0f \xC2\xB5s", *tick_us) : "-", model.tick_us, kGood, 100.0f, each);
    ImGui::SameLine(0.0f, gap);
    kit.plot("Frame", frame_ms ? written("%.1f ms", *frame_ms) : "-", model.frame_ms, kBlue, 10.0f, each);
}

void show_figures(Kit& kit, const PanelModel& model) {
    if (kit.begin_card("Figures")) {
        const PanelFigures& f = model.figures;
        kit.figure("Head age when seen", in_ms(f.head_age_ms));
        kit.figure("Motion to photon", in_ms(f.motion_to_photon_ms));
        kit.figure("Touch before sight", in_ms(f.touch_before_sight_ms));
        kit.figure("Cut to sight", in_ms(f.carve_age_ms));
        kit.figure("Drawing", in_ms(f.draw_ms));
        kit.figure("Late ticks, lost samples",
                   std::to_string(model.touch.late_ticks) + ", " + std::to_string(model.touch.dropped_samples),
                   model.touch.late_ticks + model.touch.dropped_samples > 0 ? kWarning : kText);
        if (model.savings) show_savings(kit, *model.savings);
    }
    kit.end_card();
}

}  // namespace burin::session::panel
