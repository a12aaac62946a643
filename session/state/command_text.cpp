// SPDX-License-Identifier: MIT
// Formats commands as words, and says whose each is.
#include <charconv>

#include "session/state/command_table.hpp"

namespace burin::session {

namespace {

std::string on_off(bool on) { return on ? "on" : "off"; }

struct Printer {
    CommandInput operator()(const RunAction& c) const { return {std::string(name_of(c.action)), {}}; }
    CommandInput operator()(const SetTool& c) const { return {"tool", {toolbox::text_of(c.tool)}}; }
    CommandInput operator()(const SetOperation& c) const {
        return {"operation", {std::string(toolbox::descriptor_of(c.operation).name)}};
    }
    CommandInput operator()(const SetColour& c) const { return {"colour", {exact_word(c.srgb)}}; }
    CommandInput operator()(const SetMaterial& c) const {
        return {"material", {std::string(toolbox::feel_presets()[static_cast<std::size_t>(c.preset)].name)}};
    }
    CommandInput operator()(const SetQuantity& c) const {
        return {std::string(descriptor_of(c.quantity).name), {exact_word(c.value)}};
    }
    CommandInput operator()(const SetTechnique& c) const {
        return {"technique", {std::string(descriptor_of(c.technique).name)}};
    }
    CommandInput operator()(const SetStereoMode& c) const {
        return {"stereo-mode", {std::string(file_name_of(c.mode))}};
    }
    CommandInput operator()(const SetTestPattern& c) const {
        return {"test-pattern", {std::string(file_name_of(c.pattern))}};
    }
    CommandInput operator()(const SetEyeSwap& c) const { return {"swap-eyes", {on_off(c.on)}}; }
    CommandInput operator()(const SetEdgeComfort& c) const {
        return {"edge-comfort", {std::string(name_of(c.comfort))}};
    }
    CommandInput operator()(const SetForce& c) const { return {"force", {on_off(c.on)}}; }
    CommandInput operator()(const SetAmplifiers& c) const { return {"amplifiers", {on_off(c.on)}}; }
    CommandInput operator()(const ExportTo& c) const { return {"export", {c.path}}; }
    CommandInput operator()(const QuitDiscard&) const { return {"quit", {"discard"}}; }
    CommandInput operator()(const SaveTo& c) const {
        return {"save", c.path.empty() ? std::vector<std::string>{} : std::vector<std::string>{c.path}};
    }
    CommandInput operator()(const QuitSave&) const { return {"quit", {"save"}}; }
    CommandInput operator()(const QuitStay&) const { return {"quit", {"stay"}}; }
    CommandInput operator()(const SaveAs& c) const {
        CommandInput input{"save-as", {c.path}};
        if (c.is != NameIs::given) input.arguments.emplace_back(name_states()[static_cast<std::size_t>(c.is)]);
        return input;
    }
    CommandInput operator()(const TellDocument& c) const {
        const DocumentTold& t = c.told;
        const std::string kept = std::to_string(t.kept) + "/" + std::to_string(t.strokes);
        return {"document",
                {std::string(document_states()[static_cast<std::size_t>(t.is)]), t.name, t.has_file ? "file" : "new",
                 t.keeps ? kept : "none", std::to_string(t.saves)}};
    }
    CommandInput operator()(const ScreenshotTo& c) const { return {"screenshot", {c.path}}; }
    CommandInput operator()(const SetForceShown& c) const { return {"show-force", {on_off(c.on)}}; }
    CommandInput operator()(const DoAct& c) const { return {"do", c.words}; }
    CommandInput operator()(const SelectObject& c) const { return {"select", {c.object}}; }
    CommandInput operator()(const SetMirror& c) const { return {"mirror", {toolbox::name_of(c.mirror)}}; }
    CommandInput operator()(const SetMouse& c) const { return {"mouse", {std::string(name_of(c.mode))}}; }
    CommandInput operator()(const LeadHand& c) const { return {"hand", {c.hand}}; }
    CommandInput operator()(const EditObject& c) const {
        const scene::PropertyDescriptor& property = scene::descriptor_of(c.property);
        std::string value = property.numbers == 0 ? on_off(c.value[0] != 0.0) : exact_word(c.value[0]);
        for (std::size_t i = 1; i < property.numbers; ++i) value += "," + exact_word(c.value.at(i));
        return {"object", {c.object, std::string(property.name), value}};
    }
    CommandInput operator()(const CalibrateHandle& c) const {
        return {"calibrate", c.reset ? std::vector<std::string>{"reset"} : std::vector<std::string>{}};
    }
    CommandInput operator()(const SetCatchDrill& c) const { return {"catch-drill", {on_off(c.on)}}; }
};

// The commands with arguments that are a viewer's.
struct OfAViewer {
    template <typename Command>
    bool operator()(const Command&) const {
        return false;
    }
    bool operator()(const RunAction& run) const { return is_of_a_viewer(run.action); }
    bool operator()(const SetQuantity& c) const { return descriptor_of(c.quantity).set == nullptr; }
    bool operator()(const SetStereoMode&) const { return true; }
    bool operator()(const SetTestPattern&) const { return true; }
    bool operator()(const SetEyeSwap&) const { return true; }
    bool operator()(const SetEdgeComfort&) const { return true; }
    bool operator()(const SetForceShown&) const { return true; }
    bool operator()(const SelectObject&) const { return true; }
};

}  // namespace

// By name, so that an action that is new has to be the session's or a viewer's.
bool is_of_a_viewer(Action action) {
    switch (action) {
        case Action::undo:
        case Action::redo:
        case Action::tool_1:
        case Action::tool_2:
        case Action::tool_3:
        case Action::tool_4:
        case Action::tool_5:
        case Action::smaller_radius:
        case Action::larger_radius:
        case Action::next_workspace_technique:
        case Action::take_screenshot:
        case Action::export_mesh:
        case Action::save_session:
        case Action::save_as:
        case Action::next_hand:
        case Action::put_away:
        case Action::quit: return false;
        case Action::next_stereo_mode:
        case Action::swap_eyes:
        case Action::toggle_panel:
        case Action::toggle_help:
        case Action::toggle_frame_figures:
        case Action::toggle_devices:
        case Action::toggle_full_screen:
        case Action::reset_view:
        case Action::fit_view:
        case Action::fit_object:
        case Action::view_front:
        case Action::view_side:
        case Action::view_top:
        case Action::view_back:
        case Action::view_left:
        case Action::view_bottom:
        case Action::turn_left:
        case Action::turn_right:
        case Action::turn_up:
        case Action::turn_down:
        case Action::roll_left:
        case Action::roll_right:
        case Action::first_steps: return true;
    }
    return false;
}

bool is_of_a_viewer(const SessionCommand& command) { return std::visit(OfAViewer{}, command); }

CommandInput as_input(const SessionCommand& command) { return std::visit(Printer{}, command); }

}  // namespace burin::session
