// SPDX-License-Identifier: MIT
// The driver of a Novint Falcon: from a cable to a force at the grip, and to where the grip is.
//
// Opening it asks for a packet. A Falcon that gives none has just been switched on, and is given its firmware: the boot
// loader is greeted at 9,600 a second, and takes the bytes at 140,000 once it is clear to send, each piece said back
// and compared. That fails now and then (libnifalcon, issues 9, 24, 32, 33, 45), and is begun anew up to kMostLoads
// times. Then each turn is a packet either way (falcon_packet.hpp). Until all three encoders are homed the device has a
// fault, its lamp is red, and it gets no force; homed it is blue, and without force green.
// Frame: device: the Falcon's own (falcon_kinematics.hpp), about the middle of its workspace. Thread: the servo's; but
// words_for() any.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "devices/falcon/falcon_kinematics.hpp"
#include "devices/falcon/falcon_packet.hpp"
#include "devices/falcon/falcon_port.hpp"
#include "devices/served/line_servo.hpp"

namespace burin::devices {

// Sizes of the firmware images that are known: Novint's own, and the one that libnifalcon's users load.
inline constexpr std::size_t kNovintFirmware = 7914, kNventFirmware = 8492;

// Reads a firmware file. Fails where it is of no size that is known: what a device is given is not guessed.
[[nodiscard]] Result<std::vector<std::byte>> read_falcon_firmware(const std::string& file);

class FalconLine final : public DeviceLine {
public:
    using OpenPort = std::function<Result<std::unique_ptr<FalconPort>>()>;
    // `name` is as the user calls it, for messages. An empty firmware: the device must have one already.
    FalconLine(std::string name, OpenPort open_port, std::vector<std::byte> firmware)
        : name_(std::move(name)), open_port_(std::move(open_port)), firmware_(std::move(firmware)) {}

    [[nodiscard]] Result<void> open() override;
    [[nodiscard]] bool turn(const DeviceWrench& wrench, ServedState& state) noexcept override;
    void close() noexcept override;
    [[nodiscard]] LineNotice notice() noexcept override;
    [[nodiscard]] std::string words_for(const LineNotice& notice) const override;

    static constexpr Nanoseconds kAnswer_ns = 20'000'000;  // the longest that a turn waits for its packet
    static constexpr int kMostLoads = 10;

private:
    [[nodiscard]] Cable settings_for_run() noexcept;
    [[nodiscard]] Cable exchange(const FalconCommand& command, FalconReport& report) noexcept;
    [[nodiscard]] bool answers() noexcept;
    // Loads it until it runs.
    [[nodiscard]] Result<void> give_firmware();
    [[nodiscard]] Result<void> load_firmware();
    [[nodiscard]] Result<void> greet_boot_loader();
    // Waits until the boot loader is clear to be sent to; a chip that never says so is sent to nevertheless.
    void wait_until_clear_to_send();
    // Reads until so many bytes have come; what came is in `heard`.
    [[nodiscard]] Cable hear(std::vector<std::byte>& heard, std::size_t count, Nanoseconds within_ns);
    void tell(std::uint32_t what, std::int32_t number = 0) noexcept { notice_ = {what, number}; }

    std::string name_;
    OpenPort open_port_;
    std::vector<std::byte> firmware_;
    std::unique_ptr<FalconPort> port_;
    FalconReader reader_;
    FalconPose pose_;  // of the newest packet
    bool has_pose_ = false, is_homed_ = false, is_gone_ = false;
    bool told_unhomed_ = false;
    bool is_boot_loader_silent_ = false;
    int told_loads_ = 0, loads_ = 0;  // that it took to have it run
    LineNotice notice_;
    MonotonicClock clock_;
};

}  // namespace burin::devices
