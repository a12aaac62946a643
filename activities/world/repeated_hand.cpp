// SPDX-License-Identifier: MIT
#include "activities/world/repeated_hand.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "activities/world/opened_exploration.hpp"
#include "base/try.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::activities {
devices::DeviceDescription DeviceAsRecorded::description() const {
    return wand ? devices::device_of(*wand) : devices::description_of(devices::OmniModel{});
}

haptics::Probe DeviceAsRecorded::probe(double radius_m) const {
    haptics::Probe probe = haptics::ball_probe(radius_m);
    if (!wand || points.empty()) return probe;
    probe.count = std::min(point_count(), haptics::kMostProbePoints);
    for (std::uint32_t i = 0; i < probe.count; ++i)
        probe.points[i] = {devices::offset_device_m(*wand, points[i]), radius_m};
    return probe;
}

Nanoseconds period_of(const DeviceAsRecorded& device) { return nanoseconds(1.0 / device.description().rate_Hz); }

Result<void> check_hand(const record::RecordReader& reader, const DeviceAsRecorded& device) {
    if (reader.hands().size() != 1)
        return fail(reader.path(), "has " + std::to_string(reader.hands().size()) + " hands",
                    "replay a recording of one hand");
    const std::string known = device.description().name;
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

Result<std::unique_ptr<RepeatedHand>> RepeatedHand::create(const ExploredWorld& world,
                                                           const ExplorationSettings& settings,
                                                           const DeviceAsRecorded& device, Nanoseconds begins_ns) {
    session::BroughtHand hand;
    hand.handle = device.wand;
    hand.points = device.points;
    const haptics::Probe probe = device.probe(settings.tool_radius_m);
    double spread_m = 0.0;
    for (std::uint32_t i = 1; i < probe.count; ++i)
        spread_m = std::max(spread_m, glm::length(probe.points[i].offset_device_m - probe.points[0].offset_device_m));
    BURIN_TRY(opened, open_exploration(world, settings, std::move(hand), {}, begins_ns));
    return std::unique_ptr<RepeatedHand>(new RepeatedHand(std::move(opened), settings.tool_radius_m, spread_m));
}

RepeatedHand::RepeatedHand(std::unique_ptr<OpenedExploration> opened, double radius_m, double spread_device_m)
    : opened_(std::move(opened)), radius_m_(radius_m), spread_device_m_(spread_device_m) {}

RepeatedHand::~RepeatedHand() = default;

scene::SceneService& RepeatedHand::service() { return opened_->session->scene(); }

const scene::MeshPart& RepeatedHand::objects() const { return *opened_->session->scene_side().objects(); }

haptics::TickRecord RepeatedHand::repeated(const record::RecordedTick& tick) {
    session::Session& session = *opened_->session;
    haptics::HapticChannels& channels = session.channels();
    const haptics::TickRecord record = session.loop().repeat(
        tick.sample, channels.surface.newest(), channels.parameters.newest(), tick.time_ns, tick.lateness_ns);
    haptics::TickRecord unread;
    while (channels.records.pop(unread)) {
    }
    return record;
}

void RepeatedHand::use_mapping(const Similarity& scene_from_device) {
    session::Session& session = *opened_->session;
    haptics::TickParameters parameters = session.channels().parameters.newest();
    parameters.workspace.object_from_device = scene_from_device;
    session.hands().publish(0, std::move(parameters));
    session.scene().use_probe(0, 2.0 * radius_m_ + scene_from_device.scale * spread_device_m_);
}

}  // namespace burin::activities
