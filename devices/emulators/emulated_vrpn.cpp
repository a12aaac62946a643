// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_vrpn.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/clock.hpp"

namespace burin::devices {
namespace {

// Its numbers of names are not a client's own, as those of any server. No device has the number of what it sends.
constexpr std::array<std::string_view, 4> kSenders{"VRPN Control", "Button0", "Tracker0", "Analog0"};
constexpr std::int32_t kButtonSender = 1, kTrackerSender = 2, kAnalogSender = 3;
constexpr std::array<std::string_view, 5> kTypes{"vrpn_Base pong_message", "vrpn_Analog Channel", "vrpn_Button Change",
                                                 "vrpn_Tracker Pos_Quat", "vrpn_Button States"};
constexpr std::int32_t kPongType = 0, kChannelsType = 1, kButtonType = 2, kPoseType = 3, kButtonsType = 4;

// A client that takes nothing loses its connection.
bool send_all(int socket, const VrpnServerBytes& bytes) {
    return ::send(socket, bytes.bytes().data(), bytes.bytes().size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.bytes().size());
}

std::vector<std::byte> channels_of(const Vec2& stick) { return vrpn_analog_channels(std::array{stick.x, stick.y}); }

}  // namespace

VrpnServerBytes emulated_vrpn_greeting(const EmulatedMotion& now) {
    VrpnServerBytes hello;
    hello.cookie();
    for (std::size_t i = 0; i < kSenders.size(); ++i) hello.sender(static_cast<std::int32_t>(i), kSenders[i]);
    for (std::size_t i = 0; i < kTypes.size(); ++i) hello.type(static_cast<std::int32_t>(i), kTypes[i]);
    hello.message(kButtonSender, kButtonsType, vrpn_button_states(std::array{now.is_pressed ? 1 : 0}));
    hello.message(kAnalogSender, kChannelsType, channels_of(now.stick));
    return hello;
}

VrpnServerBytes emulated_vrpn_report(const EmulatedMotion& before, const EmulatedMotion& now, std::int64_t time_us) {
    VrpnServerBytes report;
    report.message(kTrackerSender, kPoseType, vrpn_pos_quat(0, now.head_world), time_us);
    report.message(kTrackerSender, kPoseType, vrpn_pos_quat(1, now.wand_world), time_us);
    if (now.is_pressed != before.is_pressed)
        report.message(kButtonSender, kButtonType, vrpn_button_change(0, now.is_pressed ? 1 : 0), time_us);
    if (now.stick != before.stick) report.message(kAnalogSender, kChannelsType, channels_of(now.stick), time_us);
    return report;
}

std::optional<VrpnServerBytes> emulated_vrpn_answer(const HeardVrpn& said) {
    // The connection itself, "VRPN Control", is no device.
    const auto device = std::find(kSenders.begin() + kButtonSender, kSenders.end(), said.sender);
    if (said.type != "vrpn_Base ping_message" || device == kSenders.end()) return std::nullopt;
    return VrpnServerBytes().message(static_cast<std::int32_t>(device - kSenders.begin()), kPongType);
}

Result<EmulatedVrpn> EmulatedVrpn::create(const NetworkAddress& at) {
    auto bound = listen_at(at);
    if (!bound)
        return fail("emulated VRPN server at " + at.text(), bound.error(),
                    "another server may have the port: choose another one, or an address of this machine");
    auto lobs = receive_at(bound->bound);
    if (!lobs)
        return fail("emulated VRPN server at " + bound->bound.text(), "for datagrams: " + lobs.error(),
                    "another program may have the port: choose another one");
    return EmulatedVrpn(std::move(*bound), std::move(*lobs));
}

void EmulatedVrpn::accept_clients(const EmulatedMotion& now) {
    while (true) {
        OwnedFile socket(::accept4(at_.socket.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
        if (!socket) return;
        greet(std::move(socket), now);
    }
}

// Connects to those who have asked for it since the last call.
void EmulatedVrpn::call_back(const EmulatedMotion& now) {
    constexpr Nanoseconds kAnswer_ns = 200'000'000;
    for (std::size_t lob = 0; lob < kMostClients; ++lob) {
        std::array<char, 64> text{};
        sockaddr_in from{};
        socklen_t size = sizeof(from);
        const ssize_t count =
            ::recvfrom(lobs_.socket.get(), text.data(), text.size() - 1, 0, reinterpret_cast<sockaddr*>(&from), &size);
        if (count < 0) return;
        const std::string said(text.data());
        const std::size_t blank = said.find(' ');
        if (blank == std::string::npos) continue;
        const auto port = network_address(said.substr(blank + 1), {});
        if (!port || port->host != NetworkAddress{}.host) continue;
        std::array<char, INET_ADDRSTRLEN> sender{};
        ::inet_ntop(AF_INET, &from.sin_addr, sender.data(), sender.size());
        auto socket = connect_to({sender.data(), port->port}, kAnswer_ns);
        if (socket) greet(std::move(*socket), now);
    }
}

// Tells a client what there is, and reports to it from then on.
void EmulatedVrpn::greet(OwnedFile socket, const EmulatedMotion& now) {
    if (clients_.size() >= kMostClients) return;
    const int yes = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    if (send_all(socket.get(), emulated_vrpn_greeting(now))) clients_.push_back({std::move(socket), {}});
}

// Reads what a client says and answers its pings; false where it has gone or says what is no VRPN.
bool EmulatedVrpn::serve(Client& client) {
    std::array<std::byte, 4096> piece{};
    while (true) {
        const ssize_t count = ::recv(client.socket.get(), piece.data(), piece.size(), 0);
        if (count == 0) return false;
        if (count < 0) return errno == EAGAIN || errno == EINTR;
        for (const HeardVrpn& said : client.ear.take(std::span(piece).first(static_cast<std::size_t>(count)))) {
            const auto answer = emulated_vrpn_answer(said);
            if (!answer) continue;
            if (!send_all(client.socket.get(), *answer)) return false;
            pings_->fetch_add(1, std::memory_order_relaxed);
        }
        if (client.ear.is_lost()) return false;
    }
}

void EmulatedVrpn::run(const EmulatedVrpnOptions& options, const std::function<bool()>& ends) {
    MonotonicClock clock;
    const Nanoseconds begun_ns = clock.now_ns(), period_ns = nanoseconds(1.0 / options.rate_Hz);
    constexpr Nanoseconds kLongestWait_ns = 20'000'000;  // between looks at `ends` and at clients
    Nanoseconds report_ns = begun_ns;
    while (!ends()) {
        clock.sleep_until(std::min(report_ns, clock.now_ns() + kLongestWait_ns));
        const Nanoseconds now_ns = clock.now_ns();
        const double time_s = seconds(now_ns - begun_ns);
        const EmulatedMotion now = emulated_motion(options.begins_s + time_s);
        if (options.silence.is_silent(time_s)) {
            clients_.clear();
            while (OwnedFile(::accept4(at_.socket.get(), nullptr, nullptr, SOCK_CLOEXEC))) {
            }
        } else {
            accept_clients(now);
            call_back(now);
        }
        std::erase_if(clients_, [&](Client& client) { return !serve(client); });
        if (now_ns < report_ns) continue;
        report_ns = std::max(report_ns + period_ns, now_ns - 50 * period_ns);
        // Stamps by the wall clock, as VRPN's servers do.
        const std::int64_t time_us =
            std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
                .count();
        const VrpnServerBytes report = emulated_vrpn_report(std::exchange(told_, now), now, time_us);
        std::erase_if(clients_, [&](const Client& client) { return !send_all(client.socket.get(), report); });
    }
    clients_.clear();
}

}  // namespace burin::devices
