// SPDX-License-Identifier: MIT
// What a participant held in a visit and who felt it, told alike by journal, status, report, trials.csv and the facts
// of recordings. It comes of the devices' registry alone (devices/registry/), by no name of a device. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace burin::devices {
struct DeviceNature;  // devices/registry/device_nature.hpp
}  // namespace burin::devices

namespace burin::study {

// What moved the wand, from the least real to the most. Learners, scripts and played recordings are no persons. A
// simulated device is led by mouse, keys, a log or a SpaceMouse, and nobody feels it. An emulated one is the driver of
// a real device with an emulator in the device's place; `device` is one that a person holds and feels. `untold`: an
// earlier Burin wrote the journal, which called every wand a simulated one.
enum class Hand { learner, script, recording, simulated_device, emulated_device, untold, device };
[[nodiscard]] const char* name_of(Hand hand);  // "learner", "script", "recording", "simulated device", ...
[[nodiscard]] std::optional<Hand> hand_named(std::string_view name);
[[nodiscard]] Hand hand_of(const devices::DeviceNature& nature);

struct HeldDevice {
    std::string device{};  // as --device names it; of a script or a learner what stands in for one
    Hand hand = Hand::untold;

    [[nodiscard]] bool felt_by_person() const { return hand == Hand::device; }
};
// "omni:emulated (emulated device; felt by no person)"
[[nodiscard]] std::string text_of(const HeldDevice& held);

// Returns what the journal of an earlier Burin, which has the device's name alone, tells of it.
[[nodiscard]] HeldDevice held_by_name(const std::string& device);

// That the hand is scripted and the device simulated, so that nobody takes it for a person's visit.
inline constexpr const char* kScriptedDevice = "simulated wand, scripted hand";
inline constexpr const char* kLearnersDevice = "simulated wand, simulated hand";

}  // namespace burin::study
