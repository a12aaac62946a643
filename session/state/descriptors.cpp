// SPDX-License-Identifier: MIT
// Describes the workspace techniques and the quantities that a session keeps.
#include <charconv>

#include "session/input/actions.hpp"
#include "session/state/command_table.hpp"
#include "session/state/session_command.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {
namespace {

constexpr TechniqueDescriptor described(haptics::WorkspaceTechnique technique) {
    switch (technique) {
        case haptics::WorkspaceTechnique::fixed: return {technique, "fixed", "Fixed"};
        case haptics::WorkspaceTechnique::moving: return {technique, "moving", "Moving box"};
        case haptics::WorkspaceTechnique::scaling: return {technique, "scaling", "Scaling"};
        case haptics::WorkspaceTechnique::clutching: return {technique, "clutching", "Clutching"};
        case haptics::WorkspaceTechnique::bubble: return {technique, "bubble", "Bubble"};
        case haptics::WorkspaceTechnique::drift: return {technique, "drift", "Drift"};
    }
    return {};
}
constexpr std::array kTechniques = table_of<haptics::WorkspaceTechnique, described>();

// Rounds to nine significant digits, as sessions have always kept radius and hardness; so an old recording replays to
// the same bits.
double nine_digits(double value) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9).ptr;
    double rounded = value;
    std::from_chars(text.data(), end, rounded);
    return rounded;
}

void set_radius(SessionState& s, double radius_m) {
    s.led().tool.shape = toolbox::resized(s.led().tool.shape, nine_digits(radius_m));
}

void set_hardness(SessionState& s, double hardness_Ns_per_m3) {
    s.feel = toolbox::with_hardness(s.feel, nine_digits(hardness_Ns_per_m3 / toolbox::kHardnessUnit_Ns_per_m3));
}

using State = SessionState;

struct Words {
    std::string_view name, unit, argument, help;
};
struct Range {
    double least, most, from, to;
    bool by_ratio = false;
};
constexpr QuantityDescriptor row(Quantity quantity, const Words& w, const Range& r, QuantityConcern concern,
                                 double (*value)(const State&), void (*set)(State&, double)) {
    return {quantity, w.name, w.unit,     w.argument, w.help, r.least, r.most,
            r.from,   r.to,   r.by_ratio, concern,    value,  set};
}

// Bounds: lengths up to 10 m, as for all lengths in the input log; a filter's factor a below 1, or it would never
// respond; an eye distance that no human head exceeds (Dodgson 2004: 52 to 78 mm), and 0 for two identical pictures.
constexpr QuantityDescriptor described_quantity(Quantity quantity) {
    constexpr auto kTool = QuantityConcern::tool_and_touch, kTouch = QuantityConcern::touch;
    switch (quantity) {
        case Quantity::radius:
            return row(
                quantity,
                {"radius", "m", "R", "The tool's radius in metres; sizes of other tools than a ball go along"},
                {1e-6, 10.0, 0.0005, 0.05, true}, kTool,
                [](const State& s) { return toolbox::half_width_m(s.led().tool.shape); }, set_radius);
        case Quantity::hardness:
            return row(
                quantity, {"hardness", "N s/m3", "H", "How hard the material is to cut, in N s/m3"},
                {0.0, 1e12, 1e4, 1e8, true}, kTool,
                [](const State& s) { return toolbox::touch_material(s.feel).hardness_Ns_per_m3; }, set_hardness);
        case Quantity::friction:
            return row(
                quantity, {"friction", "", "MU", "Friction of the surface, Coulomb's coefficient"},
                {0.0, 10.0, 0.0, 1.0}, kTool,
                [](const State& s) { return toolbox::touch_material(s.feel).dynamic_friction; },
                [](State& s, double value) { s.feel.friction = value; });
        case Quantity::stiffness:
            return row(
                quantity, {"stiffness", "N/m", "K", "Stiffness of the surface in N/m"}, {0.0, 1e6, 50.0, 2000.0, true},
                kTool, [](const State& s) { return toolbox::touch_material(s.feel).stiffness_N_per_m; },
                [](State& s, double value) { s.feel.stiffness_N_per_m = value; });
        case Quantity::velocity_filter:
            return row(
                quantity, {"velocity-filter", "", "A", "Moving average of the velocity, weight of the past; 0: none"},
                {0.0, 0.999, 0.0, 0.99}, kTouch, [](const State& s) { return s.led().velocity_filter; },
                [](State& s, double value) { s.led().velocity_filter = value; });
        case Quantity::force_filter:
            return row(
                quantity, {"force-filter", "", "A", "Moving average of the force, weight of the past; 0: none"},
                {0.0, 0.999, 0.0, 0.99}, kTouch, [](const State& s) { return s.led().force_filter; },
                [](State& s, double value) { s.led().force_filter = value; });
        case Quantity::scale:
            return row(
                quantity, {"scale", "", "G", "How much larger motions in the scene are than the hand's"},
                {1e-3, 1e3, 0.1, 20.0, true}, kTouch, [](const State& s) { return s.led().workspace_gain; },
                [](State& s, double value) { s.led().workspace_gain = value; });
        case Quantity::eye_distance:
            return row(quantity, {"eye-distance", "m", "D", "Distance between the eyes in metres"},
                       {0.0, 0.1, 0.0, 0.08}, QuantityConcern::picture, nullptr, nullptr);
        case Quantity::strength:
            return row(
                quantity,
                {"strength", "", "S", "How deep a stroke of the mouse on a surface is, in half widths of the tool"},
                {kLeastStrength, kMostStrength, 0.05, 1.0, true}, QuantityConcern::picture, nullptr, nullptr);
    }
    return {};
}
constexpr std::array kQuantities = table_of<Quantity, described_quantity>();

}  // namespace

std::span<const TechniqueDescriptor> techniques() { return kTechniques; }
const TechniqueDescriptor& descriptor_of(haptics::WorkspaceTechnique technique) {
    return kTechniques.at(static_cast<std::size_t>(technique));
}

std::span<const QuantityDescriptor> quantities() { return kQuantities; }
const QuantityDescriptor& descriptor_of(Quantity quantity) {
    return kQuantities.at(static_cast<std::size_t>(quantity));
}

}  // namespace burin::session
