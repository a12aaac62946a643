// SPDX-License-Identifier: MIT
#include "session/state/governed.hpp"

namespace burin::session {

void keep_governed(const SessionState& before, SessionState& state, SessionOrders& orders) {
    const bool asked = !orders.world.empty() || !orders.carving.empty() || state.technique != before.technique ||
                       state.workspace_gain != before.workspace_gain || state.force_filter != before.force_filter ||
                       state.velocity_filter != before.velocity_filter;
    if (!asked) return;
    state.tool = before.tool;
    state.held = before.held;
    state.feel = before.feel;
    state.world = before.world;
    state.technique = before.technique;
    state.workspace_gain = before.workspace_gain;
    state.force_filter = before.force_filter;
    state.velocity_filter = before.velocity_filter;
    orders.world.clear();
    orders.carving.clear();
    orders.parameters = true;
    orders.messages.push_back({"tool, objects and workspace are the activity's, and stay as they are", orders.line});
}

}  // namespace burin::session
