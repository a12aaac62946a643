// SPDX-License-Identifier: MIT
// Ticks whose every value follows from their number, so that a test knows what a recording must hold, and a place to
// record them in.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "haptics/tick_record.hpp"
#include "record/record_reader.hpp"
#include "record/record_writer.hpp"
#include "tests/support/run_command.hpp"

namespace burin::record::test {

inline haptics::TickRecord made_tick(std::uint64_t tick, std::uint32_t points = 1) {
    const auto t = static_cast<double>(tick);
    haptics::TickRecord r;
    r.tick = tick;
    r.time_ns = 5'000'000'000 + static_cast<Nanoseconds>(tick) * 1'000'000;
    r.lateness_ns = static_cast<Nanoseconds>(tick % 7);
    r.sample.time_ns = r.time_ns - 1;
    r.sample.position_device_m = {std::sin(t), std::cos(t), 1e-9 * t};
    r.sample.orientation_device = glm::normalize(Quat(1.0, std::sin(t), 0.2, std::cos(3.0 * t)));
    r.sample.buttons = static_cast<std::uint32_t>(tick & 3);
    for (std::size_t j = 0; j < devices::kMostJoints; ++j) r.sample.joints[j] = t + 0.125 * static_cast<double>(j);
    r.contact.point_count = points;
    for (std::uint32_t i = 0; i < points; ++i) {
        haptics::PointRecord& p = r.contact.points[i];
        p.hip_object_m = {t, 2.0 * t, 3.0 * t + i};
        p.proxy_object_m = p.hip_object_m + Vec3(0.001 * i);
        p.force_device_N = {0.1 * i, -t, 1.0 / (1.0 + t)};
        p.penetration_m = 1e-3 / (1.0 + t);
        p.active_triangle = static_cast<std::uint32_t>(tick) + i;
    }
    r.wanted.force_device_N = {t, -t, 0.0};
    r.gate.given.force_device_N = {t, -0.5 * t, 0.0};
    r.gate.saturated = tick % 2 == 1;
    r.flags = static_cast<std::uint32_t>(tick * 3);
    r.surface_sequence = tick / 10;
    r.parameter_sequence = 1;
    return r;
}

inline haptics::Probe probe_of(std::uint32_t points) {
    haptics::Probe probe;
    probe.count = points;
    return probe;
}

inline devices::DeviceDescription device_with(std::uint32_t joints) {
    devices::DeviceDescription device;
    device.name = "made";
    device.joints.count = joints;
    return device;
}

// A writer with one hand, whose ticks the test pushes.
struct Recording {
    explicit Recording(std::size_t ring_ticks = 1024) : ring(ring_ticks) {}

    [[nodiscard]] Result<void> begin(const std::string& path, WriterOptions options = {}) {
        auto made = RecordWriter::create(
            path, {{"made", device_with(2), probe_of(2), &ring, more_columns, more_values}}, std::move(options));
        if (!made) return std::unexpected(made.error());
        writer = std::move(*made);
        return {};
    }
    // Pushes so many ticks, and waits for the writer before the ring overflows.
    void push(std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) {
            ring.push(made_tick(++last_tick, 2));
            if (last_tick % 256 == 0) writer->take_now();
        }
        writer->take_now();
    }

    Ring<haptics::TickRecord> ring;
    std::vector<Column> more_columns = {};  // RecordedHand's
    std::function<void(const haptics::TickRecord&, std::vector<Word>& row)> more_values = {};
    std::unique_ptr<RecordWriter> writer;
    std::uint64_t last_tick = 0;
};

// Returns how many ticks a file holds, of those from 1 on whose every value is as made; all blocks must be readable.
inline Result<std::uint64_t> sound_ticks(const std::string& path) {
    Result<RecordReader> reader = RecordReader::open(path);
    if (!reader) return std::unexpected(reader.error());
    std::uint64_t tick = 0;
    for (std::size_t n = 0; n < reader->hands()[0].blocks.size(); ++n) {
        const Result<Block> block = reader->block(0, n);
        if (!block) return std::unexpected(block.error());
        for (std::uint32_t row = 0; row < block->rows(); ++row) {
            const std::vector<Word> wanted = row_of(made_tick(++tick, 2), {2, 2});
            for (std::size_t c = 0; c < wanted.size(); ++c)
                if (block->at(c, row) != wanted[c])
                    return fail(path, "tick " + std::to_string(tick) + " differs in column " + std::to_string(c));
        }
    }
    return tick;
}

}  // namespace burin::record::test
