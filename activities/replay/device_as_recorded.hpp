// SPDX-License-Identifier: MIT
// The device of a recording, so that its motion can be felt with it again. One thread.
#pragma once

#include <string>

#include "activities/world/repeated_hand.hpp"
#include "record/record_reader.hpp"

namespace burin::activities {

// Returns the line of a live session's settings (session/state/session_settings.hpp); empty: it was none.
[[nodiscard]] std::string live_settings_of(const record::RecordReader& reader);

// Returns the device with which a motion was recorded, and which of its points touched: of a wand as the recording
// describes it, or as its file does where the recording holds only the digest. What is no wand is the simulated Omni.
[[nodiscard]] Result<DeviceAsRecorded> device_as_recorded(const record::RecordReader& reader);

}  // namespace burin::activities
