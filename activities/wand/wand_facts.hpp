// SPDX-License-Identifier: MIT
// Facts about the wand of a recording. A simulated wand is as its description says, so that a recording holds the
// description's text and digest: then its motion can be felt anywhere, and a replay with another wand is refused.
// One thread; reads the description's file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "record/record_reader.hpp"

namespace burin::activities {

// Returns the facts that describe a wand (record/motion.hpp); none where the device is no wand that a file describes,
// or the file cannot be read.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> facts_of_wand_file(const std::string& device);

// Returns the file that describes a device; empty for one that a program knows by itself.
[[nodiscard]] std::string wand_file_of(const std::string& device);

// Checks that a wand's file is there and is the recorded one. `remedy` says what to do where it is not. A recording
// without its digest is not checked.
[[nodiscard]] Result<void> check_wand_file(const record::RecordReader& reader, const std::string& device,
                                           const std::string& remedy);

}  // namespace burin::activities
