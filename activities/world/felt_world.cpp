// SPDX-License-Identifier: MIT
#include "activities/world/felt_world.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "devices/haptic/simulated_omni.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "haptics/haptic_loop.hpp"
#include "scene/scene_service.hpp"
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

// Finds which object is touched: the one whose surface is nearest to where the tool rests on it.
class TouchedObject {
public:
    TouchedObject(const scene::MeshPart& part, std::span<const scene::ObjectId> ids) : part_(part) {
        for (const scene::ObjectId id : ids) {
            const scene::SceneObject& object = part.object(id);
            if (!object.felt) continue;
            auto& tree = trees_[object.mesh.get()];
            if (!tree)
                tree = std::make_shared<geometry::TriangleTree>(object.mesh->positions_m, object.mesh->triangles);
            objects_.emplace_back(id, tree);
        }
    }
    [[nodiscard]] std::optional<scene::ObjectId> at(const Vec3& place_scene) const {
        std::optional<scene::ObjectId> nearest;
        double least_m = HUGE_VAL;
        for (const auto& [id, tree] : objects_) {
            const Pose& pose = part_.pose(id);
            const Similarity mesh_from_scene =
                inverse(Similarity{pose.position_m, pose.orientation, part_.object(id).scale});
            const double distance_m =
                tree->nearest(mesh_from_scene * place_scene, 0).distance_m / mesh_from_scene.scale;
            if (distance_m >= least_m) continue;
            least_m = distance_m;
            nearest = id;
        }
        return nearest;
    }

private:
    const scene::MeshPart& part_;
    std::map<const geometry::TriangleMesh*, std::shared_ptr<const geometry::TriangleTree>> trees_;
    std::vector<std::pair<scene::ObjectId, std::shared_ptr<const geometry::TriangleTree>>> objects_;
};

// Collects what was felt of each object.
class Touches {
public:
    Touches(const scene::MeshPart& part, std::span<const scene::ObjectId> ids, double radius_m)
        : part_(part), touched_(part, ids), radius_m_(radius_m) {}

    // Returns the name of an object when it has been touched at so many updates as press the tool into it.
    std::optional<std::string> add(double time_s, const haptics::ToolState& tool) {
        if ((tool.flags & haptics::kTickInContact) == 0) return std::nullopt;
        const auto id = touched_.at(tool.proxy_object_m - radius_m_ * tool.contact_normal_object);
        if (!id) return std::nullopt;
        const auto [at, is_new] = found_.try_emplace(*id);
        ObjectTouch& touch = at->second;
        if (is_new) touch = {*id, part_.object(*id).name, 0, time_s, 0.0, 0.0};
        const double force_N = glm::length(tool.given.force_device_N);
        touch.force_max_N = std::max(touch.force_max_N, force_N);
        touch.force_mean_N += (force_N - touch.force_mean_N) / static_cast<double>(++touch.updates);
        constexpr std::uint64_t kPressed = 15;
        return touch.updates == kPressed ? std::optional(touch.name) : std::nullopt;
    }
    [[nodiscard]] std::vector<ObjectTouch> all() const {
        std::vector<ObjectTouch> list;
        for (const auto& [id, touch] : found_) list.push_back(touch);
        return list;
    }

private:
    const scene::MeshPart& part_;
    TouchedObject touched_;
    double radius_m_;
    std::map<scene::ObjectId, ObjectTouch> found_;
};

haptics::TickParameters parameters_of(const Similarity& scene_from_device, double radius_m,
                                      const scene::MaterialTable& materials) {
    haptics::TickParameters parameters;
    parameters.sequence = 1;
    parameters.workspace.object_from_device = scene_from_device;
    parameters.probe = haptics::ball_probe(radius_m);
    parameters.action = haptics::ToolAction::touch;
    materials.write(parameters.materials);
    return parameters;
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
    Result<devices::SimulatedHand> hand = hand_along(stroke, felt.object_from_device, options.grip);
    if (!hand) return std::unexpected(hand.error());

    SimulatedClock clock;
    haptics::HapticChannels channels;
    channels.parameters.draft() = parameters_of(felt.object_from_device, options.tool_radius_m, materials);
    channels.parameters.publish();
    devices::SimulatedOmni omni(std::move(*hand), {}, &clock);
    haptics::HapticLoop loop(omni, clock, channels);
    const double reach_m = kReach_m * felt.object_from_device.scale;
    scene::SceneService service({&part},
                                {{&channels, stroke.front().position_object_m, 2.0 * options.tool_radius_m, reach_m}});
    session::FigureKeeper keeper(felt, felt.duration_s, seconds(loop.period_ns()));
    Touches touches(part, ids, options.tool_radius_m);

    const Nanoseconds start_ns = clock.now_ns(), end_ns = start_ns + nanoseconds(felt.duration_s);
    Nanoseconds next_update_ns = start_ns;
    while (clock.now_ns() < end_ns) {
        if (clock.now_ns() >= next_update_ns) {
            if (const auto updated = service.update(clock.now_ns()); !updated) return std::unexpected(updated.error());
            next_update_ns = clock.now_ns() + scene::SceneService::kHandsMove_ns;
            const double time_s = seconds(clock.now_ns() - start_ns);
            WorldMoment moment{channels.tool.newest(), std::nullopt};
            moment.newly_touched = touches.add(time_s, moment.tool);
            keeper.take(channels);
            if (on_update)
                if (const auto done = on_update(time_s, moment); !done) return std::unexpected(done.error());
        }
        clock.sleep_until(clock.now_ns() + loop.period_ns());
        loop.step();
    }
    keeper.take(channels);
    keeper.finish(channels);
    felt.surfaces_published = service.published(0);
    felt.last_tool = channels.tool.newest();
    figures.touches = touches.all();
    return figures;
}

}  // namespace burin::activities
