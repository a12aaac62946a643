// SPDX-License-Identifier: MIT
#include "scene/scene_service.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/try.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "haptics/tick_record.hpp"
#include "scene/contact_follower.hpp"
#include "scene/scene_changes.hpp"

namespace burin::scene {
namespace {

std::vector<TouchPublisher::Slot*> slots_of(const std::vector<SceneHand>& hands) {
    std::vector<TouchPublisher::Slot*> slots;
    for (const SceneHand& hand : hands) slots.push_back(&hand.channels->surface);
    return slots;
}

}  // namespace

SceneService::SceneService(std::vector<ScenePart*> parts, std::vector<SceneHand> hands)
    : parts_(std::move(parts)), hands_(std::move(hands)), publisher_(slots_of(hands_)) {
    for (const SceneHand& hand : hands_) {
        places_.push_back(hand.start_scene);
        followers_.emplace_back(hand.of);
    }
    sunk_m_.resize(hands_.size());
    seen_.last_ticks.resize(hands_.size());
    seen_.parts.resize(parts_.size());
}

SceneService::~SceneService() = default;

Result<void> SceneService::repeat(const SceneUpdate& recorded) {
    if (recorded.last_ticks.size() > hands_.size() || recorded.parts.size() > parts_.size())
        return fail("the recorded update", "is of more hands or parts than there are", "replay it in its own scene");
    SceneUpdate whole = recorded;
    whole.last_ticks.resize(hands_.size());
    whole.parts.resize(parts_.size());
    return update(recorded.time_ns, &whole);
}

void SceneService::read_ticks(std::size_t hand, std::uint64_t last_tick) {
    Ring<haptics::TickRecord>& ring = hands_[hand].channels->ticks;
    ticks_.clear();
    while (const haptics::TickRecord* oldest = ring.oldest()) {
        if (oldest->tick > last_tick) break;
        ticks_.push_back(*oldest);
        ring.drop();
    }
    if (ticks_.empty()) return;
    const haptics::PointRecord& first = ticks_.back().contact.points[0];
    seen_.last_ticks[hand] = ticks_.back().tick;
    places_[hand] = first.proxy_object_m;
    sunk_m_[hand] = glm::length(first.hip_object_m - places_[hand]);
}

Result<void> SceneService::update(Nanoseconds now_ns, const SceneUpdate* recorded) {
    const Nanoseconds since_ns = now_ns - std::exchange(seen_.time_ns, now_ns);
    seen_.orders = recorded != nullptr ? recorded->orders : 0;
    // While a hand stands still its loop rests and gives a tenth of the ticks: twice as many mean that it moves.
    const auto few = static_cast<std::size_t>(std::max<Nanoseconds>(2 * since_ns / haptics::HapticLoop::kRest_ns, 1));
    hands_move_ = false;
    contacts_.clear();
    for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
        read_ticks(hand, recorded != nullptr ? recorded->last_ticks[hand] : UINT64_MAX);
        hands_move_ = hands_move_ || ticks_.size() > few;
        for (ScenePart* part : parts_) part->take_ticks(hand, ticks_);
        for (const haptics::TickRecord& tick : ticks_) followers_[hand].follow(tick, contacts_);
    }
    std::ranges::stable_sort(contacts_, {}, &ContactEvent::time_ns);
    for (ScenePart* part : parts_) part->take_contacts(contacts_);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const PartSeen* const part_seen = recorded != nullptr ? &recorded->parts[i] : nullptr;
        BURIN_TRY_DO(parts_[i]->update(now_ns, part_seen));
        seen_.parts[i] = parts_[i]->seen();
    }
    for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
        const double reach_m = hands_[hand].reach_m;
        // In something soft the hand is farther from its tool than it moves until the next update.
        const double beyond_m = std::max(sunk_m_[hand] - 0.5 * reach_m, 0.0);
        const ProbeBall ball{hand, places_[hand], hands_[hand].around_m + reach_m + beyond_m};
        BURIN_TRY_DO(publisher_.publish(ball, parts_, now_ns));
    }
    for (ScenePart* part : parts_) part->after_publication();
    return {};
}

void SceneService::take_changes(SceneChanges& changes) {
    for (ScenePart* part : parts_) part->take_changes(changes);
    told_steps_.resize(parts_.size());
    for (std::size_t part = 0; part < parts_.size(); ++part)
        if (const PartSteps steps = parts_[part]->undo_steps(); std::exchange(told_steps_[part], steps) != steps)
            changes.steps.push_back({part, steps});
    std::ranges::move(std::exchange(contacts_, {}), std::back_inserter(changes.hands.contacts));
}

Nanoseconds SceneService::period_ns() const {
    Nanoseconds period_ns = hands_move_ || parts_.empty() ? kHandsMove_ns : parts_.front()->period_ns();
    for (const ScenePart* part : parts_) period_ns = std::min(period_ns, part->period_ns());
    return period_ns;
}

void SceneService::let_lag() {
    for (ScenePart* part : parts_) part->let_lag();
}

void SceneService::finish() {
    for (ScenePart* part : parts_) part->finish();
}

}  // namespace burin::scene
