// SPDX-License-Identifier: MIT
// Shows an activity the ticks of one hand of one part, with the contact events that the scene's service makes of them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scene/contact_follower.hpp"
#include "session/activity/activity.hpp"

namespace burin::activities {

class OneHand {
public:
    // Has the activity go on by these ticks, which follow those of the step before.
    void step(session::Activity& activity, std::span<const haptics::TickRecord> ticks, session::ActivityOrders& orders,
              const session::WorldObjects* world = nullptr, const haptics::ToolState& tool = {},
              Nanoseconds time_ns = 0) {
        std::vector<scene::ContactEvent> contacts;
        for (const haptics::TickRecord& tick : ticks) follower_.follow(tick, contacts);
        const std::array parts{session::PartView{{}, ticks, tool}};
        const std::array hands{session::HandView{{}, parts}};
        activity.step({time_ns, hands, contacts, world}, orders);
    }

private:
    scene::ContactFollower follower_;
};

}  // namespace burin::activities
