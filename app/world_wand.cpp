// SPDX-License-Identifier: MIT
#include "app/world_wand.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "activities/wand/felt_wand.hpp"
#include "activities/wand/wand_view.hpp"
#include "app/output_files.hpp"
#include "app/picture_folder.hpp"
#include "base/text.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "scene/vrml_world.hpp"
#include "session/felt/felt_figures.hpp"

namespace burin::app {
namespace {

constexpr std::size_t kMostWandPictures = 24;

Result<scene::World> world_to_explore(const std::string& path) {
    scene::WorldOrProblems world = scene::read_any_world(path);
    if (world) return std::move(*world);
    if (world.error().size() == 1) return std::unexpected(world.error().front());
    for (const Error& problem : world.error()) std::fprintf(stderr, "burin: %s\n", problem.line().c_str());
    return fail(path, std::to_string(world.error().size()) + " problems", "correct them; burin world check lists them");
}

// A name that is safe in a file's name: letters, digits, dashes.
std::string safe_word(const std::string& name) {
    std::string word = name.substr(0, 40);
    for (char& c : word)
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '-';
    return word;
}

activities::WandPose pose_felt(const activities::WandFelt& felt) {
    activities::WandPose pose;
    pose.scene_from_tool = felt.scene_from_tool;
    for (const activities::PointFelt& point : felt.points) pose.points_scene.push_back(point.place_m);
    pose.force_N = felt.given_force_N;
    return pose;
}

// Draws the world where an object is first pressed, and at the end.
class WandPictures {
public:
    WandPictures(const scene::MeshPart& part, const std::vector<scene::ObjectId>& ids, const WorldExploration& options,
                 const devices::WandDescription& wand)
        : view_(part, ids, options.radius_m), avatar_(wand, wand.gain, options.radius_m) {
        const Vec3 size_m = view_.bounds_scene().extent();
        camera_.middle_scene = view_.bounds_scene().center();
        camera_.half_height_m = 0.55 * std::max({size_m.x, size_m.y, size_m.z});
    }

    Result<void> open(const std::string& folder) {
        if (folder.empty()) return {};
        Result<PictureFolder> made = PictureFolder::create(folder, "--pictures");
        if (!made) return std::unexpected(made.error());
        folder_.emplace(std::move(*made));
        return {};
    }
    void take_updates(const std::vector<scene::ObjectUpdate>& updates) { view_.take(updates); }
    Result<void> at(const activities::WandMoment& moment) {
        if (!folder_ || moment.felt == nullptr) return {};
        last_ = pose_felt(*moment.felt);
        if (!moment.newly_touched || touched_ >= kMostWandPictures) return {};
        return take("touched-" + std::to_string(++touched_) + "-" + safe_word(*moment.newly_touched) + ".png");
    }
    Result<void> finish() { return folder_ ? take("end.png") : Result<void>{}; }

private:
    Result<void> take(const std::string& name) {
        return folder_->take(avatar_.close_scene(view_, last_, camera_), name);
    }
    activities::WorldView view_;
    activities::WandView avatar_;
    activities::WandCamera camera_;
    std::optional<PictureFolder> folder_;
    activities::WandPose last_;
    std::size_t touched_ = 0;
};

void print_point_touches(const activities::WandExploredWorld& explored) {
    std::size_t objects = 6, points = 5;
    for (const activities::PointTouch& touch : explored.touches) {
        objects = std::max(objects, touch.object_name.size());
        points = std::max(points, touch.point_name.size());
    }
    const int first = static_cast<int>(std::min<std::size_t>(objects, 40)),
              second = static_cast<int>(std::min<std::size_t>(points, 20));
    std::printf("  %-*s  %-*s  first touched  touched  mean force  largest\n", first, "object", second, "point");
    for (const activities::PointTouch& touch : explored.touches)
        std::printf("  %-*s  %-*s  %11.2f s  %5.2f s  %8.2f N  %5.2f N\n", first, touch.object_name.c_str(), second,
                    touch.point_name.c_str(), touch.first_s, 0.01 * static_cast<double>(touch.updates),
                    touch.force_mean_N, touch.force_max_N);
    if (explored.touches.empty()) std::printf("  nothing was touched\n");
    const devices::WandSaturation& s = explored.run.saturation;
    std::printf(
        "largest force %.2f N, largest torque %.0f N mm; ticks at a limit: force %llu %llu %llu, torque %llu "
        "%llu %llu of %llu\n",
        explored.force_max_N, 1e3 * explored.torque_max_Nm, static_cast<unsigned long long>(s.force[0]),
        static_cast<unsigned long long>(s.force[1]), static_cast<unsigned long long>(s.force[2]),
        static_cast<unsigned long long>(s.torque[0]), static_cast<unsigned long long>(s.torque[1]),
        static_cast<unsigned long long>(s.torque[2]), static_cast<unsigned long long>(explored.run.ticks));
}

Json report_of(const WorldExploration& options, const devices::WandDescription& wand,
               const std::vector<devices::WandPoint>& points, const activities::WandExploredWorld& explored) {
    Json names = Json::array(), touches = Json::array();
    for (const devices::WandPoint& point : points) names.push_back(point.name);
    for (const activities::PointTouch& touch : explored.touches)
        touches.push_back({{"object", touch.object_name},
                           {"point", touch.point_name},
                           {"first_touched_s", touch.first_s},
                           {"touched_s", 0.01 * static_cast<double>(touch.updates)},
                           {"force_max_N", touch.force_max_N},
                           {"force_mean_N", touch.force_mean_N}});
    const activities::WandRun& run = explored.run;
    return {{"burin", BURIN_VERSION},
            {"world", options.world},
            {"stroke", options.stroke},
            {"device", wand.name},
            {"points", names},
            {"radius_m", options.radius_m},
            {"ticks", run.ticks},
            {"ticks_in_contact", explored.ticks_in_contact},
            {"ticks_without_force", explored.ticks_faulted},
            {"force_max_N", explored.force_max_N},
            {"torque_max_Nm", explored.torque_max_Nm},
            {"ticks_at_force_limit", run.saturation.force},
            {"ticks_at_torque_limit", run.saturation.torque},
            {"amplifiers_tripped", run.trips},
            {"motion_fitted", explored.fitted},
            {"motion_scaled", explored.scene_from_device.scale},
            {"touches", touches}};
}

Result<void> write_wand_report(const WorldExploration& options, const devices::WandDescription& wand,
                               const std::vector<devices::WandPoint>& points, const scene::MeshPart& part,
                               const activities::WandExploredWorld& explored) {
    if (options.report.empty()) return {};
    if (const auto done = write_text(session::felt_figure_path(options.report), wand_figure(explored, points)); !done)
        return done;
    if (const auto done = write_text(session::felt_table_path(options.report), wand_table(explored, part, points));
        !done)
        return done;
    return write_text(options.report, json_text(report_of(options, wand, points, explored)));
}

}  // namespace

Result<void> explore_world_with_wand(const WorldExploration& options) {
    const std::array inputs{options.world, options.stroke};
    if (const auto ok = check_outputs({}, options.report, inputs); !ok) return ok;
    const Result<devices::WandDescription> wand = devices::wand_named(options.device);
    if (!wand) return std::unexpected(wand.error());
    activities::WandOptions feel;
    feel.wand = *wand;
    feel.radius_m = options.radius_m;
    Result<std::vector<devices::WandPoint>> points =
        devices::points_named(*wand, options.points.empty() ? devices::kUsualPoints : options.points);
    if (!points) return std::unexpected(points.error());
    feel.points = std::move(*points);
    const Result<sculpt::Stroke> stroke = sculpt::read_stroke(options.stroke);
    if (!stroke) return std::unexpected(stroke.error());
    Result<scene::World> world = world_to_explore(options.world);
    if (!world) return std::unexpected(world.error());
    for (const std::string& remark : world->remarks) std::fprintf(stderr, "burin: %s\n", remark.c_str());
    std::vector<scene::ObjectId> ids;
    for (const scene::SceneObject& object : world->objects) ids.push_back(object.id);
    scene::MaterialTable materials;
    Result<std::unique_ptr<scene::MeshPart>> part = scene::MeshPart::create(std::move(world->objects), materials);
    if (!part) return std::unexpected(part.error());

    WandPictures pictures(**part, ids, options, *wand);
    if (const auto opened = pictures.open(options.pictures); !opened) return opened;
    const Result<activities::WandExploredWorld> explored = activities::explore_with_wand(
        **part, ids, materials, *stroke, feel, [&](const activities::WandMoment& moment) -> Result<void> {
            pictures.take_updates((*part)->take_object_updates());
            return pictures.at(moment);
        });
    if (!explored) return std::unexpected(explored.error());
    if (explored->fitted)
        std::fprintf(stderr, "burin: %s: leaves the wand's workspace; it is centred in it, scaled by %.3g\n",
                     options.stroke.c_str(), explored->scene_from_device.scale);
    if (const auto done = pictures.finish(); !done) return done;
    print_point_touches(*explored);
    return write_wand_report(options, *wand, feel.points, **part, *explored);
}

}  // namespace burin::app
