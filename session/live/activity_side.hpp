// SPDX-License-Identifier: MIT
// The activity of a live session, if it has one: what its commands tell it, the ticks that it goes on by, and what it
// orders, which is done as if a user had asked for it.
// Threads: the tap is the scene's (session/live/sample_tap.hpp), all else the frame's.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "session/activity/activity.hpp"
#include "session/hands/session_hands.hpp"
#include "session/input/input_event.hpp"
#include "session/live/sample_tap.hpp"
#include "session/state/leader.hpp"

namespace burin::session {

class ActivitySide {
public:
    // Null: the session has no activity, and nothing here does anything.
    explicit ActivitySide(std::shared_ptr<Activity> activity) : activity_(std::move(activity)) {
        if (activity_) tap_.emplace();
    }

    [[nodiscard]] bool is_there() const { return activity_ != nullptr; }
    // Returns the part of the scene by which the ticks and contacts of the hands come; null without an activity.
    [[nodiscard]] SampleTap* tap() { return tap_ ? &*tap_ : nullptr; }
    // Returns what it brings into the scene; null where that is nothing.
    [[nodiscard]] scene::ScenePart* scene_part() { return activity_ ? activity_->scene_part() : nullptr; }
    // Returns Activity::known_m(); 0 without an activity.
    [[nodiscard]] double known_m() const { return activity_ ? activity_->known_m() : 0.0; }
    // Takes, for the next step, what the hands have done, as the scene has read it, and how parts of the scene look.
    void take(HandNews news, std::vector<scene::DrawnShare> drawn) {
        news_.add(std::move(news));
        if (activity_) std::ranges::move(drawn, std::back_inserter(drawn_));
    }
    // Adds the acts of its widgets whose keys are pressed among a step's events.
    void press_keys(std::span<const InputEvent> events, SessionOrders& orders) const;
    // Tells the activity what the step's commands ask of it, and has it go on; changes the state and adds to the orders
    // as it wants. tools: of each part of the hands, by its number.
    void step(SessionState& state, SessionOrders& orders, Nanoseconds time_ns, const SessionHands& hands,
              std::span<const haptics::ToolState> tools, Leader& leader);
    [[nodiscard]] bool is_running() const { return activity_ && activity_->is_running(); }
    void adjust(PartOfHand of, haptics::TickParameters& parameters) const {
        if (activity_) activity_->adjust(of, parameters);
    }
    [[nodiscard]] const BroughtHand* brought_hand() const { return activity_ ? activity_->brought_hand() : nullptr; }
    [[nodiscard]] bool draws_hands() const { return activity_ && activity_->draws_hands(); }
    void stage(picture::Picture& scene, std::size_t screen) const {
        if (activity_) activity_->stage(scene, screen);
    }
    // Returns its section of the panel; none without an activity.
    [[nodiscard]] std::optional<ActivityPanel> panel() const {
        return activity_ ? std::optional(activity_->panel()) : std::nullopt;
    }
    // Returns whether what is felt and seen is the activity's alone (governed.hpp).
    [[nodiscard]] bool governs() const { return activity_ && activity_->governs(); }
    // Returns the trials that it has begun and ended since the last call.
    [[nodiscard]] std::vector<TrialMark> take_trials() { return std::exchange(trials_, {}); }
    // Returns what it wants done on the scene's thread since the last call.
    [[nodiscard]] std::vector<std::function<void()>> take_on_scene() { return std::exchange(on_scene_, {}); }
    // Returns what it has written into the recording since the last call.
    [[nodiscard]] std::vector<EventMark> take_events() { return std::exchange(events_, {}); }
    // Returns Activity::check(); 0 without an activity.
    [[nodiscard]] std::uint64_t check() const { return activity_ ? activity_->check() : 0; }
    // Ends the activity; it is not told of anything afterwards. Does nothing when called again.
    [[nodiscard]] Result<void> finish() {
        const auto ended = std::exchange(activity_, nullptr);
        return ended ? ended->finish() : Result<void>{};
    }

private:
    void carry_out(ActivityOrders wanted, SessionState& state, SessionOrders& orders, const SessionHands& hands,
                   Leader& leader);

    std::shared_ptr<Activity> activity_;
    std::optional<SampleTap> tap_;
    HandNews news_;  // since the last step, as are
    std::vector<scene::DrawnShare> drawn_;
    std::vector<TrialMark> trials_;  // not taken yet, as are
    std::vector<EventMark> events_;
    std::vector<std::function<void()>> on_scene_;
};

}  // namespace burin::session
