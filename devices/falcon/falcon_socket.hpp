// SPDX-License-Identifier: MIT
// The socket between the driver of a Falcon and an emulated one, in place of USB: a UNIX socket of messages
// (SOCK_SEQPACKET) in the abstract namespace, named after the user and the emulator. A message is what USB would carry:
//   host to device   'c', request, value low, value high   a request of the chip
//                    'w', bytes                            bytes out
//   device to host   a piece that comes in (falcon_port.hpp)
// Only processes of the same user are spoken with. Any thread.
#pragma once

#include <sys/un.h>

#include <string>

namespace burin::devices {

inline constexpr char kFalconControl = 'c', kFalconWrite = 'w';
inline constexpr std::size_t kMostFalconMessage = 1 + 64;

struct FalconSocketName {
    sockaddr_un address{};
    unsigned int size = 0;
};
[[nodiscard]] FalconSocketName falcon_socket_name(const std::string& name);
// Returns what is before the emulator's name in the system's list of sockets.
[[nodiscard]] std::string falcon_socket_prefix();
// Whether the process at the other end is this user's.
[[nodiscard]] bool is_own_process(int socket);

}  // namespace burin::devices
