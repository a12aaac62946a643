// SPDX-License-Identifier: MIT
// An exercise of a hand in a glove, in a session: the hand of `burin hand` with the rules of an exercise beside it.
//
//   ticks of the fingers -> Grasp (gestures, what is held, the drawn hand) -> turns of the exercise -> events
//   events -> messages, the recording's trials, score and log (report())
// The exercise's rules are pure and know no session (ball_exercise.hpp); this class feeds them.
// Frame: the scene's. One thread, the frame's.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "activities/grasp/grasp.hpp"
#include "activities/rehab/rehab_settings.hpp"
#include "base/json.hpp"

namespace burin::activities {

// Reads what Rehab::settings() has written. Fails on anything else.
[[nodiscard]] Result<BallSettings> ball_settings_of(const std::string& settings);

class Rehab final : public session::Activity {
public:
    // Requires sound settings.
    explicit Rehab(const BallSettings& settings) : settings_(settings), hand_(GraspOptions{}) {}

    [[nodiscard]] std::string settings() const override;
    [[nodiscard]] Result<void> act(std::span<const std::string> words, session::ActivityOrders& orders) override;
    void step(const session::ActivityView& view, session::ActivityOrders& orders) override;
    [[nodiscard]] bool is_running() const override { return true; }
    void adjust(session::PartOfHand of, haptics::TickParameters& parameters) const override {
        hand_.adjust(of, parameters);
    }
    [[nodiscard]] bool draws_hands() const override { return true; }
    void stage(renderer::Scene& scene, std::size_t screen) const override { hand_.stage(scene, screen); }
    [[nodiscard]] session::ActivityPanel panel() const override;

    [[nodiscard]] const BallState& state() const { return state_; }
    [[nodiscard]] const BallSettings& ball() const { return settings_; }
    [[nodiscard]] const std::vector<BallEvent>& events() const { return events_; }
    // Returns settings, score, measures and events.
    [[nodiscard]] Json report() const;

private:
    void tell(const BallEvent& event, session::ActivityOrders& orders);

    BallSettings settings_;
    Grasp hand_;
    bool has_ball_ = false;  // the world's ball has been given its colour and stiffness
    Nanoseconds turn_ns_ = 0;
    BallState state_;
    std::vector<BallEvent> events_;
};

}  // namespace burin::activities
