// SPDX-License-Identifier: MIT
// The other end: takes websocket connections of text messages, for emulators. One thread.
#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/clock.hpp"
#include "devices/trackers/network.hpp"

namespace burin::devices {

class WebSocketServer {
public:
    // Who is spoken with: a number that no other connection has or had.
    using Guest = std::uint64_t;
    struct Host {
        std::function<void(Guest)> came;  // after the handshake
        std::function<void(Guest, std::string_view text)> said;
    };

    // Listens; port 0: a free one. An error says in words why that cannot be.
    [[nodiscard]] static std::expected<WebSocketServer, std::string> listen(const NetworkAddress& at);
    ~WebSocketServer();
    WebSocketServer(WebSocketServer&& other) noexcept;
    WebSocketServer& operator=(WebSocketServer&& other) noexcept;

    [[nodiscard]] const NetworkAddress& address() const;
    // Takes guests and messages for so long; `host` must outlive it.
    void serve_for(Nanoseconds time_ns, const Host& host);
    // Sends after what was sent to the same guest before; one who has gone gets nothing.
    void send(Guest to, std::string text);
    // Ends all connections without a goodbye, as a service that dies.
    void drop_all();

private:
    struct Hall;
    explicit WebSocketServer(std::unique_ptr<Hall> hall);
    std::unique_ptr<Hall> hall_;
};

}  // namespace burin::devices
