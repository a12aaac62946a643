// SPDX-License-Identifier: MIT
// A participant's visit in a live session: the study's worlds as its scene, the activity, and the journal that keeps
// its stages. Whoever prepares a visit runs its session. One thread; blocks on the disk.
#pragma once

#include <memory>
#include <string>

#include "activities/train/participant_device.hpp"
#include "activities/train/stage_on_disk.hpp"
#include "activities/train/study_activity.hpp"
#include "base/error.hpp"
#include "session/options/session_setup.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::activities {

// Returns whether a log is one of a session, by its first line; else it is a script of simulated time.
[[nodiscard]] bool is_session_log(const std::string& file);

// Refuses a recording as a participant's input: what it holds would be counted as theirs.
[[nodiscard]] Result<void> check_visit_input(const std::string& file);

struct LiveVisitOptions {
    std::string participant;
    session::SessionSetup session;
    VisitLeave leave;
    bool records_motion = true;  // where the protocol has it recorded
    Provenance provenance;
};

// The journal has the visit as soon as a stage of it begins: one whose device or window does not open, or that begins
// no stage, has not been.
class LiveVisit {
public:
    // The folder must be open for writing, and outlive the visit. Fails where the participant has no stage to go
    // through now, and where the device or the session's record is not fit for it.
    [[nodiscard]] static Result<std::unique_ptr<LiveVisit>> prepare(study::StudyFolder& study,
                                                                    const LiveVisitOptions& options);
    LiveVisit(const LiveVisit&) = delete;
    LiveVisit& operator=(const LiveVisit&) = delete;

    // Returns what is to be run.
    [[nodiscard]] session::SessionSetup session() const;
    [[nodiscard]] std::size_t stages_ended() const { return activity_->stages_ended(); }
    [[nodiscard]] std::size_t stages_left() const { return plan_.places.size() - stages_ended(); }  // of the day

private:
    LiveVisit(study::StudyFolder& study, const LiveVisitOptions& options, const study::Group& group, VisitPlan plan,
              FeltWorlds worlds, ParticipantDevice device);
    [[nodiscard]] Result<void> begin(const TrainingRun& run);
    [[nodiscard]] StageKeeper keeper();

    study::StudyFolder& study_;
    std::string participant_;
    session::SessionSetup setup_;
    VisitPlan plan_;
    ParticipantDevice device_;
    FeltWorlds worlds_;
    StageOnDisk disk_;
    std::shared_ptr<StudyActivity> activity_;
    bool has_begun_ = false;
};

}  // namespace burin::activities
