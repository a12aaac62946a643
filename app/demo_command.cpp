// SPDX-License-Identifier: MIT
#include "app/demo_command.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "activities/wand/cube_test.hpp"
#include "activities/wand/wand_view.hpp"
#include "app/carve/sculpt_options.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/picture_folder.hpp"
#include "app/study/study_command.hpp"
#include "app/world/world_explore.hpp"
#include "base/assets.hpp"
#include "devices/haptic/wand_file.hpp"
#include "scene/vrml_world.hpp"
#include "session/picture/pictures.hpp"

namespace burin::app {
namespace {

// The cases of which there is a picture, and its name.
constexpr std::array kPictured{
    std::pair(activities::CubeCase::top, "top.png"), std::pair(activities::CubeCase::bottom, "bottom.png"),
    std::pair(activities::CubeCase::both, "both.png"), std::pair(activities::CubeCase::against, "single-point.png")};

struct CubeWorld {
    std::vector<scene::ObjectId> ids;
    scene::MaterialTable materials;
    std::unique_ptr<scene::MeshPart> part;
    Box cube_scene_m;  // of the object to be pressed
};

// Reads a world; its first object that is felt is the one that is pressed.
Result<void> open_cube(CubeWorld& to, const std::string& path) {
    scene::WorldOrProblems world = scene::read_any_world(path);
    if (!world) return std::unexpected(world.error().front());
    for (const scene::SceneObject& object : world->objects) {
        to.ids.push_back(object.id);
        if (!object.felt || !to.cube_scene_m.empty()) continue;
        for (const Vec3& p : object.mesh->positions_m) to.cube_scene_m.include(object.pose * (object.scale * p));
    }
    if (to.cube_scene_m.empty()) return fail(path, "has nothing to touch", "name a world with a cube");
    auto part = scene::MeshPart::create(std::move(world->objects), to.materials);
    if (!part) return std::unexpected(part.error());
    to.part = std::move(*part);
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

Result<void> draw_cases(const std::filesystem::path& folder, const CubeWorld& world, const activities::CubeTest& test,
                        const devices::WandDescription& wand, double radius_m) {
    Result<PictureFolder> pictures = PictureFolder::create(folder.string(), "--out");
    if (!pictures) return std::unexpected(pictures.error());
    const activities::WorldView view(*world.part, world.ids, radius_m);
    const activities::WandView avatar(wand, wand.gain, radius_m);
    activities::WandCamera camera;
    // From the side on which the wand is, so that the face that is pressed is seen along.
    camera.towards_eye = {-1.0, 0.45, -0.65};
    camera.middle_scene = {world.cube_scene_m.center().x, world.cube_scene_m.center().y,
                           0.5 * (world.cube_scene_m.center().z + test.face_m)};
    camera.half_height_m = world.cube_scene_m.extent().y;
    for (const auto& [which, name] : kPictured) {
        const activities::WandPose pose = pose_in_case(test.measures[static_cast<std::size_t>(which)]);
        if (const auto taken = pictures->take(avatar.close_scene(view, pose, camera), name); !taken) return taken;
    }
    return {};
}

void print_findings(const activities::CubeTest& test) {
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

Json cube_report(const activities::CubeTest& test, const std::string& world) {
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

Result<void> write_figures(const std::filesystem::path& folder, const activities::CubeTest& test,
                           const std::string& world) {
    for (const auto& [name, content] : {std::pair("figure-15.svg", activities::figure_control(test)),
                                        std::pair("figure-23.svg", activities::figure_forces(test)),
                                        std::pair("figure-24.svg", activities::figure_torques(test)),
                                        std::pair("figure-25.svg", activities::figure_sums(test)),
                                        std::pair("ticks.csv", activities::cube_table(test)),
                                        std::pair("report.json", json_text(cube_report(test, world)))}) {
        const std::string path = (folder / name).string();
        if (const auto written = write_text(path, content); !written) return written;
        std::printf("wrote %s\n", path.c_str());
    }
    return {};
}

}  // namespace

struct DemoCommand::Options {
    session::SculptOptions sculpt;
    std::string sculpt_out = "out/demo";
    std::string world_out = "out/demo-world", study_out = "out/demo-study", hand_out = "out/demo-hand";
    std::string out, world = asset_path("worlds/wand-cube.wrl"), wand;
    double radius_m = 0.004;
    bool no_pictures = false;

    [[nodiscard]] Result<void> carve() const;
    [[nodiscard]] Result<void> explore() const;
    [[nodiscard]] Result<void> take_study() const;
    [[nodiscard]] Result<void> grasp() const;
    [[nodiscard]] Result<void> press_cube() const;
};

namespace {

// Returns what the demonstration carves where the command line says nothing else: an ornament in a soccer ball.
session::SculptOptions ornament() {
    session::SculptOptions options;
    options.workpiece.source = asset_path("workpieces/soccer_ball.obj");
    options.workpiece.resolution = 512;
    options.tool.shape = "ball:0.003";
    options.stroke = asset_path("strokes/ornament.csv");
    options.hand = session::HandChoice::simulated;
    options.feel.hardness = "medium";
    options.feel.press_N = 1.5;
    options.feel.grip_N_per_m = 1000.0;
    return options;
}

}  // namespace

Result<void> DemoCommand::Options::carve() const {
    session::SculptOptions options = sculpt;
    const std::filesystem::path folder = sculpt_out;
    if (const auto made = session::make_picture_folder(sculpt_out, "--out"); !made) return made;
    for (const char* part : {"part.stl", "part.ply"}) options.exports.push_back((folder / part).string());
    if (options.pictures.empty()) options.pictures = sculpt_out;
    if (options.report.empty()) options.report = (folder / "report.json").string();
    session::settle_room(options, false);
    if (const auto carved = app::sculpt(options); !carved) return carved;
    std::printf("left in %s\n", sculpt_out.c_str());
    return {};
}

Result<void> DemoCommand::Options::explore() const {
    WorldExploration exploration;
    exploration.world = asset_path("worlds/garden.toml");
    exploration.stroke = asset_path("strokes/garden.csv");
    exploration.pictures = world_out;
    exploration.report = (std::filesystem::path(world_out) / "report.json").string();
    if (const auto made = session::make_picture_folder(world_out, "--out"); !made) return made;
    return explore_world(exploration);
}

Result<void> DemoCommand::Options::take_study() const {
    StudyInitOptions init;
    init.places = {"kinesthetic-path", study_out};
    init.seed = 1;
    if (const auto made = study_init(init); !made) return made;
    StudyRunOptions run;
    run.study = study_out;
    run.simulated = true;
    if (const auto ran = study_run(run, {}); !ran) return ran;
    return study_report(study_out);
}

Result<void> DemoCommand::Options::grasp() const {
    HandSession session;
    prepare_hand(session);
    session.grasp = "whole";
    session.session.live.outputs = hand_out;
    if (const auto made = session::make_picture_folder(hand_out, "--out"); !made) return made;
    return hand(session);
}

DemoCommand::DemoCommand(Command app)
    : options_(std::make_unique<Options>()),
      command_(
          app.subcommand("demo", "Carve an ornament into a ball with a simulated hand; other runs that show much")) {
    options_->sculpt = ornament();
    command_.option("--out", options_->sculpt_out, "A folder for pictures, meshes and report").show_default();
    add_carving_options(command_, options_->sculpt);
    world_ = command_.subcommand("world", "A simulated hand feels the objects of a garden");
    world_.option("--out", options_->world_out, "A folder for pictures and report").show_default();
    study_ = command_.subcommand("study", "A study of simulated learners, from its protocol to its report");
    study_.option("--out", options_->study_out, "A new folder for it").show_default();
    hand_ = command_.subcommand("hand", "A drawn hand grasps a ball, carries it and lets it go");
    hand_.option("--out", options_->hand_out, "A folder for pictures").show_default();
    Command wand = command_.subcommand(
        "wand", "Press a wand's ends against a cube: forces, torques and their signs, with pictures and plots");
    Options& o = *options_;
    wand.option("--out", o.out, "A folder for pictures, figures, table and report").required();
    wand.option("--world", o.world, "A world whose first object that is felt is the cube")
        .asset(AssetRoom::worlds)
        .show_default();
    wand.option("--wand", o.wand, "A wand's description (TOML); else the Quanser wand's").asset(AssetRoom::devices);
    wand_ = wand;
    wand.option("--radius", o.radius_m, "Radius of the balls that touch, in metres").within(1e-4, 0.02).show_default();
    wand.flag("--no-pictures", o.no_pictures, "Leave out the pictures, which need a Vulkan device");
}

DemoCommand::~DemoCommand() = default;

bool DemoCommand::parsed() const { return command_.parsed(); }

Result<void> DemoCommand::run() const {
    const Options& o = *options_;
    if (world_.parsed()) return o.explore();
    if (study_.parsed()) return o.take_study();
    if (hand_.parsed()) return o.grasp();
    return wand_.parsed() ? o.press_cube() : o.carve();
}

Result<void> DemoCommand::Options::press_cube() const {
    const Options& o = *this;
    const Result<devices::WandDescription> described =
        o.wand.empty() ? devices::WandDescription{} : devices::read_wand(o.wand);
    if (!described) return std::unexpected(described.error());
    CubeWorld cube;
    if (const auto opened = open_cube(cube, o.world); !opened) return opened;
    if (const auto made = session::make_picture_folder(o.out, "--out"); !made) return made;
    const Result<activities::CubeTest> test =
        activities::run_cube_test(*cube.part, cube.materials, cube.cube_scene_m, *described, o.radius_m);
    if (!test) return std::unexpected(test.error());
    if (const auto written = write_figures(o.out, *test, o.world); !written) return written;
    if (!o.no_pictures)
        if (const auto drawn = draw_cases(o.out, cube, *test, *described, o.radius_m); !drawn) return drawn;
    print_findings(*test);
    if (test->holds()) return {};
    std::fflush(stdout);
    return fail(o.out, "not all forces and torques are as expected", "see the lines that say WRONG");
}

}  // namespace burin::app
