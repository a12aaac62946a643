// SPDX-License-Identifier: MIT
// Shows which devices and trackers there are, and why others are not.
#include "desk/panel/panel_sections.hpp"

namespace burin::session::panel {

namespace {

void show_device(Kit& kit, const PanelDevice& device) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float whole = kit.width(), height = kit.px(20.0f), left = kit.px(20.0f);
    ImGui::Dummy({whole, height});
    const float middle = at.y + 0.5f * height, top = middle - 0.5f * kit.type.small->FontSize;
    kit.lamp({at.x + kit.px(6.0f), middle}, device.condition);
    const float room = whole - left - kit.size_of(device.state, kit.type.small).x - kit.px(8.0f);
    kit.write({at.x + left, top}, kText, kit.shortened(device.option + " " + device.name, room, kit.type.small),
              kit.type.small);
    kit.write_right(at.x + whole, top, kDim, device.state, kit.type.small);
    ImGui::Indent(left);
    kit.paragraph(kDim, device.cause, kit.type.small);
    if (!device.remedy.empty()) kit.paragraph(kAccent, device.remedy, kit.type.small);
    ImGui::Unindent(left);
    kit.gap(4.0f);
}

}  // namespace

void show_devices(Kit& kit, const PanelModel& model) {
    if (kit.begin_card("Devices")) {
        if (kit.button("toggle-devices", "Close", kit.width())) kit.give(RunAction{Action::toggle_devices});
        if (!model.devices_note.empty()) kit.paragraph(kDim, model.devices_note);
        for (const PanelDevice& device : model.devices) show_device(kit, device);
    }
    kit.end_card();
}

}  // namespace burin::session::panel
