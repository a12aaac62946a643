// SPDX-License-Identifier: MIT
#include "activities/wand/wand_run.hpp"

#include <algorithm>
#include <utility>

#include "base/try.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "record/record_writer.hpp"
#include "record/touched_columns.hpp"
#include "scene/scene_service.hpp"

namespace burin::activities {
namespace {

// How far an end may move until the next update, at the device: 1 m/s and 6 rad/s for more than a period.
constexpr double kWandReach_m = 0.02;

haptics::TickParameters wand_parameters(const WandOptions& options, const devices::DeviceDescription& device,
                                        const scene::MaterialTable& materials) {
    haptics::TickParameters parameters;
    parameters.sequence = 1;
    parameters.workspace.object_from_device = options.scene_from_device;
    parameters.workspace.workspace_device_m = device.workspace_m;
    parameters.probe.count = static_cast<std::uint32_t>(options.points.size());
    for (std::size_t i = 0; i < options.points.size(); ++i)
        parameters.probe.points[i] = {devices::offset_device_m(options.wand, options.points[i]), options.radius_m};
    parameters.clearance_ratio = 0.0;  // nothing is carved
    parameters.action = haptics::ToolAction::touch;
    parameters.position_noise_m = device.resolution_m;
    parameters.limits.max_force_N = device.max_force_N;
    materials.write(parameters.materials);
    return parameters;
}

// Returns the hand's side of the scene: the ball around where the first point rests that holds all others.
scene::SceneHand hand_in_scene(const WandOptions& options, const devices::HandPose& start,
                               haptics::HapticChannels& channels) {
    const Vec3 first_m = devices::offset_device_m(options.wand, options.points.front());
    double farthest_m = 0.0;
    for (const devices::WandPoint& point : options.points)
        farthest_m = std::max(farthest_m, glm::length(devices::offset_device_m(options.wand, point) - first_m));
    const double scale = options.scene_from_device.scale;
    return {&channels, options.scene_from_device * (start.position_device_m + start.orientation_device * first_m),
            scale * farthest_m + 2.0 * options.radius_m, scale * kWandReach_m};
}

// Begins to record every tick; null where none is recorded. The recorder is the ring's only reader.
Result<std::unique_ptr<record::RecordWriter>> record_wand(const WandOptions& options, const scene::MeshPart& part,
                                                          const devices::DeviceDescription& device,
                                                          const haptics::Probe& probe,
                                                          haptics::HapticChannels& channels) {
    if (options.record.empty()) return nullptr;
    const record::RowShape shape = record::shape_of(device, probe);
    record::RecordedHand hand{device.name, device, probe, &channels.records};
    hand.more_columns = record::touched_columns(shape);
    hand.more_values = [shape](const haptics::TickRecord& tick, std::vector<record::Word>& row) {
        record::append_touched(tick, shape, row);
    };
    record::WriterOptions writer;
    writer.facts = options.facts;
    for (scene::ObjectId id = 1; id <= part.size(); ++id)
        if (part.has(id)) writer.objects.emplace_back(static_cast<std::int64_t>(id), part.object(id).name);
    std::vector<record::RecordedHand> hands;
    hands.push_back(std::move(hand));
    return record::RecordWriter::create(options.record, std::move(hands), std::move(writer));
}

}  // namespace

std::vector<devices::HandPose> script_in_device(std::vector<devices::HandPose> script,
                                                const Similarity& scene_from_device) {
    const Similarity device_from_scene = inverse(scene_from_device);
    for (devices::HandPose& pose : script) {
        pose.position_device_m = device_from_scene * pose.position_device_m;
        // The handle's axes are the device's where it is not turned, so the turn is taken into these.
        pose.orientation_device =
            device_from_scene.orientation * pose.orientation_device * scene_from_device.orientation;
    }
    return script;
}

Result<WandRun> run_wand(scene::MeshPart& part, const scene::MaterialTable& materials,
                         std::vector<devices::HandPose> script, const WandOptions& options, const OnWandTick& on_tick,
                         const OnWandUpdate& on_update) {
    BURIN_TRY(hand, devices::SimulatedHand::create(std::move(script), devices::HandPath::straight, options.grip));
    const double end_s = hand.end_s();
    const devices::HandTarget start = hand.target(0.0);

    SimulatedClock clock;
    haptics::HapticChannels channels(haptics::HapticChannels::kTicks,
                                     options.record.empty() ? haptics::HapticChannels::kRecords : record::kRingTicks);
    devices::SimulatedWand wand(std::move(hand), options.wand, &clock);
    const haptics::TickParameters parameters = wand_parameters(options, wand.description(), materials);
    channels.parameters.draft() = parameters;
    channels.parameters.publish();
    BURIN_TRY(recorder, record_wand(options, part, wand.description(), parameters.probe, channels));
    haptics::HapticLoop loop(wand, clock, channels);
    scene::SceneService service(
        {&part}, {hand_in_scene(options, {0.0, start.position_device_m, start.orientation_device, 0}, channels)});

    WandRun run;
    run.period_s = seconds(loop.period_ns());
    const Nanoseconds start_ns = clock.now_ns(), end_ns = start_ns + nanoseconds(end_s);
    Nanoseconds next_update_ns = start_ns;
    haptics::TickRecord last, drained;
    while (clock.now_ns() < end_ns) {
        if (clock.now_ns() >= next_update_ns) {
            BURIN_TRY_DO(service.update(clock.now_ns()));
            if (recorder) {
                // Simulated time is not held back by any clock: the ring would overflow.
                recorder->take_now();
                if (const auto failed = recorder->failure()) return std::unexpected(*failed);
            }
            next_update_ns = clock.now_ns() + scene::SceneService::kHandsMove_ns;
            if (on_update) BURIN_TRY_DO(on_update(seconds(clock.now_ns() - start_ns), last));
        }
        clock.sleep_until(clock.now_ns() + loop.period_ns());
        last = loop.step();
        while (!recorder && channels.records.pop(drained)) {
        }
        if (on_tick) on_tick(seconds(clock.now_ns() - start_ns), last);
    }
    if (recorder) BURIN_TRY_DO(recorder->close());
    run.ticks = loop.ticks();
    run.surfaces_published = service.published(0);
    run.trips = wand.trips();
    run.saturation = wand.saturation();
    return run;
}

}  // namespace burin::activities
