// SPDX-License-Identifier: MIT
// libFuzzer body of the reader of VRPN's bytes. Whatever a server sends, in whatever pieces: no fault, no more names
// than the bound, payloads within what was sent, and samples that a session takes. The emulated server's own reader of
// what a client sends gets the same.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "devices/emulators/emulated_vrpn.hpp"
#include "devices/trackers/tracker_bodies.hpp"
#include "devices/trackers/vrpn_protocol.hpp"

namespace {

using namespace burin;
using namespace burin::devices;

void require(bool condition) {
    if (!condition) std::abort();
}

void check(const TrackerSample& sample) {
    if (const auto* head = std::get_if<HeadInput>(&sample.input)) {
        require(finite(head->pose_world.position_m));
        require(std::abs(glm::length(head->pose_world.orientation) - 1.0) < 1e-6);
    }
    if (const auto* stick = std::get_if<WandStick>(&sample.input))
        require(std::abs(stick->position.x) <= 1.0 && std::abs(stick->position.y) <= 1.0);
    if (const auto* click = std::get_if<WandClick>(&sample.input)) require(click->button < 32);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    VrpnReader reader;
    VrpnNames names;
    TrackerInbox inbox;
    TrackerTranslator translator(
        "fuzz",
        {.head = {{"a", 0}}, .wands = {{{{"a", 1}}, {}}}, .buttons = {{{{"a", 0}}, {}}}, .sticks = {{{{"a", 0}}, {}}}},
        inbox);
    // A sound beginning, so that what follows reaches the messages; the first byte says whether, and in what pieces.
    const std::size_t piece = size > 0 ? 1 + data[0] % 64 : 1;
    if (size > 0 && data[0] >= 64) {
        VrpnBytes begin;
        begin.cookie().name(kVrpnSender, 0, "a").name(kVrpnType, 0, kVrpnPose);
        std::ranges::copy(begin.bytes(), reader.room().begin());
        reader.came(begin.bytes().size());
    }
    for (std::size_t at = 1; at < size && !reader.failure(); at += piece) {
        const std::size_t count = std::min(piece, size - at);
        const auto room = reader.room();
        require(room.size() >= count);
        std::copy_n(reinterpret_cast<const std::byte*>(data) + at, count, room.begin());
        reader.came(count);
        while (const auto message = reader.next()) {
            require(message->payload.size() <= size + 64);
            if (names.take(*message)) continue;
            // By the payload's form and not by its type's name, so that all are reached.
            if (const auto pose = vrpn_pose(message->payload))
                translator.pose("a", pose->sensor, {pose->position_m, pose->orientation}, true, 0);
            if (const auto button = vrpn_button(message->payload))
                translator.button("a", button->button, button->state != 0, 0);
            if (const auto states = vrpn_buttons(message->payload)) require(states->size() <= kMostVrpnButtons);
            if (const auto channels = vrpn_channels(message->payload)) translator.channels("a", *channels, 0);
        }
    }
    VrpnServerEar ear;
    if (size > 0 && data[0] >= 64) static_cast<void>(ear.take(VrpnBytes().cookie().bytes()));
    for (std::size_t at = 1; at < size && !ear.is_lost(); at += piece)
        for (const HeardVrpn& said : ear.take(std::as_bytes(std::span(data + at, std::min(piece, size - at))))) {
            require(said.payload.size() <= size);
            static_cast<void>(emulated_vrpn_answer(said));
        }
    require(names.senders().size() <= kMostVrpnNames);
    for (const TrackerSample& sample : inbox.take()) check(sample);
    return 0;
}
