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

namespace burin::study {

inline constexpr const char* kOperatorEvent = "operator";
// Facts of a session file that replay needs; all are texts.
inline constexpr const char *kProtocolFact = "study protocol", *kWorldFact = "study world", *kGroupFact = "study group",
                            *kStageFact = "study stage";
// Of a live stage: its ticks were a session's, whose surface and parameters are not a stage's. Pose, force on the hand,
// flags and times are in its file, and no contact.
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

    void take(const haptics::TickRecord& record, OperatorAct act);
    // Of what the operator wrote and what became of the stage; times as the ticks'.
    void note(Nanoseconds time_ns, const std::string& name, const std::string& value);
    // All is on the disk when it returns. Fails with why not.
    [[nodiscard]] Result<void> close();

private:
    StageRecording();
    Ring<haptics::TickRecord> ring_;
    std::unique_ptr<record::RecordWriter> writer_;
    std::size_t untaken_ = 0;
};

[[nodiscard]] std::vector<std::pair<std::string, std::string>> facts_of_stage(const std::string& protocol_digest,
                                                                              const Group& group, const Stage& stage,
                                                                              const FeltWorld& world,
                                                                              const StageTouch& touch);

}  // namespace burin::study
