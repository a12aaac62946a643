// SPDX-License-Identifier: MIT
// What lies over all else and moves nothing: messages in a corner, and what the widget under the mouse is for.
#include <algorithm>
#include <optional>

#include "desk/input/desk_input_table.hpp"
#include "desk/panel/panel_sections.hpp"
#include "session/state/command_table.hpp"

namespace burin::session::panel {
namespace {

constexpr float kNoteWidth = 400.0f, kNoteGap = 6.0f, kNoteInset = 12.0f;
// More would hide the picture; all of them are in the log.
constexpr std::size_t kMostNotes = 5;

// A message as it lies in the corner.
struct Note {
    ImU32 colour = kDim;
    std::string title, text;  // one may be empty
    std::uint32_t count = 1;
    bool can_be_put_away = false;
    std::string button, button_text;  // its label; empty: there is none
    SessionCommand command;
};

ImU32 colour_of_kind(MessageKind kind) {
    switch (kind) {
        case MessageKind::info: return kGood;
        case MessageKind::warning: return kWarning;
        case MessageKind::error: return kFault;
    }
    return kDim;
}

// Returns what holds now, until it is over.
std::vector<Note> conditions_of(const PanelModel& model) {
    std::vector<Note> notes;
    const PanelTouch& touch = model.touch;
    if (!touch.force_on) {
        notes.push_back({.colour = kWarning,
                         .title = "Force is switched off",
                         .text = "The device is held at zero; switch it on under Touch.",
                         .button = {},
                         .button_text = {},
                         .command = {}});
    } else if (touch.cause != haptics::GateCause::none && touch.cause != haptics::GateCause::caught) {
        Note note{.colour = kFault,
                  .title = "No force",
                  .text = sentence_of(text(touch.cause)),
                  .button = {},
                  .button_text = {},
                  .command = {}};
        // Whether they can be enabled is the device's to say.
        if (touch.cause == haptics::GateCause::device_fault) {
            note.button = "amplifiers";
            note.button_text = "Enable the amplifiers";
            note.command = SetAmplifiers{true};
        }
        notes.push_back(std::move(note));
    } else if (touch.was_let_go) {
        notes.push_back({.colour = kWarning,
                         .title = "The tool has been let go",
                         .text = "It was caught on the surface while the hand was free. The force has faded out and "
                                 "comes back.",
                         .button = {},
                         .button_text = {},
                         .command = {}});
    }
    for (const std::string& warning : model.warnings)
        notes.push_back(
            {.colour = kWarning, .title = {}, .text = warning, .button = {}, .button_text = {}, .command = {}});
    return notes;
}

std::vector<Note> notes_of(const PanelModel& model) {
    std::vector<Note> notes = conditions_of(model);
    const std::size_t first = model.notes.size() > kMostNotes ? model.notes.size() - kMostNotes : 0;
    for (std::size_t i = first; i < model.notes.size(); ++i) {
        const PanelNote& told = model.notes[i];
        notes.push_back({.colour = colour_of_kind(told.kind),
                         .title = {},
                         .text = told.text,
                         .count = told.count,
                         .can_be_put_away = told.kind != MessageKind::info,
                         .button = {},
                         .button_text = {},
                         .command = {}});
    }
    return notes;
}

ImVec2 size_of_broken(ImFont* font, const std::string& text, float width) {
    if (text.empty()) return {0.0f, 0.0f};
    return font->CalcTextSizeA(font->FontSize, 1e6f, width, text.data(), text.data() + text.size());
}

void write_broken(ImFont* font, ImVec2 at, ImU32 colour, const std::string& text, float width) {
    if (text.empty()) return;
    ImGui::GetWindowDrawList()->AddText(font, font->FontSize, {std::floor(at.x), std::floor(at.y)}, colour, text.data(),
                                        text.data() + text.size(), width);
}

constexpr ImGuiWindowFlags kOver = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;

// Begins a window over all else; it takes no mouse unless it has something to press.
void begin_over(Kit& kit, const std::string& name, ImVec2 lo, ImVec2 size, bool pressed) {
    ImGui::SetNextWindowPos(lo);
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::Begin(name.c_str(), nullptr, kOver | (pressed ? 0 : ImGuiWindowFlags_NoInputs));
    ImGui::PopStyleVar();
    kit.parts.push_back({static_cast<std::uint32_t>(std::max(lo.x, 0.0f)),
                         static_cast<std::uint32_t>(std::max(lo.y, 0.0f)), static_cast<std::uint32_t>(size.x) + 1,
                         static_cast<std::uint32_t>(size.y) + 1});
    kit.places[name] = kit.parts.back();
}

void draw_ground(Kit& kit, ImVec2 lo, ImVec2 size, ImU32 colour) {
    ImDrawList& d = *ImGui::GetWindowDrawList();
    const ImVec2 hi{lo.x + size.x, lo.y + size.y};
    d.AddRectFilled(lo, hi, with_alpha(kGround, 244), kit.px(7.0f));
    d.AddRectFilled(lo, hi, with_alpha(colour, 38), kit.px(7.0f));
    d.AddRectFilled(lo, {lo.x + kit.px(4.0f), hi.y}, colour, kit.px(7.0f), ImDrawFlags_RoundCornersLeft);
}

float height_of(const Kit& kit, const Note& note, float inside) {
    const float gap = !note.title.empty() && !note.text.empty() ? kit.px(2.0f) : 0.0f;
    return size_of_broken(kit.type.strong, note.title, inside).y + gap +
           size_of_broken(kit.type.text, note.text, inside).y + (note.button.empty() ? 0.0f : kit.px(36.0f)) +
           2.0f * kit.px(9.0f);
}

void show_note(Kit& kit, const Note& note, const std::string& name, ImVec2 lo, ImVec2 size, float inside) {
    begin_over(kit, name, lo, size, note.can_be_put_away || !note.button.empty());
    draw_ground(kit, lo, size, note.colour);
    const float left = lo.x + kit.px(4.0f + kNoteInset);
    float y = lo.y + kit.px(9.0f);
    write_broken(kit.type.strong, {left, y}, note.colour, note.title, inside);
    if (!note.title.empty()) y += size_of_broken(kit.type.strong, note.title, inside).y + kit.px(2.0f);
    write_broken(kit.type.text, {left, y}, kText, note.text, inside);
    const float right = lo.x + size.x - kit.px(10.0f), top = lo.y + kit.px(9.0f);
    const std::string times = note.count > 1 ? "\xC3\x97 " + std::to_string(note.count) : std::string();
    const float cross = note.can_be_put_away ? kit.px(18.0f) : 0.0f;
    if (!times.empty()) kit.write_right(right - cross, top, note.colour, times, kit.type.strong);
    if (note.can_be_put_away) {
        ImGui::SetCursorScreenPos(lo);
        const bool clicked = ImGui::InvisibleButton((name + " away").c_str(), size);
        const ImU32 colour = ImGui::IsItemHovered() ? kText : kDim;
        const ImVec2 m{right - kit.px(5.0f), top + kit.px(8.0f)};
        const float r = kit.px(4.0f);
        ImDrawList& d = *ImGui::GetWindowDrawList();
        d.AddLine({m.x - r, m.y - r}, {m.x + r, m.y + r}, colour, kit.px(1.5f));
        d.AddLine({m.x - r, m.y + r}, {m.x + r, m.y - r}, colour, kit.px(1.5f));
        if (clicked) kit.give(RunAction{Action::put_away});
    }
    if (!note.button.empty()) {
        ImGui::SetCursorScreenPos({left, lo.y + size.y - kit.px(9.0f + 28.0f)});
        if (kit.button(note.button, note.button_text, inside)) kit.give(note.command);
    }
    ImGui::End();
}

std::string time_text(Nanoseconds time_ns) {
    const auto s = static_cast<long>(seconds(time_ns));
    const std::string rest = std::to_string(s % 60);
    return std::to_string(s / 60) + (rest.size() < 2 ? ":0" : ":") + rest;
}

}  // namespace

void show_notes(Kit& kit, const PanelModel& model, const Area& free) {
    const std::vector<Note> notes = notes_of(model);
    const float margin = kit.px(kNoteInset);
    const float wide = std::min(kit.px(kNoteWidth), free.hi.x - free.lo.x - 2.0f * margin);
    const float inside = wide - kit.px(4.0f + 2.0f * kNoteInset + 34.0f);  // beside count and cross
    if (inside <= 0.0f) return;
    float bottom = free.hi.y - margin;
    for (std::size_t i = notes.size(); i-- > 0;) {  // the newest is at the bottom
        const float height = height_of(kit, notes[i], inside);
        if (bottom - height < free.lo.y) return;
        show_note(kit, notes[i], "message " + std::to_string(i), {free.lo.x + margin, bottom - height}, {wide, height},
                  inside);
        bottom -= height + kit.px(kNoteGap);
    }
}

void show_log(Kit& kit, const PanelModel& model) {
    if (kit.begin_card("Messages", model.log.empty() ? std::string("none") : std::to_string(model.log.size()))) {
        const ImVec2 lo = kit.visible_lo, hi = kit.visible_hi, at = ImGui::GetCursorScreenPos();
        const ImVec2 size{kit.width(), kit.px(120.0f)};
        kit.visible_lo = {lo.x, std::max(lo.y, at.y)};
        kit.visible_hi = {hi.x, std::min(hi.y, at.y + size.y)};
        ImGui::BeginChild("log", size, false, ImGuiWindowFlags_NoNav);
        for (const PanelNote& note : std::vector<PanelNote>(model.log.rbegin(), model.log.rend())) {
            const std::string times = note.count > 1 ? " (" + std::to_string(note.count) + " times)" : std::string();
            kit.paragraph(note.kind == MessageKind::info ? kDim : colour_of_kind(note.kind),
                          time_text(note.time_ns) + "  " + note.text + times);
        }
        ImGui::EndChild();
        kit.visible_lo = lo;
        kit.visible_hi = hi;
    }
    kit.end_card();
}

std::string tip_of(std::string_view label) {
    const std::string_view name = label.substr(0, label.find(' '));
    if (name == "do") return {};  // an activity's button says itself what it does
    if (name == "object" && label.size() > name.size()) {
        const std::string_view rest = label.substr(name.size() + 1), property = rest.substr(0, rest.find(' '));
        const auto known = std::ranges::find(scene::object_properties(), property, &scene::PropertyDescriptor::name);
        return known == scene::object_properties().end() ? std::string() : std::string(help_of(known->property));
    }
    const auto spec = std::ranges::find(commands(), name, &CommandSpec::name);
    if (spec == commands().end()) return {};
    std::string tip(spec->help), keys;
    for (const ShortCut& cut : short_cuts())
        if (name_of(cut.action) == name) keys += (keys.empty() ? "" : ", ") + label_of(cut);
    return keys.empty() ? tip : tip + (tip.empty() ? "" : " ") + "(" + keys + ")";
}

void show_tip(Kit& kit, const std::string& label, float left) {
    const auto why = kit.why_off.find(label);
    const std::string off = why == kit.why_off.end() ? std::string() : why->second;
    const std::string tip = tip_of(label);
    const auto at = kit.places.find(label);
    if ((off.empty() && tip.empty()) || at == kit.places.end()) return;
    const float most = kit.px(300.0f), inset = kit.px(10.0f);
    const ImVec2 upper = size_of_broken(kit.type.small, off, most), lower = size_of_broken(kit.type.small, tip, most);
    const float gap = off.empty() || tip.empty() ? 0.0f : kit.px(4.0f);
    const ImVec2 size{std::max(upper.x, lower.x) + 2.0f * inset, upper.y + gap + lower.y + kit.px(12.0f)};
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const PixelRect& widget = at->second;
    const auto x = static_cast<float>(widget.x), y = static_cast<float>(widget.y);
    // Beside the panel where there is room, else below the widget, or above it at the picture's end.
    const float below = y + static_cast<float>(widget.height) + kit.px(6.0f);
    ImVec2 lo{left - size.x - kit.px(8.0f), y};
    if (lo.x < 0.0f || x < left)
        lo = {std::min(x, screen.x - size.x), below + size.y <= screen.y ? below : y - size.y - kit.px(6.0f)};
    lo = {std::floor(std::max(lo.x, 0.0f)), std::floor(std::clamp(lo.y, 0.0f, std::max(screen.y - size.y, 0.0f)))};
    begin_over(kit, "tip", lo, size, false);
    draw_ground(kit, lo, size, off.empty() ? kAccent : kWarning);
    write_broken(kit.type.small, {lo.x + inset, lo.y + kit.px(6.0f)}, kWarning, off, most);
    write_broken(kit.type.small, {lo.x + inset, lo.y + kit.px(6.0f) + upper.y + gap}, kText, tip, most);
    ImGui::End();
}

}  // namespace burin::session::panel
