// SPDX-License-Identifier: MIT
// The attempts of a trial as a recording marks them: each from the start of its clock to how it ended. Pure; one
// thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/felt/stage_session.hpp"

namespace burin::study {

struct TrialMark {
    Nanoseconds time_ns = 0;
    bool begins = false;
    std::string state;  // how it ended: "done", why the attempt failed, or how the stage did
};

class TrialMarks {
public:
    // Returns what the events since the last call begin and end, in order; an end follows its beginning.
    [[nodiscard]] std::vector<TrialMark> take(const StageSession& session);

private:
    std::size_t events_told_ = 0;
    bool open_ = false;
};

}  // namespace burin::study
