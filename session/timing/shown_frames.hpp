// SPDX-License-Identifier: MIT
// Frames that were handed to the display and are not known to be seen yet: what is learnt of when they are, by asking now and then, never by
// waiting. Between frames there is time to ask: next_look_ns() says when it is worth it. A time is told only if it is sharp: the ask
// before, that said no, was at most kSharp_ns ago.
// All times are passed in. One thread.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "app/session/frame_pacing.hpp"

namespace burin {

class ShownFrames {
public:
    static constexpr Nanoseconds kLookEvery_ns = 1'000'000;
    static constexpr Nanoseconds kSharp_ns = 2'000'000;
    static constexpr Nanoseconds kPatience_ns = 250'000'000;  // a hidden window may never be seen

    // picture: how many the display was handed until then, this one included; the same as before, where this frame was only for others.
    void handed(const FrameMeasure& measure, std::uint64_t picture, Nanoseconds now_ns);

    // Whether the picture of a number has been seen; nothing where nobody knows, or will any more.
    using WasShown = std::function<std::optional<bool>(std::uint64_t picture)>;
    // The frames of which all is known that will be, in their order: for after_frame().
    [[nodiscard]] std::vector<FrameMeasure> look(Nanoseconds now_ns, const WasShown& was_shown);

    // When to look again; nothing while no frame is waited for.
    [[nodiscard]] std::optional<Nanoseconds> next_look_ns() const;

private:
    struct Frame {
        FrameMeasure measure;
        std::optional<std::uint64_t> picture;
        Nanoseconds handed_ns = 0;
    };
    std::deque<Frame> waiting_;
    std::uint64_t last_picture_ = 0;
    std::optional<Nanoseconds> looked_ns_;  // when the oldest was not seen yet
    bool sharp_ = false;                    // the last one's time was: the next comes about when it was planned for
};

}  // namespace burin
