// SPDX-License-Identifier: MIT
// Holds words and limits that several commands of burin bench share.
#pragma once

namespace burin::app {

inline constexpr const char* kBenchThreadsHelp = "How many threads work; 0: one per core";
inline constexpr int kMostBenchThreads = 1024;
inline constexpr int kMostBenchUpdates = 1000;  // the scenes have a thousand cuts

}  // namespace burin::app
