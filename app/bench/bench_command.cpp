// SPDX-License-Identifier: MIT
#include "app/bench/bench_command.hpp"

#include <array>
#include <cstdio>
#include <filesystem>

#include "app/cli/output_files.hpp"
#include "bench/measure/timing.hpp"
#include "bench/stroke/pareto.hpp"
#include "bench/stroke/stroke_report.hpp"
#include "compute/rays/lattice.hpp"
#include "geometry/files/mesh_export.hpp"
#include "sculpt/workpiece.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

constexpr int kMostThreads = 1024, kMostUpdates = 1000;  // the scenes have a thousand cuts
constexpr int kReferenceRays = 2048;                     // a side, for the removed volume of a part of a scene
constexpr const char *kCubeScene = "cube", *kTurnedCubeScene = "turned-cube", *kMeshScene = "mesh:";

}  // namespace

struct BenchCommand::Options {
    bench::StrokeOptions stroke;
    bench::ParetoOptions pareto;
    std::string tool = "ball", peer, json, exported;  // of stroke
    std::vector<std::string> scenes{kCubeScene};
    bool plain = false;
    std::size_t updates = 1000;
    std::string csv, svg, pareto_json;

    [[nodiscard]] Result<void> run_stroke() const;
    [[nodiscard]] Result<void> run_pareto() const;

private:
    [[nodiscard]] Result<void> check_stroke() const;
    [[nodiscard]] Result<bench::CarveScene> scene_named(const std::string& name) const;
    [[nodiscard]] Result<Json> report_of(const std::string& scene_name) const;
    [[nodiscard]] Result<void> add_peer(Json& report, const bench::CarveScene& scene) const;
};

Result<void> BenchCommand::Options::check_stroke() const {
    session::InputFiles inputs;
    for (const std::string& scene : scenes) inputs.tool(scene);  // mesh:FILE, as tools are written
    if (const auto ok = check_places(std::array{json, exported}, inputs.list()); !ok) return ok;
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
    if (!peer.empty() && tool != "ball") {
        return fail("--peer " + peer, "carves with a ball at one place after the other", "leave --tool at ball");
    }
    if (!peer.empty() && !bench::has_peers()) {
        return fail("--peer " + peer, "is not built into this program",
                    "install it with scripts/setup --peers and configure with -DBURIN_WITH_PEERS=ON");
    }
    return {};
}

Result<void> BenchCommand::Options::add_peer(Json& report, const bench::CarveScene& scene) const {
    const Result<compute::Lattice> lattice = compute::lattice_around({Vec3(0.0), Vec3(1.0)}, stroke.resolution);
    if (!lattice) return std::unexpected(lattice.error());
    const auto threads = report["threads"].get<unsigned>();
    for (const auto method : {bench::VdbMethod::csg_difference, bench::VdbMethod::leaf_brush}) {
        const auto run = bench::run_openvdb(scene, *lattice, threads, method);
        if (!run) return std::unexpected(run.error());
        const auto errors = bench::measure(run->mesh, scene, lattice->spacing_m);
        bench::add_openvdb(report, bench::describe(scene, *run, errors, lattice->spacing_m));
    }
    return {};
}

Result<bench::CarveScene> BenchCommand::Options::scene_named(const std::string& name) const {
    const bool swept = tool == "capsule";
    bench::CarveScene scene;
    if (name.starts_with(kMeshScene)) {
        const std::string file = name.substr(std::string(kMeshScene).size());
        // The scene is brought to a size of its own, whatever the file's unit.
        Result<sculpt::ClosedMesh> closed =
            sculpt::load_closed_mesh({.source = file, .close_holes = true, .units = LengthUnit::m});
        if (!closed) return std::unexpected(closed.error());
        const std::string stem = std::filesystem::path(file).stem().string();
        Result<bench::CarveScene> on_mesh = bench::stroke_on_mesh_scene(stem, std::move(closed->mesh), swept);
        if (!on_mesh) return on_mesh;
        scene = std::move(*on_mesh);
    } else {
        scene = swept ? bench::stroke_1000_swept_scene() : bench::stroke_1000_scene();
    }
    if (updates < scene.sweeps.size()) scene = bench::beginning_of(scene, updates, kReferenceRays);
    return name == kTurnedCubeScene ? bench::turned(std::move(scene)) : scene;
}

Result<Json> BenchCommand::Options::report_of(const std::string& scene_name) const {
    const Result<bench::CarveScene> scene = scene_named(scene_name);
    if (!scene) return std::unexpected(scene.error());
    const std::string on = bench::machine();
    bench::StrokeOptions run_options = stroke;
    run_options.with_undo = run_options.with_light = !plain;
    const auto run = bench::run_stroke(*scene, run_options);
    if (!run) return std::unexpected(run.error());
    Json report = bench::describe(*scene, *run, bench::measure(run->mesh, *scene, run->cell_m),
                                  bench::count_self_intersections(run->mesh, stroke.threads));
    report["tool"] = tool;
    report["machine"] = on;
    if (!peer.empty()) {
        if (const auto added = add_peer(report, *scene); !added) return std::unexpected(added.error());
    }
    if (!exported.empty()) {
        if (const auto written = geometry::export_mesh(run->mesh, exported); !written) {
            return std::unexpected(written.error());
        }
    }
    return report;
}

Result<void> BenchCommand::Options::run_stroke() const {
    if (const auto ok = check_stroke(); !ok) return ok;
    std::vector<Json> reports;
    for (const std::string& scene : scenes) {
        Result<Json> report = report_of(scene);
        if (!report) return std::unexpected(report.error());
        reports.push_back(std::move(*report));
    }
    bench::sort_worst_first(reports);
    const bool one = reports.size() == 1;
    if (json != kStandardOutput) {
        std::fputs((one ? bench::table(reports.front()) : bench::scene_table(reports)).c_str(), stdout);
    }
    return write_output(json, json_text(one ? reports.front() : Json(reports)));
}

Result<void> BenchCommand::Options::run_pareto() const {
    if (const auto ok = check_places(std::array{csv, svg, pareto_json}); !ok) return ok;
    const auto compared = bench::run_pareto(
        pareto, [](const std::string& line) { std::fprintf(stderr, "measured: %s\n", line.c_str()); });
    if (!compared) return std::unexpected(compared.error());
    Json report = {{"machine", compared->machine}, {"rows", compared->rows}, {"left_out", compared->left_out}};
    if (pareto_json != kStandardOutput && csv != kStandardOutput && svg != kStandardOutput) {
        std::fputs(bench::pareto_table(*compared).c_str(), stdout);
    }
    if (const auto written = write_output(csv, bench::pareto_csv(*compared)); !written) return written;
    if (const auto written = write_output(svg, bench::pareto_svg(*compared)); !written) return written;
    return write_output(pareto_json, json_text(report));
}

BenchCommand::BenchCommand(Command app)
    : options_(std::make_unique<Options>()),
      command_(app.subcommand("bench", "Measure carving, touching and drawing, and reaching across the wall")) {
    command_.require_subcommand();
    const std::string threads_help = "How many threads work; 0: one per core";

    stroke_ = command_.subcommand("stroke", "STROKE-1000: a thousand cuts into a workpiece, every figure of one run");
    Options& o = *options_;
    stroke_.option("--resolution", o.stroke.resolution, "Lattice cells along the cube's side, or a mesh's longest")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    stroke_.choice("--engine", o.stroke.on_vulkan, "cpu or vulkan", {{"cpu", false}, {"vulkan", true}});
    stroke_.option("--tool", o.tool, "ball: a stamp at each place; capsule: swept from each place to the next")
        .one_of({"ball", "capsule"})
        .show_default();
    stroke_.option(
        "--scene", o.scenes,
        "cube: along the lattice; turned-cube: turned by 20 degrees; mesh:FILE: a scan, say, whose holes are "
        "closed. Several give one table, the worst first, and their figures as a list");
    stroke_.flag("--plain", o.plain, "Leave out the updates with undo and with light, a run each");
    stroke_.option("--threads", o.stroke.threads, threads_help).within(0, kMostThreads);
    stroke_.option("--updates", o.updates, "Only so many of the cuts").within(1, kMostUpdates).show_default();
    stroke_.option("--json", o.json, "A file for all figures; - for standard output");
    stroke_.option("--export", o.exported, "Where to write the carved mesh: .stl, .ply or .obj");
    stroke_.option("--peer", o.peer, "openvdb: do the same with it, and compare").one_of({"openvdb"});

    pareto_ = command_.subcommand("pareto", "Time against error over resolutions, for both engines and the peers");
    pareto_.option("--smallest", o.pareto.smallest, "The coarsest resolution")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    pareto_.option("--largest", o.pareto.largest, "The finest; each is twice the one before")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    pareto_
        .option("--largest-on-software-vulkan", o.pareto.largest_on_software_vulkan,
                "The finest for the Vulkan engine where its device is a software one; 0: none")
        .within(0, compute::kMaxResolution)
        .show_default();
    pareto_.option("--threads", o.pareto.threads, threads_help).within(0, kMostThreads);
    pareto_.option("--updates", o.pareto.updates, "Only so many of the cuts").within(1, kMostUpdates).show_default();
    pareto_.option("--cgal-updates", o.pareto.cgal_updates, "Only so many of the cuts with CGAL, which is slow")
        .within(1, kMostUpdates)
        .show_default();
    pareto_.option("--csv", o.csv, "A file for the table; - for standard output");
    pareto_.option("--svg", o.svg, "A file for the figure");
    pareto_.option("--json", o.pareto_json, "A file for every figure of every run; - for standard output");

    others_.push_back(add_bench_frame(command_));
    others_.push_back(add_bench_haptics(command_));
    others_.push_back(add_bench_record(command_));
    others_.push_back(add_bench_document(command_));
    others_.push_back(add_bench_study(command_));
    others_.push_back(add_bench_stability(command_));
    others_.push_back(add_bench_glove(command_));
    others_.push_back(add_bench_workspace(command_));
    others_.push_back(add_bench_body(command_));
    others_.push_back(add_bench_world(command_));
}

BenchCommand::~BenchCommand() = default;

bool BenchCommand::parsed() const { return command_.parsed(); }

Result<void> BenchCommand::run() const {
    for (const BenchSubcommand& other : others_) {
        if (other.command.parsed()) return other.run();
    }
    return stroke_.parsed() ? options_->run_stroke() : options_->run_pareto();
}

}  // namespace burin::app
