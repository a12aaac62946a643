// SPDX-License-Identifier: MIT
// libFuzzer body of the readers of a glove's serial line. Whatever the bytes: no fault, values within what a frame
// holds, each byte counted once; and three sound frames behind them bring the reader into step again.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "devices/gloves/glove_frame.hpp"

namespace {

using namespace burin::devices;

void require(bool condition) {
    if (!condition) std::abort();
}

void check(const GloveSet& set) {
    for (const FingerAngles& finger : set.joints)
        for (const double angle : finger)
            require(angle >= kLeastAngle_rad - 1e-9 && angle <= kLeastAngle_rad + kAngleRange_rad + 1e-9);
    if (!set.forces_N) return;
    for (const double force_N : *set.forces_N) require(force_N >= 0.0 && force_N <= kMostFrameForce_N);
}
void check(const GloveCommand& command) {
    for (const double force_N : command.forces_N) require(force_N >= 0.0 && force_N <= kMostFrameForce_N);
}

// Reads the bytes, then three frames of `sound`, of which the last must be found: the first two may be lost to a frame
// that the bytes began.
template <typename Frame>
void read_and_recover(const std::uint8_t* data, std::size_t size, Frame sound) {
    GloveFrameReader<Frame> reader;
    const auto take = [&](std::byte byte) {
        const auto frame = reader.take(byte);
        if (frame) check(*frame);
        return frame;
    };
    for (std::size_t i = 0; i < size; ++i) static_cast<void>(take(static_cast<std::byte>(data[i])));
    require(reader.counts().dropped_bytes <= size);
    bool is_found = false;
    for (std::uint8_t number = 1; number <= 3; ++number) {
        sound.number = number;
        for (const std::byte byte : frame_of(sound).view()) {
            const auto frame = take(byte);
            is_found = frame && frame->number == 3;
        }
    }
    require(is_found);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    read_and_recover(data, size, GloveSet{.forces_N = GloveForces{1.0, 2.0, 3.0, 4.0}});
    read_and_recover(data, size, GloveSet{});
    read_and_recover(data, size, GloveCommand{.forces_N = {1.0, 0.0, 2.0, 0.0}});
    return 0;
}
