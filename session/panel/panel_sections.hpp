// SPDX-License-Identifier: MIT
// What the panel consists of, from top to bottom. For app/session/panel.cpp alone.
#pragma once

#include "app/session/panel_widgets.hpp"

namespace burin::panel {

void show_header(Kit& kit, const PanelModel& model);
void show_tool(Kit& kit, const PanelModel& model);
void show_material(Kit& kit, const PanelModel& model);
void show_touch(Kit& kit, const PanelModel& model);
void show_workspace(Kit& kit, const PanelModel& model);
void show_view(Kit& kit, const PanelModel& model);
void show_history(Kit& kit, const PanelModel& model);
void show_state(Kit& kit, const PanelModel& model);
void show_figures(Kit& kit, const PanelModel& model);
void show_plots(Kit& kit, const PanelModel& model);  // side by side, always in sight
void show_help(Kit& kit);
void show_footer(Kit& kit, const PanelModel& model);

// The tool of another kind that is about as large. Of sizes that a parser takes.
[[nodiscard]] ToolSpec tool_like(const ToolSpec& tool, ToolKind kind);
// With one size changed, and the others where they must follow.
[[nodiscard]] ToolSpec with_size(ToolSpec tool, std::size_t index, double size_m);

}  // namespace burin::panel
