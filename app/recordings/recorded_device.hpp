// SPDX-License-Identifier: MIT
// The device of a recording. A simulated wand is as its description says, so a recording keeps the description's text
// and digest: then its motion can be felt anywhere, and a replay with another wand is refused. One thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "activities/world/repeated_hand.hpp"
#include "record/record_reader.hpp"

namespace burin::app {

// Returns the facts that describe a wand (record/motion.hpp); none where the device is no wand that a file describes,
// or the file cannot be read.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> facts_of_wand_file(const std::string& device);

// Returns the file that describes a device; empty for one that a program knows by itself.
[[nodiscard]] std::string wand_file_of(const std::string& device);

// Checks that a wand's file is there and is the recorded one. `remedy` says what to do where it is not. A recording
// without its digest is not checked.
[[nodiscard]] Result<void> check_wand_file(const record::RecordReader& reader, const std::string& device,
                                           const std::string& remedy);

// Returns the line of a live session's settings (session/state/session_settings.hpp); empty: it was none.
[[nodiscard]] std::string live_settings_of(const record::RecordReader& reader);

// Returns the device with which a motion was recorded, and which of its points touched: of a wand as the recording
// describes it, or as its file does where the recording holds only the digest. What is no wand is the simulated Omni.
[[nodiscard]] Result<activities::RecordedDevice> recorded_device(const record::RecordReader& reader);

}  // namespace burin::app
