// SPDX-License-Identifier: MIT
// Commands as words, and what else has a name in them.
#include <charconv>
#include <cmath>

#include "app/session/command_table.hpp"

namespace burin {

namespace {

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, kToolKinds> kToolKindNames{"ball",     "cylinder", "cone",
                                                                  "bullnose", "box",      "mesh"};
constexpr std::array<std::string_view, kOperations> kOperationNames{"cut", "fill", "paint", "smooth"};
constexpr std::array<std::string_view, kTechniques> kTechniqueNames{"fixed",     "moving", "scaling",
                                                                    "clutching", "bubble", "drift"};
constexpr std::array<std::string_view, 3> kRadiusAndLength{"radius", "length"};
constexpr std::array<std::string_view, 3> kConeSizes{"tip radius", "top radius", "length"};
constexpr std::array<std::string_view, 3> kBullNoseSizes{"radius", "corner", "length"};
constexpr std::array<std::string_view, 3> kBoxSizes{"width", "height", "depth"};

// The shortest text that reads back to the same bits.
std::string exact(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string on_off(bool on) { return on ? "on" : "off"; }

struct Printer {
    CommandInput operator()(const RunAction& c) const { return {std::string(name_of(c.action)), {}}; }
    CommandInput operator()(const SetTool& c) const { return {"tool", {text_of(c.tool)}}; }
    CommandInput operator()(const SetOperation& c) const {
        return {"operation", {std::string(file_name_of(c.operation))}};
    }
    CommandInput operator()(const SetColour& c) const {
        return {"colour", {exact(c.srgb[0]) + "," + exact(c.srgb[1]) + "," + exact(c.srgb[2])}};
    }
    CommandInput operator()(const SetQuantity& c) const {
        return {std::string(range_of(c.quantity).name), {exact(c.value)}};
    }
    CommandInput operator()(const SetTechnique& c) const {
        return {"technique", {std::string(file_name_of(c.technique))}};
    }
    CommandInput operator()(const SetStereoMode& c) const {
        return {"stereo-mode", {std::string(file_name_of(c.mode))}};
    }
    CommandInput operator()(const SetTestPattern& c) const {
        return {"test-pattern", {std::string(file_name_of(c.pattern))}};
    }
    CommandInput operator()(const SetEyeSwap& c) const { return {"swap-eyes", {on_off(c.on)}}; }
    CommandInput operator()(const SetForce& c) const { return {"force", {on_off(c.on)}}; }
    CommandInput operator()(const ExportTo& c) const { return {"export", {c.path}}; }
    CommandInput operator()(const ScreenshotTo& c) const { return {"screenshot", {c.path}}; }
    CommandInput operator()(const SetForceShown& c) const { return {"show-force", {on_off(c.on)}}; }
};

}  // namespace

std::string_view file_name_of(ToolKind kind) { return kToolKindNames.at(static_cast<std::size_t>(kind)); }
std::string_view file_name_of(Operation operation) { return kOperationNames.at(static_cast<std::size_t>(operation)); }
std::string_view file_name_of(WorkspaceTechnique technique) {
    return kTechniqueNames.at(static_cast<std::size_t>(technique));
}

std::span<const std::string_view> size_names(ToolKind kind) {
    switch (kind) {
        case ToolKind::ball: return Names(kRadiusAndLength).first(1);
        case ToolKind::cylinder: return Names(kRadiusAndLength).first(2);
        case ToolKind::cone: return kConeSizes;
        case ToolKind::bullnose: return kBullNoseSizes;
        case ToolKind::box: return kBoxSizes;
        case ToolKind::mesh: break;
    }
    return {};
}

std::string text_of(const ToolSpec& tool) {
    std::string text = std::string(file_name_of(tool.kind)) + ":";
    if (tool.kind == ToolKind::mesh) return text + tool.file;
    for (std::size_t i = 0; i < size_names(tool.kind).size(); ++i) text += (i == 0 ? "" : ",") + exact(tool.sizes_m[i]);
    return text;
}

std::string material_text(const SetColour& colour) {
    std::string text;
    for (const double part : colour.srgb) text += (text.empty() ? "" : ",") + std::to_string(std::lround(255.0 * part));
    return text;
}

CommandInput as_input(const SessionCommand& command) { return std::visit(Printer{}, command); }

}  // namespace burin
