// SPDX-License-Identifier: MIT
// A number for what a session did, so that a replay can tell whether it does the same: FNV-1a over the bits of what ticks felt and gave,
// of where frames have things, and at the end of the surface. No protection against intent. One thread.
#pragma once

#include <bit>
#include <cstdint>
#include <deque>
#include <span>

#include "app/session/session_state.hpp"
#include "geometry/surface_tile.hpp"
#include "haptics/channels.hpp"

namespace burin {

class SessionCheck {
public:
    void tick(const TickRecord& record);
    // Of a frame that draws the tool of this tick and has taken its news. Ticks are not asked for again.
    [[nodiscard]] std::uint64_t frame(std::uint64_t tick, const SessionState& state);

private:
    struct After {
        std::uint64_t tick = 0, check = 0;
    };
    std::uint64_t check_ = 0;
    std::deque<After> ticks_;  // that no frame has seen yet, but for the first
};

[[nodiscard]] std::uint64_t check_of(const Surface& surface);

}  // namespace burin
