// SPDX-License-Identifier: MIT
#include "session/state/governed.hpp"

#include <string>
#include <tuple>

namespace burin::session {
namespace {

// The one list of what is governed: what is compared is what is put back.
template <typename State>
auto governed_part(State& s) {
    return std::tie(s.tool, s.held, s.feel, s.world, s.technique, s.workspace_gain, s.force_filter, s.velocity_filter,
                    s.force_on, s.catch_drill, s.only_touch, s.carves, s.world_from_object, s.world_from_device,
                    s.device_from_read, s.force_shown, s.output.mode, s.output.swap_eyes, s.output.test_pattern,
                    s.edge_comfort);
}

}  // namespace

void keep_governed(const SessionState& before, SessionState& state, SessionOrders& orders) {
    const bool asked =
        !orders.world.empty() || !orders.carving.empty() || governed_part(before) != governed_part(state);
    if (!asked) return;
    governed_part(state) = governed_part(before);
    orders.world.clear();
    orders.carving.clear();
    orders.parameters = true;
    orders.messages.push_back({std::string(kGovernedMessage), orders.line});
}

}  // namespace burin::session
