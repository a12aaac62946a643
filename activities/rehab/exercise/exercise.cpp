// SPDX-License-Identifier: MIT
#include "activities/rehab/exercise/exercise.hpp"

namespace burin::activities {

std::string_view text_of(ExerciseEnd end) {
    switch (end) {
        case ExerciseEnd::done: return "done";
        case ExerciseEnd::time_over: return "time over";
        case ExerciseEnd::not_yet: return "broken off";
    }
    return "";
}

}  // namespace burin::activities
