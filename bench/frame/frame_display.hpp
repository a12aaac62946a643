// SPDX-License-Identifier: MIT
// An X display for libraries that need one to draw off screen: the one named by DISPLAY, or an Xvfb that is started
// here and ends with this object.
// Ownership: move-only. Thread: it sets and clears DISPLAY, so use it before other threads read the environment.
#pragma once

#include <sys/types.h>

#include "base/error.hpp"

namespace burin::bench {

class FrameDisplay {
public:
    // Errors: Xvfb is not installed, or does not report its display number within 10 s.
    [[nodiscard]] static Result<FrameDisplay> open();
    FrameDisplay(FrameDisplay&& other) noexcept;
    FrameDisplay& operator=(FrameDisplay&& other) noexcept;
    ~FrameDisplay();

private:
    explicit FrameDisplay(pid_t server) : server_(server) {}
    void close();
    pid_t server_ = 0;  // process of the Xvfb; 0: the display was there before
};

}  // namespace burin::bench
