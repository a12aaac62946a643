// SPDX-License-Identifier: MIT
// Whether a device is there, and why not: what `burin devices` lists. Plain data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace burin::devices {

enum class Presence : std::uint8_t {
    there,      // it can be opened
    perhaps,    // what leads to it is there; whether it is, shows when it is opened
    absent,     // nothing of it is there
    forbidden,  // it is there, and this user or program may not open it
    unusable,   // it is there, and cannot be used
};

struct DevicePresence {
    Presence presence = Presence::absent;
    std::string name;    // as --device or --tracker takes it
    std::string cause;   // what was found, or what is missing
    std::string remedy;  // what the user can do; empty: nothing needs to be done
};

// Words for text and JSON, in the order of Presence.
[[nodiscard]] constexpr const char* name_of(Presence presence) {
    switch (presence) {
        case Presence::there: return "there";
        case Presence::perhaps: return "perhaps";
        case Presence::absent: return "absent";
        case Presence::forbidden: return "forbidden";
        case Presence::unusable: return "unusable";
    }
    return "";
}

}  // namespace burin::devices
