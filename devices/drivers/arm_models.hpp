// SPDX-License-Identifier: MIT
// The arms that a maker's library may be of, with the figures that each is described by, and the name of a model in
// what --device takes: NAME,model=KEY@LIBRARY. A driver finds the model by asking the library, and says it in the
// settled text, so that a recording is done again with the same figures and without the device.
//
// Forces and stiffness are those that CHAI3D 3.2 has for the same arms, in its cDeltaDevice and cPhantomDevice; no edge
// of a box is longer than the diameter that it has for them. Mass, damping and friction are assumed low. An arm that is
// not known has the lowest figures of those that are. Torques of handles that are driven are not described: they get
// none. Pure.
#pragma once

#include <string>
#include <string_view>

#include "devices/haptic/simulated_omni.hpp"

namespace burin::devices {

struct ArmModel {
    std::string_view key;  // as model=KEY
    const char* name = "";
    OmniModel figures;
};

// Returns what HDAPI's model string means. A library whose greatest force is below the model's means the first one, a
// PHANTOM Omni, as does a string that is not known.
[[nodiscard]] const ArmModel& hd_model(std::string_view said, double most_N);
// Tells whether the string names one of the PHANTOMs that are described.
[[nodiscard]] bool hd_knows(std::string_view said);
// Returns what DHD's system type means. A type that CHAI3D has no figures for, as a lambda's, is the unknown one.
[[nodiscard]] const ArmModel& dhd_model(int type);
[[nodiscard]] bool dhd_knows(int type);
// Return the model of that key; the first one where there is none.
[[nodiscard]] const ArmModel& hd_model_called(std::string_view key);
[[nodiscard]] const ArmModel& dhd_model_called(std::string_view key);
// Returns their keys, for people.
[[nodiscard]] std::string hd_model_keys();
[[nodiscard]] std::string dhd_model_keys();
// Tells whether a device of this type has a gripper, which presses the first button where the library is told so.
[[nodiscard]] bool dhd_has_gripper(int type) noexcept;

struct ModelledText {
    std::string text;   // without the model
    std::string model;  // its key; empty: none was named
};
[[nodiscard]] ModelledText without_model(const std::string& text);
// Returns the text with a model in it, before @LIBRARY.
[[nodiscard]] std::string with_model(const std::string& text, std::string_view key);

}  // namespace burin::devices
