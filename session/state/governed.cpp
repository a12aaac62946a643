// SPDX-License-Identifier: MIT
#include "session/state/governed.hpp"

#include <string>
#include <tuple>

#include "session/state/session_orders.hpp"

namespace burin::session {
namespace {

// The one list of what is governed: what is compared is what is put back.
template <typename State>
auto governed_part(State& s) {
    return std::tie(s.feel, s.world, s.carves, s.world_from_object);
}
template <typename Hand>
auto governed_part_of(Hand& hand) {
    return std::tie(hand.tool, hand.held, hand.technique, hand.workspace_gain, hand.force_filter, hand.velocity_filter,
                    hand.force_on, hand.catch_drill, hand.only_touch, hand.world_from_device, hand.device_from_read);
}

}  // namespace

void keep_governed(const SessionState& before, SessionState& state, SessionOrders& orders, bool viewer_changed) {
    bool asked = viewer_changed || !orders.world.empty() || !orders.carving.empty() ||
                 governed_part(before) != governed_part(state);
    for (std::size_t i = 0; i < state.hands.size(); ++i) {
        asked = asked || governed_part_of(before.hands[i]) != governed_part_of(state.hands[i]);
        governed_part_of(state.hands[i]) = governed_part_of(before.hands[i]);
    }
    if (!asked) return;
    governed_part(state) = governed_part(before);
    orders.world.clear();
    orders.carving.clear();
    orders.parameters = true;
    orders.messages.push_back({std::string(kGovernedMessage), orders.line});
}

void keep_governed(const SessionState& before, SessionState& state, SessionOrders& orders, bool viewer_changed,
                   std::string_view newest) {
    const std::size_t told = orders.messages.size();
    keep_governed(before, state, orders, viewer_changed);
    if (orders.messages.size() > told && orders.line == 0 && newest == kGovernedMessage) orders.messages.pop_back();
}

}  // namespace burin::session
