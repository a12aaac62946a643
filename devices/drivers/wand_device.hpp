// SPDX-License-Identifier: MIT
// A Quanser 5-DOF wand by its maker's library (hil_wand.hpp): wand, wand:IDENTIFIER of its card, wand:FILE.toml for a
// wand that FILE describes, wand:IDENTIFIER,FILE.toml for both, and @LIBRARY behind any of them for a library that the
// system's loader does not find. Identifiers that begin with "emulated" are those of `burin devices emulate wand`,
// whose library stands beside the program; an identifier with :// is of a card on another machine.
//
// What a file leaves out is the wand of quanser_wand_of_maker(). A tick's sample is of a turn ago (served_arm.hpp).
// Steps of place and turn are what the encoders' steps make at the handle, the greatest over the workspace. The wand
// has no button that is known. Threads: as haptic_device.hpp.
#pragma once

#include <string>
#include <vector>

#include "devices/hand/any_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/wand_description.hpp"
#include "devices/presence/device_presence.hpp"

namespace burin::devices {

inline constexpr const char* kHilWand = "wand";
inline constexpr const char* kEmulatedHilLibrary = "libburin_emulated_hil.so";

struct WandAddress {
    std::string card = "0", file, library;  // file and library may be empty
    bool names_library = false;             // by an @
};
[[nodiscard]] WandAddress wand_address(const std::string& text);

// Returns the wand that the text's file describes.
[[nodiscard]] Result<WandDescription> wand_at(const std::string& text);
// Refuses a text that names no library behind its @.
[[nodiscard]] Result<void> check_wand(const std::string& text);
// The clock must be the machine's and outlive the device. `hand` is not followed: a person's is there.
[[nodiscard]] Result<OpenedDevice> open_wand(const std::string& text, AnyHand hand, Clock& clock);
// One that is nowhere and rests, for a recording that is done again.
[[nodiscard]] Result<OpenedDevice> wand_that_rests(const std::string& text, Clock& clock);
// Looks for the maker's library, and for emulated wands. Opens none: that would take it from who uses it.
[[nodiscard]] std::vector<DevicePresence> look_for_wands();

}  // namespace burin::devices
