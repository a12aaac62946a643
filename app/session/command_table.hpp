// SPDX-License-Identifier: MIT
// Everything that a session can be told to do, by name: panel, keys, scripts and replays all say it in these words, so that they cannot
// differ. Each command has its arguments, one line of help and a parser that gives a typed value.
// Numbers are SI; what is printed reads back to the same bits. Pure; any thread.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/session/desk_input_table.hpp"
#include "app/session/input_event.hpp"
#include "base/error.hpp"
#include "compute/tool.hpp"
#include "haptics/workspace/technique.hpp"
#include "renderer/output/stereo_mode.hpp"

namespace burin {

// A tool's shape in the words of --tool (app/tool_option.hpp): what the session hands to parse_tool.
enum class ToolKind : std::uint8_t { ball, cylinder, cone, bullnose, box, mesh };
inline constexpr std::size_t kToolKinds = 6;
struct ToolSpec {
    ToolKind kind = ToolKind::ball;
    // ball: R; cylinder: R, L; cone: tip R, top R, L; bullnose: R, corner, L; box: X, Y, Z; mesh: none. The rest is 0.
    std::array<double, 3> sizes_m{0.005, 0.0, 0.0};
    std::string file;  // of a mesh

    bool operator==(const ToolSpec&) const = default;
};
[[nodiscard]] std::string_view file_name_of(ToolKind kind);  // "bullnose"
[[nodiscard]] std::string text_of(const ToolSpec& tool);     // "bullnose:0.005,0.001,0.02"
// What each size is called, as many as there are: "radius", "length".
[[nodiscard]] std::span<const std::string_view> size_names(ToolKind kind);
[[nodiscard]] Result<ToolSpec> parse_tool_spec(std::string_view text);

[[nodiscard]] std::string_view file_name_of(Operation operation);
[[nodiscard]] std::string_view file_name_of(WorkspaceTechnique technique);
inline constexpr std::size_t kOperations = 4, kTechniques = 6;

// The commands. Those without arguments that keys have too are an Action each.
struct RunAction {
    Action action = Action::undo;
    bool operator==(const RunAction&) const = default;
};
struct SetTool {
    ToolSpec tool;
    bool operator==(const SetTool&) const = default;
};
struct SetOperation {
    Operation operation = Operation::cut;
    bool operator==(const SetOperation&) const = default;
};
struct SetColour {  // of what the tool leaves; sRGB, 0 to 1
    std::array<double, 3> srgb{};
    bool operator==(const SetColour&) const = default;
};
// A number that the session keeps.
enum class Quantity : std::uint8_t {
    radius,           // m, of a ball, or of the other tools' first radius
    hardness,         // N s/m^3
    friction,         // Coulomb's mu
    stiffness,        // N/m
    velocity_filter,  // a of the moving average, 0: none
    force_filter,     // likewise
    scale,            // position gain of the workspace
    eye_distance,     // m
};
struct SetQuantity {
    Quantity quantity = Quantity::radius;
    double value = 0.0;
    bool operator==(const SetQuantity&) const = default;
};
struct SetTechnique {
    WorkspaceTechnique technique = WorkspaceTechnique::fixed;
    bool operator==(const SetTechnique&) const = default;
};
struct SetStereoMode {
    StereoMode mode = StereoMode::mono;
    bool operator==(const SetStereoMode&) const = default;
};
struct SetTestPattern {
    TestPattern pattern = TestPattern::none;
    bool operator==(const SetTestPattern&) const = default;
};
struct SetEyeSwap {
    bool on = false;
    bool operator==(const SetEyeSwap&) const = default;
};
struct SetForce {  // off: the device is held at zero force
    bool on = true;
    bool operator==(const SetForce&) const = default;
};
struct SetForceShown {  // an arrow at the tool
    bool on = false;
    bool operator==(const SetForceShown&) const = default;
};
struct ExportTo {
    std::string path;
    bool operator==(const ExportTo&) const = default;
};
struct ScreenshotTo {
    std::string path;
    bool operator==(const ScreenshotTo&) const = default;
};

using SessionCommand =
    std::variant<RunAction, SetTool, SetOperation, SetColour, SetQuantity, SetTechnique, SetStereoMode, SetTestPattern,
                 SetEyeSwap, SetForce, SetForceShown, ExportTo, ScreenshotTo>;

// What a quantity may be: names, bounds that the parser holds it to, and what the panel offers.
struct QuantityRange {
    Quantity quantity;
    std::string_view name;  // of the command
    std::string_view unit;
    double least, most;  // allowed
    double from, to;     // offered by the panel; the upper end may be exceeded by a command
    bool by_ratio;       // the panel's steps are factors
};
[[nodiscard]] const QuantityRange& range_of(Quantity quantity);

struct CommandSpec {
    std::string_view name;
    std::string_view arguments;  // "R" or "ball:R | cylinder:R,L"; empty: none. In [ ]: may be left out
    std::string_view help;       // a line
};
// In the order in which they are listed to people.
[[nodiscard]] std::span<const CommandSpec> commands();

// The Error names the command, what is wrong with it, and what would be right.
[[nodiscard]] Result<SessionCommand> parse_command(const CommandInput& input);
// "tool ball:0.004": words as app/session/input_words.hpp has them; a line of a script.
[[nodiscard]] Result<SessionCommand> parse_command_line(std::string_view line);
// parse_command(as_input(c)) is c.
[[nodiscard]] CommandInput as_input(const SessionCommand& command);
// As --material has it: "204,51,26" (app/tool_option.hpp).
[[nodiscard]] std::string material_text(const SetColour& colour);

}  // namespace burin
