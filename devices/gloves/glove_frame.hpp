// SPDX-License-Identifier: MIT
// Frames on the serial line of a force-feedback glove with four pistons from palm to fingertip (thumb, index, middle,
// ring), as the Rutgers Master II has them. Its own layout was never published; this one keeps its sizes, 28 bytes of
// positions and 32 of positions and forces, so that as many go over 38,400 bit/s. docs/glove.md has the layout.
//
// Angles are of 12 bits over 270 degrees, from -90 on: steps of 0.066 degrees. Forces are of 8 bits in steps of 0.05 N.
// Sets are of version 1 or 2; one of version 2 begins with another byte, far from that of version 1, and ends in a
// second check. The first check, CRC-8 by x^8 + x^2 + x + 1, does not see two bits that are 127 apart; the second, by
// x^8 + x^4 + x^3 + x^2 + 1, does not see two that are 255 apart: both together see any two and any odd number of a
// frame. Commands and laws are shorter than 127 bits, so that one check sees the same of them. The reader comes into
// step by itself: a byte that begins no frame, or one whose check differs, is dropped, and what follows it is looked at
// anew. A frame inside a frame is found where the outer one does not check. Pure; no heap, lock or throw; one thread
// for each reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "devices/haptic/haptic_device.hpp"

namespace burin::devices {

inline constexpr std::size_t kGloveFingers = 4, kFingerJoints = 4;
// A finger's angles, in radians: to the side (positive towards the thumb), then its three joints' flexion from the palm
// on. Straight fingers have zeros.
using FingerAngles = std::array<double, kFingerJoints>;
using GloveJoints = std::array<FingerAngles, kGloveFingers>;
using GloveForces = std::array<double, kGloveFingers>;  // N, of the pistons; away from the palm is positive

inline constexpr double kLeastAngle_rad = -1.5707963267948966, kAngleRange_rad = 4.71238898038469;
inline constexpr double kForceStep_N = 0.05, kMostFrameForce_N = 255 * kForceStep_N;
inline constexpr std::size_t kSetBytes = 28, kSetWithForcesBytes = 32, kCommandBytes = 8, kLawBytes = 11;
inline constexpr std::size_t kMostSetBytes = kSetWithForcesBytes + 1;  // of version 2

// One set of joint angles, as the controller sends it.
struct GloveSet {
    std::uint8_t number = 0;                                  // counts up, and begins again after 255
    bool motors_on = false, fault = false, is_local = false;  // local: the controller renders a finger by itself
    GloveJoints joints{};
    std::optional<GloveForces> forces_N;  // measured at the pistons; none in a frame of positions alone
    std::uint8_t version = 1;             // of the frame: 1, or 2 with a second check
    bool operator==(const GloveSet&) const = default;
};

// A host's command: the forces that the pistons are to give, and which of them the controller is to render by itself
// from now on by the newest law that it has of each; one of which it has none follows the forces. Stop takes all force
// off, and all laws, until the next forces. With a law a command is that law, and nothing else.
struct GloveCommand {
    struct Law {
        std::uint8_t finger = 0;  // below kGloveFingers
        DriveLaw law;             // holds
        bool operator==(const Law&) const = default;
    };
    std::uint8_t number = 0;
    bool stop = false;
    GloveForces forces_N{};
    std::uint8_t local = 0;  // bit i: finger i
    std::optional<Law> law = {};
    bool operator==(const GloveCommand&) const = default;
};
inline constexpr double kSpringStep_N_per_m = 0.1, kDampingStep_Ns_per_m = 0.05, kStartStep_m = 0.00001;

using GloveLaws = std::array<DriveLaw, kGloveFingers>;

// Bytes of one frame.
struct GloveBytes {
    std::array<std::byte, kMostSetBytes> bytes{};
    std::size_t count = 0;
    [[nodiscard]] std::span<const std::byte> view() const noexcept { return {bytes.data(), count}; }
};

// Returns how many bytes a set's frame has.
[[nodiscard]] constexpr std::size_t bytes_of(const GloveSet& set) noexcept {
    return (set.forces_N ? kSetWithForcesBytes : kSetBytes) + (set.version == 2 ? 1 : 0);
}
// Values are rounded to the nearest step; those beyond what a frame holds are held at its ends.
[[nodiscard]] GloveBytes frame_of(const GloveSet& set) noexcept;
[[nodiscard]] GloveBytes frame_of(const GloveCommand& command) noexcept;

// Counts of what a reader has received and dropped since it began.
struct GloveLineCounts {
    std::uint64_t frames = 0, dropped_bytes = 0;
    std::uint64_t missed = 0;  // frames whose numbers were left out
};

// Reads sets, or commands, from the bytes of a line as they come.
template <typename Frame>
class GloveFrameReader {
public:
    // Takes a byte; returns the frame that it completes.
    [[nodiscard]] std::optional<Frame> take(std::byte byte) noexcept;
    [[nodiscard]] const GloveLineCounts& counts() const noexcept { return counts_; }

private:
    void drop(std::size_t bytes) noexcept;
    [[nodiscard]] std::optional<Frame> look() noexcept;

    std::array<std::byte, kMostSetBytes> bytes_{};
    std::size_t count_ = 0;
    // Bytes since the last frame of version 2: soon after one, what looks like version 1 stands within a damaged one.
    std::size_t since_second_ = kSecondHolds;
    static constexpr std::size_t kSecondHolds = 4 * kMostSetBytes;
    std::optional<std::uint8_t> last_number_;
    GloveLineCounts counts_;
};

extern template class GloveFrameReader<GloveSet>;
extern template class GloveFrameReader<GloveCommand>;

}  // namespace burin::devices
