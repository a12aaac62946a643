// SPDX-License-Identifier: MIT
// A participant's visit in a live session: the stages of training_run.hpp as the session's activity. The operator's
// words are its acts (`do start`), the page and the operator's rows its section of the panel.
//
// Data flow: ticks of the session -> TrainingRun::follow -> what is seen and felt of the world's objects as
// edits, guidance, force limit and the place of the proxies as tick parameters, and each stage's beginning, notes and
// end to whoever keeps them. Where a frame finds that the start cap was touched, the next tick begins with both proxies
// on the tube's axis there.
// The session's scene must be scene(): the worlds of all stages of the visit (visit_scene.hpp), of which those of the
// stage under way are seen and felt. Where several worlds are there, each tick is followed with the numbers that the
// stage's world gives its objects (study/felt/felt_world.hpp), as its recording has them.
// `do jig` says that the wand stands in its jig. Where it reads farther off than the protocol allows, the stage under
// way is paused, and nothing begins or goes on until it reads right there.
// Frame: the scene's, which is the study world's. Thread: the frame's.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "activities/train/training_run.hpp"
#include "activities/train/visit_scene.hpp"
#include "session/activity/activity.hpp"
#include "session/activity/brought_hand.hpp"
#include "study/felt/trial_marks.hpp"

namespace burin::activities {

// Functions that keep the stages; null ones keep nothing. A failure is shown as a message, and the visit goes on.
struct StageKeeper {
    std::function<Result<void>(const TrainingRun&)> begun;
    std::function<void(const TrainingRun::Ticked&)> tick;
    std::function<Result<void>(const std::vector<RunEvent>&)> events;
    std::function<Result<void>(const EndedStage&)> ended;
    std::function<Result<void>()> closed;  // the session has ended; a stage may be under way
};

// The device in the participant's hand.
struct StudyDevice {
    std::optional<devices::WandDescription> wand = {};  // none: there is no jig
    std::string participant = {};                       // whose hand it is, for the operator; empty: nobody's
    // The wand stands in each stage's world as study::world_from_wand() has it, and all of the scene is known around
    // it; else as the session places a handle, and as far as it moves: so were visits of before December 2026.
    bool placed = false;
    // Leads the wand, or has its samples, in a person's place; none: whoever holds the device.
    std::optional<session::BroughtHand> hand = {};
};

class StudyActivity final : public session::Activity {
public:
    // Protocol, group and worlds must outlive it. facts: what a recording needs of the protocol (recorded_visit.hpp).
    StudyActivity(const study::Protocol& protocol, const study::Group& group, const FeltWorlds& worlds,
                  std::vector<study::StagePlace> places, std::string settings, StudyDevice device, StageKeeper keeper,
                  std::vector<std::pair<std::string, std::string>> facts = {});

    // Returns the scene that the session is opened with.
    [[nodiscard]] const std::shared_ptr<const scene::World>& scene() const { return visit_.scene(); }
    [[nodiscard]] std::string settings() const override { return settings_; }
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> facts() const override { return facts_; }
    [[nodiscard]] std::span<const session::Act> acts() const override;
    [[nodiscard]] Result<void> act(std::span<const std::string> words, session::ActivityOrders& orders) override;
    void step(const session::ActivityView& view, session::ActivityOrders& orders) override;
    [[nodiscard]] bool is_running() const override { return run_.phase() == TrainingRun::Phase::in_stage; }
    [[nodiscard]] const session::BroughtHand* brought_hand() const override {
        return device_.hand ? &*device_.hand : nullptr;
    }
    // All of the scene: points that hang on the wall elsewhere than the hand are within what is known.
    [[nodiscard]] double known_m() const override;
    void adjust(session::PartOfHand of, haptics::TickParameters& parameters) const override;
    // The wand's two points, top red and bottom green, over what the session draws of it; no wand where none is seen.
    void stage(picture::Picture& scene, std::size_t screen) const override;
    [[nodiscard]] session::ActivityPanel panel() const override;
    [[nodiscard]] bool governs() const override { return true; }
    [[nodiscard]] Result<void> finish() override;

    [[nodiscard]] const TrainingRun& run() const { return run_; }
    // Returns what is to be shown since the last step, without the events, which the keeper has been given.
    [[nodiscard]] const TrainingShown& shown() const { return shown_; }
    [[nodiscard]] std::size_t stages_ended() const { return ended_; }

private:
    [[nodiscard]] bool ends_by_operator() const;
    [[nodiscard]] Result<void> check_order(const OperatorCommand& command) const;
    [[nodiscard]] Result<void> check_jig(session::ActivityOrders& orders);
    void begin_stage(session::ActivityOrders& orders);
    void follow(const haptics::TickRecord& tick, session::ActivityOrders& orders);
    void place_proxies(std::size_t known, session::ActivityOrders& orders);
    void show(session::ActivityOrders& orders);
    void show(const std::vector<ShownObject>& objects, session::ActivityOrders& orders);
    void open_world(session::ActivityOrders& orders);
    void press(bool pressed, session::ActivityOrders& orders);
    void note_trials(session::ActivityOrders& orders);
    [[nodiscard]] const haptics::TickRecord& in_stage_world(const haptics::TickRecord& tick);
    void end_stage(session::ActivityOrders& orders);
    void tell(const Result<void>& done, session::ActivityOrders& orders);

    const study::Protocol& protocol_;
    const study::Group& group_;
    VisitScene visit_;
    const study::FeltWorld* world_;  // whose objects can be felt
    std::string settings_;
    std::vector<std::pair<std::string, std::string>> facts_;
    StudyDevice device_;
    StageKeeper keeper_;
    TrainingRun run_;
    study::TrialMarks trials_;  // of the stage under way
    TrainingShown shown_;
    std::map<scene::ObjectId, ShownObject> as_shown_;
    std::optional<bool> tube_pressed_;  // as last ordered
    Nanoseconds now_ns_ = 0;            // of the last tick
    haptics::ProxyPlacement placement_;
    haptics::TickRecord renumbered_;       // the last tick of another world than the first
    Pose reads_device_;                    // where the wand read to be in the last step
    bool starts_with_first_tick_ = false;  // it was started before there was one
    std::string jig_off_;                  // by how much the wand was off in its jig; empty: it was not
    std::string jig_row_;                  // the same as short as the panel has room for
    std::size_t ended_ = 0;
};

}  // namespace burin::activities
