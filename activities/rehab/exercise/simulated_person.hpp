// SPDX-License-Identifier: MIT
// Whose hand a script moves, where the fingers are led one by one (ExerciseKind::course).
#pragma once

#include <cstdint>

namespace burin::activities {

// A healthy one, or one that goes half as far, whose index does not press and whose fingers follow each other.
enum class SimulatedPerson : std::uint8_t { healthy, weak };

}  // namespace burin::activities
