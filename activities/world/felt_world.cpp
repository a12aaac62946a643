// SPDX-License-Identifier: MIT
#include "activities/world/felt_world.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "activities/world/world_recorder.hpp"
#include "activities/world/world_touch.hpp"
#include "base/try.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "haptics/haptic_loop.hpp"
#include "session/felt/felt_stroke.hpp"

namespace burin::activities {
namespace {

constexpr double kRests_s = 0.3;    // before and after the stroke; the gate's ramp must be over by then
constexpr double kReach_m = 0.014;  // at the device, until the next update: 1 m/s for more than a period

Result<devices::SimulatedHand> hand_along(const sculpt::Stroke& stroke, const Similarity& scene_from_device,
                                          const devices::HandGrip& grip) {
    const Similarity device_from_scene = inverse(scene_from_device);
    std::vector<devices::HandPose> script;
    const auto add = [&](const sculpt::StrokeRow& row, double time_s) {
        script.push_back({time_s, device_from_scene * row.position_object_m, row.orientation_object, 0u});
    };
    add(stroke.front(), 0.0);
    for (const sculpt::StrokeRow& row : stroke) add(row, row.time_s - stroke.front().time_s + kRests_s);
    return devices::SimulatedHand::create(std::move(script), devices::HandPath::straight, grip);
}

// Collects what was felt of each object.
class Touches {
public:
    explicit Touches(const scene::MeshPart& part) : part_(part) {}

    // Returns the name of an object when it has been touched at so many updates as press the tool into it.
    std::optional<std::string> add(double time_s, const haptics::ToolState& tool, scene::ObjectId touched) {
        if (touched == 0) return std::nullopt;
        const auto [at, is_new] = found_.try_emplace(touched);
        ObjectTouch& touch = at->second;
        if (is_new) touch = {touched, part_.object(touched).name, 0, time_s, 0.0, 0.0};
        const double force_N = glm::length(tool.given.force_device_N);
        touch.force_max_N = std::max(touch.force_max_N, force_N);
        touch.force_mean_N += (force_N - touch.force_mean_N) / static_cast<double>(++touch.updates);
        touch.course.push_back({time_s, force_N, glm::length(tool.hip_object_m - tool.proxy_object_m)});
        constexpr std::uint64_t kPressed = 15;
        return touch.updates == kPressed ? std::optional(touch.name) : std::nullopt;
    }
    void add(const haptics::TickRecord& tick) {
        const haptics::PointRecord& point = tick.contact.points[0];
        if (point.object == 0 || point.constraints == 0) return;
        walls_[point.object].add(tick, 0);
    }
    [[nodiscard]] std::vector<ObjectTouch> all() const {
        std::vector<ObjectTouch> list;
        for (const auto& [id, touch] : found_) {
            list.push_back(touch);
            if (const auto wall = walls_.find(id); wall != walls_.end()) list.back().wall = wall->second;
        }
        return list;
    }

private:
    const scene::MeshPart& part_;
    std::map<scene::ObjectId, ObjectTouch> found_;
    std::map<scene::ObjectId, session::RenderedTally> walls_;
};

Result<std::unique_ptr<WorldRecorder>> recorder_of(const scene::MeshPart& part, std::span<const scene::ObjectId> ids,
                                                   const devices::DeviceDescription& device,
                                                   const ExplorationSettings& settings, const ExploreOptions& options) {
    if (options.record.empty()) return std::unique_ptr<WorldRecorder>();
    std::vector<std::pair<std::int64_t, std::string>> objects;
    for (const scene::ObjectId id : ids) objects.emplace_back(static_cast<std::int64_t>(id), part.object(id).name);
    WorldRecorder::Facts facts = options.facts;
    facts.emplace_back(kActivityFact, kWorldActivity);
    facts.emplace_back(kSettingsFact, settings_text(settings));
    return WorldRecorder::create(options.record, device, haptics::ball_probe(settings.tool_radius_m), std::move(facts),
                                 std::move(objects));
}

}  // namespace

Result<WorldFigures> explore_by_feel(scene::MeshPart& part, std::span<const scene::ObjectId> ids,
                                     const scene::MaterialTable& materials, const sculpt::Stroke& stroke,
                                     const ExploreOptions& options, const OnUpdate& on_update) {
    WorldFigures figures;
    session::FeltFigures& felt = figures.felt;
    felt.workspace_device_m = devices::OmniModel{}.workspace_m;
    felt.object_from_device = session::fit_into_workspace(stroke, felt.workspace_device_m);
    felt.duration_s = stroke.back().time_s - stroke.front().time_s + 2.0 * kRests_s;
    BURIN_TRY(hand, hand_along(stroke, felt.object_from_device, options.grip));

    ExplorationSettings settings;
    settings.tool_radius_m = options.tool_radius_m;
    settings.scene_from_device = felt.object_from_device;
    settings.start_scene_m = stroke.front().position_object_m;
    settings.reach_m = kReach_m * felt.object_from_device.scale;
    WorldTouch touch(part, materials, settings);
    haptics::HapticChannels& channels = touch.channels();
    SimulatedClock clock;
    devices::SimulatedOmni omni(std::move(hand), {}, &clock);
    haptics::HapticLoop loop(omni, clock, channels);
    BURIN_TRY(recorder, recorder_of(part, ids, omni.description(), settings, options));
    session::FigureKeeper keeper(felt, felt.duration_s, seconds(loop.period_ns()));
    Touches touches(part);
    scene::TouchedObjects touched{};  // in the last tick

    const Nanoseconds start_ns = clock.now_ns(), end_ns = start_ns + nanoseconds(felt.duration_s);
    Nanoseconds next_update_ns = start_ns;
    while (clock.now_ns() < end_ns) {
        if (clock.now_ns() >= next_update_ns) {
            BURIN_TRY_DO(touch.service().update(clock.now_ns()));
            next_update_ns = clock.now_ns() + scene::SceneService::kHandsMove_ns;
            const double time_s = seconds(clock.now_ns() - start_ns);
            WorldMoment moment{channels.tool.newest(), std::nullopt};
            moment.newly_touched = touches.add(time_s, moment.tool, touched[0]);
            keeper.take(channels);
            if (recorder) {
                BURIN_TRY_DO(recorder->update(clock.now_ns(), touch.service().seen().last_ticks[0]));
            }
            if (on_update) BURIN_TRY_DO(on_update(time_s, moment));
        }
        clock.sleep_until(clock.now_ns() + loop.period_ns());
        const haptics::TickRecord tick = loop.step();
        touched = scene::touched_in(tick, touched);
        touches.add(tick);
        if (recorder) recorder->add(tick, std::array{tick.contact.points[0].object});
    }
    if (recorder) BURIN_TRY_DO(recorder->finish());
    keeper.take(channels);
    keeper.finish(channels);
    felt.surfaces_published = touch.service().published(0);
    felt.last_tool = channels.tool.newest();
    figures.touches = touches.all();
    return figures;
}

}  // namespace burin::activities
