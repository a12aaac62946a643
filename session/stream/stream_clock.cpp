// SPDX-License-Identifier: MIT
#include "session/stream/stream_clock.hpp"

namespace burin::session {

StreamClock measure_stream_clock(const devices::LslApi& api, Clock& clock) {
    constexpr int kReadings = 64;
    StreamClock best;
    for (int i = 0; i < kReadings; ++i) {
        const Nanoseconds before_ns = clock.now_ns();
        const double there_s = api.local_clock();
        const Nanoseconds after_ns = clock.now_ns();
        const double within_s = 0.5 * seconds(after_ns - before_ns);
        if (i > 0 && within_s >= best.within_s) continue;
        best = {there_s - 0.5 * (seconds(before_ns) + seconds(after_ns)), within_s};
    }
    return best;
}

}  // namespace burin::session
