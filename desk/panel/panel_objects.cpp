// SPDX-License-Identifier: MIT
// The panel's section for the objects of a world: which one is chosen, how it feels, how it looks.
#include <array>
#include <cmath>
#include "desk/panel/panel_sections.hpp"

#include "session/objects/object_turn.hpp"

namespace burin::session::panel {
namespace {

using scene::ObjectProperty;

struct SliderRange {
    double from, to;
    bool by_ratio;
};

void give_value(Kit& kit, const PanelObject& object, ObjectProperty property, const scene::PropertyValue& value) {
    kit.give_held(EditObject{object.name, property, value});
}

void show_slider(Kit& kit, const PanelObject& object, ObjectProperty property, std::string_view title,
                 const SliderRange& range, double now, const std::string& text) {
    const std::string label = "object " + std::string(scene::descriptor_of(property).name);
    const auto part = kit.slider(label, title, part_of(now, range.from, range.to, range.by_ratio), text);
    if (!part) return;
    const double wanted = value_at(*part, range.from, range.to, range.by_ratio);
    if (wanted != now) give_value(kit, object, property, {wanted});
}

void show_switch(Kit& kit, const PanelObject& object, ObjectProperty property, std::string_view title, bool on) {
    const std::string label = "object " + std::string(scene::descriptor_of(property).name);
    if (kit.toggle(label, title, on)) kit.give(EditObject{object.name, property, {on ? 0.0 : 1.0}});
}

// Three sliders: about what points up at the turned object's place, to the right and to the viewer.
void show_turns(Kit& kit, const PanelObject& object) {
    constexpr std::array<std::string_view, 3> kTitles{"Turn", "Nod", "Lean"};
    constexpr std::array<double, 3> kMost_deg{180.0, 90.0, 180.0};
    const ObjectTurn now = turn_of(object.orientation);
    for (std::size_t i = 0; i < kTitles.size(); ++i) {
        const std::string label = "object orientation" + (i == 0 ? std::string() : " " + std::string(kTitles.at(i)));
        const auto part = kit.slider(label, kTitles.at(i), part_of(now.at(i), -kMost_deg.at(i), kMost_deg.at(i), false),
                                     written("%.0f\xC2\xB0", std::round(now.at(i)) + 0.0));
        if (!part) continue;
        ObjectTurn wanted = now;
        wanted.at(i) = std::round(value_at(*part, -kMost_deg.at(i), kMost_deg.at(i), false));
        if (std::abs(wanted.at(i) - now.at(i)) < 0.5) continue;
        give_value(kit, object, ObjectProperty::orientation, orientation_value(wanted));
    }
}

// One line for so many points, and why it is less than asked.
void show_rendered_line(Kit& kit, const std::string& name, const scene::RenderedMaterial& rendered) {
    kit.figure(name,
               written("%.0f N/m, ", rendered.stiffness_N_per_m) + written("%.2g N s/m", rendered.damping_Ns_per_m));
    if (rendered.bound == haptics::StiffnessBound::none) return;
    kit.paragraph(kDim, std::string("less than asked: ") + haptics::short_text(rendered.bound), kit.type.small);
}

void show_rendered(Kit& kit, const PanelObject& object) {
    for (const PanelRendered& hand : object.rendered) {
        const std::string of = hand.hand.empty() ? "" : ", " + hand.hand;
        show_rendered_line(kit, hand.all ? "Rendered" + of + ", one point" : "Rendered" + of, hand.one);
        if (hand.all) show_rendered_line(kit, "each, all touching", *hand.all);
    }
    if (object.energy_percent < 2) return;
    kit.paragraph(kDim, written("now the energy account takes %.0f %% of the force", object.energy_percent),
                  kit.type.small);
}

}  // namespace

void show_objects(Kit& kit, const PanelModel& model) {
    if (!model.object) return;
    const PanelObject& object = *model.object;
    if (kit.begin_card("Objects", object.state)) {
        std::vector<Item> items;
        std::size_t chosen_now = 0;
        for (const std::string& name : model.object_names) {
            if (name == object.name) chosen_now = items.size();
            items.push_back({"select " + name, name, true});
        }
        const auto chosen = kit.list("select", "Object", items, chosen_now);
        if (chosen) kit.give(SelectObject{model.object_names[*chosen]});
        const scene::HapticMaterial& m = object.material;
        show_slider(kit, object, ObjectProperty::stiffness, "Stiffness", {20.0, 2000.0, true}, m.stiffness_N_per_m,
                    written("%.0f N/m", m.stiffness_N_per_m));
        show_slider(kit, object, ObjectProperty::damping, "Damping", {0.0, 10.0, false}, m.damping_Ns_per_m,
                    written("%.1f N s/m", m.damping_Ns_per_m));
        show_rendered(kit, object);
        show_slider(kit, object, ObjectProperty::friction, "Friction", {0.0, 1.5, false}, m.dynamic_friction,
                    written("%.2f", m.dynamic_friction));
        show_slider(kit, object, ObjectProperty::scale, "Size", {0.25, 4.0, true}, object.scale,
                    written("\xC3\x97 %.3g", object.scale));
        show_turns(kit, object);
        if (object.own_colours) kit.figure("Colour", "own colours");
        show_swatches(kit, "object colour", object.colour_srgb, [&](const std::array<double, 3>& srgb) {
            give_value(kit, object, ObjectProperty::colour, {srgb[0], srgb[1], srgb[2]});
        });
        show_switch(kit, object, ObjectProperty::seen, "Seen", object.seen);
        show_switch(kit, object, ObjectProperty::felt, "Felt", object.felt);
    }
    kit.end_card();
}

}  // namespace burin::session::panel
