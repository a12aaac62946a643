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

// Leaves that an operator gives a visit to depart from the protocol's calendar.
struct VisitLeave {
    bool resumes_late = false;  // begins a stage anew whose interruption is longer ago than resume_within_min
    bool any_delay = false;     // begins a day too early or too late after the day before
};

// The stages of the first day that the participant has not ended, and what of the calendar is not kept by that.
struct VisitPlan {
    std::vector<study::StagePlace> places;
    std::vector<std::string> deviations;  // a sentence each without its stop; none without leave
};
// Asks about this participant alone. Fails where no stage is left, where nobody must go through them (who has
// withdrawn, who is simulated), and, without leave, where the calendar is not kept.
[[nodiscard]] Result<VisitPlan> plan_visit(const study::StudyFolder& study, const std::string& participant,
                                           const VisitLeave& leave, std::int64_t now_utc_ns);
// Writes to the journal that the visit begins, with its deviations from the protocol.
[[nodiscard]] Result<void> begin_visit(study::StudyFolder& study, const std::string& participant,
                                       const study::HeldDevice& held, const VisitPlan& plan);

// Facts of the program that runs a visit, for its recordings: program, version, compiler, settings.
using Provenance = std::vector<std::pair<std::string, std::string>>;

class StageOnDisk {
public:
    // Whether the motion is recorded tick by tick, where the protocol has it recorded.
    enum class Motion { none, ticks };

    // Study and group must outlive it. provenance: facts of the program and its settings for each recording.
    StageOnDisk(study::StudyFolder& study, std::string participant, const study::Group& group, Motion motion,
                study::HeldDevice held, Provenance provenance)
        : study_(study),
          participant_(std::move(participant)),
          group_(group),
          motion_(motion),
          held_(std::move(held)),
          provenance_(std::move(provenance)) {}

    // The run has begun a stage.
    [[nodiscard]] Result<void> begin(const TrainingRun& run);
    void take(const TrainingRun::Ticked& ticked);
    [[nodiscard]] Result<void> take(const std::vector<RunEvent>& events);
    [[nodiscard]] Result<void> end(const EndedStage& ended);
    // Keeps what is recorded, also of a stage that did not come to its end.
    [[nodiscard]] Result<void> close();
    // Returns the stage that was begun last.
    [[nodiscard]] const study::StagePlace& at() const { return at_; }

private:
    study::StudyFolder& study_;
    std::string participant_;
    const study::Group& group_;
    Motion motion_;
    study::HeldDevice held_;
    Provenance provenance_;
    study::StagePlace at_;
    study::StageFiles files_;
    std::unique_ptr<study::StageRecording> recording_;
};

}  // namespace burin::activities
