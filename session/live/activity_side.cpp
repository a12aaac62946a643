// SPDX-License-Identifier: MIT
#include "session/live/activity_side.hpp"

#include <algorithm>

namespace burin::session {

void ActivitySide::step(SessionState& state, SessionOrders& orders, Nanoseconds time_ns,
                        const haptics::ToolState& tool) {
    ActivityOrders wanted;
    for (const AskedAct& asked : std::exchange(orders.acts, {})) {
        Result<void> done = check_act(activity_.get(), asked.words);
        if (done) done = activity_->act(asked.words, wanted);
        if (!done) orders.messages.push_back({done.error().line(), asked.line});
    }
    if (!activity_) return;
    activity_->step({time_ns, ticks_, tool, state.world.get()}, wanted);
    ticks_.clear();
    carry_out(std::move(wanted), state, orders);
}

void ActivitySide::carry_out(ActivityOrders wanted, SessionState& state, SessionOrders& orders) {
    for (const EditObject& edit : wanted.edits)
        if (const auto done = run_command(state, orders, edit); !done) orders.messages.push_back({done.error().line()});
    for (const std::string& message : wanted.messages) orders.messages.push_back({message});
    for (const std::string& name : wanted.screenshots) orders.screenshots.push_back({name});
    std::ranges::move(wanted.trials, std::back_inserter(trials_));
    orders.parameters = orders.parameters || wanted.parameters;
    state.quit = state.quit || wanted.quit;
}

}  // namespace burin::session
