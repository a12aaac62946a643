// SPDX-License-Identifier: MIT
#include "devices/emulators/glove_wire.hpp"

#include <cmath>
#include <numbers>

namespace burin::devices {
namespace {

// The tables of docs/glove.md, section "The line".
constexpr unsigned kHostBegins = 0x9e, kControllerBegins = 0x9d, kControllerBeginsSecond = 0x62;
constexpr unsigned kHostForces = 3, kHostStop = 4, kHostLaw = 5;
constexpr std::size_t kHostForcesLength = 8, kHostLawLength = 11;
constexpr double kNewtonsOfStep = 0.05;

unsigned number(std::byte byte) { return std::to_integer<unsigned>(byte); }

// Returns how long a frame is that begins so; 0: none does.
std::size_t host_length(unsigned kind) {
    const unsigned lower = kind % 16, upper = kind / 16;
    if (lower == kHostForces) return kHostForcesLength;
    if (lower == kHostStop && upper == 0) return kHostForcesLength;
    if (lower == kHostLaw && upper <= 3) return kHostLawLength;
    return 0;
}

GloveCommand said_by(std::span<const std::byte> frame) {
    const auto newtons = [&](std::size_t at) { return kNewtonsOfStep * number(frame[at]); };
    const auto upper_first = [&](std::size_t at) { return 256 * number(frame[at]) + number(frame[at + 1]); };
    const unsigned lower = number(frame[1]) % 16, upper = number(frame[1]) / 16;
    GloveCommand command;
    command.number = static_cast<std::uint8_t>(number(frame[2]));
    if (lower == kHostLaw) {
        DriveLaw law;
        law.holds = true;
        law.spring_N_per_m = 0.1 * upper_first(3);
        law.damping_Ns_per_m = 0.05 * number(frame[5]);
        law.friction_N = newtons(6);
        law.start_m = 0.00001 * upper_first(7);
        law.most_N = newtons(9);
        command.law = GloveCommand::Law{static_cast<std::uint8_t>(upper), law};
    } else if (lower == kHostStop) {
        command.stop = true;
    } else {
        command.local = static_cast<std::uint8_t>(upper);
        command.forces_N = {newtons(3), newtons(4), newtons(5), newtons(6)};  // thumb, index, middle, ring
    }
    return command;
}

// Steps of 12 bits from -90 to 180 degrees.
unsigned angle_steps(double angle_rad) {
    const double share = (angle_rad + 0.5 * std::numbers::pi) / (1.5 * std::numbers::pi);
    return !(share > 0.0) ? 0u : share >= 1.0 ? 4095u : static_cast<unsigned>(std::lround(4095.0 * share));
}

unsigned force_steps(double force_N) {
    const double steps = force_N / kNewtonsOfStep;
    return !(steps > 0.0) ? 0u : steps >= 255.0 ? 255u : static_cast<unsigned>(std::lround(steps));
}

// The remainder of the message by a polynomial, as on paper: the message is followed by eight zeros, and one bit after
// the other goes into a register of eight.
std::byte remainder_by(unsigned polynomial, std::span<const std::byte> bytes) {
    unsigned rest = 0;
    for (std::size_t bit = 0; bit < 8 * (bytes.size() + 1); ++bit) {
        const unsigned byte = bit / 8 < bytes.size() ? number(bytes[bit / 8]) : 0u;
        rest = rest << 1 | (byte >> (7 - bit % 8) & 1u);
        if ((rest & 0x100u) != 0) rest ^= polynomial;
    }
    return static_cast<std::byte>(rest);
}

}  // namespace

std::byte controller_check(std::span<const std::byte> bytes) {
    return remainder_by(0b1'0000'0111, bytes);  // x^8 + x^2 + x + 1
}

std::byte controller_second_check(std::span<const std::byte> bytes) {
    return remainder_by(0b1'0001'1101, bytes);  // x^8 + x^4 + x^3 + x^2 + 1
}

std::optional<HeardGloveFrame> GloveControllerEar::take(std::byte byte) {
    waiting_.push_back(byte);
    while (!waiting_.empty()) {
        const bool begins = number(waiting_[0]) == kHostBegins;
        if (begins && waiting_.size() < 2) break;
        const std::size_t length = begins ? host_length(number(waiting_[1])) : 0;
        if (length > waiting_.size()) break;
        const std::span<const std::byte> all(waiting_);
        if (length == 0 || controller_check(all.first(length - 1)) != waiting_[length - 1]) {
            waiting_.erase(waiting_.begin());
            continue;
        }
        const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(length);
        HeardGloveFrame heard{.bytes = {waiting_.begin(), end}, .command = said_by(all.first(length))};
        waiting_.erase(waiting_.begin(), end);
        return heard;
    }
    return std::nullopt;
}

std::vector<std::byte> controller_frame(const GloveSet& set) {
    std::vector<std::byte> frame;
    const auto add = [&](unsigned byte) { frame.push_back(static_cast<std::byte>(byte)); };
    add(set.version == 2 ? kControllerBeginsSecond : kControllerBegins);
    add((set.forces_N ? 2u : 1u) + (set.motors_on ? 0x10u : 0u) + (set.fault ? 0x20u : 0u) +
        (set.is_local ? 0x40u : 0u));
    add(set.number);
    for (const FingerAngles& finger : set.joints) {
        // Two angles in three bytes: to the side and the first flexion, then the second and the third.
        for (const std::size_t pair : {0u, 2u}) {
            const unsigned both = angle_steps(finger[pair]) * 4096 + angle_steps(finger[pair + 1]);
            add(both / 65536);
            add(both / 256 % 256);
            add(both % 256);
        }
    }
    if (set.forces_N)
        for (const double force_N : *set.forces_N) add(force_steps(force_N));
    frame.push_back(controller_check(frame));
    if (set.version == 2) frame.push_back(controller_second_check(frame));
    return frame;
}

}  // namespace burin::devices
