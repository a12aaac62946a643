// SPDX-License-Identifier: MIT
// An exercise of a hand in a glove, in a session: the hand of `burin hand`, a body that gives in place of one of the
// world's objects, and the exercise (activities/rehab/exercise/exercise.hpp), which says what comes of it.
//
//   ticks of the fingers -> Grasp (gestures, what is held, the drawn hand) -> turns of the exercise -> its course
//                        -> the soft body, a part of the scene (bodies/soft_part.hpp) -> what the fingers feel of it
//   the body's changes, with the update that the frame takes -> its picture
//   the turns until each finger has pressed once -> the start, with a glove that is worn
//   its events, as they come -> the keeper, which writes them down (activities/rehab/progress/run_journal.hpp)
//   start, pause, rest, stop (activities/rehab/exercise/run_control.hpp) -> whether its clock goes on, with force
//   the turns from then on until the exercise ends -> measures of the hand; course and measures -> report()
// Frame: the scene's. One thread, the frame's; the body is the scene's.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "activities/grasp/grasp.hpp"
#include "activities/rehab/exercise/exercise.hpp"
#include "activities/rehab/exercise/person_range.hpp"
#include "activities/rehab/exercise/run_control.hpp"
#include "base/json.hpp"

namespace burin::activities {

class Rehab final : public session::Activity {
public:
    explicit Rehab(std::unique_ptr<Exercise> exercise);

    [[nodiscard]] std::string settings() const override;
    [[nodiscard]] std::span<const session::Act> acts() const override;
    [[nodiscard]] Result<void> act(std::span<const std::string> words, session::ActivityOrders& orders) override;
    void step(const session::ActivityView& view, session::ActivityOrders& orders) override;
    void write(session::ActivityRecord& record) override;
    [[nodiscard]] std::uint64_t check() const override;
    [[nodiscard]] bool is_running() const override { return true; }
    void adjust(session::PartOfHand of, haptics::TickParameters& parameters) const override;
    [[nodiscard]] bool draws_hands() const override { return true; }
    [[nodiscard]] std::optional<session::LedHand> led_hand() const override { return exercise_->led_hand(); }
    void stage(picture::Picture& scene, std::size_t screen) const override;
    [[nodiscard]] scene::ScenePart* scene_part() override { return body_.get(); }
    [[nodiscard]] session::ActivityPanel panel() const override;

    [[nodiscard]] const Exercise& exercise() const { return *exercise_; }
    // The kind of part that a document keeps the body as, and the most dents of it that are kept.
    static constexpr std::string_view kBodyPart = bodies::kSoftBodyPart;
    static constexpr std::size_t kMostDents = bodies::SoftDents::kMostSteps;
    // Has its body go on as it was saved (SoftPart::load), before the session. Fails where it has none.
    [[nodiscard]] Result<void> load_body(const scene::Pages& pages, const scene::Steps& steps,
                                         std::span<const scene::Pages> each_step, const std::string& where);
    [[nodiscard]] const HandMeasures& measures() const { return measures_; }
    // Has a keeper told how far the run has come: with each event and, while it goes on, each kTells_ns besides, the
    // report and the events since. What it cannot keep is told to the person, once, and tried again.
    using Keeper = std::function<Result<void>(const Json& report, const Json& new_events)>;
    void keep_with(Keeper keeper) { keeper_ = std::move(keeper); }
    // Adds a fact of the run, which does not depend on it, to what a session file keeps of it.
    void add_fact(std::string name, std::string value) { facts_.emplace_back(std::move(name), std::move(value)); }
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> facts() const override { return facts_; }

    // Has report and panel say by what assessment it is fitted to the person: an object with a "text". It changes
    // nothing: the settings have what came of it.
    void fitted_by(Json assessment) { fitted_ = std::move(assessment); }
    // Adds what is told of the run besides, such as a comment, to its report.
    void describe(Json told) { told_ = std::move(told); }
    // Returns settings, score, counts, measures and events.
    [[nodiscard]] Json report() const;
    // Returns why it was broken off: stopped, or by itself before its time began; empty: it was not.
    [[nodiscard]] std::string failure() const;

private:
    void take_over(const session::ActivityView& view, session::ActivityOrders& orders);
    void take_shape(const session::ActivityView& view);
    // Has the body follow what the hand has taken hold of and let go of.
    void carry(std::span<const session::HoldObject> holds, session::ActivityOrders& orders);
    // Has the fingers press once; returns whether the exercise may go on.
    [[nodiscard]] bool has_started(const FingersTurn& fingers, session::ActivityOrders& orders);
    void follow_most_force(const FingersTurn& fingers);
    [[nodiscard]] Json person_range() const;
    void tell_keeper(session::ActivityOrders& orders);
    void turn(ExerciseTurn turn, session::ActivityOrders& orders);
    // Carries out Start, Pause, Rest or Stop.
    [[nodiscard]] Result<void> follow(RunOrder order, session::ActivityOrders& orders);
    [[nodiscard]] Result<void> start_without_presses();
    // Moves times of trials from `first` on to the loop's clock.
    void on_loop_clock(std::vector<session::TrialMark>& trials, std::size_t first) const;
    [[nodiscard]] bool is_asking() const { return asks_ && !start_.is_done(); }
    // Returns whether the device is to give force: not before the start, in a break or when it was stopped.
    [[nodiscard]] bool gives_force() const { return control_.gives_force(); }
    // Make the parts of the panel (rehab_panel.cpp).
    [[nodiscard]] std::string state_text() const;
    [[nodiscard]] session::ActivityPanel::Task task() const;
    [[nodiscard]] std::vector<session::ActivityPanel::Table> tables() const;
    [[nodiscard]] std::vector<session::ActivityPanel::Button> buttons() const;

    static constexpr Nanoseconds kTells_ns = 5'000'000'000, kTriesAgain_ns = 1'000'000'000;

    std::unique_ptr<Exercise> exercise_;
    Grasp hand_;
    std::unique_ptr<bodies::SoftPart> body_;
    std::string object_;                               // the world's, whose place it takes; empty: not known yet
    bool has_given_way_ = false;                       // the world's own
    std::shared_ptr<const picture::DrawnMesh> drawn_;  // the body, as of the update that the frame has taken
    Pose scene_from_drawn_;
    std::optional<Vec3> lies_in_palm_m_;  // by that update
    bool is_lost_ = false;                // the body has fallen so deep that nobody reaches it
    Nanoseconds turn_ns_ = 0;
    std::array<double, kFelt> body_shares_{};  // of each finger's force, in the turn before
    bool asks_ = false, has_asked_ = false,
         has_let_go_ = false;  // each finger to press once, before the exercise begins
    StartCheck start_;
    PersonRange range_;
    double smooth_sum_N_ = 0.0, most_together_N_ = 0.0;  // of all fingers, as measured, over kMostForce_s
    HandMeasures measures_;
    Keeper keeper_;
    std::size_t kept_ = 0;  // events
    Nanoseconds told_keeper_ns_ = 0;
    bool keeper_fails_ = false;
    Json fitted_;  // null: by none
    std::vector<std::pair<std::string, std::string>> facts_;
    RunControl control_;
    Json told_ = Json::object();
    FingersTurn shown_;                       // the last turn's, with forces that are slow enough to be read
    std::vector<session::EventMark> orders_;  // that were followed and are not written yet
    std::size_t written_ = 0;                 // events
};

}  // namespace burin::activities
