// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_dtrack.hpp"

#include "base/clock.hpp"
#include "devices/trackers/dtrack_protocol.hpp"

namespace burin::devices {

Result<void> run_emulated_dtrack(const NetworkAddress& to, const SilenceDrill& silence,
                                 const std::function<bool()>& ends) {
    auto socket = sender_to(to);
    if (!socket)
        return fail("emulated DTrack to " + to.text(), socket.error(), "write HOST, PORT or HOST:PORT of the session");
    MonotonicClock clock;
    const Nanoseconds begun_ns = clock.now_ns(), period_ns = kNanosecondsPerSecond / 60;
    for (std::uint32_t number = 1; !ends(); ++number) {
        clock.sleep_until(begun_ns + number * period_ns);
        const double time_s = seconds(clock.now_ns() - begun_ns);
        if (silence.is_silent(time_s)) continue;
        const EmulatedMotion now = emulated_motion(time_s);
        DTrackFrame frame;
        frame.number = number;
        frame.bodies = {{0, true, now.head_world}};
        frame.flysticks = {{{0, true, now.wand_world}, 8, now.is_pressed ? 1u : 0u, {now.stick.x, now.stick.y}}};
        send_datagram(*socket, dtrack_datagram(frame));
    }
    return {};
}

}  // namespace burin::devices
