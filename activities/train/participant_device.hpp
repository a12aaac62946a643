// SPDX-License-Identifier: MIT
// The device of a participant's visit: which is opened, and what the study tells of it.
#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "devices/haptic/wand_description.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::activities {

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

}  // namespace burin::activities
