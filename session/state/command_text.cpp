// SPDX-License-Identifier: MIT
// Formats commands as words.
#include <charconv>

#include "session/state/command_table.hpp"

namespace burin::session {

namespace {

// Returns the shortest text that reads back to the same bits.
std::string exact(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string on_off(bool on) { return on ? "on" : "off"; }

struct Printer {
    CommandInput operator()(const RunAction& c) const { return {std::string(name_of(c.action)), {}}; }
    CommandInput operator()(const SetTool& c) const { return {"tool", {sculpt::text_of(c.tool)}}; }
    CommandInput operator()(const SetOperation& c) const {
        return {"operation", {std::string(sculpt::descriptor_of(c.operation).name)}};
    }
    CommandInput operator()(const SetColour& c) const {
        return {"colour", {exact(c.srgb[0]) + "," + exact(c.srgb[1]) + "," + exact(c.srgb[2])}};
    }
    CommandInput operator()(const SetMaterial& c) const {
        return {"material", {std::string(sculpt::feel_presets()[static_cast<std::size_t>(c.preset)].name)}};
    }
    CommandInput operator()(const SetQuantity& c) const {
        return {std::string(descriptor_of(c.quantity).name), {exact(c.value)}};
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
    CommandInput operator()(const SetMirror& c) const { return {"mirror", {sculpt::name_of(c.mirror)}}; }
    CommandInput operator()(const SetMouse& c) const { return {"mouse", {std::string(name_of(c.mode))}}; }
    CommandInput operator()(const LeadHand& c) const { return {"hand", {c.hand}}; }
    CommandInput operator()(const EditObject& c) const {
        const scene::PropertyDescriptor& property = scene::descriptor_of(c.property);
        std::string value = property.numbers == 0 ? on_off(c.value[0] != 0.0) : exact(c.value[0]);
        for (std::size_t i = 1; i < property.numbers; ++i) value += "," + exact(c.value.at(i));
        return {"object", {c.object, std::string(property.name), value}};
    }
    CommandInput operator()(const CalibrateHandle& c) const {
        return {"calibrate", c.reset ? std::vector<std::string>{"reset"} : std::vector<std::string>{}};
    }
    CommandInput operator()(const SetCatchDrill& c) const { return {"catch-drill", {on_off(c.on)}}; }
};

}  // namespace

CommandInput as_input(const SessionCommand& command) { return std::visit(Printer{}, command); }

}  // namespace burin::session
