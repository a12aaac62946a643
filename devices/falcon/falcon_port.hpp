// SPDX-License-Identifier: MIT
// The cable to a Novint Falcon, as its USB chip (FTDI) shows it: settings of the serial line behind it, bytes out, and
// pieces of bytes in. The driver knows no more of USB than this, so that the same driver speaks over a socket with an
// emulated device that has the same settings and bytes.
// One thread. No function throws; a cable that was pulled stays pulled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "devices/presence/device_presence.hpp"

namespace burin::devices {

// Requests of the chip, with the values that are needed (libnifalcon f7c727a, FalconCommLibUSB.cpp).
enum class FtdiRequest : std::uint8_t { reset = 0, modem = 1, flow = 2, baud = 3, data = 4, latency = 9 };
inline constexpr std::uint16_t kFtdiPurgeIn = 1, kFtdiPurgeOut = 2;                                // of reset
inline constexpr std::uint16_t kFtdiDtrLow = 0x0100, kFtdiDtrHigh = 0x0101, kFtdiRtsLow = 0x0200;  // of modem
inline constexpr std::uint16_t kFtdiBoot = 0x4138, kFtdiUpload = 0x0015, kFtdiRun = 0x0002;  // of baud: 9,600, 140,000,
                                                                                             // 1,500,000 a second
inline constexpr std::uint16_t kFtdi8N1 = 0x0008;                                            // of data
inline constexpr std::size_t kFtdiPiece =
    64;  // the longest that comes in at once, two bytes of the chip's own included
inline constexpr std::size_t kFtdiOwn = 2;
// Of the first of them: the device behind the chip is clear to be sent to.
inline constexpr std::byte kFtdiClearToSend{0x10};

enum class Cable : std::uint8_t {
    well,
    late,    // nothing came in time; the cable is well as far as is known
    pulled,  // there is no device any more
};

class FalconPort {
public:
    virtual ~FalconPort() = default;
    [[nodiscard]] virtual Cable request(FtdiRequest what, std::uint16_t value) noexcept = 0;
    [[nodiscard]] virtual Cable write(std::span<const std::byte> bytes, Nanoseconds within_ns) noexcept = 0;
    // Reads one piece, which begins with kFtdiOwn bytes of the chip's own; `count` is how many bytes it has in all.
    [[nodiscard]] virtual Cable read(std::span<std::byte, kFtdiPiece> piece, std::size_t& count,
                                     Nanoseconds within_ns) noexcept = 0;
};

// Opens the cable of a Falcon by the place where `burin devices` lists it ("1-4.2"); empty: the first that there is.
// An Error says that there is none, or that it may not be opened, and what to do.
[[nodiscard]] Result<std::unique_ptr<FalconPort>> open_usb_falcon(const std::string& place);
// Looks for Falcons on USB without opening one.
[[nodiscard]] std::vector<DevicePresence> look_for_usb_falcons();

// Opens the socket of an emulated one (devices/emulators/emulated_falcon.hpp) by its name.
[[nodiscard]] Result<std::unique_ptr<FalconPort>> open_emulated_falcon(const std::string& name);
// Returns the names of the emulated Falcons that run now.
[[nodiscard]] std::vector<std::string> emulated_falcons();

}  // namespace burin::devices
