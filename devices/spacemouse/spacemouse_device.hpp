// SPDX-License-Identifier: MIT
// A SpaceMouse that leads a hand: --device spacemouse, with a stylus, and spacemouse-wand, with a wand. The cap gives
// no force, so the stylus and what feels are a simulated device's; the hand that holds it is led by the cap instead of
// by the mouse of the desk.
//
// The hand's target goes where the rates lead it (spacemouse_rates.hpp), within the workspace, and never farther from
// the stylus than the hand has to be to press as hard as the device can: else the way back from a wall would take as
// long as the push into it. Buttons: the first presses, the second undoes a stroke, the third takes the scene along
// (the device's second button), the fourth does again what was undone.
// Faults: none of the cable is there, or its thread is silent: the target is where the stylus is, and no button is
// down. Frame: device. Threads: as haptic_device.hpp; take_messages() and take_commands() are the frame's.
#pragma once

#include <string>
#include <vector>

#include "devices/hand/any_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/wand_description.hpp"
#include "devices/spacemouse/spacemouse_port.hpp"

namespace burin::devices {

inline constexpr const char* kSpaceMouseWand = "spacemouse-wand";
inline constexpr Nanoseconds kSpaceMouseLost_ns = 500'000'000;  // a thread that is silent for so long
// From the stylus to where the hand means to be: 3 N of its grip, which a device of 3.3 N can hold.
inline constexpr double kSpaceMouseLead_m = 0.015;
inline constexpr double kSpaceMouseTurnLead_rad = 0.3;

// `text` is what follows the name (spacemouse_rates.hpp). Refuse one with settings that are none, and the first also
// one that describes a wand.
[[nodiscard]] Result<void> check_spacemouse(const std::string& text);
[[nodiscard]] Result<void> check_spacemouse_wand(const std::string& text);
// The clock must be the machine's and outlive the device. The hand says where it begins, and is not followed.
[[nodiscard]] Result<OpenedDevice> open_spacemouse(const std::string& text, AnyHand hand, Clock& clock);
[[nodiscard]] Result<OpenedDevice> open_spacemouse_wand(const std::string& text, AnyHand hand, Clock& clock);
// Devices that are nowhere and rest, for a recording that is done again.
[[nodiscard]] OpenedDevice spacemouse_that_rests(Clock& clock);
[[nodiscard]] Result<OpenedDevice> spacemouse_wand_that_rests(const std::string& text, Clock& clock);
// Looks as look_for_spacemice() does; the names are those of the wand.
[[nodiscard]] std::vector<DevicePresence> look_for_spacemouse_wands();
// Returns the description of the wand that the text names: a file's, or the program's.
[[nodiscard]] Result<WandDescription> spacemouse_wand_described(const std::string& text);
[[nodiscard]] std::string spacemouse_file_of(const std::string& text);

}  // namespace burin::devices
