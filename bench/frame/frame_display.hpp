// SPDX-License-Identifier: MIT
// A display for those who need one to draw off screen: the one named by DISPLAY, or an Xvfb of our own that ends with it.
// Ownership: move-only. Thread: it sets and clears DISPLAY, so before other threads read the environment.
#pragma once

#include <sys/types.h>

#include "base/error.hpp"

namespace burin::bench {

class FrameDisplay {
public:
    // Errors: Xvfb is not installed, or does not say its number within 10 s.
    [[nodiscard]] static Result<FrameDisplay> open();
    FrameDisplay(FrameDisplay&& other) noexcept;
    FrameDisplay& operator=(FrameDisplay&& other) noexcept;
    ~FrameDisplay();

private:
    explicit FrameDisplay(pid_t server) : server_(server) {}
    void close();
    pid_t server_ = 0;  // 0: the display is not ours
};

}  // namespace burin::bench
