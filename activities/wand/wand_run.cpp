// SPDX-License-Identifier: MIT
#include "activities/wand/wand_run.hpp"

#include <utility>

#include "activities/world/opened_exploration.hpp"
#include "base/try.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::activities {
namespace {

// How far an end may move until the next update, at the device: 1 m/s and 6 rad/s for more than a period.
constexpr double kWandReach_m = 0.02;

}  // namespace

ExplorationSettings settings_of(const WandOptions& options, const Pose& start_device) {
    const devices::DeviceDescription device = devices::device_of(options.wand);
    const Vec3 first_m = devices::offset_device_m(options.wand, options.points.front());
    ExplorationSettings settings;
    settings.tool_radius_m = options.radius_m;
    settings.scene_from_device = options.scene_from_device;
    settings.start_scene_m = options.scene_from_device * (start_device * first_m);
    settings.reach_m = options.scene_from_device.scale * kWandReach_m;
    settings.clearance_ratio = 0.0;  // nothing is carved
    settings.position_noise_m = device.resolution_m;
    settings.limits.max_force_N = device.max_force_N;
    return settings;
}

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

Result<WandRun> run_wand(const ExploredWorld& world, std::vector<devices::HandPose> script, const WandOptions& options,
                         const OnWandTick& on_tick, const OnWandUpdate& on_update) {
    BURIN_TRY(leads, devices::SimulatedHand::create(std::move(script), devices::HandPath::straight, options.grip));
    const double end_s = leads.end_s();
    const devices::HandTarget start = leads.target(0.0);
    const ExplorationSettings settings = settings_of(options, {start.position_device_m, start.orientation_device});
    const session::Session* session = nullptr;
    haptics::TickRecord last;
    FeltBy felt_by;
    felt_by.on_tick = [&](const haptics::TickRecord& tick) {
        last = tick;
        if (on_tick) on_tick(seconds(tick.time_ns), tick);
    };
    if (on_update)
        felt_by.on_update = [&] {
            return on_update(seconds(last.time_ns), last, session->scene_side().world()->drawn());
        };
    session::BroughtHand hand{{}, std::move(leads), options.wand, options.points};
    BURIN_TRY(opened, open_exploration(world, settings, std::move(hand), std::move(felt_by)));
    session = opened->session.get();
    BURIN_TRY_DO(opened->run(end_s, options.facts));

    session::Session& ended = *opened->session;
    const auto& wand = dynamic_cast<const devices::SimulatedWand&>(ended.hands().opened(0));
    return WandRun{ended.loop().ticks(), ended.scene().published(0), wand.trips(), seconds(ended.loop().period_ns()),
                   wand.saturation()};
}

}  // namespace burin::activities
