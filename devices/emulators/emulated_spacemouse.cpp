// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_spacemouse.hpp"

#include <sys/socket.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "base/clock.hpp"
#include "base/try.hpp"
#include "devices/presence/emulator_socket.hpp"
#include "devices/served/served_arm.hpp"
#include "devices/spacemouse/spacemouse_port.hpp"

namespace burin::devices {
namespace {

constexpr Nanoseconds kLook_ns = 2'000'000, kReport_ns = 8'000'000;

SpaceMouseProduct emulated_product(bool joined) {
    return joined ? *spacemouse_product(0x256f, 0xc62e) : *spacemouse_product(0x046d, 0xc626);
}

void send_bytes(const OwnedFile& host, const HidBytes& bytes) {
    static_cast<void>(::send(host.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
}

bool is_resting(const CapStand& cap) { return cap.push == Vec3(0.0) && cap.turn == Vec3(0.0); }

}  // namespace

CapStand circling_cap(double time_s) {
    constexpr double kCycle_s = 12.0, kRest_s = 2.0, kDown_s = 3.0, kUp_s = 11.0;
    constexpr double kPush = 0.5, kTurn = 0.4;  // a circle of 20 mm at the usual settings
    constexpr double kApproach = 0.8;           // 48 mm in a second
    const double t = std::fmod(time_s, kCycle_s);
    CapStand cap;
    if (t < kRest_s) return cap;
    if (t < kDown_s) {
        cap.push = {0.0, 0.0, -kApproach};
    } else if (t < kUp_s) {
        const double angle = 2.0 * std::numbers::pi * (t - kDown_s) / (kUp_s - kDown_s);
        cap.push = kPush * Vec3(std::sin(angle), std::cos(angle), 0.0);
        cap.turn = {0.0, 0.0, kTurn * std::cos(angle)};
        cap.buttons = 1;
    } else {
        cap.push = {0.0, 0.0, kApproach};
    }
    return cap;
}

Result<EmulatedSpaceMouse> EmulatedSpaceMouse::create(const std::string& name, EmulatedSpaceMouseOptions options) {
    BURIN_TRY(listener, listen_as_emulator(kSpaceMouse, name));
    return EmulatedSpaceMouse(std::move(listener), std::move(options));
}

std::vector<HidBytes> cap_reports(const CapStand& before, const CapStand& now, bool joined) {
    std::vector<HidBytes> reports;
    if (now.buttons != before.buttons) reports.push_back(cap_button_report(now.buttons));
    if (is_resting(now) && is_resting(before)) return reports;
    if (joined) {
        reports.push_back(cap_joined_report(now.push, now.turn));
    } else {
        reports.push_back(cap_push_report(now.push));
        reports.push_back(cap_turn_report(now.turn));
    }
    return reports;
}

void EmulatedSpaceMouse::report(const OwnedFile& host, const CapStand& cap) {
    const HidBytes instead = [&] {
        const std::lock_guard held(drill_->lock);
        return drill_->instead;
    }();
    const std::vector<HidBytes> scripted = cap_reports(std::exchange(told_, cap), cap, options_.joined);
    for (const HidBytes& report : instead.empty() ? scripted : std::vector<HidBytes>{instead}) send_bytes(host, report);
}

void EmulatedSpaceMouse::run(const std::function<bool()>& ends) {
    static_cast<void>(ask_for_servo_priority());
    MonotonicClock clock;
    OwnedFile host;
    const Nanoseconds begun_ns = clock.now_ns();
    Nanoseconds came_ns = 0, due_ns = 0;
    while (!ends()) {
        clock.sleep_until(clock.now_ns() + kLook_ns);
        const Nanoseconds now_ns = clock.now_ns();
        const bool is_pulled = drill_->is_pulled || options_.silence.is_silent(seconds(now_ns - begun_ns));
        // A host sends nothing: what can be read of it is its end.
        std::byte nothing{};
        const bool has_gone = host && ::recv(host.get(), &nothing, 1, MSG_DONTWAIT) == 0;
        if (is_pulled || has_gone) host = OwnedFile();
        // One host at a time: others find the connection closed.
        if (OwnedFile came = accept_host(listener_); came && !host && !is_pulled) {
            host = std::move(came);
            const std::string greeting = spacemouse_greeting(emulated_product(options_.joined));
            static_cast<void>(::send(host.get(), greeting.data(), greeting.size(), MSG_NOSIGNAL));
            came_ns = due_ns = now_ns;
            told_ = {};
        }
        drill_->has_host = static_cast<bool>(host);
        if (!host || now_ns < due_ns) continue;
        due_ns = now_ns + kReport_ns;
        if (!drill_->is_silent) report(host, options_.script(seconds(now_ns - came_ns)));
    }
}

}  // namespace burin::devices
