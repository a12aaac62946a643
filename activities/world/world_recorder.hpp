// SPDX-License-Identifier: MIT
// Records the ticks of an exploration in simulated time: every tick with the object that each point touches, and when
// the scene was updated after which tick, as lines "update TICK".
// Data flow: haptic loop -> add() -> a ring -> the writer's thread (record/record_writer.hpp). No clock holds simulated
// time back, so update() waits until the writer has taken all.
// Threads: one calls it; the object's numbers go to the writer's thread by a ring.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/ring.hpp"
#include "haptics/tick_record.hpp"
#include "record/record_writer.hpp"

namespace burin::activities {

inline constexpr const char* kUpdateLine = "update ";

class WorldRecorder {
public:
    using Facts = std::vector<std::pair<std::string, std::string>>;
    // The objects that can be touched, by the numbers that add() is given.
    [[nodiscard]] static Result<std::unique_ptr<WorldRecorder>> create(
        const std::string& path, const devices::DeviceDescription& device, const haptics::Probe& probe, Facts facts,
        std::vector<std::pair<std::int64_t, std::string>> objects);

    // Takes a tick and the object that each of its points touches.
    void add(const haptics::TickRecord& tick, std::span<const std::uint32_t> objects);
    // Notes an update of the scene after a tick, and waits for the writer. Fails when nothing is recorded any more.
    [[nodiscard]] Result<void> update(Nanoseconds time_ns, std::uint64_t last_tick);
    [[nodiscard]] Result<void> finish() { return writer_->close(); }

private:
    struct Objects {
        std::uint64_t tick = 0;
        std::array<std::uint32_t, haptics::kMostProbePoints> numbers{};
    };
    WorldRecorder() : ticks_(record::kRingTicks), objects_(2 * record::kRingTicks) {}
    void append_objects(const haptics::TickRecord& tick, std::vector<record::Word>& row);

    Ring<haptics::TickRecord> ticks_;
    Ring<Objects> objects_;  // pushed before their tick
    std::uint32_t points_ = 1;
    std::unique_ptr<record::RecordWriter> writer_;  // last: its thread reads the rings until it has ended
};

}  // namespace burin::activities
