// SPDX-License-Identifier: MIT
// The registry of all force-feedback devices that there are. To add one, copy devices/sample/sample_device.hpp and its
// source, and enter it in the table of device_registry.cpp: the help of --device and its parsing read that table. A row
// that lacks something does not compile (opening.hpp).
// Thread: the one that opens the session.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/wand_description.hpp"
#include "devices/presence/device_presence.hpp"
#include "devices/registry/opening.hpp"

namespace burin::devices {

class Recordings;  // devices/haptic/recorded_device.hpp

// What a device needs of the program. The clock must outlive the device.
struct HapticHost {
    Clock& clock;  // of a device that is there it must be the machine's
    AnyHand hand;  // what holds the stylus of a simulated device, and leads the palm of a glove
    // A recording is done again, and no device is looked for: whatever there is stands in for one, with the same
    // description. Its samples are the recording's.
    bool stands_in = false;
    const Recordings* recordings = nullptr;  // reads those that are played as a device; null: none can be
};

// What a device is, as far as it can be known before it is opened. Who wants a device asks for what it needs of this,
// and for no device by its name.
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

struct HapticKind {
    std::string_view name;   // as --device spells it
    std::string_view usage;  // what it is, for the help
    // As in DeviceNature:
    Needed<std::size_t> parts;
    Needed<bool> is_upright, is_worn, felt_by_person, has_amplifiers;
    // Returns the handle's description: of the file, or the program's where none is named; null: it has no handle.
    Result<WandDescription> (*handle)(const std::string& file);
    Opening open;
    // Says what of a kind without a driver might be there; null: it is simulated and always there.
    std::vector<DevicePresence> (*might_be_there)() = nullptr;
    // Returns the file in what follows the name, where more than a file can; null: all of it is the file.
    std::string (*file_of)(const std::string& text) = nullptr;
    // Mean what they mean in DeviceNature.
    bool leads_itself = false, has_force = true;
    bool takes_text = true;  // behind its name and a colon; false: the name is all of it
};
[[nodiscard]] std::span<const HapticKind> haptic_kinds();

// Returns the nature of the device of that name, or of NAME:FILE. Fails where there is none of that name, and says
// which there are, and where its description cannot be read. A recorded device is of the nature of the one that was
// recorded.
[[nodiscard]] Result<DeviceNature> nature_of_device(std::string_view name, const Recordings* recordings = nullptr);
// Returns the same of the name alone: no file is read, so that there is no handle, and what a recording plays is not
// known.
[[nodiscard]] Result<DeviceNature> nature_of_name(std::string_view name);
// Returns whether the device of that name has a handle, whatever its description says of it; false where there is no
// such device.
[[nodiscard]] bool has_handle(std::string_view name, const Recordings* recordings = nullptr);
// Returns the names of all devices that have one, for people: "simulated-wand".
[[nodiscard]] std::string devices_with_handles();
// Returns the file that describes a device's handle: FILE of NAME:FILE; empty: none is named, or it has no handle.
[[nodiscard]] std::string handle_file_of(std::string_view name);

inline constexpr const char* kDefaultHapticDevice = "simulated";

// Opens the device of that name, or of NAME:FILE. An Error names the kinds that there are, or says why the device
// cannot be used.
[[nodiscard]] Result<OpenedDevice> open_haptic_device(std::string_view name, HapticHost host);

// Returns all names with what they are, for the help of --device.
[[nodiscard]] std::string haptic_usage();

}  // namespace burin::devices
