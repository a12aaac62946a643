// SPDX-License-Identifier: MIT
// What Haply's service says and takes, as its maker's documentation has it: JSON over a websocket. Whoever connects
// gets the whole state with what devices there are; each message to the service gets one state. Pure.
// Frame: the service's x is to the right, its y away from the user, its z up, metres from the middle of the device's
// base; what is here is in the device frame, whose origin is the middle of the workspace.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/space.hpp"

namespace burin::devices {

// Where the middle of the workspace is taken to be, in the service's frame: assumed, as the maker does not say.
inline constexpr Vec3 kInverse3Middle_m{0.0, -0.13, 0.16};

enum class Inverse3Trouble : std::uint8_t { none, uncalibrated, without_power, not_ready };

// A device, as one state has it.
struct Inverse3State {
    std::string id;
    std::optional<Vec3> position_m;          // none: it is missing, or no number
    std::optional<Inverse3Trouble> trouble;  // none: the state does not say
};
struct Inverse3Words {
    std::vector<Inverse3State> devices;
    // Of the first handle that there is. None: there is none, or its turn is none.
    std::optional<Quat> orientation;
    bool has_handle = false;
    std::uint32_t buttons = 0;
    // Version 3.5 and later: forces are "vector" and not "values". Of the first message alone.
    bool takes_vector = false;
};

// Reads a state. Nothing where it is no JSON, or has no list of devices: another language, or another version.
[[nodiscard]] std::optional<Inverse3Words> read_inverse3(std::string_view text) noexcept;
// Returns their ids, which live as long as the words.
[[nodiscard]] std::vector<std::string_view> inverse3_ids(const Inverse3Words& words);
// Returns the device of that id; null: it is not there.
[[nodiscard]] const Inverse3State* inverse3_of(const Inverse3Words& words, std::string_view id) noexcept;

// Returns a command that gives a force for this one turn of the service.
[[nodiscard]] std::string inverse3_force(std::string_view id, const Vec3& force_N, bool takes_vector);
// Returns what asks for the whole state, as at first.
[[nodiscard]] std::string inverse3_asks_for_all();

}  // namespace burin::devices
