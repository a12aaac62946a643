// SPDX-License-Identifier: MIT
#include "app/session/tracker_port.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include "app/session/input_line.hpp"

namespace burin {
namespace {

constexpr std::size_t kMostBytes = 4096;    // of a datagram: some twenty poses
constexpr std::size_t kMostWaiting = 4096;  // seconds of a fast tracker, when nobody takes them
constexpr const char* kRemedy =
    "give udp:PORT, or udp:ADDRESS:PORT with an address of this machine, such as udp:0.0.0.0:5005";

Result<sockaddr_in> address_of(const std::string& where) {
    if (!where.starts_with("udp:")) return fail("tracker " + where, "is no udp address", kRemedy);
    const std::string rest = where.substr(4);
    const std::size_t colon = rest.rfind(':');
    const std::string host = colon == std::string::npos ? "127.0.0.1" : rest.substr(0, colon);
    const std::string port = colon == std::string::npos ? rest : rest.substr(colon + 1);
    std::uint16_t number = 0;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    if (error != std::errc{} || end != port.data() + port.size() ||
        inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1)
        return fail("tracker " + where, "has no such port or address", kRemedy);
    address.sin_port = htons(number);
    return address;
}

bool is_a_trackers(const Input& input) {
    return std::holds_alternative<HeadInput>(input) || std::holds_alternative<WandInput>(input) ||
           std::holds_alternative<WandClick>(input) || std::holds_alternative<WandStick>(input);
}

}  // namespace

Result<std::unique_ptr<TrackerPort>> TrackerPort::open(const std::string& where, Clock& clock,
                                                       std::function<void()> on_news) {
    auto port = std::unique_ptr<TrackerPort>(new TrackerPort(clock, std::move(on_news)));
    if (const auto bound = port->bind_to(where); !bound) return std::unexpected(bound.error());
    port->thread_ = std::thread([p = port.get()] { p->listen(); });
    return port;
}

Result<void> TrackerPort::bind_to(const std::string& where) {
    const auto address = address_of(where);
    if (!address) return std::unexpected(address.error());
    stop_ = eventfd(0, EFD_CLOEXEC);
    socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const auto* plain = reinterpret_cast<const sockaddr*>(&*address);
    if (stop_ < 0 || socket_ < 0 || bind(socket_, plain, sizeof(*address)) != 0) {
        return fail("tracker " + where, std::string("cannot be listened to: ") + std::strerror(errno),  // NOLINT
                    "another program may have the port; choose another one, or an address of this machine");
    }
    sockaddr_in bound{};
    socklen_t size = sizeof(bound);
    if (getsockname(socket_, reinterpret_cast<sockaddr*>(&bound), &size) == 0) port_ = ntohs(bound.sin_port);
    return {};
}

TrackerPort::~TrackerPort() {
    if (thread_.joinable()) {
        const std::uint64_t one = 1;
        while (write(stop_, &one, sizeof(one)) < 0 && errno == EINTR) {
        }
        thread_.join();
    }
    if (socket_ >= 0) close(socket_);
    if (stop_ >= 0) close(stop_);
}

void TrackerPort::listen() {
    std::array<char, kMostBytes> datagram{};
    std::array<pollfd, 2> ready{{{socket_, POLLIN, 0}, {stop_, POLLIN, 0}}};
    while (true) {
        if (poll(ready.data(), ready.size(), -1) < 0 && errno != EINTR) return;
        if (ready[1].revents != 0) return;
        const ssize_t size = recv(socket_, datagram.data(), datagram.size(), 0);
        if (size < 0) continue;
        hear({datagram.data(), static_cast<std::size_t>(size)}, clock_.now_ns());
        if (on_news_) on_news_();
    }
}

void TrackerPort::hear(std::string_view datagram, Nanoseconds now_ns) {
    const std::lock_guard lock(mutex_);
    while (!datagram.empty()) {
        const std::size_t end = datagram.find('\n');
        const std::string line(datagram.substr(0, end));
        datagram.remove_prefix(end == std::string_view::npos ? datagram.size() : end + 1);
        const auto event = parse_line(line.empty() ? line : "0 " + line, "tracker");
        if (!event) {
            refuse(event.error().line(), now_ns);
        } else if (*event && !is_a_trackers((*event)->input)) {
            refuse("tracker: only head, wand, wand-button and wand-stick come from there", now_ns);
        } else if (*event && heard_.size() >= kMostWaiting) {
            ++refused_;
        } else if (*event) {
            heard_.push_back({now_ns, std::move((*event)->input)});
        }
    }
}

// Whoever sends nonsense sends it often.
void TrackerPort::refuse(const std::string& why, Nanoseconds now_ns) {
    ++refused_;
    if (said_ && now_ns - said_ns_ < kNanosecondsPerSecond) return;
    said_ = true;
    said_ns_ = now_ns;
    messages_.push_back(why);
}

std::vector<TrackerPort::Heard> TrackerPort::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(heard_, {});
}

std::vector<std::string> TrackerPort::take_messages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

std::uint64_t TrackerPort::refused() const {
    const std::lock_guard lock(mutex_);
    return refused_;
}

}  // namespace burin
