// SPDX-License-Identifier: MIT
// Shows the progress of long work in a line on standard error: rewritten in place on a terminal, a new line every ten
// seconds elsewhere, and nothing for work of less than a second.
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
    void show(double done);  // 0 to 1; cheap enough to be called at every step

private:
    std::string what_;
    MonotonicClock clock_;
    Nanoseconds next_ns_;
    bool terminal_, shown_ = false;
};

}  // namespace burin
