// SPDX-License-Identifier: MIT
// The motion of a stage on the disk: one session file (record/record_writer.hpp) with every tick of the wand, the acts
// of the operator, and facts that say which protocol, group, stage and world its forces come from.
//
// Data flow: tick record -> ring -> the writer's thread -> blocks of columns -> SQLite, synced.
// A file that an interruption left behind stays and can be read up to its last transaction; the journal says that its
// stage has no end. One thread for each object.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "record/record_writer.hpp"
#include "study/felt/stage_session.hpp"
#include "study/felt/trial_marks.hpp"
#include "study/folder/held_device.hpp"

namespace burin::study {

inline constexpr const char* kOperatorEvent = "operator";
// Facts of a session file that replay needs; all are texts.
inline constexpr const char *kProtocolFact = "study protocol", *kWorldFact = "study world", *kGroupFact = "study group",
                            *kStageFact = "study stage";
// Of a live stage: its ticks were a session's, whose surface and parameters are not a stage's.
inline constexpr const char *kTicksFact = "ticks", *kTicksOfSession = "of a session's own loop";

class StageRecording {
public:
    // Makes the file, which must not exist. Facts: pairs of a key and a text, added to those of the stage.
    [[nodiscard]] static Result<std::unique_ptr<StageRecording>> create(
        const std::filesystem::path& file, const StageTouch& touch,
        std::vector<std::pair<std::string, std::string>> facts, Nanoseconds block_ns);
    ~StageRecording();
    StageRecording(const StageRecording&) = delete;
    StageRecording& operator=(const StageRecording&) = delete;

    // session: as the tick left it. From the clock's start to the end of the attempt a trial stands in the file, by the
    // stage's name: "done" where it ended with a valid exit, else why it failed.
    void take(const haptics::TickRecord& record, OperatorAct act, const StageSession& session);
    // Of what the operator wrote and what became of the stage; times as the ticks'.
    void note(Nanoseconds time_ns, const std::string& name, const std::string& value);
    // All is on the disk when it returns. Fails with why not.
    [[nodiscard]] Result<void> close();

private:
    StageRecording();
    void note_trials(const StageSession& session);

    Ring<haptics::TickRecord> ring_;
    std::unique_ptr<record::RecordWriter> writer_;
    std::string stage_;
    std::size_t untaken_ = 0;
    TrialMarks marks_;
    std::optional<std::int64_t> trial_;  // that is under way
};

// A tick's values in the order of a stage's columns, columns_for() and behind them touched_columns(), where object0 and
// object1 are what each point touches (felt_world.hpp).
[[nodiscard]] std::vector<record::Word> stage_row(const haptics::TickRecord& tick, const record::RowShape& shape);

[[nodiscard]] std::vector<std::pair<std::string, std::string>> facts_of_stage(const std::string& protocol_digest,
                                                                              const Group& group, const Stage& stage,
                                                                              const FeltWorld& world,
                                                                              const StageTouch& touch);
// Facts of who went through a stage and with what; `device` and `hand` as the journal and trials.csv have them.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> facts_of_hand(const std::string& participant,
                                                                             const HeldDevice& held);

}  // namespace burin::study
