// SPDX-License-Identifier: MIT
// Whoever knows the ticks of a recorded session and judges those of its replay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/error.hpp"
#include "haptics/tick_record.hpp"

namespace burin::session {

class TickWitness {
public:
    // What a log's line of a tick leaves out.
    struct Known {
        decltype(devices::DeviceSample::joints) joints{};
        Nanoseconds lateness_ns = 0;
    };
    virtual ~TickWitness() = default;
    // Returns what is known of a part's tick; nothing where it was not recorded. Ticks are asked for in their order.
    [[nodiscard]] virtual std::optional<Known> known(std::size_t part, std::uint64_t tick) = 0;
    // Takes a part's tick as it was computed again. A failure ends the replay.
    [[nodiscard]] virtual Result<void> take(std::size_t part, const haptics::TickRecord& again) = 0;
};

}  // namespace burin::session
