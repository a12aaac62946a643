// SPDX-License-Identifier: MIT
// The smallest whole driver, to be copied: docs/writing-a-driver.md leads through it. `--device sample` opens it on any
// machine, since the device is made up: an arm that swings about its middle, behind a cable that carries packets.
//
// A packet down is the force, three little-endian floats in newtons; one up is where the handle is, three in metres,
// and a byte of buttons. A cable that carries nothing for kSampleSilent turns has lost its device.
// Frame: device, about the middle of the workspace, which is +X right, +Y up, +Z to the user. Threads: as LineServo.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "devices/hand/any_hand.hpp"
#include "devices/presence/device_presence.hpp"
#include "devices/served/line_servo.hpp"

namespace burin::devices {

inline constexpr const char* kSample = "sample";
inline constexpr double kSampleMost_N = 4.0;
inline constexpr int kSampleSilent = 20;  // turns, and so milliseconds

// ---- 1. The bytes: pure, with every number from the other end checked

using SampleCommandBytes = std::array<std::byte, 12>;
using SampleReportBytes = std::array<std::byte, 13>;
struct SampleReport {
    Vec3 position_device_m{0.0};
    std::uint32_t buttons = 0;
};
// Returns the packet of a force, shortened to what the device takes.
[[nodiscard]] SampleCommandBytes sample_command_bytes(const Vec3& force_device_N) noexcept;
// Returns what a packet says; nothing where it is of another size or has a number that is none.
[[nodiscard]] std::optional<SampleReport> sample_report(std::span<const std::byte> packet) noexcept;

// ---- 2. The cable, as thin as what carries the bytes: a serial line, a socket, a maker's library

class SampleCable {
public:
    virtual ~SampleCable() = default;
    // Sends a command and returns the bytes of the report; empty where none has come. May wait.
    [[nodiscard]] virtual std::span<const std::byte> exchange(const SampleCommandBytes& command) noexcept = 0;
};
// Returns the made-up arm's; a driver of yours opens a port here.
[[nodiscard]] Result<std::unique_ptr<SampleCable>> open_sample_cable();

// ---- 3. The line: a turn a millisecond on a thread of its own

class SampleLine final : public DeviceLine {
public:
    using OpenCable = std::function<Result<std::unique_ptr<SampleCable>>()>;
    explicit SampleLine(OpenCable open_cable) : open_cable_(std::move(open_cable)) {}

    [[nodiscard]] Result<void> open() override;
    [[nodiscard]] bool turn(const DeviceWrench& wrench, ServedState& state) noexcept override;
    void close() noexcept override { cable_.reset(); }
    [[nodiscard]] LineNotice notice() noexcept override { return std::exchange(notice_, {}); }
    [[nodiscard]] std::string words_for(const LineNotice& notice) const override;

private:
    OpenCable open_cable_;
    std::unique_ptr<SampleCable> cable_;
    int silent_ = 0;        // turns in a row without a report
    bool is_gone_ = false;  // said, and not yet back
    LineNotice notice_;
};

// ---- 4. What the row of the table in devices/registry/device_registry.cpp names

// Opens the device. The clock must be the machine's and outlive it. `hand` is not followed.
[[nodiscard]] Result<OpenedDevice> open_sample(const std::string& text, AnyHand hand, Clock& clock);
// Returns one that is nowhere and rests, for a recording that is done again.
[[nodiscard]] OpenedDevice sample_that_rests(Clock& clock);
[[nodiscard]] std::vector<DevicePresence> look_for_samples();

}  // namespace burin::devices
