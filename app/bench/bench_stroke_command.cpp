// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/bench/bench_command.hpp"
#include "app/bench/bench_limits.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "bench/measure/surface_errors.hpp"
#include "bench/measure/timing.hpp"
#include "bench/stroke/pareto.hpp"
#include "bench/stroke/stroke_report.hpp"
#include "compute/rays/lattice.hpp"
#include "geometry/files/closed_mesh.hpp"
#include "geometry/files/mesh_export.hpp"
#include "sculpt/load_workpiece.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

constexpr int kReferenceRays = 2048;         // a side, for the removed volume of a part of a scene
constexpr const char* kCapsule = "capsule";  // a ball that is swept
constexpr std::array kStrokeTools{bench::StrokeTool::ball, bench::StrokeTool::cylinder, bench::StrokeTool::cone,
                                  bench::StrokeTool::bullnose, bench::StrokeTool::box};
constexpr const char *kCubeScene = "cube", *kTurnedCubeScene = "turned-cube", *kMeshScene = "mesh:";

struct StrokeBench {
    bench::StrokeOptions stroke;
    std::string tool = "ball", peer, json, exported;
    std::vector<std::string> scenes{kCubeScene};
    bool plain = false, swept = false;
    std::size_t updates = 1000;

    [[nodiscard]] Result<void> run();

private:
    [[nodiscard]] Result<void> check() const;
    [[nodiscard]] Result<bench::CarveScene> scene_named(const std::string& name) const;
    [[nodiscard]] Result<Json> report_of(const std::string& scene_name) const;
    [[nodiscard]] Result<void> add_peer(Json& report, const bench::CarveScene& scene) const;
};

// Prints what was asked of the device, where there is one.
void print_counts(const Json& report, bool names_scene) {
    const std::string counts = bench::counts_table(report);
    if (counts.empty()) return;
    const std::string title = names_scene ? report["scene"].get<std::string>() + "\n" : "";
    std::printf("\n%s%s", title.c_str(), counts.c_str());
}

Result<void> StrokeBench::check() const {
    session::InputFiles inputs;
    for (const std::string& scene : scenes) inputs.tool(scene);  // mesh:FILE, as tools are written
    BURIN_TRY_DO(check_places(std::array{json, exported}, inputs.list()));
    if (!exported.empty()) {
        const auto format = geometry::mesh_format_of(exported);
        if (!format || *format == geometry::MeshFormat::off) {
            return fail(exported, "has no extension that Burin exports", "name it .stl, .ply or .obj");
        }
    }
    for (const std::string& scene : scenes) {
        if (scene != kCubeScene && scene != kTurnedCubeScene && !scene.starts_with(kMeshScene)) {
            return fail("--scene " + scene, "is no scene", "choose cube, turned-cube or mesh:FILE");
        }
    }
    if (!exported.empty() && scenes.size() > 1) {
        return fail("--export " + exported, "takes one mesh, and there are several scenes", "give one --scene");
    }
    if (!peer.empty() && scenes != std::vector<std::string>{kCubeScene}) {
        return fail("--peer " + peer, "carves only a cube along the lattice", "leave --scene at cube");
    }
    if (!peer.empty() && (tool != "ball" || swept || stroke.smooths)) {
        return fail("--peer " + peer, "carves with a ball at one place after the other",
                    "leave --tool at ball, without --swept and --operation");
    }
    if (!peer.empty() && !bench::has_peers()) {
        return fail("--peer " + peer, "is not built into this program",
                    "install it with scripts/setup --peers and configure with -DBURIN_WITH_PEERS=ON");
    }
    return {};
}

Result<void> StrokeBench::add_peer(Json& report, const bench::CarveScene& scene) const {
    BURIN_TRY(lattice, compute::lattice_around({Vec3(0.0), Vec3(1.0)}, stroke.resolution));
    const auto threads = report["threads"].get<unsigned>();
    for (const auto method : {bench::VdbMethod::csg_difference, bench::VdbMethod::leaf_brush}) {
        BURIN_TRY(run, bench::run_openvdb(scene, lattice, threads, method));
        const auto errors = bench::measure(run.mesh, scene, lattice.spacing_m);
        bench::add_openvdb(report, bench::describe(scene, run, errors, lattice.spacing_m));
    }
    return {};
}

Result<bench::CarveScene> StrokeBench::scene_named(const std::string& name) const {
    bench::CarveScene scene;
    if (name.starts_with(kMeshScene)) {
        const std::string file = name.substr(std::string(kMeshScene).size());
        // The scene is brought to a size of its own, whatever the file's unit.
        BURIN_TRY(closed, geometry::load_closed_mesh({.file = file, .close_holes = true, .units = LengthUnit::m}));
        const std::string stem = std::filesystem::path(file).stem().string();
        Result<bench::CarveScene> on_mesh = bench::stroke_on_mesh_scene(stem, std::move(closed.mesh), swept);
        if (!on_mesh) return on_mesh;
        scene = std::move(*on_mesh);
    } else {
        scene = swept ? bench::stroke_1000_swept_scene() : bench::stroke_1000_scene();
    }
    // Where it is known, the volume serves as a reference.
    if (updates < scene.sweeps.size())
        scene = bench::beginning_of(scene, updates, stroke.is_known() ? kReferenceRays : 1);
    return name == kTurnedCubeScene ? bench::turned(std::move(scene)) : scene;
}

Result<Json> StrokeBench::report_of(const std::string& scene_name) const {
    BURIN_TRY(scene, scene_named(scene_name));
    const std::string on = bench::machine();
    bench::StrokeOptions run_options = stroke;
    run_options.with_undo = run_options.with_light = !plain;
    BURIN_TRY(run, bench::run_stroke(scene, run_options));
    std::optional<bench::SurfaceErrors> errors;
    if (stroke.is_known()) errors = bench::measure(run.mesh, scene, run.cell_m);
    Json report = bench::describe(scene, run, errors, bench::count_self_intersections(run.mesh, stroke.threads));
    report["tool"] = tool;
    report["operation"] = stroke.smooths ? "smooth" : "cut";
    report["swept"] = swept;
    report["machine"] = on;
    if (!peer.empty()) {
        BURIN_TRY_DO(add_peer(report, scene));
    }
    if (!exported.empty()) {
        if (const auto written = geometry::export_mesh(run.mesh, exported); !written) {
            return std::unexpected(written.error());
        }
    }
    return report;
}

Result<void> StrokeBench::run() {
    if (tool == kCapsule) {
        swept = true;
    } else {
        stroke.tool = *std::ranges::find(kStrokeTools, tool, [](bench::StrokeTool of) { return bench::name_of(of); });
    }
    BURIN_TRY_DO(check());
    std::vector<Json> reports;
    for (const std::string& scene : scenes) {
        BURIN_TRY(report, report_of(scene));
        reports.push_back(std::move(report));
    }
    bench::sort_worst_first(reports);
    const bool one = reports.size() == 1;
    if (json != kStandardOutput) {
        std::fputs((one ? bench::table(reports.front()) : bench::scene_table(reports)).c_str(), stdout);
        for (const Json& report : reports) print_counts(report, !one);
    }
    return write_output(json, json_text(one ? reports.front() : Json(reports)));
}

CommandAction add_stroke_bench(Command command) {
    const auto options = std::make_shared<StrokeBench>();
    command
        .option("--resolution", options->stroke.resolution, "Lattice cells along the cube's side, or a mesh's longest")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    command.choice("--engine", options->stroke.on_vulkan, "cpu or vulkan", {{"cpu", false}, {"vulkan", true}});
    command
        .option("--tool", options->tool,
                "A ball, or a tool in its place that removes about as much; capsule: a ball with --swept")
        .one_of({"ball", kCapsule, "cylinder", "cone", "bullnose", "box"})
        .show_default();
    command.choice("--operation", options->stroke.smooths, "What the tool does: cut, or smooth what it has cut before",
                   {{"cut", false}, {"smooth", true}});
    command.flag("--swept", options->swept, "Sweep the tool from each place to the next; else a stamp at each place");
    command.option("--scene", options->scenes,
                   "cube: along the lattice; turned-cube: turned by 20 degrees; mesh:FILE: a scan, say, whose holes "
                   "are closed. Several give one table, the worst first, and their figures as a list");
    command.flag("--plain", options->plain, "Leave out the updates with undo and with light, a run each");
    command.option("--threads", options->stroke.threads, kBenchThreadsHelp).within(0, kMostBenchThreads);
    command.option("--updates", options->updates, "Only so many of the cuts")
        .within(1, kMostBenchUpdates)
        .show_default();
    command.option("--json", options->json, "A file for all figures; - for standard output");
    command.option("--export", options->exported, "Where to write the carved mesh: .stl, .ply or .obj");
    command.option("--peer", options->peer, "openvdb: do the same with it, and compare").one_of({"openvdb"});
    return action([options] { return options->run(); });
}

}  // namespace

CommandRow bench_stroke_row() {
    return {"stroke", "STROKE-1000: a thousand cuts into a workpiece, every figure of one run", add_stroke_bench};
}

}  // namespace burin::app
