// SPDX-License-Identifier: MIT
#include "app/world/world_wand.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "activities/wand/felt_wand.hpp"
#include "activities/wand/wand_pictures.hpp"
#include "activities/wand/wand_stroke.hpp"
#include "activities/wand/wand_world.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/picture_folder.hpp"
#include "app/world/rendered_report.hpp"
#include "app/world/world_explore.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/record_writer.hpp"
#include "scene/world_file.hpp"
#include "session/felt/felt_figures.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

void print_point_touches(const activities::WandExploredWorld& explored) {
    std::size_t objects = 6, points = 5;
    for (const activities::PointTouch& touch : explored.touches) {
        objects = std::max(objects, touch.object_name.size());
        points = std::max(points, touch.point_name.size());
    }
    const int first = static_cast<int>(std::min<std::size_t>(objects, 40)),
              second = static_cast<int>(std::min<std::size_t>(points, 20));
    std::printf("  %-*s  %-*s  first touched  touched  mean force  largest  %s\n", first, "object", second, "point",
                kWallHead);
    for (const activities::PointTouch& touch : explored.touches)
        std::printf("  %-*s  %-*s  %11.2f s  %5.2f s  %8.2f N  %5.2f N  %s\n", first, touch.object_name.c_str(), second,
                    touch.point_name.c_str(), touch.first_s, 0.01 * static_cast<double>(touch.updates),
                    touch.force_mean_N, touch.force_max_N, wall_text(touch.wall).c_str());
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
    for (const activities::PointTouch& touch : explored.touches) {
        touches.push_back({{"object", touch.object_name},
                           {"point", touch.point_name},
                           {"first_touched_s", touch.first_s},
                           {"touched_s", 0.01 * static_cast<double>(touch.updates)},
                           {"force_max_N", touch.force_max_N},
                           {"force_mean_N", touch.force_mean_N}});
        add_wall(touches.back(), touch.wall);
    }
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
                               const std::vector<devices::WandPoint>& points, const scene::World& world,
                               const activities::WandExploredWorld& explored) {
    if (options.report.empty()) return {};
    BURIN_TRY_DO(write_text(session::felt_figure_path(options.report), wand_figure(explored, points)));
    if (const auto done = write_text(session::felt_table_path(options.report), wand_table(explored, world, points));
        !done)
        return done;
    return write_text(options.report, json_text(report_of(options, wand, points, explored)));
}

}  // namespace

Result<void> explore_world_with_wand(const WorldExploration& options) {
    session::InputFiles inputs;
    inputs.world(options.world).file(options.stroke).file(options.record).device(options.device);
    BURIN_TRY_DO(make_folder_of(options.report));
    BURIN_TRY_DO(check_felt_report(options.report, inputs.list()));
    BURIN_TRY_DO(record::check_new_place(options.record));
    const activities::WandStroke stroke{options.world, options.stroke, options.device, options.points,
                                        options.radius_m};
    BURIN_TRY(opened, activities::open_wand_world(stroke));
    activities::WandWorld& w = *opened;
    w.world.record = options.record;
    if (!options.record.empty())
        w.feel.facts =
            facts_of_wand(stroke, w, {{"program", "burin"}, {"version", BURIN_VERSION}, {"compiler", __VERSION__}});

    tell_what_is_not_rendered(options.world, w.world.scene->objects, devices::device_of(w.feel.wand),
                              probe_of(w.feel.wand, w.feel.points));
    BURIN_TRY(folder, PictureFolder::create_if_named(options.pictures, "--pictures"));
    activities::PictureDrawer draw;
    if (folder)
        draw = [&](const picture::Picture& scene, const std::string& file) { return folder->take(scene, file); };
    activities::WandPictures pictures(*w.world.scene, w.feel, std::move(draw));
    const Result<activities::WandExploredWorld> explored = activities::explore_with_wand(
        w.world, w.stroke, w.feel, [&](const activities::WandMoment& moment) { return pictures.at(moment); });
    if (!explored) return std::unexpected(explored.error());
    if (explored->fitted)
        std::fprintf(stderr, "burin: %s: leaves the wand's workspace; it is centred in it, scaled by %.3g\n",
                     options.stroke.c_str(), explored->scene_from_device.scale);
    BURIN_TRY_DO(pictures.finish());
    print_point_touches(*explored);
    print_motion_scaled(explored->scene_from_device.scale);
    if (!options.record.empty())
        std::printf("%s: %s ticks recorded\n", options.record.c_str(), std::to_string(explored->run.ticks).c_str());
    return write_wand_report(options, w.feel.wand, w.feel.points, *w.world.scene, *explored);
}

}  // namespace burin::app
