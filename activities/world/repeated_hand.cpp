// SPDX-License-Identifier: MIT
#include "activities/world/repeated_hand.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/try.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/haptic/simulated_wand.hpp"
#include "haptics/channels.hpp"

namespace burin::activities {
namespace {

Result<std::unique_ptr<devices::HapticDevice>> still_device(const DeviceAsRecorded& device) {
    BURIN_TRY(hand, devices::SimulatedHand::create({devices::HandPose{}}));
    if (device.wand) return std::make_unique<devices::SimulatedWand>(std::move(hand), *device.wand);
    return std::make_unique<devices::SimulatedOmni>(std::move(hand));
}

}  // namespace

haptics::Probe DeviceAsRecorded::probe(double radius_m) const {
    haptics::Probe probe = haptics::ball_probe(radius_m);
    if (!wand || points.empty()) return probe;
    probe.count = std::min(point_count(), haptics::kMostProbePoints);
    for (std::uint32_t i = 0; i < probe.count; ++i)
        probe.points[i] = {devices::offset_device_m(*wand, points[i]), radius_m};
    return probe;
}

Result<void> check_hand(const record::RecordReader& reader, const DeviceAsRecorded& device) {
    if (reader.hands().size() != 1)
        return fail(reader.path(), "has " + std::to_string(reader.hands().size()) + " hands",
                    "replay a recording of one hand");
    BURIN_TRY(still, still_device(device));
    const std::string known = still->description().name;
    if (reader.hands()[0].name == known) return {};
    return fail(reader.path(), "was recorded with " + reader.hands()[0].name + ", whose figures are not in it",
                "replay a recording of a " + known);
}

Result<void> check_tick(const record::RecordReader& reader, const record::RecordedTick& tick) {
    constexpr Nanoseconds kMost_ns = Nanoseconds{1} << 60;
    const auto is_time = [](Nanoseconds t_ns) { return t_ns >= -kMost_ns && t_ns <= kMost_ns; };
    const Similarity& map = tick.object_from_device;
    const Quat& q = map.orientation;
    const bool is_map = finite(map.position_m) && haptics::is_felt_at(map.scale) &&
                        std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0) <= 1e-6;
    if (is_time(tick.time_ns) && is_time(tick.sample.time_ns) && is_time(tick.lateness_ns) && is_map) return {};
    return fail(reader.path(), "tick " + std::to_string(tick.tick) + " has a time or a mapping that no tick has",
                "burin session check tells what is damaged");
}

Result<std::unique_ptr<RepeatedHand>> RepeatedHand::create(const DeviceAsRecorded& device,
                                                           haptics::HapticChannels& channels) {
    BURIN_TRY(still, still_device(device));
    return std::unique_ptr<RepeatedHand>(new RepeatedHand(std::move(still), channels));
}

haptics::TickRecord RepeatedHand::repeated(const record::RecordedTick& tick) {
    const haptics::TickRecord record = loop_.repeat(tick.sample, channels_.surface.newest(),
                                                    channels_.parameters.newest(), tick.time_ns, tick.lateness_ns);
    haptics::TickRecord unread;
    while (channels_.records.pop(unread)) {
    }
    return record;
}

}  // namespace burin::activities
