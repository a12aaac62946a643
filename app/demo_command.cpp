// SPDX-License-Identifier: MIT
#include "app/demo_command.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "activities/wand/pressed_cube.hpp"
#include "activities/wand/wand_view.hpp"
#include "app/carve/sculpt.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/picture_folder.hpp"
#include "app/cli/sculpt_options.hpp"
#include "app/study/study_command.hpp"
#include "app/study/study_run_command.hpp"
#include "app/world/hand_command.hpp"
#include "app/world/world_explore.hpp"
#include "base/assets.hpp"
#include "base/try.hpp"
#include "desk/draw/picture_folder.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/haptic/wand_file.hpp"
#include "scene/vrml_world.hpp"
#include "scene/world_file.hpp"

namespace burin::app {
namespace {

// The cases of which there is a picture, and its name.
constexpr std::array kPictured{
    std::pair(activities::CubeCase::top, "top.png"), std::pair(activities::CubeCase::bottom, "bottom.png"),
    std::pair(activities::CubeCase::both, "both.png"), std::pair(activities::CubeCase::against, "single-point.png")};

struct CubeWorld {
    activities::ExploredWorld world;
    Box cube_scene_m;  // of the object to be pressed
};

// Reads a world; its first object that is felt is the one that is pressed.
Result<void> open_cube(CubeWorld& to, const std::string& path) {
    scene::WorldOrProblems world = scene::read_any_world(path);
    if (!world) return std::unexpected(world.error().front());
    for (const scene::SceneObject& object : world->objects) {
        if (!object.felt || !to.cube_scene_m.empty()) continue;
        for (const Vec3& p : object.mesh->positions_m) to.cube_scene_m.include(object.pose * (object.scale * p));
    }
    if (to.cube_scene_m.empty()) return fail(path, "has nothing to touch", "name a world with a cube");
    to.world = {.file = path,
                .scene = std::make_shared<const scene::World>(std::move(*world)),
                .device = std::string(devices::kSimulatedWand)};
    return {};
}

activities::WandPose pose_in_case(const activities::CubeMeasure& measure) {
    const activities::CubeTick& tick = measure.mean;
    activities::WandPose pose;
    pose.scene_from_tool = tick.scene_from_handle;
    pose.force_N = tick.given_force_N;
    pose.points_scene = {tick.top_scene_m, tick.bottom_scene_m};
    return pose;
}

Result<void> draw_cases(const std::filesystem::path& folder, const CubeWorld& world,
                        const activities::PressedCube& test, const devices::WandDescription& wand, double radius_m) {
    BURIN_TRY(pictures, PictureFolder::create(folder.string(), "--out"));
    const activities::WorldView view(session::DrawnWorld(world.world.scene->objects), radius_m);
    const activities::WandView avatar(wand, wand.gain, radius_m);
    activities::WandCamera camera;
    // From the side on which the wand is, so that the face that is pressed is seen along.
    camera.towards_eye = {-1.0, 0.45, -0.65};
    camera.middle_scene = {world.cube_scene_m.center().x, world.cube_scene_m.center().y,
                           0.5 * (world.cube_scene_m.center().z + test.face_m)};
    camera.half_height_m = world.cube_scene_m.extent().y;
    for (const auto& [which, name] : kPictured) {
        const activities::WandPose pose = pose_in_case(test.measures[static_cast<std::size_t>(which)]);
        BURIN_TRY_DO(pictures.take(avatar.close_scene(view, pose, camera), name));
    }
    return {};
}

void print_findings(const activities::PressedCube& test) {
    for (const activities::CubeFinding& finding : test.findings) {
        std::printf("%-5s %s: %s\n      found: %s\n", finding.holds ? "yes" : "WRONG", activities::text(finding.which),
                    finding.expected.c_str(), finding.found.c_str());
    }
    const devices::WandSaturation& s = test.two_points_run.saturation;
    std::printf(
        "ticks at a limit: force %llu %llu %llu, torque %llu %llu %llu of %llu; the amplifiers tripped %llu times\n",
        static_cast<unsigned long long>(s.force[0]), static_cast<unsigned long long>(s.force[1]),
        static_cast<unsigned long long>(s.force[2]), static_cast<unsigned long long>(s.torque[0]),
        static_cast<unsigned long long>(s.torque[1]), static_cast<unsigned long long>(s.torque[2]),
        static_cast<unsigned long long>(test.two_points_run.ticks),
        static_cast<unsigned long long>(test.two_points_run.trips + test.one_point_run.trips));
}

Json vector_of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json cube_report(const activities::PressedCube& test, const std::string& world) {
    Json report{{"burin", BURIN_VERSION}, {"world", world}, {"as_expected", test.holds()}};
    report["cases"] = Json::array();
    for (const activities::CubeMeasure& m : test.measures)
        report["cases"].push_back({{"case", activities::text(m.which)},
                                   {"from_s", m.from_s},
                                   {"to_s", m.to_s},
                                   {"ticks", m.ticks},
                                   {"force_N", vector_of(m.mean.given_force_N)},
                                   {"torque_Nm", vector_of(m.mean.given_torque_Nm)},
                                   {"top_end_inside_m", m.sunk_top_m}});
    report["findings"] = Json::array();
    for (const activities::CubeFinding& f : test.findings)
        report["findings"].push_back(
            {{"case", activities::text(f.which)}, {"expected", f.expected}, {"found", f.found}, {"holds", f.holds}});
    return report;
}

Result<void> write_figures(const std::filesystem::path& folder, const activities::PressedCube& test,
                           const std::string& world) {
    for (const auto& [name, content] : {std::pair("figure-15.svg", activities::figure_control(test)),
                                        std::pair("figure-23.svg", activities::figure_forces(test)),
                                        std::pair("figure-24.svg", activities::figure_torques(test)),
                                        std::pair("figure-25.svg", activities::figure_sums(test)),
                                        std::pair("ticks.csv", activities::cube_table(test)),
                                        std::pair("report.json", json_text(cube_report(test, world)))}) {
        const std::string path = (folder / name).string();
        BURIN_TRY_DO(write_text(path, content));
        std::printf("wrote %s\n", path.c_str());
    }
    return {};
}

// Options of burin demo wand.
struct CubeDemo {
    std::string out, world = asset_path("worlds/wand-cube.wrl"), wand;
    double radius_m = 0.004;
    bool no_pictures = false;
};

Result<void> demo_wand(const CubeDemo& o) {
    BURIN_TRY(described, o.wand.empty() ? devices::WandDescription{} : devices::read_wand(o.wand));
    CubeWorld cube;
    BURIN_TRY_DO(open_cube(cube, o.world));
    BURIN_TRY_DO(session::make_picture_folder(o.out, "--out"));
    BURIN_TRY(test, activities::press_cube(cube.world, cube.cube_scene_m, described, o.radius_m));
    BURIN_TRY_DO(write_figures(o.out, test, o.world));
    if (!o.no_pictures) BURIN_TRY_DO(draw_cases(o.out, cube, test, described, o.radius_m));
    print_findings(test);
    if (test.holds()) return {};
    std::fflush(stdout);
    return fail(o.out, "not all forces and torques are as expected", "see the lines that say WRONG");
}

// Returns what the demonstration carves where the command line says nothing else: an ornament in a soccer ball.
session::SessionSetup ornament() {
    session::SessionSetup options;
    options.carve.workpiece.source = asset_path("workpieces/soccer_ball.obj");
    options.carve.workpiece.resolution = 512;
    options.hands.tool.shape = "ball:0.003";
    options.carve.stroke.file = asset_path("strokes/ornament.csv");
    options.carve.stroke.hand = session::HandChoice::simulated;
    options.carve.feel.hardness = "medium";
    options.carve.feel.press_N = 1.5;
    options.carve.feel.grip_N_per_m = 1000.0;
    return options;
}

Result<void> demo_ornament(const session::SessionSetup& sculpt, const std::string& out) {
    session::SessionSetup options = sculpt;
    const std::filesystem::path folder = out;
    BURIN_TRY_DO(session::make_picture_folder(out, "--out"));
    for (const char* part : {"part.stl", "part.ply"}) options.carve.exports.files.push_back((folder / part).string());
    if (options.carve.stroke.pictures.empty()) options.carve.stroke.pictures = out;
    if (options.carve.stroke.report.empty()) options.carve.stroke.report = (folder / "report.json").string();
    session::settle_room(options, false);
    BURIN_TRY_DO(app::sculpt(options));
    std::printf("left in %s\n", out.c_str());
    return {};
}

Result<void> demo_world(const std::string& out) {
    WorldExploration exploration;
    exploration.world = asset_path("worlds/garden.toml");
    exploration.stroke = asset_path("strokes/garden.csv");
    exploration.pictures = out;
    exploration.report = (std::filesystem::path(out) / "report.json").string();
    BURIN_TRY_DO(session::make_picture_folder(out, "--out"));
    return explore_world(exploration);
}

Result<void> demo_study(const std::string& out) {
    StudyInitOptions init;
    init.places = {"kinesthetic-path", out};
    init.seed = 1;
    BURIN_TRY_DO(study_init(init));
    StudyRunOptions run;
    run.study = out;
    run.simulated = true;
    BURIN_TRY_DO(study_run(run, {}));
    return study_report(out);
}

Result<void> demo_hand(const std::string& out) {
    HandSession session;
    prepare_hand(session);
    session.grasp = "whole";
    session.session.work.outputs = out;
    BURIN_TRY_DO(session::make_picture_folder(out, "--out"));
    return hand(session);
}

CommandAction add_demo_world(Command command) {
    const auto out = std::make_shared<std::string>("out/demo-world");
    command.option("--out", *out, "A folder for pictures and report").show_default();
    return action([out] { return demo_world(*out); });
}

CommandAction add_demo_study(Command command) {
    const auto out = std::make_shared<std::string>("out/demo-study");
    command.option("--out", *out, "A new folder for it").show_default();
    return action([out] { return demo_study(*out); });
}

CommandAction add_demo_hand(Command command) {
    const auto out = std::make_shared<std::string>("out/demo-hand");
    command.option("--out", *out, "A folder for pictures").show_default();
    return action([out] { return demo_hand(*out); });
}

CommandAction add_demo_wand(Command command) {
    const auto options = std::make_shared<CubeDemo>();
    command.option("--out", options->out, "A folder for pictures, figures, table and report").required();
    command.option("--world", options->world, "A world whose first object that is felt is the cube")
        .asset(AssetRoom::worlds)
        .show_default();
    command.option("--wand", options->wand, "A wand's description (TOML); else the Quanser wand's")
        .asset(AssetRoom::devices);
    command.option("--radius", options->radius_m, "Radius of the balls that touch, in metres")
        .within(1e-4, 0.02)
        .show_default();
    command.flag("--no-pictures", options->no_pictures, "Leave out the pictures, which need a Vulkan device");
    return action([options] { return demo_wand(*options); });
}

// The ornament's options are those of burin sculpt, with another workpiece and stroke where none are given.
struct OrnamentDemo {
    session::SessionSetup sculpt = ornament();
    std::string out = "out/demo";
};

CommandAction add_demo(Command command) {
    const auto options = std::make_shared<OrnamentDemo>();
    command.option("--out", options->out, "A folder for pictures, meshes and report").show_default();
    add_carving_options(command, options->sculpt);
    return add_commands(
        command,
        {{"world", "A simulated hand feels the objects of a garden", add_demo_world},
         {"study", "A study of simulated learners, from its protocol to its report", add_demo_study},
         {"hand", "A drawn hand grasps a ball, carries it and lets it go", add_demo_hand},
         {"wand", "Press a wand's ends against a cube: forces, torques and their signs, with pictures and plots",
          add_demo_wand}},
        action([options] { return demo_ornament(options->sculpt, options->out); }));
}

}  // namespace

CommandRow demo_row() {
    return {"demo", "Carve an ornament into a ball with a simulated hand; other runs that show much", add_demo};
}

}  // namespace burin::app
