// SPDX-License-Identifier: MIT
// The device of a participant's visit: which is opened, what the study tells of it, and what its recordings keep of the
// program.
#pragma once

#include <optional>
#include <string>

#include "activities/train/stage_on_disk.hpp"
#include "app/study/study_run_command.hpp"
#include "base/error.hpp"
#include "devices/haptic/wand_description.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

struct ParticipantDevice {
    std::string opened;                            // as a session's --device
    std::optional<devices::WandDescription> wand;  // none: it has no handle with points, and no jig
    study::HeldDevice held;                        // as journal, status, report, table and recordings tell it
};
// Where no device or the simulated wand is asked for, the wand with the protocol's points is written to the study's
// folder and opened. Fails where there is no such device, where its points are not the protocol's, and where the group
// feels the tube and the device gives no force.
[[nodiscard]] Result<ParticipantDevice> participant_device(const std::string& asked, const study::StudyFolder& study,
                                                           const study::Group& group);

// Program, version, compiler, command and settings of a run; no file's name, which may name somebody.
[[nodiscard]] activities::Provenance provenance_of(const StudyRunOptions& options);

}  // namespace burin::app
