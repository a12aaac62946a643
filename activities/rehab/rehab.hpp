// SPDX-License-Identifier: MIT
// An exercise of a hand in a glove, in a session: the hand of `burin hand` with the rules of an exercise beside it, and
// a body that gives in place of the world's rigid ball.
//
//   ticks of the fingers -> Grasp (gestures, what is held, the drawn hand) -> turns of the exercise -> events
//   events -> messages, the recording's trials, score and log (report())
// The exercise's rules are pure and know no session (ball_exercise.hpp); this class feeds them.
// ticks -> the soft body, a part of the scene (bodies/soft_part.hpp) -> what the fingers feel of it, and its picture
// Frame: the scene's. One thread, the frame's; the body is the scene's.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "activities/grasp/grasp.hpp"
#include "activities/rehab/rehab_settings.hpp"
#include "base/json.hpp"
#include "bodies/soft_part.hpp"

namespace burin::activities {

// Reads what Rehab::settings() has written. Fails on anything else.
[[nodiscard]] Result<BallSettings> ball_settings_of(const std::string& settings);

class Rehab final : public session::Activity {
public:
    // Requires sound settings.
    explicit Rehab(const BallSettings& settings);

    [[nodiscard]] std::string settings() const override;
    [[nodiscard]] Result<void> act(std::span<const std::string> words, session::ActivityOrders& orders) override;
    void step(const session::ActivityView& view, session::ActivityOrders& orders) override;
    [[nodiscard]] bool is_running() const override { return true; }
    void adjust(session::PartOfHand of, haptics::TickParameters& parameters) const override {
        hand_.adjust(of, parameters);
    }
    [[nodiscard]] bool draws_hands() const override { return true; }
    void stage(renderer::Scene& scene, std::size_t screen) const override;
    [[nodiscard]] scene::ScenePart* scene_part() override { return body_.get(); }
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
    std::unique_ptr<bodies::SoftPart> body_;
    bool has_ball_ = false, has_given_way_ = false;  // the world's own has been told to give way to it, and has
    // The body as it was drawn last.
    mutable std::uint64_t drawn_version_ = 0;
    mutable std::shared_ptr<const renderer::DrawnMesh> drawn_;
    Nanoseconds turn_ns_ = 0;
    BallState state_;
    std::vector<BallEvent> events_;
};

}  // namespace burin::activities
