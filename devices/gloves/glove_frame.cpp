// SPDX-License-Identifier: MIT
#include "devices/gloves/glove_frame.hpp"

#include <algorithm>
#include <cmath>

namespace burin::devices {
namespace {

// A set of version 2 begins with another number in every bit than one of version 1.
constexpr std::uint8_t kSetSync = 0x9d, kSecondSetSync = 0x62, kCommandSync = 0x9e;
// The lower half of a frame's second byte; the upper half of a set's has the controller's state.
constexpr std::uint8_t kKindMask = 0x0f, kPositions = 1, kPositionsAndForces = 2, kForces = 3, kStop = 4, kLaw = 5;
constexpr std::uint8_t kMotorsOn = 0x10, kFault = 0x20, kLocal = 0x40;
constexpr unsigned kUpperHalf = 4;  // bits up to it: of a command, which fingers are local, or the law's finger
constexpr std::size_t kAnglesAt = 3, kForcesAt = 27, kCommandForcesAt = 3, kLawAt = 3;
constexpr int kAngleSteps = 4095;

// CRC-8, most significant bit first, beginning at 0. The first check's polynomial is x^8 + x^2 + x + 1 (SMBus's packet
// error code), the second's x^8 + x^4 + x^3 + x^2 + 1 (that of SAE J1850).
constexpr unsigned kFirstPolynomial = 0x07, kSecondPolynomial = 0x1d;
std::uint8_t check_of(std::span<const std::byte> bytes, unsigned polynomial = kFirstPolynomial) noexcept {
    unsigned crc = 0;
    for (const std::byte byte : bytes) {
        crc ^= static_cast<unsigned>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x80u) != 0 ? (crc << 1 ^ polynomial) & 0xffu : crc << 1;
    }
    return static_cast<std::uint8_t>(crc);
}

unsigned steps_of(double value, double least, double step, unsigned most) noexcept {
    const double steps = std::isfinite(value) ? std::round((value - least) / step) : 0.0;
    return static_cast<unsigned>(std::clamp(steps, 0.0, static_cast<double>(most)));
}

double angle_of(unsigned steps) noexcept { return kLeastAngle_rad + kAngleRange_rad * steps / kAngleSteps; }

std::byte force_byte(double force_N) noexcept {
    return static_cast<std::byte>(steps_of(force_N, 0.0, kForceStep_N, 255));
}

double force_of(std::byte byte) noexcept { return kForceStep_N * static_cast<unsigned>(byte); }

void finish(GloveBytes& frame, std::size_t count) noexcept {
    frame.count = count;
    frame.bytes[count - 1] = static_cast<std::byte>(check_of({frame.bytes.data(), count - 1}));
}

void put_word(GloveBytes& frame, std::size_t at, unsigned word) noexcept {
    frame.bytes[at] = static_cast<std::byte>(word >> 8);
    frame.bytes[at + 1] = static_cast<std::byte>(word & 0xffu);
}

// Returns the size of a frame of this kind; 0: there is none.
std::size_t size_of(const GloveSet*, std::uint8_t kind) noexcept {
    const std::uint8_t own = kind & kKindMask;
    if ((kind & ~(kKindMask | kMotorsOn | kFault | kLocal)) != 0) return 0;
    return own == kPositions ? kSetBytes : own == kPositionsAndForces ? kSetWithForcesBytes : 0;
}
std::size_t size_of(const GloveCommand*, std::uint8_t kind) noexcept {
    const std::uint8_t own = kind & kKindMask;
    if (own == kLaw) return kind >> kUpperHalf < kGloveFingers ? kLawBytes : 0;
    return own == kForces || kind == kStop ? kCommandBytes : 0;
}

// Returns the version of a frame that begins with this byte; 0: none does.
constexpr std::uint8_t version_of(const GloveSet*, std::byte first) noexcept {
    return first == std::byte{kSetSync} ? 1 : first == std::byte{kSecondSetSync} ? 2 : 0;
}
constexpr std::uint8_t version_of(const GloveCommand*, std::byte first) noexcept {
    return first == std::byte{kCommandSync} ? 1 : 0;
}

// Returns whether a whole frame's checks are its bytes'.
bool checks(std::span<const std::byte> frame, std::uint8_t version) noexcept {
    const std::span<const std::byte> first = version == 2 ? frame.first(frame.size() - 1) : frame;
    if (version == 2 && static_cast<std::uint8_t>(frame.back()) != check_of(first, kSecondPolynomial)) return false;
    return static_cast<std::uint8_t>(first.back()) == check_of(first.first(first.size() - 1));
}

void set_version(GloveSet& set, std::uint8_t version) noexcept { set.version = version; }
void set_version(GloveCommand&, std::uint8_t) noexcept {}

void read(std::span<const std::byte> bytes, GloveSet& set) noexcept {
    const auto kind = static_cast<std::uint8_t>(bytes[1]);
    set.motors_on = (kind & kMotorsOn) != 0;
    set.fault = (kind & kFault) != 0;
    set.is_local = (kind & kLocal) != 0;
    for (std::size_t i = 0; i < kGloveFingers * kFingerJoints; ++i) {
        const std::size_t at = kAnglesAt + i / 2 * 3;
        const auto byte = [&](std::size_t k) { return static_cast<unsigned>(bytes[at + k]); };
        const unsigned steps = i % 2 == 0 ? byte(0) << 4 | byte(1) >> 4 : (byte(1) & 0x0fu) << 8 | byte(2);
        set.joints[i / kFingerJoints][i % kFingerJoints] = angle_of(steps);
    }
    if ((kind & kKindMask) != kPositionsAndForces) return;
    GloveForces& forces_N = set.forces_N.emplace();
    for (std::size_t i = 0; i < kGloveFingers; ++i) forces_N[i] = force_of(bytes[kForcesAt + i]);
}

unsigned word_at(std::span<const std::byte> bytes, std::size_t at) noexcept {
    return static_cast<unsigned>(bytes[at]) << 8 | static_cast<unsigned>(bytes[at + 1]);
}

DriveLaw law_in(std::span<const std::byte> bytes) noexcept {
    DriveLaw law;
    law.holds = true;
    law.spring_N_per_m = kSpringStep_N_per_m * word_at(bytes, kLawAt);
    law.damping_Ns_per_m = kDampingStep_Ns_per_m * static_cast<unsigned>(bytes[kLawAt + 2]);
    law.friction_N = force_of(bytes[kLawAt + 3]);
    law.start_m = kStartStep_m * word_at(bytes, kLawAt + 4);
    law.most_N = force_of(bytes[kLawAt + 6]);
    return law;
}

void read(std::span<const std::byte> bytes, GloveCommand& command) noexcept {
    const auto kind = static_cast<std::uint8_t>(bytes[1]);
    const auto upper = static_cast<std::uint8_t>(kind >> kUpperHalf);
    if ((kind & kKindMask) == kLaw) {
        command.law = {upper, law_in(bytes)};
        return;
    }
    command.stop = kind == kStop;
    command.local = upper;
    for (std::size_t i = 0; i < kGloveFingers; ++i) command.forces_N[i] = force_of(bytes[kCommandForcesAt + i]);
}

}  // namespace

GloveBytes frame_of(const GloveSet& set) noexcept {
    GloveBytes frame;
    const std::uint8_t kind = set.forces_N ? kPositionsAndForces : kPositions;
    const auto state = static_cast<std::uint8_t>((set.motors_on ? kMotorsOn : 0) | (set.fault ? kFault : 0) |
                                                 (set.is_local ? kLocal : 0));
    frame.bytes[0] = std::byte{set.version == 2 ? kSecondSetSync : kSetSync};
    frame.bytes[1] = static_cast<std::byte>(kind | state);
    frame.bytes[2] = static_cast<std::byte>(set.number);
    for (std::size_t i = 0; i < kGloveFingers * kFingerJoints; i += 2) {
        const auto steps = [&](std::size_t k) {
            return steps_of(set.joints[k / kFingerJoints][k % kFingerJoints], kLeastAngle_rad,
                            kAngleRange_rad / kAngleSteps, kAngleSteps);
        };
        const unsigned first = steps(i), second = steps(i + 1);
        const std::size_t at = kAnglesAt + i / 2 * 3;
        frame.bytes[at] = static_cast<std::byte>(first >> 4);
        frame.bytes[at + 1] = static_cast<std::byte>((first & 0x0fu) << 4 | second >> 8);
        frame.bytes[at + 2] = static_cast<std::byte>(second & 0xffu);
    }
    for (std::size_t i = 0; set.forces_N && i < kGloveFingers; ++i)
        frame.bytes[kForcesAt + i] = force_byte((*set.forces_N)[i]);
    finish(frame, set.forces_N ? kSetWithForcesBytes : kSetBytes);
    if (set.version == 2) {
        frame.bytes[frame.count] = static_cast<std::byte>(check_of(frame.view(), kSecondPolynomial));
        ++frame.count;
    }
    return frame;
}

GloveBytes frame_of(const GloveCommand& command) noexcept {
    GloveBytes frame;
    frame.bytes[0] = std::byte{kCommandSync};
    frame.bytes[2] = static_cast<std::byte>(command.number);
    if (command.law) {
        const auto& [finger, law] = *command.law;
        frame.bytes[1] = static_cast<std::byte>(kLaw | finger << kUpperHalf);
        put_word(frame, kLawAt, steps_of(law.spring_N_per_m, 0.0, kSpringStep_N_per_m, 0xffff));
        frame.bytes[kLawAt + 2] =
            static_cast<std::byte>(steps_of(law.damping_Ns_per_m, 0.0, kDampingStep_Ns_per_m, 0xff));
        frame.bytes[kLawAt + 3] = force_byte(law.friction_N);
        put_word(frame, kLawAt + 4, steps_of(law.start_m, 0.0, kStartStep_m, 0xffff));
        frame.bytes[kLawAt + 6] = force_byte(law.most_N);
        finish(frame, kLawBytes);
        return frame;
    }
    frame.bytes[1] = static_cast<std::byte>(command.stop ? kStop : kForces | (command.local & 0x0f) << kUpperHalf);
    for (std::size_t i = 0; !command.stop && i < kGloveFingers; ++i)
        frame.bytes[kCommandForcesAt + i] = force_byte(command.forces_N[i]);
    finish(frame, kCommandBytes);
    return frame;
}

template <typename Frame>
void GloveFrameReader<Frame>::drop(std::size_t bytes) noexcept {
    std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(bytes), bytes_.begin() + static_cast<std::ptrdiff_t>(count_),
              bytes_.begin());
    count_ -= bytes;
}

// Looks for a frame at the beginning of what waits, and drops what cannot be one. A byte completes one frame at most:
// what waits is shorter than two.
template <typename Frame>
std::optional<Frame> GloveFrameReader<Frame>::look() noexcept {
    constexpr const Frame* kType = nullptr;
    while (count_ > 0) {
        const std::uint8_t version = version_of(kType, bytes_[0]);
        if (version > 0 && count_ < 2) return std::nullopt;
        const std::size_t own = version > 0 ? size_of(kType, static_cast<std::uint8_t>(bytes_[1])) : 0;
        const std::size_t size = own > 0 && version == 2 ? own + 1 : own;
        if (size > count_) return std::nullopt;
        const std::span<const std::byte> frame(bytes_.data(), size);
        const bool is_within = version == 1 && since_second_ < kSecondHolds;
        if (size == 0 || is_within || !checks(frame, version)) {
            ++counts_.dropped_bytes;
            drop(1);
            continue;
        }
        Frame read_frame;
        read_frame.number = static_cast<std::uint8_t>(frame[2]);
        read(frame, read_frame);
        set_version(read_frame, version);
        if (version == 2) since_second_ = 0;
        drop(size);
        ++counts_.frames;
        if (last_number_) counts_.missed += static_cast<std::uint8_t>(read_frame.number - *last_number_ - 1);
        last_number_ = read_frame.number;
        return read_frame;
    }
    return std::nullopt;
}

template <typename Frame>
std::optional<Frame> GloveFrameReader<Frame>::take(std::byte byte) noexcept {
    bytes_[count_++] = byte;
    since_second_ = std::min(since_second_ + 1, kSecondHolds);
    return look();
}

template class GloveFrameReader<GloveSet>;
template class GloveFrameReader<GloveCommand>;

}  // namespace burin::devices
