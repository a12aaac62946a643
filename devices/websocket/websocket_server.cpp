// SPDX-License-Identifier: MIT
#include "devices/websocket/websocket_server.hpp"

#include "base/try.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <utility>

namespace burin::devices {

namespace asio = boost::asio;
namespace beast = boost::beast;

struct WebSocketServer::Hall {
    struct Seat {
        explicit Seat(asio::ip::tcp::socket socket) : stream(std::move(socket)) {}
        beast::websocket::stream<asio::ip::tcp::socket> stream;
        beast::flat_buffer heard;
        std::deque<std::string> owed;
        bool writes = false;
    };
    using SeatOf = std::shared_ptr<Seat>;  // what goes on holds it too

    asio::io_context io{1};
    asio::ip::tcp::acceptor door{io};
    NetworkAddress bound;
    std::map<Guest, SeatOf> seats;
    Guest last = 0;
    const Host* host = nullptr;

    void take_next() {
        door.async_accept([this](beast::error_code error, asio::ip::tcp::socket socket) {
            if (!door.is_open()) return;
            if (!error) seat(std::move(socket));
            take_next();
        });
    }
    void seat(asio::ip::tcp::socket socket) {
        const Guest guest = ++last;
        beast::error_code ignored;
        socket.set_option(asio::ip::tcp::no_delay(true), ignored);
        const auto seat = std::make_shared<Seat>(std::move(socket));
        seats[guest] = seat;
        seat->stream.text(true);
        seat->stream.async_accept([this, guest, seat](beast::error_code error) {
            if (error) return leave(guest);
            if (host != nullptr) host->came(guest);
            hear(guest, seat);
        });
    }
    void hear(Guest guest, const SeatOf& seat) {
        seat->stream.async_read(seat->heard, [this, guest, seat](beast::error_code error, std::size_t) {
            if (error) return leave(guest);
            const auto bytes = seat->heard.data();
            const std::string text(static_cast<const char*>(bytes.data()), bytes.size());
            seat->heard.clear();
            if (host != nullptr) host->said(guest, text);
            hear(guest, seat);
        });
    }
    void write(Guest guest, const SeatOf& seat) {
        if (seat->writes || seat->owed.empty()) return;
        seat->writes = true;
        seat->stream.async_write(asio::buffer(seat->owed.front()),
                                 [this, guest, seat](beast::error_code error, std::size_t) {
                                     seat->writes = false;
                                     seat->owed.pop_front();
                                     if (error) return leave(guest);
                                     write(guest, seat);
                                 });
    }
    void leave(Guest guest) {
        const auto found = seats.find(guest);
        if (found == seats.end()) return;
        beast::error_code ignored;
        found->second->stream.next_layer().close(ignored);
        seats.erase(found);
    }
};

WebSocketServer::WebSocketServer(std::unique_ptr<Hall> hall) : hall_(std::move(hall)) {}
WebSocketServer::~WebSocketServer() = default;
WebSocketServer::WebSocketServer(WebSocketServer&& other) noexcept = default;
WebSocketServer& WebSocketServer::operator=(WebSocketServer&& other) noexcept = default;

std::expected<WebSocketServer, std::string> WebSocketServer::listen(const NetworkAddress& at) {
    BURIN_TRY(listening, listen_at(at));
    auto hall = std::make_unique<Hall>();
    beast::error_code error;
    hall->door.assign(asio::ip::tcp::v4(), listening.socket.release(), error);
    if (error) return std::unexpected(error.message());
    hall->bound = listening.bound;
    hall->take_next();
    return WebSocketServer(std::move(hall));
}

const NetworkAddress& WebSocketServer::address() const { return hall_->bound; }

void WebSocketServer::serve_for(Nanoseconds time_ns, const Host& host) {
    hall_->host = &host;
    hall_->io.restart();
    hall_->io.run_for(std::chrono::nanoseconds(time_ns));
    hall_->host = nullptr;
}

void WebSocketServer::send(Guest to, std::string text) {
    const auto found = hall_->seats.find(to);
    if (found == hall_->seats.end()) return;
    const Hall::SeatOf seat = found->second;
    seat->owed.push_back(std::move(text));
    hall_->write(to, seat);
}

void WebSocketServer::drop_all() {
    while (!hall_->seats.empty()) hall_->leave(hall_->seats.begin()->first);
}

}  // namespace burin::devices
