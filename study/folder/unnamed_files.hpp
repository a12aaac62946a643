// SPDX-License-Identifier: MIT
// Files below data/ that the journal does not tell of: the sign that lines were cut off its end, which no digest of a
// line shows. Reads the folder; one thread.
#pragma once

#include <string>
#include <vector>

#include "study/folder/study_folder.hpp"

namespace burin::study {

// Where the recordings lie within the study's folder. An UnnamedFile of this name: the folder cannot be read.
inline constexpr const char* kDataFolder = "data";

struct UnnamedFile {
    std::string file;  // within the study's folder
    std::string what, remedy;
};
// In the order of their names. A file of figures beside a stage whose end the journal does not tell counts too, where
// the stage was not done again since: it is written before the end. What SQLite leaves beside a recording that was cut
// off belongs to the recording.
[[nodiscard]] std::vector<UnnamedFile> unnamed_files(const StudyFolder& study);

}  // namespace burin::study
