// SPDX-License-Identifier: MIT
#include "devices/websocket/websocket_client.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <utility>

namespace burin::devices {

namespace asio = boost::asio;
namespace beast = boost::beast;

struct WebSocketClient::Wire {
    asio::io_context io{1};
    beast::websocket::stream<asio::ip::tcp::socket> stream{io};
    beast::flat_buffer heard;
    std::string said;
    bool reads = false, writes = false, has_heard = false, is_gone = false;

    // Has what goes on go on until it holds, or the time is over.
    template <typename Holds>
    bool run_until(Holds holds, Nanoseconds within_ns) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::nanoseconds(within_ns);
        io.restart();
        while (!holds() && io.run_one_until(end) > 0) {
        }
        return holds();
    }
    void read() {
        reads = true;
        stream.async_read(heard, [this](beast::error_code error, std::size_t) {
            reads = false;
            has_heard = !error;
            is_gone = is_gone || error;
        });
    }
    void write(std::string_view text) {
        said = text;
        writes = true;
        stream.async_write(asio::buffer(said), [this](beast::error_code error, std::size_t) {
            writes = false;
            is_gone = is_gone || error;
        });
    }
};

WebSocketClient::WebSocketClient(std::unique_ptr<Wire> wire) : wire_(std::move(wire)) {}
WebSocketClient::~WebSocketClient() = default;
WebSocketClient::WebSocketClient(WebSocketClient&& other) noexcept = default;
WebSocketClient& WebSocketClient::operator=(WebSocketClient&& other) noexcept = default;

std::expected<WebSocketClient, std::string> WebSocketClient::connect(const NetworkAddress& to, Nanoseconds within_ns) {
    const auto begun = std::chrono::steady_clock::now();
    BURIN_TRY(socket, connect_to(to, within_ns));
    auto wire = std::make_unique<Wire>();
    beast::error_code error;
    wire->stream.next_layer().assign(asio::ip::tcp::v4(), socket.release(), error);
    if (error) return std::unexpected(error.message());
    wire->stream.read_message_max(kMostWebSocketMessage);
    wire->stream.text(true);
    bool is_done = false;
    wire->stream.async_handshake(to.text(), "/", [&](beast::error_code e) {
        is_done = true;
        error = e;
    });
    const Nanoseconds past_ns =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begun).count();
    if (!wire->run_until([&] { return is_done; }, std::max<Nanoseconds>(within_ns - past_ns, 1'000'000)))
        return std::unexpected("it says nothing when it is greeted");
    if (error) return std::unexpected("it does not speak the websocket protocol: " + error.message());
    return WebSocketClient(std::move(wire));
}

WebSocketClient::Outcome WebSocketClient::send(std::string_view text, Nanoseconds within_ns) noexcept {
    const auto has_left = [&] { return !wire_->writes || wire_->is_gone; };
    if (!wire_->run_until(has_left, within_ns)) return Outcome::late;
    if (wire_->is_gone) return Outcome::gone;
    wire_->write(text);
    static_cast<void>(wire_->run_until(has_left, within_ns));
    return wire_->is_gone ? Outcome::gone : Outcome::well;
}

WebSocketClient::Outcome WebSocketClient::receive(std::string& text, Nanoseconds within_ns) noexcept {
    if (!wire_->is_gone && !wire_->reads && !wire_->has_heard) wire_->read();
    static_cast<void>(wire_->run_until([&] { return wire_->has_heard || wire_->is_gone; }, within_ns));
    if (!wire_->has_heard) return wire_->is_gone ? Outcome::gone : Outcome::late;
    const auto bytes = wire_->heard.data();
    text.assign(static_cast<const char*>(bytes.data()), bytes.size());
    wire_->heard.clear();
    wire_->has_heard = false;
    return Outcome::well;
}

void WebSocketClient::close(Nanoseconds within_ns) noexcept {
    if (wire_->is_gone) return;
    bool is_done = false;
    static_cast<void>(wire_->run_until([&] { return !wire_->writes; }, within_ns));
    if (!wire_->writes)
        wire_->stream.async_close(beast::websocket::close_code::normal, [&](beast::error_code) { is_done = true; });
    static_cast<void>(wire_->run_until([&] { return is_done; }, within_ns));
    // What still goes on must not be called back with what is about to leave.
    beast::error_code ignored;
    wire_->stream.next_layer().close(ignored);
    wire_->is_gone = true;
    static_cast<void>(wire_->run_until([&] { return is_done && !wire_->reads && !wire_->writes; }, within_ns));
    wire_->io.stop();
}

}  // namespace burin::devices
