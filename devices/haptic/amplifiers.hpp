// SPDX-License-Identifier: MIT
// What a HapticDevice offers besides, whose amplifiers can be switched by the program.
#pragma once

#include <cstdint>

namespace burin::devices {

enum class AmplifierAnswer : std::uint8_t {
    done,
    cause_remains,  // they stay off, since what tripped them is not over
};

class Amplifiers {
public:
    virtual ~Amplifiers() = default;
    // Switches the amplifiers of the motors, as an operator does: off at any time, and on again after a trip, once its
    // cause is over. While they are off, and in one sample at least, the device reports a fault, so that the force
    // begins from zero afterwards. Any thread; wait-free.
    [[nodiscard]] virtual AmplifierAnswer switch_amplifiers(bool on) noexcept = 0;
};

}  // namespace burin::devices
