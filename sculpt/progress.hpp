// SPDX-License-Identifier: MIT
// One progress line on standard error for work that takes longer than a moment: rewritten in place on a terminal, a new line
// now and then elsewhere, nothing at all for short work.
#pragma once

#include <string>

#include "base/clock.hpp"

namespace burin {

class Progress {
public:
    explicit Progress(std::string what);
    ~Progress();  // ends the line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void show(double done);  // 0 to 1; cheap, may be called often

private:
    std::string what_;
    MonotonicClock clock_;
    Nanoseconds next_ns_;
    bool terminal_, shown_ = false;
};

}  // namespace burin
