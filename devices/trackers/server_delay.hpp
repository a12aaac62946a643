// SPDX-License-Identifier: MIT
// How late the reports of a server come, from the time stamps of its own clock, which need not be ours.
//
// The least difference between arrival and stamp of the last 15 to 30 s is taken for both clocks' difference and the
// way that a report takes at best; what a report takes longer is its delay. Clocks that drift apart by less than a
// second a day add microseconds. A clock that is set makes reports seem late for as long at most; one that is set by
// more than kSet_ns is seen at once. A delay that never changes cannot be told from a clock. Pure but for its state; no
// heap.
#pragma once

#include <algorithm>

#include "base/clock.hpp"

namespace burin::devices {

class ServerDelay {
public:
    static constexpr Nanoseconds kWindow_ns = 15 * kNanosecondsPerSecond, kSet_ns = 10 * kNanosecondsPerSecond;

    // Takes a report's stamp and when it arrived; returns its delay, 0 or more.
    Nanoseconds note(Nanoseconds stamp_ns, Nanoseconds arrival_ns) noexcept {
        const Nanoseconds apart_ns = arrival_ns - stamp_ns;
        if (!begun_ || apart_ns - std::min(before_ns_, least_ns_) > kSet_ns) {
            begun_ = true;
            before_ns_ = least_ns_ = apart_ns;
            since_ns_ = arrival_ns;
        } else if (arrival_ns - since_ns_ > kWindow_ns) {
            before_ns_ = least_ns_;
            least_ns_ = apart_ns;
            since_ns_ = arrival_ns;
        }
        least_ns_ = std::min(least_ns_, apart_ns);
        return apart_ns - std::min(before_ns_, least_ns_);
    }

private:
    bool begun_ = false;
    Nanoseconds before_ns_ = 0, least_ns_ = 0, since_ns_ = 0;  // of the window before and of this one
};

}  // namespace burin::devices
