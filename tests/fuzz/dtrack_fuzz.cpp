// SPDX-License-Identifier: MIT
// libFuzzer body of the reader of DTrack's datagrams. Whatever comes: no fault, bounds kept, and samples that a session
// takes; and what is read and written again reads the same.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "devices/emulators/dtrack_wire.hpp"
#include "devices/trackers/dtrack_protocol.hpp"
#include "devices/trackers/tracker_bodies.hpp"

namespace {

using namespace burin;
using namespace burin::devices;

void require(bool condition) {
    if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const DTrackFrame frame = dtrack_frame({reinterpret_cast<const char*>(data), size});
    require(frame.bodies.size() <= kMostDTrackBodies);
    TrackerInbox inbox;
    TrackerTranslator translator(
        "fuzz", {.head = {{"body", 0}}, .wands = {}, .buttons = {}, .sticks = {{{{"s", 0}}, {}}}}, inbox);
    for (const DTrackBody& body : frame.bodies) translator.pose("body", 0, body.pose, body.is_tracked, 0);
    for (const DTrackFlystick& stick : frame.flysticks) {
        require(stick.button_count <= kMostFlystickButtons && stick.sticks.size() <= kMostFlystickSticks);
        translator.channels("s", stick.sticks, 0);
    }
    for (const TrackerSample& sample : inbox.take()) {
        if (const auto* head = std::get_if<HeadInput>(&sample.input)) {
            require(finite(head->pose_world.position_m));
            require(std::abs(glm::length(head->pose_world.orientation) - 1.0) < 1e-6);
        }
        if (const auto* stick = std::get_if<WandStick>(&sample.input))
            require(std::abs(stick->position.x) <= 1.0 && std::abs(stick->position.y) <= 1.0);
    }
    const DTrackFrame again = dtrack_frame(controller_datagram(frame));
    if (frame.fault.empty()) require(again.number == frame.number);
    return 0;
}
