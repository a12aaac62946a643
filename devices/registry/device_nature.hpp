// SPDX-License-Identifier: MIT
// Properties of a force-feedback device that do not depend on its kind, as plain data. The registry returns them for a
// device's name (devices/registry/device_registry.hpp).
#pragma once

#include <cstddef>
#include <optional>

#include "devices/haptic/wand_description.hpp"

namespace burin::devices {

// Properties of a device that are known before it is opened. Code that needs a certain device asks for the property and
// never for a name.
struct DeviceNature {
    std::size_t parts = 1;        // that move by themselves
    bool is_upright = false;      // held as a handle or a hand is, not as a pen
    bool is_worn = false;         // on a hand, whose bending fingers are its parts
    bool felt_by_person = true;   // false: by a simulated hand alone, or by an emulator's
    bool is_emulated = false;     // its driver is real, and speaks with `burin devices emulate` in place of the device
    bool has_force = true;        // pushes whatever hand leads it; false: nobody's, as with a mouse
    bool has_amplifiers = false;  // that the program can switch
    bool is_played = false;       // by a recording: it asks nobody, and takes no force
    bool leads_itself = false;    // simulated, and led by neither a script nor the mouse
    // A handle with points of its own that touch, in place of one tip, and with a jig to calibrate it in: its
    // description, from the device's file or from the program. None: the device has none.
    std::optional<WandDescription> handle;
};

}  // namespace burin::devices
