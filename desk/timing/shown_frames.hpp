// SPDX-License-Identifier: MIT
// Finds out when presented frames are seen, by polling and never by waiting; next_look_ns() says when polling is worth
// it. A time is reported only if it is sharp: the previous poll, at which the frame was not seen yet, was at most
// kSharp_ns before.
// All times are passed in. One thread.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "desk/timing/frame_pacing.hpp"

namespace burin::session {

class ShownFrames {
public:
    static constexpr Nanoseconds kLookEvery_ns = 1'000'000;
    static constexpr Nanoseconds kSharp_ns = 2'000'000;
    static constexpr Nanoseconds kPatience_ns = 250'000'000;  // a hidden window may never be seen

    // Adds a presented frame. picture: how many pictures the display has been handed so far, this one included;
    // unchanged where this frame was only for other displays.
    void handed(const FrameMeasure& measure, std::uint64_t picture, Nanoseconds now_ns);

    // Returns whether a numbered picture has been seen; nothing where that is unknown or will stay so.
    using WasShown = std::function<std::optional<bool>(std::uint64_t picture)>;
    // Polls; returns, in order, the frames of which all is known that will be, for after_frame().
    [[nodiscard]] std::vector<FrameMeasure> look(Nanoseconds now_ns, const WasShown& was_shown);

    // Returns when to poll again; nothing while no frame is waiting.
    [[nodiscard]] std::optional<Nanoseconds> next_look_ns() const;

private:
    struct Frame {
        FrameMeasure measure;
        std::optional<std::uint64_t> picture;
        Nanoseconds handed_ns = 0;
    };
    std::deque<Frame> waiting_;
    std::uint64_t last_picture_ = 0;
    std::optional<Nanoseconds> looked_ns_;  // last poll at which the oldest was not seen
    // The last frame's time was sharp: the next comes about when it was planned for.
    bool sharp_ = false;
};

}  // namespace burin::session
