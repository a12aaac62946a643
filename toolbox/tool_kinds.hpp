// SPDX-License-Identifier: MIT
// The kinds of tool and of operation as people name them, one descriptor each. Command line, commands, help, panel,
// input log and tests take names, sizes and rules from here, and nowhere else.
//
// A tool is written KIND:SIZE,SIZE,... in metres, such as "bullnose:0.005,0.001,0.02", or mesh:FILE. Whether its sizes
// suit the workpiece is checked when it is used (compute/tools/tool_spans.hpp). Functions are pure, but for make_shape,
// which reads the file of a mesh; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/descriptor_table.hpp"
#include "base/error.hpp"
#include "base/length_unit.hpp"
#include "compute/tools/tool.hpp"

namespace burin::toolbox {

// In the order of the alternatives of compute::ToolShape.
enum class ToolKind : std::uint8_t { ball, cylinder, cone, bullnose, box, mesh };
inline constexpr std::size_t kToolKinds = std::variant_size_v<compute::ToolShape>;

// Sizes in the order in which they are written, metres; those that a kind does not have are 0.
using ToolSizes = std::array<double, 3>;

struct ToolSpec {
    ToolKind kind = ToolKind::ball;
    ToolSizes sizes_m{0.01, 0.0, 0.0};
    std::string file;                                // of a mesh; empty for other kinds
    std::optional<LengthUnit> units = std::nullopt;  // of that file; none: as it states, else guessed

    bool operator==(const ToolSpec&) const = default;
};

struct ToolSize {
    std::string_view symbol;  // as help writes it: "R"
    std::string_view name;    // as the panel writes it: "radius"; empty: there is no such size
    bool may_be_zero = false;
};

// Relation between the sizes of a kind.
struct SizeRule {
    bool (*holds)(const ToolSizes& sizes_m) = nullptr;  // null: no rule
    std::string_view problem, remedy;                   // of the message when it does not hold
    // Returns sizes that keep the rule, changing others than the one at `kept`; least_m: the least to make a size that
    // has to be above zero.
    ToolSizes (*adapted)(ToolSizes sizes_m, std::size_t kept, double least_m) = nullptr;
};

struct ToolDescriptor {
    ToolKind kind;
    std::string_view name;  // "bullnose"
    // Empty for a kind that a file describes.
    std::array<ToolSize, 3> sizes;
    std::string_view size_remedy;  // of the message about a size that is zero or negative
    SizeRule rule;
    // Sizes of a tool about as wide as a ball of radius 1, from which the panel makes its first sizes; the first that
    // is not zero is the one that measures this width. All zero for a kind that a file describes, which the panel does
    // not offer.
    ToolSizes proportions;
    // Makes the shape of a tool that check_sizes accepts.
    Result<compute::ToolShape> (*make)(const ToolSpec& tool);

    [[nodiscard]] constexpr std::span<const ToolSize> used_sizes() const {
        std::size_t count = 0;
        while (count < sizes.size() && !sizes[count].name.empty()) ++count;
        return std::span(sizes).first(count);
    }
    [[nodiscard]] constexpr bool on_panel() const { return proportions != ToolSizes{}; }
};

// Lists all kinds in the order of ToolKind.
[[nodiscard]] std::span<const ToolDescriptor> tool_kinds();
[[nodiscard]] const ToolDescriptor& descriptor_of(ToolKind kind);
[[nodiscard]] std::string synopsis_of(const ToolDescriptor& kind);  // "bullnose:R,C,L"
[[nodiscard]] std::vector<std::string> tool_synopses();             // of all kinds

// Parses a tool as the option --tool, commands and the input log write it. Checks the sizes, but not that a file can be
// read. Errors name `where`.
[[nodiscard]] Result<ToolSpec> parse_tool_spec(std::string_view text, const std::string& where);
// Formats a tool so that parsing gives the same bits: "bullnose:0.005,0.001,0.02".
[[nodiscard]] std::string text_of(const ToolSpec& tool);
// Fails on a size that is zero or negative where it must not be, and where the kind's rule does not hold.
// A larger tool is a mistake in the unit, on the command line as in a session.
inline constexpr double kMostToolSize_m = 10.0;
[[nodiscard]] Result<void> check_sizes(const ToolSpec& tool, const std::string& where);
// Makes the shape of a tool that check_sizes accepts. Reads the file of a mesh, which must be closed.
[[nodiscard]] Result<compute::ToolShape> make_shape(const ToolSpec& tool);

// Returns about the radius of a ball as wide as the tool; 0 for one that a file describes.
[[nodiscard]] double half_width_m(const ToolSpec& tool);
// Returns the tool with all its sizes in proportion, as wide as a ball of this radius. Not for one that a file
// describes, which keeps its size.
[[nodiscard]] ToolSpec resized(ToolSpec tool, double half_width_m);
// Returns the radius of the ball that the tool is; 0 for other tools.
[[nodiscard]] double ball_radius_m(const ToolSpec& tool);

struct OperationDescriptor {
    compute::Operation operation = compute::Operation::cut;
    std::string_view name;               // as --operation has it
    std::string_view material;           // name of the surface that it leaves, in exported files
    std::array<std::uint8_t, 3> colour;  // of that surface unless the user chooses one; sRGB
};
// Lists all operations in the order of compute::Operation.
[[nodiscard]] std::span<const OperationDescriptor> operations();
[[nodiscard]] const OperationDescriptor& descriptor_of(compute::Operation operation);

}  // namespace burin::toolbox
