// SPDX-License-Identifier: MIT
// Sockets of trackers and of their emulators: opened with a reason where that fails, closed when they go out of scope.
// Errors say what is wrong in words; the caller says whose it is. IPv4. Any thread.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "devices/presence/owned_file.hpp"

namespace burin::devices {

// How the error of an address begins whose host is not known.
inline constexpr std::string_view kNoSuchMachine = "no such machine";

struct NetworkAddress {
    std::string host = "127.0.0.1";
    std::uint16_t port = 0;
    [[nodiscard]] std::string text() const { return host + ":" + std::to_string(port); }
};

// Reads HOST, HOST:PORT or PORT alone; what is left out is as in `usual`. Nothing where it is none of these.
[[nodiscard]] std::optional<NetworkAddress> network_address(const std::string& text, const NetworkAddress& usual);

// Connects by TCP, within so long, the search for the machine's name included. Nothing that is sent waits for more to
// send (TCP_NODELAY); reads do not block. `stop` ends it early; null: nothing does.
[[nodiscard]] std::expected<OwnedFile, std::string> connect_to(const NetworkAddress& to, Nanoseconds within_ns,
                                                               const StopSign* stop = nullptr);
// Listens for TCP connections, or binds for datagrams; of the port 0 the system's choice is in `bound`. Datagrams of a
// multicast group (224.0.0.0 to 239.255.255.255) are those of the group on all networks of this machine, and others may
// hear them too.
struct BoundSocket {
    OwnedFile socket;
    NetworkAddress bound;
};
[[nodiscard]] std::expected<BoundSocket, std::string> listen_at(const NetworkAddress& at);
[[nodiscard]] std::expected<BoundSocket, std::string> receive_at(const NetworkAddress& at);

// Opens a socket that sends datagrams to one address; a datagram that nobody takes is lost.
[[nodiscard]] std::expected<OwnedFile, std::string> sender_to(const NetworkAddress& to);
void send_datagram(const OwnedFile& socket, std::string_view datagram);

}  // namespace burin::devices
