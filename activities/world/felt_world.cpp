// SPDX-License-Identifier: MIT
#include "activities/world/felt_world.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "activities/carve/pressing_hand.hpp"
#include "activities/world/opened_exploration.hpp"
#include "base/try.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "haptics/haptic_loop.hpp"
#include "scene/contact_follower.hpp"
#include "scene/world_file.hpp"

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
    explicit Touches(const scene::World& world) : world_(world) {}

    // Returns the name of an object when it has been touched at so many updates as press the tool into it.
    std::optional<std::string> add(double time_s, const haptics::ToolState& tool, scene::ObjectId touched) {
        if (touched == 0) return std::nullopt;
        const auto [at, is_new] = found_.try_emplace(touched);
        ObjectTouch& touch = at->second;
        if (is_new) touch = {touched, name_in(world_, touched), 0, time_s, 0.0, 0.0};
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
    const scene::World& world_;
    std::map<scene::ObjectId, ObjectTouch> found_;
    std::map<scene::ObjectId, session::RenderedTally> walls_;
};

// Collects what was felt on the way.
class WorldKeeper {
public:
    WorldKeeper(WorldFigures& figures, const scene::World& world, double period_s)
        : figures_(figures), touches_(world), keeper_(figures.felt, figures.felt.duration_s, period_s) {}

    void add(const haptics::TickRecord& tick) {
        touched_ = scene::touched_in(tick, touched_);
        touches_.add(tick);
        keeper_.add(tick);
        figures_.felt.last_tool = haptics::tool_of(tick, 0, 0);
        time_s_ = seconds(tick.time_ns);
    }
    [[nodiscard]] WorldMoment moment() {
        WorldMoment moment;
        moment.time_s = time_s_;
        moment.tool = figures_.felt.last_tool;
        if (moment.tool.tick > 0) moment.newly_touched = touches_.add(time_s_, moment.tool, touched_[0]);
        return moment;
    }
    void finish(session::Session& session) {
        keeper_.finish(session.channels());
        figures_.felt.surfaces_published = session.scene().published(0);
        figures_.touches = touches_.all();
    }

private:
    WorldFigures& figures_;
    Touches touches_;
    session::FigureKeeper keeper_;
    scene::TouchedObjects touched_{};  // in the last tick
    double time_s_ = 0.0;
};

}  // namespace

Result<WorldFigures> explore_by_feel(const ExploredWorld& world, const sculpt::Stroke& stroke,
                                     const ExploreOptions& options, const OnUpdate& on_update) {
    WorldFigures figures;
    session::FeltFigures& felt = figures.felt;
    felt.workspace_device_m = devices::OmniModel{}.workspace_m;
    felt.object_from_device = fit_into_workspace(stroke, felt.workspace_device_m);
    felt.duration_s = stroke.back().time_s - stroke.front().time_s + 2.0 * kRests_s;
    session::BroughtHand hand;
    BURIN_TRY(leads, hand_along(stroke, felt.object_from_device, options.grip));
    hand.leads = std::move(leads);

    ExplorationSettings settings;
    settings.tool_radius_m = options.tool_radius_m;
    settings.scene_from_device = felt.object_from_device;
    settings.start_scene_m = stroke.front().position_object_m;
    settings.reach_m = kReach_m * felt.object_from_device.scale;

    std::optional<WorldKeeper> keeper;
    session::Session* session = nullptr;
    FeltBy felt_by{[&](const haptics::TickRecord& tick) { keeper->add(tick); },
                   [&]() -> Result<void> {
                       WorldMoment moment = keeper->moment();
                       moment.drawn = &session->scene_side().world()->drawn();
                       return on_update ? on_update(moment) : Result<void>{};
                   }};
    BURIN_TRY(opened, open_exploration(world, settings, std::move(hand), std::move(felt_by)));
    session = opened->session.get();
    keeper.emplace(figures, *world.scene, seconds(session->loop().period_ns()));
    BURIN_TRY_DO(opened->run(felt.duration_s, options.facts));
    keeper->finish(*session);
    return figures;
}

}  // namespace burin::activities
