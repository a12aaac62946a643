// SPDX-License-Identifier: MIT
// What a recorded tick was computed from, read back from its columns: the device's sample, the mapping into the scene,
// times and sequence numbers. With the surface of that number it gives the same tick (haptics/haptic_loop.hpp,
// repeat()). Pure; any thread.
#pragma once

#include <array>
#include <vector>

#include "devices/haptic/device_sample.hpp"
#include "record/row_walk.hpp"

namespace burin::record {

// Facts (table meta) of a recording that a simulated wand led: the text of its description
// (devices/haptic/wand_file.hpp), the SHA-256 of that text, which is its file's where it has one, and the names of the
// points that touched, with commas between them, where no settings of a session name them.
inline constexpr const char *kWandTextFact = "wand description", *kWandDigestFact = "wand sha256",
                            *kWandPointsFact = "wand points";

// The fact that holds the digest of the world that was touched (scene/world_digest.hpp).
inline constexpr const char* kWorldDigestFact = "world sha256";

struct RecordedTick {
    std::int64_t tick = 0;
    Nanoseconds time_ns = 0, lateness_ns = 0;
    devices::DeviceSample sample;
    Similarity object_from_device;
    std::uint64_t surface_sequence = 0;
    std::uint64_t parameter_sequence = 0;
};

// Finds the columns of a hand once, and reads ticks by them.
class MotionColumns {
public:
    // Fails on a table that lacks one of them.
    [[nodiscard]] static Result<MotionColumns> find(const RecordReader& reader, std::size_t hand);
    // Requires the block to be of that hand.
    [[nodiscard]] RecordedTick at(const Block& block, std::uint32_t row) const;

private:
    std::vector<std::size_t> integers_, doubles_, bits_, joints_;  // columns by type, in the order in which at() reads
    std::vector<std::size_t> drive_;  // of a part that drives one way; empty: of no such part
    std::size_t drive_state_ = 0;
};

}  // namespace burin::record
