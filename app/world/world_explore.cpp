// SPDX-License-Identifier: MIT
#include "app/world/world_explore.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "activities/world/felt_world.hpp"
#include "activities/world/opened_world.hpp"
#include "activities/world/touch_pictures.hpp"
#include "activities/world/world_plot.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/picture_folder.hpp"
#include "app/world/rendered_report.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "record/record_writer.hpp"
#include "scene/world_file.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

Json touches_json(const activities::WorldFigures& figures) {
    Json list = Json::array();
    for (const activities::ObjectTouch& touch : figures.touches) {
        list.push_back({{"object", touch.name},
                        {"first_touched_s", touch.first_s},
                        {"touched_s", 0.01 * static_cast<double>(touch.updates)},
                        {"force_max_N", touch.force_max_N},
                        {"force_mean_N", touch.force_mean_N}});
        add_wall(list.back(), touch.wall);
    }
    return list;
}

void print_touches(const activities::WorldFigures& figures) {
    std::size_t width = 6;
    for (const activities::ObjectTouch& touch : figures.touches) width = std::max(width, touch.name.size());
    const int columns = static_cast<int>(std::min<std::size_t>(width, 40));
    std::printf("  %-*s  first touched  touched  mean force  largest  %s\n", columns, "object", kWallHead);
    for (const activities::ObjectTouch& touch : figures.touches) {
        std::printf("  %-*s  %11.2f s  %5.2f s  %8.2f N  %5.2f N  %s\n", columns, touch.name.c_str(), touch.first_s,
                    0.01 * static_cast<double>(touch.updates), touch.force_mean_N, touch.force_max_N,
                    wall_text(touch.wall).c_str());
    }
    if (figures.touches.empty()) std::printf("  nothing was touched\n");
}

Result<void> write_world_report(const WorldExploration& options, const activities::WorldFigures& figures) {
    if (options.report.empty()) return {};
    const std::string figure = session::felt_figure_path(options.report),
                      table = session::felt_table_path(options.report),
                      depth = session::felt_depth_path(options.report);
    BURIN_TRY_DO(write_text(figure, activities::world_figure(figures)));
    BURIN_TRY_DO(write_text(table, session::felt_table(figures.felt)));
    BURIN_TRY_DO(write_text(depth, activities::depth_figure(figures)));
    const session::FeltFigures& felt = figures.felt;
    const Json report{
        {"burin", BURIN_VERSION},
        {"world", options.world},
        {"stroke", options.stroke},
        {"radius_m", options.radius_m},
        {"ticks", felt.ticks},
        {"ticks_in_contact", felt.ticks_in_contact},
        {"force_max_N", felt.force_max_N},
        {"force_mean_in_contact_N", felt.force_mean_in_contact_N},
        {"motion_scaled", felt.object_from_device.scale},
        {"objects", touches_json(figures)},
        {"plots",
         {std::filesystem::path(figure).filename().string(), std::filesystem::path(table).filename().string(),
          std::filesystem::path(depth).filename().string()}}};
    return write_text(options.report, json_text(report));
}

}  // namespace

void print_motion_scaled(double scene_from_device_scale) {
    if (scene_from_device_scale == 1.0) return;
    std::printf("  motion scaled by %.3g: 1 mm of the hand's way is %.3g mm in the world; forces are the hand's\n",
                scene_from_device_scale, scene_from_device_scale);
}

Result<void> explore_world(const WorldExploration& options) {
    session::InputFiles inputs;
    inputs.world(options.world).file(options.stroke).file(options.record);
    BURIN_TRY_DO(make_folder_of(options.report));
    BURIN_TRY_DO(check_felt_report(options.report, inputs.list()));
    BURIN_TRY_DO(record::check_new_place(options.record));
    BURIN_TRY(stroke, sculpt::read_stroke(options.stroke));
    BURIN_TRY(world, activities::open_world(options.world, {}));
    activities::ExploreOptions explore;
    explore.tool_radius_m = options.radius_m;
    if (!options.record.empty()) {
        BURIN_TRY(facts, activities::facts_of_stroke(
                             options.world, *world, options.stroke,
                             {{"program", "burin"}, {"version", BURIN_VERSION}, {"compiler", __VERSION__}}));
        explore.facts = std::move(facts);
    }
    tell_what_is_not_rendered(options.world, world->scene->objects, devices::description_of({}),
                              haptics::ball_probe(options.radius_m));

    BURIN_TRY(folder, PictureFolder::create_if_named(options.pictures, "--pictures"));
    activities::PictureDrawer draw;
    if (folder)
        draw = [&](const picture::Picture& scene, const std::string& file) { return folder->take(scene, file); };
    activities::TouchPictures pictures(*world->scene, options.radius_m, std::move(draw));
    BURIN_TRY(figures, activities::explore_by_feel(
                           {.file = options.world, .scene = world->scene, .record = options.record}, stroke, explore,
                           [&](const activities::WorldMoment& moment) { return pictures.at(moment); }));
    if (folder) BURIN_TRY_DO(folder->take_both_eyes(pictures.on_wall(figures.felt.last_tool), "stereo.png"));
    if (!options.record.empty())
        std::printf("%s: %s ticks recorded\n", options.record.c_str(), std::to_string(figures.felt.ticks).c_str());
    print_touches(figures);
    print_motion_scaled(figures.felt.object_from_device.scale);
    return write_world_report(options, figures);
}

}  // namespace burin::app
