// SPDX-License-Identifier: MIT
// How the clock of the streams' library stands to the session's: an offset that is measured, and by how much it may be
// wrong. The library's lsl_local_clock() is read between two readings of the session's clock, several times; the pair
// that lies closest together says the most. Pure but for the readings.
#pragma once

#include "base/clock.hpp"
#include "devices/lsl/lsl_api.hpp"

namespace burin::session {

struct StreamClock {
    double offset_s = 0.0;  // to be added to a time of the session's clock, to have a stamp
    double within_s = 0.0;  // the offset is right to so much either way

    [[nodiscard]] double stamp_s(Nanoseconds time_ns) const { return seconds(time_ns) + offset_s; }
    [[nodiscard]] Nanoseconds time_ns(double of_stamp_s) const { return nanoseconds(of_stamp_s - offset_s); }
};

[[nodiscard]] StreamClock measure_stream_clock(const devices::LslApi& api, Clock& clock);

}  // namespace burin::session
