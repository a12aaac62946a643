// SPDX-License-Identifier: MIT
// A device that has been opened, whatever it is: the parts of it that move by themselves, and what it offers besides.
// A stylus is one part, and so is a wand; a glove has a part for each fingertip.
//
// Ownership: the parts are the opened device's; what they share is kept alive by them. Threads: opened by one thread;
// then each part's read() and write() are the haptic thread's (haptic_device.hpp).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "devices/haptic/amplifiers.hpp"
#include "devices/haptic/haptic_device.hpp"

namespace burin::devices {

struct DevicePart {
    std::string name;  // within the device: "index"; empty for the only part
    std::unique_ptr<HapticDevice> device;
};

// What a device has to say to its user besides its samples: errors of a maker's library, a calibration that needs a
// hand.
class DeviceMessages {
public:
    virtual ~DeviceMessages() = default;
    // Returns what has been said since the last call. The frame's thread.
    [[nodiscard]] virtual std::vector<std::string> take_messages() = 0;
    // Returns the commands of a session that its keys have given since the last call, in order: "undo". The frame's
    // thread.
    [[nodiscard]] virtual std::vector<std::string> take_commands() { return {}; }
};

struct OpenedDevice {
    std::vector<DevicePart> parts;       // at least one; all of one rate
    DeviceMessages* messages = nullptr;  // of a part; null: it says nothing
    Amplifiers* amplifiers = nullptr;    // of all parts; null: none that can be switched from here
    // As --device names it with what was found when it was opened, so that what stands in for it has the same
    // description; empty: as it was named.
    std::string settled;
};

// Returns the opened device of the only part that a device has.
[[nodiscard]] inline OpenedDevice of_one_part(std::unique_ptr<HapticDevice> device, Amplifiers* amplifiers = nullptr) {
    OpenedDevice opened;
    opened.amplifiers = amplifiers;
    opened.parts.push_back({{}, std::move(device)});
    return opened;
}

// A part of a device whose parts are read and written by one object: Whole has
// DeviceSample read(std::size_t part) noexcept and void write(std::size_t part, const DeviceWrench&) noexcept,
// and may have void offer(std::size_t part, const DriveLaw&) noexcept.
template <typename Whole>
class PartOf final : public HapticDevice {
public:
    PartOf(std::shared_ptr<Whole> whole, std::size_t part, const DeviceDescription& description)
        : whole_(std::move(whole)), part_(part), description_(description) {}
    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] DeviceSample read() noexcept override { return whole_->read(part_); }
    void write(const DeviceWrench& wrench) noexcept override { whole_->write(part_, wrench); }
    void offer(const DriveLaw& law) noexcept override {
        if constexpr (requires { whole_->offer(part_, law); }) whole_->offer(part_, law);
    }

private:
    std::shared_ptr<Whole> whole_;
    std::size_t part_;
    DeviceDescription description_;
};

// Returns the opened device whose parts are those of one object, all alike, and named in their order.
template <typename Whole>
[[nodiscard]] OpenedDevice of_parts(const std::shared_ptr<Whole>& whole, const DeviceDescription& description,
                                    std::span<const char* const> names) {
    OpenedDevice opened;
    for (std::size_t part = 0; part < names.size(); ++part)
        opened.parts.push_back({names[part], std::make_unique<PartOf<Whole>>(whole, part, description)});
    return opened;
}

}  // namespace burin::devices
