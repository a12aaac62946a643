// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_dtrack.hpp"

#include "base/clock.hpp"
#include "devices/emulators/dtrack_wire.hpp"

namespace burin::devices {

std::string emulated_dtrack_datagram(std::uint32_t number, const EmulatedMotion& now) {
    DTrackFrame frame;
    frame.number = number;
    frame.bodies = {{0, true, now.head_world}};
    frame.flysticks = {{{0, true, now.wand_world}, 8, now.is_pressed ? 1u : 0u, {now.stick.x, now.stick.y}}};
    return controller_datagram(frame);
}

Result<void> run_emulated_dtrack(const NetworkAddress& to, const SilenceDrill& silence,
                                 const std::function<bool()>& ends, double begins_s) {
    auto socket = sender_to(to);
    if (!socket)
        return fail("emulated DTrack to " + to.text(), socket.error(), "write HOST, PORT or HOST:PORT of the session");
    MonotonicClock clock;
    const Nanoseconds begun_ns = clock.now_ns(), period_ns = kNanosecondsPerSecond / 60;
    for (std::uint32_t number = 1; !ends(); ++number) {
        clock.sleep_until(begun_ns + number * period_ns);
        const double time_s = seconds(clock.now_ns() - begun_ns);
        if (silence.is_silent(time_s)) continue;
        send_datagram(*socket, emulated_dtrack_datagram(number, emulated_motion(begins_s + time_s)));
    }
    return {};
}

}  // namespace burin::devices
