// SPDX-License-Identifier: MIT
// What a recording says at its end of the engine that carved.
#pragma once

#include <string>

#include "compute/engine/engine.hpp"

namespace burin::session {

// The fact in a session file that has these words.
inline constexpr const char* kCarvedByFact = "carved by";

// Returns the engine that carved last, and the work of its device, where it had one: submissions, waits that blocked,
// what was copied each way, and the most of the device's memory that was held at once.
[[nodiscard]] std::string carved_by(const compute::CarvingEngine& engine);

}  // namespace burin::session
