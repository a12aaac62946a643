// SPDX-License-Identifier: MIT
#include "devices/presence/emulator_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace burin::devices {
namespace {

constexpr std::size_t kMostName = 60;  // with what stands before it, less than an address holds

struct SocketName {
    sockaddr_un address{};
    socklen_t size = 0;
};

std::string socket_prefix(const std::string& kind) { return "burin-" + kind + "-" + std::to_string(::getuid()) + "-"; }

SocketName socket_name(const std::string& kind, const std::string& name) {
    SocketName made;
    made.address.sun_family = AF_UNIX;
    const std::string path = (socket_prefix(kind) + name).substr(0, sizeof(made.address.sun_path) - 1);
    // A name that begins with a zero byte is in the abstract namespace.
    std::memcpy(made.address.sun_path + 1, path.data(), path.size());
    made.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + path.size());
    return made;
}

bool is_own_process(int socket) {
    ucred other{};
    socklen_t size = sizeof(other);
    return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &other, &size) == 0 && other.uid == ::getuid();
}

}  // namespace

Result<OwnedFile> listen_as_emulator(const std::string& kind, const std::string& name) {
    const std::string where = "emulated " + kind + " " + name;
    if (!name.starts_with(kEmulatedName) || name.size() > kMostName || name.find_first_of("/@,:") != std::string::npos)
        return fail(where, "has no such name", "begin it with emulated: emulated, emulated-2");
    OwnedFile listener(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const SocketName at = socket_name(kind, name);
    if (!listener || ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&at.address), at.size) != 0 ||
        ::listen(listener.get(), 4) != 0)
        return fail(where, "cannot be made: another one may be running by this name",
                    "end that one, or choose another name: --at emulated-2");
    return listener;
}

OwnedFile accept_host(const OwnedFile& listener) {
    OwnedFile came(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    return came && is_own_process(came.get()) ? std::move(came) : OwnedFile();
}

Result<EmulatorConnection> connect_to_emulator(const std::string& where, const std::string& kind,
                                               const std::string& name) {
    const std::string remedy = "start it in another terminal: burin devices emulate " + kind +
                               (name == kEmulatedName ? std::string() : " --at " + name);
    // Does not block: the queue of an emulator that is stopped fills up, and connect would then wait for ever.
    OwnedFile socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const SocketName at = socket_name(kind, name);
    if (!socket || ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&at.address), at.size) != 0) {
        if (errno == EAGAIN)
            return fail(where, "the emulator does not answer, and others wait for it", "let it go on, or end it");
        return fail(where, "no emulator runs by this name", remedy);
    }
    if (!is_own_process(socket.get())) return fail(where, "the emulator of this name is another user's", remedy);
    std::array<char, 64> greeting{};
    pollfd waits{socket.get(), POLLIN, 0};
    const ssize_t came =
        ::poll(&waits, 1, 1000) > 0 ? ::recv(socket.get(), greeting.data(), greeting.size(), 0) : ssize_t{0};
    if (came <= 0)
        return fail(where, "is in use by another program, or does not answer",
                    "end that program, or let the emulator go on if it is stopped, or start another: --at emulated-2");
    return EmulatorConnection{std::move(socket), std::string(greeting.data(), static_cast<std::size_t>(came))};
}

std::vector<std::string> running_emulators(const std::string& kind) {
    std::vector<std::string> names;
    std::ifstream list("/proc/net/unix");
    const std::string begin = "@" + socket_prefix(kind);
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
