// SPDX-License-Identifier: MIT
#include "app/world/world_explore.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "activities/world/felt_world.hpp"
#include "activities/world/world_plot.hpp"
#include "activities/world/world_view.hpp"
#include "app/cli/output_files.hpp"
#include "app/world/rendered_report.hpp"
#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "desk/draw/pictures.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "gpu/device.hpp"
#include "picture/png.hpp"
#include "record/motion.hpp"
#include "record/record_writer.hpp"
#include "renderer/frame/renderer.hpp"
#include "scene/world_digest.hpp"
#include "session/live/world_side.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

constexpr ImageSize kPictureSize{1280, 960};
constexpr std::size_t kMostTouchPictures = 24;

// A name that is safe in a file's name: letters, digits, dashes.
std::string file_word(const std::string& name) {
    std::string word;
    for (const char c : name.substr(0, 40)) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        word += plain ? c : '-';
    }
    return word;
}

// Draws the pictures of an exploration, on its folder and device.
class WorldPictures {
public:
    static Result<std::optional<WorldPictures>> create(const std::string& folder) {
        if (folder.empty()) return std::optional<WorldPictures>();
        BURIN_TRY_DO(session::make_picture_folder(folder, "--pictures"));
        Result<gpu::Device> device = gpu::Device::create();
        if (!device) {
            Error e = device.error();
            e.what += ", and --pictures needs one";
            return std::unexpected(e);
        }
        BURIN_TRY(renderer, renderer::Renderer::create(*device, kPictureSize));
        return std::optional<WorldPictures>(WorldPictures(folder, std::move(*device), std::move(renderer)));
    }

    // Writes one picture, as seen from the middle between the eyes.
    Result<void> take(const picture::Picture& scene, const std::string& name) {
        BURIN_TRY(image, renderer_.render(scene));
        return write(name, image.left);
    }
    Result<void> take_both_eyes(const picture::Picture& scene, const std::string& name) {
        BURIN_TRY(image, renderer_.render(scene));
        return write(name, side_by_side(image));
    }

private:
    WorldPictures(std::string folder, gpu::Device device, renderer::Renderer renderer)
        : folder_(std::move(folder)), device_(std::move(device)), renderer_(std::move(renderer)) {}
    Result<void> write(const std::string& name, const Image& image) {
        const std::filesystem::path path = std::filesystem::path(folder_) / name;
        BURIN_TRY_DO(picture::write_png(path, image));
        std::printf("wrote %s\n", path.string().c_str());
        return {};
    }

    std::string folder_;
    gpu::Device device_;
    renderer::Renderer renderer_;
};

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

// What a session file says of the program and of what was explored.
Result<std::vector<std::pair<std::string, std::string>>> facts_of_world(const WorldExploration& options,
                                                                        const scene::World& world) {
    const auto world_file = file_digest(options.world), stroke_file = file_digest(options.stroke);
    if (!world_file) return std::unexpected(world_file.error());
    if (!stroke_file) return std::unexpected(stroke_file.error());
    return std::vector<std::pair<std::string, std::string>>{
        {"program", "burin"},
        {"version", BURIN_VERSION},
        {"compiler", __VERSION__},
        {"command", "world --stroke"},
        {"world", options.world},
        {"world file sha256", *world_file},
        {record::kWorldDigestFact, scene::world_digest(world.objects)},
        {"stroke", options.stroke},
        {"stroke sha256", *stroke_file},
        {"time", "simulated"}};
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
    BURIN_TRY(world, session::read_sound_world(options.world));
    activities::ExploreOptions explore;
    explore.tool_radius_m = options.radius_m;
    explore.record = options.record;
    if (!options.record.empty()) {
        BURIN_TRY(facts, facts_of_world(options, world));
        explore.facts = std::move(facts);
    }
    std::vector<scene::ObjectId> ids;
    for (const scene::SceneObject& object : world.objects) ids.push_back(object.id);
    scene::MaterialTable materials;
    BURIN_TRY(part, scene::MeshPart::create(std::move(world.objects), materials));

    tell_what_is_not_rendered(options.world, *part, ids, devices::description_of({}),
                              haptics::ball_probe(options.radius_m));

    BURIN_TRY(pictures, WorldPictures::create(options.pictures));
    activities::WorldView view(*part, ids, options.radius_m);
    std::set<std::string> pictured;
    bool began = false;
    const auto frame = [&](double, const activities::WorldMoment& moment) -> Result<void> {
        view.take((part)->take_object_updates());
        if (!pictures) return {};
        if (!std::exchange(began, true)) return (pictures)->take(view.close_scene({}), "world.png");
        if (!moment.newly_touched || pictured.size() >= kMostTouchPictures) return {};
        pictured.insert(*moment.newly_touched);
        return (pictures)->take(view.close_scene(moment.tool), "touched-" + std::to_string(pictured.size()) + "-" +
                                                                   file_word(*moment.newly_touched) + ".png");
    };
    BURIN_TRY(figures, activities::explore_by_feel(*part, ids, materials, stroke, explore, frame));
    if (pictures) {
        const auto done = (pictures)->take_both_eyes(view.wall_scene(figures.felt.last_tool), "stereo.png");
        if (!done) return done;
    }
    if (!options.record.empty())
        std::printf("%s: %s ticks recorded\n", options.record.c_str(), std::to_string(figures.felt.ticks).c_str());
    print_touches(figures);
    print_motion_scaled(figures.felt.object_from_device.scale);
    return write_world_report(options, figures);
}

}  // namespace burin::app
