// SPDX-License-Identifier: MIT
// Messages on the socket between the driver of a Falcon and an emulated one (devices/presence/emulator_socket.hpp), one
// for each transfer that USB would carry:
//   host to device   'c', request, value low, value high   a request of the chip
//                    'w', bytes                            bytes out
//   device to host   a piece that comes in (falcon_port.hpp); the first one is the greeting
#pragma once

#include <cstddef>

namespace burin::devices {

inline constexpr char kFalconControl = 'c', kFalconWrite = 'w';
inline constexpr std::size_t kMostFalconMessage = 1 + 64;

}  // namespace burin::devices
