// SPDX-License-Identifier: MIT
#include "devices/falcon/falcon_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <sstream>

#include "devices/falcon/falcon_port.hpp"
#include "devices/trackers/network.hpp"

namespace burin::devices {
namespace {

int as_milliseconds(Nanoseconds time_ns) { return static_cast<int>((time_ns + 999'999) / 1'000'000); }

class EmulatedFalconPort final : public FalconPort {
public:
    explicit EmulatedFalconPort(OwnedFile socket) : socket_(std::move(socket)) {}

    [[nodiscard]] Cable request(FtdiRequest what, std::uint16_t value) noexcept override {
        const std::array<std::byte, 4> message{static_cast<std::byte>(kFalconControl), static_cast<std::byte>(what),
                                               static_cast<std::byte>(value & 0xff),
                                               static_cast<std::byte>(value >> 8)};
        return send(message);
    }
    [[nodiscard]] Cable write(std::span<const std::byte> bytes, Nanoseconds /*within_ns*/) noexcept override {
        // Longer ones are several, as on USB.
        while (!bytes.empty()) {
            std::array<std::byte, kMostFalconMessage> message{};
            const std::size_t count = std::min(bytes.size(), message.size() - 1);
            message[0] = static_cast<std::byte>(kFalconWrite);
            std::copy_n(bytes.begin(), count, message.begin() + 1);
            if (const Cable cable = send(std::span(message).first(count + 1)); cable != Cable::well) return cable;
            bytes = bytes.subspan(count);
        }
        return Cable::well;
    }
    [[nodiscard]] Cable read(std::span<std::byte, kFtdiPiece> piece, std::size_t& count,
                             Nanoseconds within_ns) noexcept override {
        count = 0;
        pollfd waits{socket_.get(), POLLIN, 0};
        const int ready = ::poll(&waits, 1, as_milliseconds(within_ns));
        if (ready == 0 || (ready < 0 && errno == EINTR)) return Cable::late;
        const ssize_t came = ::recv(socket_.get(), piece.data(), piece.size(), MSG_DONTWAIT);
        if (came < 0 && (errno == EAGAIN || errno == EINTR)) return Cable::late;
        if (came <= 0) return Cable::pulled;
        count = static_cast<std::size_t>(came);
        return Cable::well;
    }

private:
    Cable send(std::span<const std::byte> message) noexcept {
        const ssize_t sent = ::send(socket_.get(), message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent >= 0) return Cable::well;
        return errno == EAGAIN || errno == EINTR ? Cable::late : Cable::pulled;
    }

    OwnedFile socket_;
};

}  // namespace

std::string falcon_socket_prefix() { return "burin-falcon-" + std::to_string(::getuid()) + "-"; }

FalconSocketName falcon_socket_name(const std::string& name) {
    FalconSocketName made;
    made.address.sun_family = AF_UNIX;
    const std::string path = (falcon_socket_prefix() + name).substr(0, sizeof(made.address.sun_path) - 1);
    // A name that begins with a zero byte is in the abstract namespace: it ends with its process, and leaves no file.
    std::memcpy(made.address.sun_path + 1, path.data(), path.size());
    made.size = static_cast<unsigned int>(offsetof(sockaddr_un, sun_path) + 1 + path.size());
    return made;
}

bool is_own_process(int socket) {
    ucred other{};
    socklen_t size = sizeof(other);
    return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &other, &size) == 0 && other.uid == ::getuid();
}

Result<std::unique_ptr<FalconPort>> open_emulated_falcon(const std::string& name) {
    const std::string where = "haptic device falcon " + name;
    const std::string remedy = "start it in another terminal: burin devices emulate falcon" +
                               (name == "emulated" ? std::string() : " --at " + name);
    OwnedFile socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
    const FalconSocketName at = falcon_socket_name(name);
    if (!socket || ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&at.address), at.size) != 0)
        return fail(where, "no emulator runs by this name", remedy);
    if (!is_own_process(socket.get())) return fail(where, "the emulator of this name is another user's", remedy);
    // An emulator has one cable: who comes second is refused by its closing the connection.
    std::array<std::byte, kFtdiPiece> greeting{};
    pollfd waits{socket.get(), POLLIN, 0};
    if (::poll(&waits, 1, 1000) <= 0 || ::recv(socket.get(), greeting.data(), greeting.size(), 0) <= 0)
        return fail(where, "is in use by another program", "end that one, or start another emulator: --at emulated-2");
    return std::make_unique<EmulatedFalconPort>(std::move(socket));
}

std::vector<std::string> emulated_falcons() {
    std::vector<std::string> names;
    std::ifstream list("/proc/net/unix");
    const std::string begin = "@" + falcon_socket_prefix();
    constexpr unsigned long kListens = 0x10000;  // the flag of a socket that takes connections
    std::string line;
    std::getline(list, line);
    while (std::getline(list, line)) {
        std::istringstream columns(line);
        std::string number, references, protocol, flags, type, state, inode, path;
        if (!(columns >> number >> references >> protocol >> flags >> type >> state >> inode >> path)) continue;
        if (!path.starts_with(begin) || (std::strtoul(flags.c_str(), nullptr, 16) & kListens) == 0) continue;
        names.push_back(path.substr(begin.size()));
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace burin::devices
