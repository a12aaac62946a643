// SPDX-License-Identifier: MIT
#include "app/carving.hpp"

#include "base/clock.hpp"
#include "compute/tool_spans.hpp"
#include "compute/vulkan_engine.hpp"

namespace burin {
namespace {

// The sweeps as a device carves them; nothing when there are others among them than a ball's.
std::optional<std::vector<BallSweep>> balls_of(std::span<const ToolSweep> sweeps) {
    std::vector<BallSweep> balls;
    for (const ToolSweep& sweep : sweeps) {
        const auto* ball = std::get_if<BallTool>(&sweep.shape);
        if (ball == nullptr || sweep.operation == Operation::smooth) return std::nullopt;
        balls.push_back(
            {sweep.start.position_m, sweep.end.position_m, ball->radius_m, sweep.material, sweep.operation});
    }
    return balls;
}

double milliseconds(Nanoseconds from_ns, Nanoseconds to_ns) { return static_cast<double>(to_ns - from_ns) * 1e-6; }

}  // namespace

Carving::Carving(std::unique_ptr<CarvingEngine> engine, WorkerPool& pool)
    : engine_(std::move(engine)),
      pool_(pool),
      surface_(engine_->solid().lattice),
      tile_changed_(surface_.tile_count(), true) {
    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    surface_.mesh_all(engine_->solid(), pool_);
    first_mesh_ms_ = milliseconds(start_ns, clock.now_ns());
    initial_volume_m3_ = surface_.volume_m3();
}

Result<void> Carving::update(std::span<const ToolSweep> sweeps) {
    const auto balls = on_device_ ? balls_of(sweeps) : std::nullopt;
    if (on_device_ && !balls) {
        if (const auto home = bring_home(); !home) return home;
        on_device_.reset();
    }
    if (balls) {
        for (const ToolSweep& sweep : sweeps) {
            if (const auto good = check_sweep(engine_->solid(), sweep); !good) return good;
        }
    }
    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    const auto updated = balls ? update_on_device(*balls) : update_on_host(sweeps);
    if (!updated) return updated;
    figures_.update_ms.push_back(milliseconds(start_ns, clock.now_ns()));
    ++figures_.updates;
    figures_.sweeps += sweeps.size();
    return {};
}

Result<void> Carving::update_on_host(std::span<const ToolSweep> sweeps) {
    const Result<CarveStats> cut = apply(*engine_, sweeps, pool_);
    if (!cut) return std::unexpected(cut.error());
    const Changes changes = engine_->take_changes();
    const RemeshStats remeshed = surface_.update(engine_->solid(), changes, pool_);
    if (history_) history_->record(changes);
    note_changed_tiles();
    figures_.rays_touched += cut->rays_touched;
    figures_.rays_changed += cut->rays_changed;
    figures_.tiles_remeshed += remeshed.tiles;
    figures_.triangles_remeshed += remeshed.triangles;
    return {};
}

// ---- On the device

Result<void> Carving::mesh_on_device() {
    auto* vulkan = dynamic_cast<VulkanEngine*>(engine_.get());
    // Where the device cannot mesh it still carves, and the host meshes.
    if (vulkan == nullptr || history_ || !vulkan->device().capabilities().scalar_block_layout) return {};
    auto made = DeviceSurface::create(*vulkan);
    if (!made) return std::unexpected(made.error());
    on_device_ = std::move(*made);
    return {};
}

// The triangles near the tool are gathered with the cut, for who will ask for them as they did before.
Result<void> Carving::update_on_device(std::span<const BallSweep> sweeps) {
    if (const auto done = finish_on_device(); !done) return done;
    std::optional<DeviceSurface::Ball> touched;
    if (asked_radius_m_ > 0.0 && !sweeps.empty()) touched = {sweeps.back().end_object_m, asked_radius_m_};
    counted_ = on_device_->counts();
    under_way_ = true;
    return on_device_->carve(sweeps, touched);
}

Result<void> Carving::finish_on_device() {
    if (const auto done = on_device_->finish(); !done) return done;
    if (!under_way_) return {};
    under_way_ = false;
    figures_.rays_touched += on_device_->carved().rays_touched;
    figures_.rays_changed += on_device_->carved().rays_changed;
    figures_.tiles_remeshed += on_device_->counts().tiles - counted_.tiles;
    figures_.triangles_remeshed += on_device_->counts().triangles - counted_.triangles;
    return {};
}

Result<void> Carving::bring_home() {
    if (!on_device_) return {};
    if (const auto done = finish_on_device(); !done) return done;
    if (const auto read = static_cast<VulkanEngine&>(*engine_).read_back(); !read) return read;
    follow_engine();
    return {};
}

Result<void> Carving::local_surface(const Vec3& center_object, double radius_m, LocalSurface& out) {
    if (!on_device_) {
        gather_local_surface(surface_, center_object, radius_m, out);
        return {};
    }
    asked_radius_m_ = radius_m;
    return on_device_->local_surface(center_object, radius_m, out);
}

// ---- Undo

Result<std::size_t> Carving::undo(std::size_t strokes) { return walk_history(strokes, &History::undo); }

Result<std::size_t> Carving::redo(std::size_t strokes) { return walk_history(strokes, &History::redo); }

Result<std::size_t> Carving::walk_history(std::size_t strokes, HistoryStep step) {
    std::size_t walked = 0;
    while (history_ && walked < strokes) {
        const Result<bool> stepped = (*history_.*step)(*engine_);
        if (!stepped) return std::unexpected(stepped.error());
        if (!*stepped) break;
        follow_engine();
        ++walked;
    }
    return walked;
}

void Carving::follow_engine() {
    surface_.update(engine_->solid(), engine_->take_changes(), pool_);
    note_changed_tiles();
}

// ---- For pictures

Result<void> Carving::keep_light(const Lamp& lamp_object) {
    if (light_) return light_->set_lamp(lamp_object);
    SurfaceLight light(surface_.lattice(), Lamp{});
    if (const auto set = light.set_lamp(lamp_object); !set) return set;
    light_.emplace(std::move(light));
    light_->follow(engine_->solid(), surface_, pool_);
    return {};
}

std::size_t Carving::bake_light(const Vec3& near_object, std::size_t most_tiles) {
    if (!light_) return 0;
    const std::size_t baked = light_->step(near_object, most_tiles, pool_);
    for (const std::uint32_t tile : light_->take_baked()) tile_changed_[tile] = true;
    return baked;
}

void Carving::note_changed_tiles() {
    for (const std::uint32_t tile : surface_.changed_tiles()) tile_changed_[tile] = true;
    if (light_) light_->follow(engine_->solid(), surface_, pool_);
}

std::vector<std::uint32_t> Carving::take_changed_tiles() {
    std::vector<std::uint32_t> changed;
    for (std::uint32_t tile = 0; tile < tile_changed_.size(); ++tile) {
        if (tile_changed_[tile]) changed.push_back(tile);
    }
    tile_changed_.assign(tile_changed_.size(), false);
    return changed;
}

}  // namespace burin
