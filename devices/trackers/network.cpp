// SPDX-License-Identifier: MIT
#include "devices/trackers/network.hpp"

#include "base/try.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <mutex>
#include <thread>

namespace burin::devices {
namespace {

int whole_milliseconds(Nanoseconds time_ns) { return static_cast<int>(time_ns / 1'000'000); }

std::unexpected<std::string> because(int code) { return std::unexpected(std::string(std::strerror(code))); }

std::expected<sockaddr_in, std::string> resolved(const NetworkAddress& address) {
    addrinfo hints{};
    hints.ai_family = AF_INET;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int failed = ::getaddrinfo(address.host.c_str(), nullptr, &hints, &found);
    if (failed != 0) return std::unexpected(std::string(kNoSuchMachine) + ": " + std::string(::gai_strerror(failed)));
    sockaddr_in result{};
    std::memcpy(&result, found->ai_addr, sizeof(result));
    ::freeaddrinfo(found);
    result.sin_port = htons(address.port);
    return result;
}

// The search for a name asks servers, which may take their time, and cannot be ended: a thread of its own makes it, and
// is left alone where nobody waits any more.
struct NameSearch {
    std::mutex mutex;
    std::optional<std::expected<sockaddr_in, std::string>> found;
    StopSign is_done;
};

constexpr const char* kToldToEnd = "it was told to end";

std::expected<sockaddr_in, std::string> resolved_within(const NetworkAddress& address, Nanoseconds within_ns,
                                                        const StopSign* stop) {
    in_addr number{};
    if (stop == nullptr || ::inet_pton(AF_INET, address.host.c_str(), &number) == 1) return resolved(address);
    auto search = std::make_shared<NameSearch>();
    std::thread([search, address] {
        auto found = resolved(address);
        const std::lock_guard lock(search->mutex);
        search->found = std::move(found);
        search->is_done.give();
    }).detach();
    const auto woken = stop->wait_for(search->is_done.file(), whole_milliseconds(within_ns));
    if (woken == StopSign::Woken::by_sign) return std::unexpected(std::string(kToldToEnd));
    const std::lock_guard lock(search->mutex);
    if (!search->found) return std::unexpected("no server says where " + address.host + " is");
    return std::move(*search->found);
}

bool is_multicast(const sockaddr_in& address) { return IN_MULTICAST(ntohl(address.sin_addr.s_addr)); }

// Joins a group on each network that this machine is in; false where on none.
bool joins(int socket, const in_addr& group) {
    std::unique_ptr<struct if_nameindex, decltype(&::if_freenameindex)> networks(::if_nameindex(), &::if_freenameindex);
    bool joined = false;
    for (const struct if_nameindex* at = networks.get(); at != nullptr && at->if_index != 0; ++at) {
        const ip_mreqn membership{group, {htonl(INADDR_ANY)}, static_cast<int>(at->if_index)};
        joined |= ::setsockopt(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof(membership)) == 0;
    }
    return joined;
}

std::expected<BoundSocket, std::string> bound_at(const NetworkAddress& at, int kind) {
    BURIN_TRY(address, resolved(at));
    BoundSocket made;
    made.bound = at;
    made.socket = OwnedFile(::socket(AF_INET, kind | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const int yes = 1;
    if (kind == SOCK_STREAM || is_multicast(address))
        ::setsockopt(made.socket.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    if (!made.socket || ::bind(made.socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
        return because(errno);
    if (kind == SOCK_DGRAM && is_multicast(address) && !joins(made.socket.get(), address.sin_addr))
        return std::unexpected("no network of this machine takes part in the multicast group: " +
                               std::string(std::strerror(errno)));
    sockaddr_in bound{};
    socklen_t size = sizeof(bound);
    if (::getsockname(made.socket.get(), reinterpret_cast<sockaddr*>(&bound), &size) == 0)
        made.bound.port = ntohs(bound.sin_port);
    return made;
}

}  // namespace

std::optional<NetworkAddress> network_address(const std::string& text, const NetworkAddress& usual) {
    NetworkAddress address = usual;
    const std::size_t colon = text.rfind(':');
    const std::string last = colon == std::string::npos ? text : text.substr(colon + 1);
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(last.data(), last.data() + last.size(), port);
    const bool is_port = !last.empty() && error == std::errc{} && end == last.data() + last.size();
    const bool is_number = !last.empty() && last.find_first_not_of("0123456789") == std::string::npos;
    if (is_number && !is_port) return std::nullopt;  // beyond 65535; as a machine it would be an address of four bytes
    if (is_port) address.port = port;
    if (colon == std::string::npos && !is_port && !text.empty()) address.host = text;
    if (colon != std::string::npos) {
        address.host = text.substr(0, colon);
        if (!is_port || address.host.empty()) return std::nullopt;
    }
    return address;
}

std::expected<OwnedFile, std::string> connect_to(const NetworkAddress& to, Nanoseconds within_ns,
                                                 const StopSign* stop) {
    MonotonicClock clock;
    const Nanoseconds until_ns = clock.now_ns() + within_ns;
    BURIN_TRY(address, resolved_within(to, within_ns, stop));
    OwnedFile socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (!socket) return because(errno);
    const int yes = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    if (::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return socket;
    if (errno != EINPROGRESS) return because(errno);
    std::array<pollfd, 2> ready{
        {{socket.get(), POLLOUT, 0}, {stop != nullptr ? stop->file() : -1, POLLIN, 0}}};  // poll skips a negative file
    const int came =
        ::poll(ready.data(), ready.size(), whole_milliseconds(std::max<Nanoseconds>(until_ns - clock.now_ns(), 0)));
    if (came > 0 && ready[1].revents != 0) return std::unexpected(std::string(kToldToEnd));
    if (came == 0) return std::unexpected(std::string("it does not answer"));
    int code = 0;
    socklen_t size = sizeof(code);
    if (came < 0 || ::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &code, &size) != 0) return because(errno);
    if (code != 0) return because(code);
    return socket;
}

std::expected<BoundSocket, std::string> listen_at(const NetworkAddress& at) {
    auto made = bound_at(at, SOCK_STREAM);
    if (made && ::listen(made->socket.get(), 4) != 0) return because(errno);
    return made;
}

std::expected<BoundSocket, std::string> receive_at(const NetworkAddress& at) { return bound_at(at, SOCK_DGRAM); }

std::expected<OwnedFile, std::string> sender_to(const NetworkAddress& to) {
    BURIN_TRY(address, resolved(to));
    OwnedFile socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (!socket || ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
        return because(errno);
    return socket;
}

void send_datagram(const OwnedFile& socket, std::string_view datagram) {
    static_cast<void>(::send(socket.get(), datagram.data(), datagram.size(), MSG_NOSIGNAL));
}

}  // namespace burin::devices
