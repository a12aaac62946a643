// SPDX-License-Identifier: MIT
#include "activities/wand/felt_wand.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "activities/carve/pressing_hand.hpp"
#include "base/try.hpp"
#include "scene/world_file.hpp"

namespace burin::activities {
namespace {

constexpr double kWandRests_s = 0.3;           // before and after the stroke; the gate's ramp must be over by then
constexpr std::uint64_t kPressedUpdates = 15;  // until a touch counts as a press

WandFelt felt_in(double time_s, const haptics::TickRecord& tick) {
    const Quat& turn = tick.motion.object_from_device.orientation;
    WandFelt felt;
    felt.time_s = time_s;
    felt.scene_from_tool = {tick.motion.object_from_device * tick.sample.position_device_m,
                            tick.motion.orientation_object};
    const double given = session::given_share(tick);
    for (std::uint32_t i = 0; i < tick.contact.point_count; ++i) {
        const haptics::PointRecord& p = tick.contact.points[i];
        felt.points.push_back({p.hip_object_m, p.proxy_object_m, given * (turn * p.force_device_N), p.object});
    }
    felt.force_N = turn * tick.contact.wrench.force_device_N;
    felt.torque_Nm = turn * tick.contact.wrench.torque_device_Nm;
    felt.given_force_N = turn * tick.gate.given.force_device_N;
    felt.given_torque_Nm = turn * tick.gate.given.torque_device_Nm;
    return felt;
}

// Collects what each point has felt of each object.
class PointTouches {
public:
    PointTouches(const scene::World& world, const std::vector<devices::WandPoint>& points)
        : world_(world), points_(points) {}

    // Returns the name of an object that is pressed for the first time.
    std::optional<std::string> add(const WandFelt& felt) {
        std::optional<std::string> pressed;
        for (std::size_t i = 0; i < felt.points.size(); ++i) {
            const PointFelt& point = felt.points[i];
            if (point.object == 0) continue;
            const auto [at, is_new] = found_.try_emplace({point.object, i});
            PointTouch& touch = at->second;
            if (is_new)
                touch = {point.object, name_in(world_, point.object), points_[i].name, 0, felt.time_s, 0.0, 0.0};
            const double force_N = glm::length(point.force_N);
            touch.force_max_N = std::max(touch.force_max_N, force_N);
            touch.force_mean_N += (force_N - touch.force_mean_N) / static_cast<double>(++touch.updates);
            if (touch.updates == kPressedUpdates && pictured_.emplace(point.object, true).second)
                pressed = touch.object_name;
        }
        return pressed;
    }
    void add(const haptics::TickRecord& tick) {
        for (std::uint32_t i = 0; i < tick.contact.point_count; ++i) {
            const haptics::PointRecord& point = tick.contact.points[i];
            if (point.object != 0 && point.constraints != 0) walls_[{point.object, i}].add(tick, i);
        }
    }
    [[nodiscard]] std::vector<PointTouch> all() const {
        std::vector<PointTouch> list;
        for (const auto& [key, touch] : found_) {
            list.push_back(touch);
            if (const auto wall = walls_.find(key); wall != walls_.end()) list.back().wall = wall->second;
        }
        return list;
    }

private:
    const scene::World& world_;
    const std::vector<devices::WandPoint>& points_;
    using Key = std::pair<scene::ObjectId, std::size_t>;
    std::map<Key, PointTouch> found_;
    std::map<Key, session::RenderedTally> walls_;
    std::map<scene::ObjectId, bool> pictured_;
};

std::vector<devices::HandPose> script_of(const sculpt::Stroke& stroke) {
    std::vector<devices::HandPose> script;
    const auto add = [&](const sculpt::StrokeRow& row, double time_s) {
        script.push_back({time_s, row.position_object_m, row.orientation_object, row.button ? 1u : 0u});
    };
    add(stroke.front(), 0.0);
    for (const sculpt::StrokeRow& row : stroke) add(row, row.time_s - stroke.front().time_s + kWandRests_s);
    add(stroke.back(), script.back().time_s + kWandRests_s);
    return script;
}

bool fits(const sculpt::Stroke& stroke, const Similarity& scene_from_device, const Vec3& workspace_m) {
    const Similarity device_from_scene = inverse(scene_from_device);
    return std::ranges::all_of(stroke, [&](const sculpt::StrokeRow& row) {
        const Vec3 at = glm::abs(device_from_scene * row.position_object_m);
        return at.x <= 0.5 * workspace_m.x && at.y <= 0.5 * workspace_m.y && at.z <= 0.5 * workspace_m.z;
    });
}

}  // namespace

AxisAngle axis_angle(const Quat& unit) noexcept {
    const Quat q = unit.w < 0.0 ? -unit : unit;
    const Vec3 v(q.x, q.y, q.z);
    const double sine = glm::length(v);
    if (!(sine > 0.0)) return {};
    return {v / sine, 2.0 * std::atan2(sine, q.w)};
}

Result<WandExploredWorld> explore_with_wand(const ExploredWorld& world, const sculpt::Stroke& stroke,
                                            const WandOptions& options, const OnWandMoment& on_moment) {
    WandExploredWorld explored;
    WandOptions placed = options;
    const Vec3 workspace_m = devices::device_of(options.wand).workspace_m;
    placed.scene_from_device = devices::scene_from_device(options.wand);
    explored.fitted = !fits(stroke, placed.scene_from_device, workspace_m);
    if (explored.fitted) placed.scene_from_device = fit_into_workspace(stroke, workspace_m);
    explored.scene_from_device = placed.scene_from_device;

    PointTouches touches(*world.scene, options.points);
    const auto at_tick = [&](double, const haptics::TickRecord& tick) {
        explored.force_max_N = std::max(explored.force_max_N, glm::length(tick.gate.given.force_device_N));
        explored.torque_max_Nm = std::max(explored.torque_max_Nm, glm::length(tick.gate.given.torque_device_Nm));
        if (tick.in_contact()) ++explored.ticks_in_contact;
        touches.add(tick);
        if (tick.gate.cause != haptics::GateCause::none) ++explored.ticks_faulted;
    };
    const auto at_update = [&](double time_s, const haptics::TickRecord& last,
                               const session::DrawnWorld& drawn) -> Result<void> {
        WandMoment moment{time_s, nullptr, std::nullopt, &drawn};
        if (last.tick > 0) {
            explored.trace.push_back(felt_in(time_s, last));
            moment.felt = &explored.trace.back();
            moment.newly_touched = touches.add(explored.trace.back());
        }
        return on_moment ? on_moment(moment) : Result<void>{};
    };
    BURIN_TRY(run, run_wand(world, script_in_device(script_of(stroke), placed.scene_from_device), placed, at_tick,
                            at_update));
    explored.run = run;
    explored.touches = touches.all();
    return explored;
}

}  // namespace burin::activities
