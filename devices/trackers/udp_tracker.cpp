// SPDX-License-Identifier: MIT
#include "devices/trackers/udp_tracker.hpp"

#include "base/try.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

namespace burin::devices {
namespace {

constexpr std::size_t kMostDatagramBytes = 4096;  // per datagram: some twenty poses
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

}  // namespace

Result<std::unique_ptr<UdpTracker>> UdpTracker::open(const std::string& where, TrackerHost host) {
    auto tracker = std::unique_ptr<UdpTracker>(new UdpTracker(host));
    if (host.described != nullptr) {
        BURIN_TRY(bodies, tracker_bodies(where, {}, {}, host));
        tracker->translator_.emplace(where, std::move(bodies), tracker->inbox_);
    }
    BURIN_TRY_DO(tracker->bind_to(where));
    tracker->thread_ = std::thread([t = tracker.get()] { t->listen(); });
    return tracker;
}

Result<std::unique_ptr<Tracker>> open_udp_tracker(const std::string& where, TrackerHost host) {
    return UdpTracker::open(where, std::move(host));
}

Result<void> UdpTracker::bind_to(const std::string& where) {
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

UdpTracker::~UdpTracker() {
    if (thread_.joinable()) {
        const std::uint64_t one = 1;
        while (write(stop_, &one, sizeof(one)) < 0 && errno == EINTR) {
        }
        thread_.join();
    }
    if (socket_ >= 0) close(socket_);
    if (stop_ >= 0) close(stop_);
}

void UdpTracker::listen() {
    std::array<char, kMostDatagramBytes> datagram{};
    std::array<pollfd, 2> ready{{{socket_, POLLIN, 0}, {stop_, POLLIN, 0}}};
    while (true) {
        if (poll(ready.data(), ready.size(), -1) < 0 && errno != EINTR) return;
        if (ready[1].revents != 0) return;
        const ssize_t sent = recv(socket_, datagram.data(), datagram.size(), MSG_TRUNC);  // bytes, also lost ones
        if (sent < 0) continue;
        const auto bytes = static_cast<std::size_t>(sent);
        receive({datagram.data(), std::min(bytes, kMostDatagramBytes)}, bytes > kMostDatagramBytes,
                host_.clock.now_ns());
        if (host_.on_sample) host_.on_sample();
    }
}

void UdpTracker::receive(std::string_view datagram, bool cut_off, Nanoseconds now_ns) {
    if (cut_off) {  // what is left of the last line may read as another sample
        datagram = datagram.substr(0, datagram.rfind('\n') + 1);
        inbox_.refuse("tracker: a datagram is longer than " + std::to_string(kMostDatagramBytes) +
                          " bytes; send fewer lines in each",
                      now_ns);
    }
    while (!datagram.empty()) {
        const std::size_t end = datagram.find('\n');
        const std::string_view line = datagram.substr(0, end);
        datagram.remove_prefix(end == std::string_view::npos ? datagram.size() : end + 1);
        auto input = host_.parse_line(line);
        if (!input)
            inbox_.refuse(input.error().line(), now_ns);
        else if (*input && translator_)
            translate(**input, now_ns);
        else if (*input)
            inbox_.push({now_ns, std::move(**input)});
    }
}

void UdpTracker::translate(const TrackerInput& input, Nanoseconds now_ns) {
    const auto of_wand = [](std::uint32_t wand) { return "wand" + std::to_string(wand); };
    if (const auto* head = std::get_if<HeadInput>(&input)) {
        translator_->pose("head", 0, head->pose_world, head->tracked, now_ns);
    } else if (const auto* wand = std::get_if<WandInput>(&input)) {
        translator_->pose("wand", static_cast<std::int32_t>(wand->wand), wand->pose_world, wand->tracked, now_ns);
    } else if (const auto* click = std::get_if<WandClick>(&input)) {
        translator_->button(of_wand(click->wand), static_cast<std::int32_t>(click->button), click->pressed, now_ns);
    } else if (const auto* stick = std::get_if<WandStick>(&input)) {
        translator_->channels(of_wand(stick->wand), std::array{stick->position.x, stick->position.y}, now_ns);
    }
}

}  // namespace burin::devices
