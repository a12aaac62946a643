// SPDX-License-Identifier: MIT
// A participant's stages one after the other, with an operator: what a live session asks at each frame, and what it
// then shows. The operator begins each stage; between stages nothing is recorded.
//
//   between --start--> in a stage --its end, or next, stop--> ended --take_end()--> between, or finished
//
// Data flow, once a frame: the session's ticks since the frame before and the operator's commands -> study::step of
// each -> frame(): the objects' looks, tick parameters, page, rows, events.
// Commands act with the next tick, so that a recorded motion gives the same stage again.
// No clock, no file, no window; one thread; allocates as the attempt grows. Times are of any clock that only goes on.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "activities/train/ended_stage.hpp"
#include "activities/train/shown_objects.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::activities {

enum class OperatorSays { start, next, pause, go_on, stop, repeat, note };
struct OperatorCommand {
    OperatorSays says = OperatorSays::note;
    std::string text;  // of a note
};
// "start", "next", "pause", "go on", "stop", "repeat", "note TEXT". Fails with what there is.
[[nodiscard]] Result<OperatorCommand> operator_command(std::string_view text);

// A line of the operator's panel.
struct PanelRow {
    std::string name, value;

    bool operator==(const PanelRow&) const = default;
};

// For the record: what the operator did and what became of the stage.
struct RunEvent {
    Nanoseconds time_ns = 0;
    std::string name, value;
};

struct TrainingShown {
    std::string page;                   // what the participant reads; empty: nothing
    std::vector<ShownObject> objects;   // empty where there is no world
    std::optional<StageMoment> moment;  // of the last tick
    bool wand_seen = false;
    std::vector<RunEvent> events;  // since the frame before
};

class TrainingRun {
public:
    enum class Phase { between, in_stage, ended, finished };

    // `places`: the stages still to be done, in order. Protocol, group and worlds must outlive it.
    TrainingRun(const study::Protocol& protocol, const study::Group& group, const FeltWorlds& worlds,
                std::vector<study::StagePlace> places);

    [[nodiscard]] Phase phase() const { return phase_; }
    // The stage under way or just ended, else the next; null when finished.
    [[nodiscard]] const study::StagePlace* place() const;
    [[nodiscard]] const study::FeltWorld* world() const { return world_; }
    // Returns the session of a stage with a world that is under way or just ended; null where there is none.
    [[nodiscard]] const study::StageSession* session() const { return session_ ? &*session_ : nullptr; }

    void command(const OperatorCommand& command, Nanoseconds now_ns);
    // Fails where the command would have no effect now, with why.
    [[nodiscard]] Result<void> check(const OperatorCommand& command) const;
    // Returns whether the stage under way is paused, or will be with the next tick.
    [[nodiscard]] bool paused() const;

    // A tick that a stage with a world has taken, for whoever keeps it.
    struct Ticked {
        const haptics::TickRecord* record = nullptr;  // until the next tick
        study::OperatorAct act = study::OperatorAct::none;
        const study::StageSession* session = nullptr;  // as the tick left it; until the stage is taken
    };
    // Takes a tick of the session; it counts for nothing where no stage with a world is under way. Returns what the
    // operator did with it.
    study::OperatorAct follow(const haptics::TickRecord& record);

    // Takes the time of pages on, and returns what is to be shown now.
    [[nodiscard]] TrainingShown frame(Nanoseconds now_ns);
    // Returns the lines of the operator's panel.
    [[nodiscard]] std::vector<PanelRow> rows() const;

    // Once a stage has ended: what it gave; then the next one waits.
    [[nodiscard]] EndedStage take_end();
    // The operator has stopped: nothing further is begun in this visit.
    [[nodiscard]] bool stopped() const { return stopped_; }

private:
    void begin(Nanoseconds now_ns);
    [[nodiscard]] study::OperatorAct next_act();
    void note_stage_events(Nanoseconds now_ns);
    void take_page_on(Nanoseconds now_ns);
    void say(Nanoseconds now_ns, std::string name, std::string value);

    const study::Protocol& protocol_;
    const study::Group& group_;
    const FeltWorlds& worlds_;
    std::vector<study::StagePlace> places_;
    std::size_t at_ = 0;
    Phase phase_ = Phase::between;
    bool stopped_ = false;

    const study::FeltWorld* world_ = nullptr;
    std::optional<study::StageSession> session_;  // of a stage with a world
    study::StageSetup page_setup_;
    study::StageState page_;
    std::vector<study::StageEvent> page_events_;
    Nanoseconds begun_ns_ = 0;
    double page_time_s_ = 0.0;
    std::size_t events_told_ = 0;
    // What the panel says of the last tick.
    struct LastTick {
        bool touches_wall = false, fault = false;
        double force_N = 0.0;
    };
    std::optional<LastTick> last_;
    std::deque<study::OperatorAct> acts_;
    std::vector<RunEvent> said_;
};

}  // namespace burin::activities
