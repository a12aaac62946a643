// SPDX-License-Identifier: MIT
// A participant's visit on the disk: which stages are left, and the files and the journal of the one that is under way.
// One thread; blocks on the disk.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "activities/train/training_run.hpp"
#include "study/folder/stage_recording.hpp"

namespace burin::activities {

// The stages of the first day that the participant has not ended. Fails where there is none left, where somebody else
// must not go through them, and where the day comes too early or too late by the protocol.
[[nodiscard]] Result<std::vector<study::StagePlace>> places_left(const study::StudyFolder& study,
                                                                 const std::string& participant, bool any_delay,
                                                                 std::int64_t now_utc_ns);

class StageOnDisk {
public:
    // Whether the motion is recorded tick by tick, where the protocol has it recorded, and whose ticks they are.
    enum class Motion { none, ticks, session_ticks };

    // Study and group must outlive it.
    StageOnDisk(study::StudyFolder& study, std::string participant, const study::Group& group, Motion motion)
        : study_(study), participant_(std::move(participant)), group_(group), motion_(motion) {}

    // The run has begun a stage.
    [[nodiscard]] Result<void> begin(const TrainingRun& run);
    void take(const TrainingRun::Ticked& ticked);
    [[nodiscard]] Result<void> take(const std::vector<RunEvent>& events);
    [[nodiscard]] Result<void> end(const EndedStage& ended);
    // Keeps what is recorded, also of a stage that did not come to its end.
    [[nodiscard]] Result<void> close();

private:
    study::StudyFolder& study_;
    std::string participant_;
    const study::Group& group_;
    Motion motion_;
    study::StagePlace at_;
    study::StageFiles files_;
    std::unique_ptr<study::StageRecording> recording_;
};

}  // namespace burin::activities
