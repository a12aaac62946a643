// SPDX-License-Identifier: MIT
#include "app/carving.hpp"

#include "base/clock.hpp"

namespace burin {
namespace {

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
    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    const Result<CarveStats> cut = apply(*engine_, sweeps, pool_);
    if (!cut) return std::unexpected(cut.error());
    const Changes changes = engine_->take_changes();
    const RemeshStats remeshed = surface_.update(engine_->solid(), changes, pool_);
    if (history_) history_->record(changes);
    figures_.update_ms.push_back(milliseconds(start_ns, clock.now_ns()));

    for (const std::uint32_t tile : surface_.changed_tiles()) tile_changed_[tile] = true;
    ++figures_.updates;
    figures_.sweeps += sweeps.size();
    figures_.rays_touched += cut->rays_touched;
    figures_.rays_changed += cut->rays_changed;
    figures_.tiles_remeshed += remeshed.tiles;
    figures_.triangles_remeshed += remeshed.triangles;
    return {};
}

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
    for (const std::uint32_t tile : surface_.changed_tiles()) tile_changed_[tile] = true;
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
