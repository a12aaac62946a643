// SPDX-License-Identifier: MIT
#include "session/live/activity_side.hpp"

#include "base/try.hpp"
#include "session/objects/world_objects.hpp"
#include "session/state/session_orders.hpp"
#include "session/state/session_state.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <variant>

namespace burin::session {
namespace {

// Looks at the hands as an activity does.
class HandsViewed {
public:
    HandsViewed(const SessionHands& hands, const HandNews& news, std::span<const haptics::ToolState> tools) {
        for (std::size_t part = 0; part < hands.parts(); ++part) {
            const bool has_ticks = part < news.ticks.size();
            parts_.push_back({hands.name_in_hand(part),
                              has_ticks ? std::span<const haptics::TickRecord>(news.ticks[part])
                                        : std::span<const haptics::TickRecord>(),
                              tools[part]});
        }
        for (std::size_t hand = 0; hand < hands.hands(); ++hand)
            hands_.push_back(
                {hands.name_of_hand(hand), std::span(parts_).subspan(hands.first_part(hand), hands.parts_of(hand))});
    }
    HandsViewed(const HandsViewed&) = delete;
    HandsViewed& operator=(const HandsViewed&) = delete;

    [[nodiscard]] std::span<const HandView> all() const { return hands_; }

private:
    std::vector<PartView> parts_;
    std::vector<HandView> hands_;
};

// Returns the order for the scene, by the numbers that it knows.
Result<HoldOrder> order_of(const HoldObject& wanted, const WorldObjects* world, const SessionHands& hands) {
    if (world == nullptr)
        return fail("object " + wanted.object, "is none of this session", "open a world: burin world FILE");
    BURIN_TRY(id, object_named(*world, wanted.object));
    HoldOrder order{id, {}, wanted.felt};
    for (const PartOfHand& of : wanted.by) {
        const auto number = hands.number_of(of);
        if (!number)
            return fail("object " + wanted.object,
                        "is to be held by part " + std::to_string(of.part) + " of hand " + std::to_string(of.hand) +
                            ", and there is none",
                        "hands and their parts count from 0");
        order.parts.push_back(*number);
    }
    return order;
}

// Returns what a widget gives when a key is pressed.
std::optional<ActivityPanel::ActWords> act_of_key(const ActivityPanel::Widget& widget, Key key) {
    if (const auto* const button = std::get_if<ActivityPanel::Button>(&widget))
        return button->key == key && button->enabled ? std::optional(button->act) : std::nullopt;
    const auto* const choice = std::get_if<ActivityPanel::Choice>(&widget);
    if (choice == nullptr || choice->key != key || !choice->enabled || choice->values.empty()) return std::nullopt;
    return with_value(choice->act, choice->values[(choice->chosen + 1) % choice->values.size()].word);
}

}  // namespace

void ActivitySide::press_keys(std::span<const InputEvent> events, SessionOrders& orders) const {
    if (!activity_) return;
    for (const InputEvent& event : events) {
        const auto* const key = std::get_if<KeyInput>(&event.input);
        if (key == nullptr || key->motion != KeyMotion::press || key->modifiers != Modifiers{}) continue;
        const ActivityPanel now = activity_->panel();
        for (const ActivityPanel::Widget& widget : now.widgets)
            if (auto act = act_of_key(widget, key->key)) orders.acts.push_back({std::move(*act), event.line});
    }
}

void ActivitySide::step(SessionState& state, SessionOrders& orders, Nanoseconds time_ns, const SessionHands& hands,
                        std::span<const haptics::ToolState> tools, Leader& leader) {
    ActivityOrders wanted;
    for (const AskedAct& asked : std::exchange(orders.acts, {})) {
        Result<void> done = check_act(activity_.get(), asked.words);
        if (done) done = activity_->act(asked.words, wanted);
        if (!done) orders.messages.push_back({done.error().line(), asked.line});
    }
    if (!activity_) return;
    {
        const HandsViewed viewed(hands, news_, tools);
        activity_->step({time_ns, viewed.all(), news_.contacts, state.world.get(), drawn_}, wanted);
    }
    ActivityRecord record;
    activity_->write(record);
    std::ranges::move(record.events, std::back_inserter(events_));
    news_ = {};
    drawn_.clear();
    carry_out(std::move(wanted), state, orders, hands, leader);
}

void ActivitySide::carry_out(ActivityOrders wanted, SessionState& state, SessionOrders& orders,
                             const SessionHands& hands, Leader& leader) {
    for (const EditObject& edit : wanted.edits)
        if (const auto done = leader.run(state, orders, edit); !done) orders.messages.push_back({done.error().line()});
    for (const HoldObject& hold : wanted.holds) {
        Result<HoldOrder> order = order_of(hold, state.world.get(), hands);
        if (order)
            orders.holds.push_back(std::move(*order));
        else
            orders.messages.push_back({order.error().line()});
    }
    for (const std::string& message : wanted.messages) orders.messages.push_back({message});
    for (const std::string& name : wanted.screenshots) orders.screenshots.push_back({name});
    std::ranges::move(wanted.trials, std::back_inserter(trials_));
    std::ranges::move(wanted.on_scene, std::back_inserter(on_scene_));
    orders.parameters = orders.parameters || wanted.parameters;
    state.quit = state.quit || wanted.quit;
}

}  // namespace burin::session
