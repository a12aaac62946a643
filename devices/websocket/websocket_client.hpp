// SPDX-License-Identifier: MIT
// One end of a websocket (RFC 6455) of text messages, by Boost.Beast, which no other header shows: it is connected,
// sends and receives, each within a time that its caller gives. IPv4, without TLS. One thread at a time.
#pragma once

#include <cstddef>
#include <expected>
#include <memory>
#include <string>
#include <string_view>

#include "base/clock.hpp"
#include "devices/trackers/network.hpp"

namespace burin::devices {

// A longer message ends the connection.
inline constexpr std::size_t kMostWebSocketMessage = 256 * 1024;

class WebSocketClient {
public:
    // Connects and shakes hands. An error says in words why that cannot be.
    [[nodiscard]] static std::expected<WebSocketClient, std::string> connect(const NetworkAddress& to,
                                                                             Nanoseconds within_ns);
    ~WebSocketClient();
    WebSocketClient(WebSocketClient&& other) noexcept;
    WebSocketClient& operator=(WebSocketClient&& other) noexcept;

    enum class Outcome { well, late, gone };
    // late: what was sent before has not left yet, and this is not sent.
    [[nodiscard]] Outcome send(std::string_view text, Nanoseconds within_ns) noexcept;
    // Waits for the next message. late: it may come yet, and is the next call's.
    [[nodiscard]] Outcome receive(std::string& text, Nanoseconds within_ns) noexcept;
    // Says goodbye, and waits for no more than that has left.
    void close(Nanoseconds within_ns) noexcept;

private:
    struct Wire;
    explicit WebSocketClient(std::unique_ptr<Wire> wire);
    std::unique_ptr<Wire> wire_;
};

}  // namespace burin::devices
