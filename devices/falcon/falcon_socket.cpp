// SPDX-License-Identifier: MIT
#include "devices/falcon/falcon_socket.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "base/try.hpp"
#include "devices/falcon/falcon_port.hpp"
#include "devices/presence/emulator_socket.hpp"

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

Result<std::unique_ptr<FalconPort>> open_emulated_falcon(const std::string& name) {
    BURIN_TRY(connection, connect_to_emulator("haptic device falcon " + name, "falcon", name));
    return std::make_unique<EmulatedFalconPort>(std::move(connection.socket));
}

std::vector<std::string> emulated_falcons() { return running_emulators("falcon"); }

}  // namespace burin::devices
