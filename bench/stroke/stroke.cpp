// SPDX-License-Identifier: MIT
#include "bench/stroke/stroke.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "base/try.hpp"
#include "bench/measure/timing.hpp"
#include "compute/engine/chosen_engine.hpp"
#include "compute/repair/self_intersections.hpp"
#include "compute/vulkan/engine_choice.hpp"
#include "picture/frame_setup.hpp"
#include "sculpt/carved_part.hpp"
#include "sculpt/load_workpiece.hpp"

namespace burin::bench {
namespace {

constexpr std::uint64_t kCheckedRays = 20000;  // an axis

// A ball that smooths does so about the place that it touches, as in a session: the lowest of what it has cut.
void smooth_instead(const CarveScene& scene, compute::ToolSweep& sweep) {
    sweep.operation = compute::Operation::smooth;
    const auto* const ball = std::get_if<compute::BallTool>(&sweep.shape);
    if (ball == nullptr) return;
    const Vec3 down = scene.object_from_scene.orientation * Vec3(0.0, 0.0, -ball->radius_m);
    sweep.start.position_m += down;
    sweep.end.position_m += down;
}

std::vector<compute::ToolSweep> tool_sweeps(const CarveScene& scene, const StrokeOptions& options) {
    std::vector<compute::ToolSweep> sweeps;
    for (const compute::BallSweep& sweep : scene.sweeps) {
        sweeps.push_back(tool_sweep(scene, sweep, options.tool));
        if (options.smooths) smooth_instead(scene, sweeps.back());
    }
    return sweeps;
}

// Returns the solid that the scene's tool leaves of an uncut one.
Result<compute::Solid> cut_solid(const CarveScene& scene, compute::Solid uncut, const StrokeOptions& options,
                                 WorkerPool& pool) {
    StrokeOptions cutting = options;
    cutting.smooths = false;
    const auto engine = compute::make_cpu_engine(std::move(uncut), pool);
    BURIN_TRY_DO(engine->carve(tool_sweeps(scene, cutting)));
    return engine->solid();
}

// Fails where the processor has gone on for a device: its times are no device's.
Result<void> check_engine(sculpt::Sculpture& sculpture, const StrokeOptions& options) {
    if (!options.on_vulkan || sculpture.engine().name() == std::string_view("vulkan")) return {};
    const std::vector<std::string> why = sculpture.take_notices();
    return fail("--engine vulkan", why.empty() ? "does not carve" : why.front(), "measure with --engine cpu");
}

// Makes a sculpture of the scene's uncut solid.
Result<std::unique_ptr<sculpt::Sculpture>> start(const compute::Solid& uncut, const StrokeOptions& options,
                                                 WorkerPool& pool, StrokeRun& run) {
    const auto choice = options.on_vulkan ? compute::EngineChoice::vulkan : compute::EngineChoice::cpu;
    compute::ChosenEngine chosen = compute::choose_engine(choice, uncut, pool);
    run.engine = chosen.engine->name();
    run.device = options.on_vulkan ? chosen.device : "native";
    run.software_device = chosen.software_device;
    auto sculpture = std::make_unique<sculpt::Sculpture>(std::move(chosen.engine), pool);
    BURIN_TRY_DO(check_engine(*sculpture, options));
    return sculpture;
}

struct Carved {
    UpdateTimes times;
    UpdateCounts counts;             // empty without a device
    std::vector<double> publish_ms;  // local_surface() alone
    std::uint64_t triangles_published = 0;
    std::size_t tiles_lit = 0;
};

// Adds what an update has asked of the device. before: what was asked until then.
void note_asked(UpdateCounts& counts, const sculpt::Sculpture& sculpture,
                const std::optional<compute::DeviceTraffic>& before, std::uint64_t rays_changed_before) {
    const std::optional<compute::DeviceTraffic> after = sculpture.engine().traffic();
    if (!before || !after) return;
    const auto add = [](std::vector<double>& to, std::uint64_t now, std::uint64_t then) {
        to.push_back(static_cast<double>(now - then));
    };
    add(counts.submissions, after->submissions, before->submissions);
    add(counts.blocking_waits, after->blocking_waits, before->blocking_waits);
    add(counts.bytes_to_device, after->bytes_to_device, before->bytes_to_device);
    add(counts.bytes_to_host, after->bytes_to_host, before->bytes_to_host);
    add(counts.rays_changed, sculpture.figures().rays_changed, rays_changed_before);
}

// Carries out an update for each sweep, in the steps of CarvedPart. Ending a stroke and baking light do nothing where
// there is no history and no light.
Result<Carved> carve(sculpt::Sculpture& sculpture, const CarveScene& scene,
                     std::span<const compute::ToolSweep> sweeps) {
    const auto published = std::make_unique<geometry::LocalSurface>();
    const auto publish = [&](const compute::BallSweep& ball_scene) {
        const compute::BallSweep ball = in_object(scene, ball_scene);
        sculpture.local_surface(ball.end_object_m, kPublishedRadii * ball.radius_m, *published);
    };
    // A session publishes once before its first update.
    if (!sweeps.empty()) publish(scene.sweeps.front());
    Carved carved;
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        const std::optional<compute::DeviceTraffic> before = sculpture.engine().traffic();
        const std::uint64_t rays_changed_before = sculpture.figures().rays_changed;
        const double cpu_before_ms = process_cpu_ms();
        Stopwatch watch;
        const Result<void> done = sculpture.update({&sweeps[i], 1});
        if (done && (i + 1) % kUpdatesAStroke == 0) sculpture.end_stroke();
        const double carved_ms = watch.lap_ms();
        if (!done) return std::unexpected(done.error());
        publish(scene.sweeps[i]);
        carved.publish_ms.push_back(watch.lap_ms());
        carved.tiles_lit += sculpture.bake_light(sweeps[i].end.position_m, sculpt::CarvedPart::kLitWorking);
        carved.times.update_ms.push_back(carved_ms + carved.publish_ms.back() + watch.lap_ms());
        carved.times.cpu_ms.push_back(process_cpu_ms() - cpu_before_ms);
        carved.triangles_published += published->triangles();
        note_asked(carved.counts, sculpture, before, rays_changed_before);
    }
    return carved;
}

// Divides each update into its parts. What is left besides the cut and what local_surface() took counts as surface.
void take_figures(const sculpt::Sculpture& sculpture, Carved carved, StrokeRun& run) {
    const sculpt::SculptFigures& figures = sculpture.figures();
    run.update_ms = std::move(carved.times.update_ms);
    run.cpu_ms = std::move(carved.times.cpu_ms);
    if (figures.carve_ms.size() == run.update_ms.size()) {
        run.carve_ms = figures.carve_ms;
        for (std::size_t i = 0; i < run.update_ms.size(); ++i) {
            const double uncut_ms = run.update_ms[i] - run.carve_ms[i];
            run.publish_ms.push_back(std::min(carved.publish_ms[i], uncut_ms - figures.mesh_ms[i]));
            run.mesh_ms.push_back(uncut_ms - run.publish_ms[i]);
        }
    }
    run.triangles_published = carved.triangles_published;
    run.rays_touched = figures.rays_touched;
    run.rays_changed = figures.rays_changed;
    run.cells_remeshed = figures.cells_remeshed;
    run.triangles_remeshed = figures.triangles_remeshed;
}

// Examines the carved solid and its mesh, welded and repaired as for export.
void check(const sculpt::Sculpture& sculpture, const CarveScene& scene, const compute::Solid& uncut, WorkerPool& pool,
           StrokeRun& run) {
    const compute::Solid& solid = sculpture.engine().solid();
    run.rays_held = solid.rays_held();
    run.bytes = solid.bytes();
    run.disagreeing_edges = sculpture.surface().disagreeing_edges();
    if (run.tool == StrokeTool::ball && !run.smooths)
        run.intervals = check_intervals(solid, scene, kCheckedRays, 1, scene.is_of_cube() ? nullptr : &uncut);
    run.mesh = sculpture.surface().welded();
    const compute::RepairReport repair = compute::repair_intersections(run.mesh, sculpture.surface(), solid, pool);
    run.self_intersections_mended = repair.found - repair.left;
}

Result<void> run_plain(const CarveScene& scene, const compute::Solid& uncut, std::span<const compute::ToolSweep> sweeps,
                       const StrokeOptions& options, WorkerPool& pool, StrokeRun& run) {
    BURIN_TRY(sculpture, start(uncut, options, pool, run));
    run.first_mesh_ms = sculpture->first_mesh_ms();
    const auto before = sculpture->engine().traffic();
    BURIN_TRY(carved, carve(*sculpture, scene, sweeps));
    BURIN_TRY_DO(check_engine(*sculpture, options));
    if (const auto after = sculpture->engine().traffic(); before && after)
        run.traffic = {after->submissions - before->submissions,
                       after->blocking_waits - before->blocking_waits,
                       after->bytes_to_device - before->bytes_to_device,
                       after->bytes_to_host - before->bytes_to_host,
                       after->most_memory_bytes,
                       after->bytes_written_to_host - before->bytes_written_to_host};
    run.counts = std::move(carved.counts);
    take_figures(*sculpture, std::move(carved), run);
    check(*sculpture, scene, uncut, pool, run);
    return {};
}

}  // namespace

Result<StrokeRun> run_stroke(const CarveScene& scene, const StrokeOptions& options) {
    WorkerPool pool(options.threads);
    BURIN_TRY(uncut, uncut_solid(scene, options.resolution, pool));
    if (options.smooths) {
        BURIN_TRY(cut, cut_solid(scene, std::move(uncut), options, pool));
        uncut = std::move(cut);
    }
    StrokeRun run;
    run.threads = pool.threads();
    run.resolution = options.resolution;
    run.cell_m = uncut.lattice.spacing_m;
    run.tool = options.tool;
    run.smooths = options.smooths;
    const std::vector<compute::ToolSweep> sweeps = tool_sweeps(scene, options);
    if (const auto done = run_plain(scene, uncut, sweeps, options, pool, run); !done) {
        return std::unexpected(done.error());
    }
    if (options.with_undo) {
        BURIN_TRY(sculpture, start(uncut, options, pool, run));
        sculpture->keep_history(compute::History::kDefaultBudget_bytes);
        BURIN_TRY(carved, carve(*sculpture, scene, sweeps));
        run.with_undo = std::move(carved.times);
        run.strokes_kept = sculpture->history()->undoable();
    }
    if (options.with_light) {
        BURIN_TRY(sculpture, start(uncut, options, pool, run));
        const compute::Lamp lamp{picture::direction_to_light(), picture::kLightHalfAngleTangent};
        BURIN_TRY_DO(sculpture->keep_light(lamp));
        BURIN_TRY(carved, carve(*sculpture, scene, sweeps));
        run.with_light = std::move(carved.times);
        run.tiles_lit = carved.tiles_lit;
    }
    return run;
}

}  // namespace burin::bench
