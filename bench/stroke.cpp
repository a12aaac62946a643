// SPDX-License-Identifier: MIT
#include "bench/stroke.hpp"

#include <memory>
#include <utility>

#include "bench/timing.hpp"
#include "compute/device_surface.hpp"
#include "compute/mend_intersections.hpp"
#include "compute/surface.hpp"
#include "gpu/device.hpp"

namespace burin::bench {
namespace {

constexpr std::uint64_t kCheckedRays = 20000;  // an axis

// What does the updates: an engine with its surface.
class Carver {
public:
    explicit Carver(StrokeRun& run) : run_(run) {}
    virtual ~Carver() = default;
    [[nodiscard]] virtual Result<void> update(const BallSweep& sweep) = 0;
    // For the end: brings what these two show up to date.
    [[nodiscard]] virtual Result<void> finish() = 0;
    [[nodiscard]] virtual const Solid& solid() const = 0;
    [[nodiscard]] virtual const Surface& surface() const = 0;

protected:
    void took(double carve_ms, double mesh_ms, double publish_ms, double cpu_ms) {
        run_.carve_ms.push_back(carve_ms);
        run_.mesh_ms.push_back(mesh_ms);
        run_.publish_ms.push_back(publish_ms);
        run_.update_ms.push_back(carve_ms + mesh_ms + publish_ms);
        run_.cpu_ms.push_back(cpu_ms);
    }
    void did(const CarveStats& carved, std::uint64_t cells, std::uint64_t triangles) {
        run_.rays_touched += carved.rays_touched;
        run_.rays_changed += carved.rays_changed;
        run_.cells_remeshed += cells;
        run_.triangles_remeshed += triangles;
        run_.triangles_published += published_->triangles();
    }

    StrokeRun& run_;
    std::unique_ptr<LocalSurface> published_ = std::make_unique<LocalSurface>();
};

class HostCarver final : public Carver {
public:
    HostCarver(Solid cube, WorkerPool& pool, StrokeRun& run)
        : Carver(run), pool_(pool), surface_(cube.lattice), engine_(make_cpu_engine(std::move(cube), pool)) {
        run_.engine = engine_->name();
        run_.device = "native";
        Stopwatch watch;
        surface_.mesh_all(engine_->solid(), pool_);
        run_.first_mesh_ms = watch.lap_ms();
    }

    Result<void> update(const BallSweep& sweep) override {
        const double cpu_before_ms = process_cpu_ms();
        Stopwatch watch;
        const Result<CarveStats> carved = engine_->carve({&sweep, 1});
        if (!carved) return std::unexpected(carved.error());
        const double carve_ms = watch.lap_ms();
        const RemeshStats meshed = surface_.update(engine_->solid(), engine_->take_changes(), pool_);
        const double mesh_ms = watch.lap_ms();
        gather_local_surface(surface_, sweep.end_object_m, kPublishedRadii * sweep.radius_m, *published_);
        const double publish_ms = watch.lap_ms();
        took(carve_ms, mesh_ms, publish_ms, process_cpu_ms() - cpu_before_ms);
        did(*carved, meshed.cells, meshed.triangles);
        return {};
    }
    Result<void> finish() override { return {}; }
    const Solid& solid() const override { return engine_->solid(); }
    const Surface& surface() const override { return surface_; }

private:
    WorkerPool& pool_;
    Surface surface_;
    std::unique_ptr<CarvingEngine> engine_;
};

// Cuts, meshes and gathers on the device; the host waits for the triangles near the tool and does no more than search them.
class DeviceCarver final : public Carver {
public:
    static Result<std::unique_ptr<Carver>> create(Solid cube, WorkerPool& pool, StrokeRun& run) {
        auto device = gpu::Device::create();
        if (!device) return std::unexpected(device.error());
        auto engine = VulkanEngine::create(std::move(cube), *device);
        if (!engine) return std::unexpected(engine.error());
        Stopwatch watch;
        auto surface = DeviceSurface::create(**engine);
        if (!surface) return std::unexpected(surface.error());
        run.first_mesh_ms = watch.lap_ms();
        run.engine = (*engine)->name();
        run.device = device->info().name;
        run.software_device = device->info().is_software();
        return std::unique_ptr<Carver>(new DeviceCarver(std::move(*engine), std::move(*surface), pool, run));
    }

    Result<void> update(const BallSweep& sweep) override {
        const double cpu_before_ms = process_cpu_ms(), radius_m = kPublishedRadii * sweep.radius_m;
        const DeviceSurfaceCounts before = on_device_->counts();
        Stopwatch watch;
        auto done = on_device_->carve({&sweep, 1}, DeviceSurface::Ball{sweep.end_object_m, radius_m});
        double carve_ms = watch.lap_ms();
        if (done) done = on_device_->finish();
        double mesh_ms = watch.lap_ms();
        if (done) done = on_device_->local_surface(sweep.end_object_m, radius_m, *published_);
        if (!done) return done;
        double publish_ms = watch.lap_ms();
        if (const auto& times = on_device_->times()) {  // all that is neither cut nor mesh counts as publishing
            const double all_ms = carve_ms + mesh_ms + publish_ms;
            carve_ms = 1e3 * times->cut_s;
            mesh_ms = 1e3 * times->mesh_s;
            publish_ms = all_ms - carve_ms - mesh_ms;
        }
        took(carve_ms, mesh_ms, publish_ms, process_cpu_ms() - cpu_before_ms);
        const DeviceSurfaceCounts& now = on_device_->counts();
        did(on_device_->carved(), now.cells - before.cells, now.triangles - before.triangles);
        return {};
    }
    // The device's surface is the host's, triangle by triangle (tests/compute/device_surface_gpu.cpp), but without the names
    // of the vertices that welding needs.
    Result<void> finish() override {
        if (const auto read = engine_->read_back(); !read) return read;
        surface_.mesh_all(engine_->solid(), pool_);
        return {};
    }
    const Solid& solid() const override { return engine_->solid(); }
    const Surface& surface() const override { return surface_; }

private:
    DeviceCarver(std::unique_ptr<VulkanEngine> engine, std::unique_ptr<DeviceSurface> surface, WorkerPool& pool,
                 StrokeRun& run)
        : Carver(run),
          pool_(pool),
          engine_(std::move(engine)),
          on_device_(std::move(surface)),
          surface_(engine_->solid().lattice) {}

    WorkerPool& pool_;
    std::unique_ptr<VulkanEngine> engine_;
    std::unique_ptr<DeviceSurface> on_device_;
    Surface surface_;  // of the end
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
    std::unique_ptr<Carver> carver;
    if (options.on_vulkan) {
        auto made = DeviceCarver::create(std::move(*cube), pool, run);
        if (!made) return std::unexpected(made.error());
        carver = std::move(*made);
    } else {
        carver = std::make_unique<HostCarver>(std::move(*cube), pool, run);
    }
    for (const BallSweep& sweep : scene.sweeps) {
        if (const Result<void> updated = carver->update(sweep); !updated) return std::unexpected(updated.error());
    }
    if (const auto finished = carver->finish(); !finished) return std::unexpected(finished.error());
    const Solid& solid = carver->solid();
    run.rays_held = solid.rays_held();
    run.bytes = solid.bytes();
    run.disagreeing_edges = carver->surface().disagreeing_edges();
    run.intervals = check_intervals(solid, scene, kCheckedRays);
    // As it would be exported.
    run.mesh = carver->surface().welded();
    const MendingReport mending = mend_intersections(run.mesh, carver->surface(), solid, pool);
    run.self_intersections_mended = mending.found - mending.left;
    return run;
}

}  // namespace burin::bench
