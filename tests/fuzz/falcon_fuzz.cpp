// SPDX-License-Identifier: MIT
// libFuzzer body of the reader of a Falcon's packets and of what is made of them. Whatever the bytes: no fault, each
// byte in a packet or counted once, poses that are numbers, commands within what motors take; and of two sound packets
// behind them the second is found.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "devices/falcon/falcon_packet.hpp"

namespace {

using namespace burin;
using namespace burin::devices;

void require_falcon(bool condition) {
    if (!condition) std::abort();
}

void check_packet(const FalconBytes& bytes) {
    static_cast<void>(falcon_command(bytes));
    const auto report = falcon_report(bytes);
    if (!report) return;
    require_falcon(report->homed <= 7 && report->buttons <= 15);
    FalconBytes again = falcon_bytes(*report);
    again[kFalconPacket - 2] = bytes[kFalconPacket - 2];  // says nothing
    require_falcon(again == bytes);
    const auto pose = falcon_forward(falcon_angles(report->encoders));
    if (!pose) return;
    require_falcon(finite(pose->grip_m));
    for (const std::int16_t command : falcon_commands(falcon_torques(*pose, Vec3(1.0, -2.0, 3.0))))
        require_falcon(std::abs(command) <= kFalconMostCommand);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    FalconReader reader;
    std::uint64_t packets = 0;
    for (std::size_t i = 0; i < size; ++i)
        if (const auto packet = reader.take(static_cast<std::byte>(data[i]))) {
            ++packets;
            check_packet(*packet);
        }
    require_falcon(reader.dropped() + packets * kFalconPacket <= size);
    require_falcon(reader.dropped() + packets * kFalconPacket + kFalconPacket > size);
    bool is_found = false;
    for (std::int16_t number = 1; number <= 2; ++number)
        for (const std::byte byte : falcon_bytes(FalconReport{.encoders = {number, 0, 0}, .homed = 7})) {
            const auto packet = reader.take(byte);
            const auto report = packet ? falcon_report(*packet) : std::nullopt;
            is_found = report && report->encoders[0] == 2;
        }
    require_falcon(is_found);
    return 0;
}
