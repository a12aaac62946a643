// SPDX-License-Identifier: MIT
#include "bench/stroke.hpp"

#include <memory>

#include "bench/timing.hpp"
#include "compute/mend_intersections.hpp"
#include "compute/surface.hpp"
#include "geometry/local_surface_search.hpp"
#include "gpu/device.hpp"

namespace burin::bench {
namespace {

constexpr std::uint64_t kCheckedRays = 20000;  // an axis

Result<std::unique_ptr<CarvingEngine>> make_engine(Solid solid, const StrokeOptions& options, WorkerPool& pool,
                                                   StrokeRun& run) {
    run.device = "native";
    if (!options.on_vulkan) return make_cpu_engine(std::move(solid), pool);
    Result<gpu::Device> device = gpu::Device::create();
    if (!device) return std::unexpected(device.error());
    run.device = device->info().name;
    run.software_device = device->info().is_software();
    return make_vulkan_engine(std::move(solid), *device);
}

class Carver {
public:
    Carver(CarvingEngine& engine, WorkerPool& pool, StrokeRun& run)
        : engine_(engine), pool_(pool), run_(run), surface_(engine.solid().lattice) {
        Stopwatch watch;
        surface_.mesh_all(engine.solid(), pool);
        run.first_mesh_ms = watch.lap_ms();
    }

    Result<void> update(const BallSweep& sweep) {
        const double cpu_before_ms = process_cpu_ms();
        Stopwatch watch;
        const Result<CarveStats> carved = engine_.carve({&sweep, 1});
        if (!carved) return std::unexpected(carved.error());
        run_.carve_ms.push_back(watch.lap_ms());
        const RemeshStats meshed = surface_.update(engine_.solid(), engine_.take_changes(), pool_);
        run_.mesh_ms.push_back(watch.lap_ms());
        gather_local_surface(surface_, sweep.end_object_m, kPublishedRadii * sweep.radius_m, *published_);
        build_search(*published_);
        run_.publish_ms.push_back(watch.lap_ms());
        run_.update_ms.push_back(run_.carve_ms.back() + run_.mesh_ms.back() + run_.publish_ms.back());
        run_.cpu_ms.push_back(process_cpu_ms() - cpu_before_ms);
        run_.rays_touched += carved->rays_touched;
        run_.rays_changed += carved->rays_changed;
        run_.cells_remeshed += meshed.cells;
        run_.triangles_remeshed += meshed.triangles;
        run_.triangles_published += published_->triangle_count;
        return {};
    }

    [[nodiscard]] const Surface& surface() const { return surface_; }

private:
    CarvingEngine& engine_;
    WorkerPool& pool_;
    StrokeRun& run_;
    Surface surface_;
    std::unique_ptr<LocalSurface> published_ = std::make_unique<LocalSurface>();
};

}  // namespace

Result<StrokeRun> run_stroke(const CarveScene& scene, const StrokeOptions& options) {
    Result<Solid> cube = make_block(Vec3(1.0), options.resolution, {"cube", {200, 200, 200}});
    if (!cube) return std::unexpected(cube.error());
    WorkerPool pool(options.threads);
    StrokeRun run;
    run.threads = pool.threads();
    run.resolution = options.resolution;
    run.cell_m = cube->lattice.spacing_m;
    const auto engine = make_engine(std::move(*cube), options, pool, run);
    if (!engine) return std::unexpected(engine.error());
    run.engine = (*engine)->name();
    Carver carver(**engine, pool, run);
    for (const BallSweep& sweep : scene.sweeps) {
        if (const Result<void> updated = carver.update(sweep); !updated) return std::unexpected(updated.error());
    }
    const Solid& solid = (*engine)->solid();
    run.rays_held = solid.rays_held();
    run.bytes = solid.bytes();
    run.disagreeing_edges = carver.surface().disagreeing_edges();
    run.intervals = check_intervals(solid, scene, kCheckedRays);
    // As it would be exported.
    run.mesh = carver.surface().welded();
    const MendingReport mending = mend_intersections(run.mesh, carver.surface(), solid, pool);
    run.self_intersections_mended = mending.found - mending.left;
    return run;
}

}  // namespace burin::bench
