// SPDX-License-Identifier: MIT
// All recorded motion of a study through the haptic tick again, compared with what its folder keeps: ticks, results and
// figures. Many threads, each with recordings of its own; blocks until all are done. Reads the folder alone.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/error.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::study {

struct FolderReplayOptions {
    std::string participant;                       // empty: all
    unsigned threads = 0;                          // 0: one for each core
    std::function<void(const std::string&)> tell;  // takes a line for each fault; one call at a time, from any thread
};

struct FolderReplay {
    std::size_t recordings = 0, faults = 0;
    std::size_t without = 0;      // recordings that were erased or hold nothing yet; none of the former
    std::size_t interrupted = 0;  // of the recordings: end where they were interrupted
    std::size_t of_session = 0;   // of a live session: computed again from the ticks as stored
    std::size_t columns = 0;      // of a tick
    std::uint64_t ticks = 0;
};
// Fails where a world of the protocol cannot be touched.
[[nodiscard]] Result<FolderReplay> replay_folder(const StudyFolder& study, const FolderReplayOptions& options);

}  // namespace burin::study
