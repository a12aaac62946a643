// SPDX-License-Identifier: MIT
#include "sculpt/sculpture.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/clock.hpp"
#include "base/try.hpp"

namespace burin::sculpt {
namespace {

Vec3 middle_of(const compute::Lattice& lattice) {
    const Vec3 cells(lattice.cells[0], lattice.cells[1], lattice.cells[2]);
    return lattice.origin_object + 0.5 * lattice.spacing_m * cells;
}

// A copy is a journal's beginning, which is written each time that a session begins.
constexpr std::size_t kMostCopiedSteps_bytes = std::size_t{64} << 20;

double milliseconds(Nanoseconds from_ns, Nanoseconds to_ns) { return static_cast<double>(to_ns - from_ns) * 1e-6; }

}  // namespace

Sculpture::Sculpture(std::unique_ptr<compute::CarvingEngine> engine, WorkerPool& pool, WorkWatch* watch)
    : engine_(std::move(engine)),
      pool_(pool),
      surface_(engine_->solid().lattice),
      mirror_(middle_of(engine_->solid().lattice)),
      tile_changed_(surface_.tile_count(), true),
      unsaved_(engine_->solid().lattice) {
    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    engine_->make_cells();
    surface_.mesh_all(engine_->solid(), pool_, watch);
    first_mesh_ms_ = milliseconds(start_ns, clock.now_ns());
    initial_volume_m3_ = surface_.volume_m3();
}

Result<void> Sculpture::update(std::span<const compute::ToolSweep> sweeps) {
    BURIN_TRY_DO(begin(sweeps));
    return follow_until(0);
}

Result<void> Sculpture::begin(std::span<const compute::ToolSweep> sweeps) {
    if (!mirror_.mirror().any()) return begin_all(sweeps);
    const auto all = mirror_.with_images(sweeps);
    return all ? begin_all(*all) : std::unexpected(all.error());
}

// Begins an update with sweeps whose images are among them.
Result<void> Sculpture::begin_all(std::span<const compute::ToolSweep> sweeps) {
    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    BURIN_TRY_DO(engine_->begin(sweeps));
    begun_ms_ = milliseconds(start_ns, clock.now_ns());
    ++figures_.updates;
    figures_.sweeps += sweeps.size();
    return {};
}

Result<void> Sculpture::follow_done() {
    BURIN_TRY(first, follow_next(compute::Wait::briefly));
    for (bool followed = first; followed;) {
        BURIN_TRY(next, follow_next(compute::Wait::no));
        followed = next;
    }
    return {};
}

Result<void> Sculpture::follow_until(std::size_t left) {
    while (engine_->under_way() > left) {
        BURIN_TRY_DO(follow_next(compute::Wait::yes));
    }
    return {};
}

// Takes an update from the engine, if one is done, and brings everything up to date with it.
Result<bool> Sculpture::follow_next(compute::Wait wait) {
    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    BURIN_TRY(delta, engine_->take(wait));
    if (!delta) return false;
    const Nanoseconds cut_ns = clock.now_ns();
    const compute::RemeshStats remeshed =
        surface_.update(engine_->solid(), delta->changes, pool_, delta->made ? &*delta->made : nullptr);
    const Nanoseconds meshed_ns = clock.now_ns();
    if (history_) history_->record(delta->changes);
    unsaved_.note(delta->changes);
    if (noted_) noted_->note(delta->changes);
    note_changed_tiles();
    figures_.rays_touched += delta->stats.rays_touched;
    figures_.rays_changed += delta->stats.rays_changed;
    figures_.tiles_remeshed += remeshed.tiles;
    figures_.cells_remeshed += remeshed.cells;
    figures_.triangles_remeshed += remeshed.triangles;
    const double begun_ms = std::exchange(begun_ms_, 0.0);
    figures_.carve_ms.push_back(begun_ms + milliseconds(start_ns, cut_ns));
    figures_.mesh_ms.push_back(milliseconds(cut_ns, meshed_ns));
    figures_.update_ms.push_back(begun_ms + milliseconds(start_ns, clock.now_ns()));
    return true;
}

// Has all updates done, before something else reads or changes the solid. An engine without a device cannot fail, and
// one with a device goes on with the processor, so that there is nothing to hand on.
void Sculpture::settle() { static_cast<void>(follow_until(0)); }

void Sculpture::local_surface(const Vec3& center_object, double radius_m, geometry::LocalSurface& out) const {
    compute::gather_local_surface(surface_, center_object, radius_m, out);
}

std::vector<std::string> Sculpture::take_notices() {
    std::vector<std::string> notices = engine_->take_notices();
    if (history_) std::ranges::move(history_->take_notices(), std::back_inserter(notices));
    return notices;
}

// ---- Undo

void Sculpture::end_stroke() {
    settle();
    if (history_) history_->end_stroke();
    if (noted_ && noted_->is_open()) note_step(compute::HistoryStep::stroke);
}

// A step is noted at once, because the next one may change the same rays.
void Sculpture::note_step(compute::HistoryStep step) {
    if (noted_) noted_->take(engine_->solid(), step, noted_changes_.emplace_back(scene::Pages{.whole = false}));
}

Result<std::size_t> Sculpture::undo(std::size_t strokes) { return walk_history(strokes, compute::HistoryStep::undo); }

Result<std::size_t> Sculpture::redo(std::size_t strokes) { return walk_history(strokes, compute::HistoryStep::redo); }

Result<std::size_t> Sculpture::walk_history(std::size_t strokes, compute::HistoryStep step) {
    end_stroke();
    std::size_t walked = 0;
    while (history_ && walked < strokes) {
        BURIN_TRY(stepped, step == compute::HistoryStep::undo ? history_->undo(*engine_) : history_->redo(*engine_));
        if (!stepped) break;
        follow_engine();
        note_step(step);
        ++walked;
    }
    return walked;
}

void Sculpture::follow_engine() {
    const compute::Changes changes = engine_->take_changes();
    surface_.update(engine_->solid(), changes, pool_);
    unsaved_.note(changes);
    if (noted_) noted_->note(changes);
    note_changed_tiles();
}

void Sculpture::copy(scene::Pages& pages) const {
    workpiece::save_solid(engine_->solid(), workpiece::ChangedPages(engine_->solid().lattice), pages);
    if (history_) workpiece::copy_steps(*history_, kMostCopiedSteps_bytes, pages);
}

bool Sculpture::take_change(scene::Pages& pages) {
    if (noted_ && noted_changes_.empty() && !noted_->empty()) note_step(compute::HistoryStep::goes_on);
    if (noted_changes_.empty()) return false;
    pages = std::move(noted_changes_.front());
    noted_changes_.pop_front();
    return true;
}

void Sculpture::is_saved() {
    unsaved_.clear();
    if (history_) static_cast<void>(history_->take_unsaved());
}

Result<void> Sculpture::save(scene::Pages& pages) {
    end_stroke();
    if (pages.whole) unsaved_.note_all();
    workpiece::save_solid(engine_->solid(), unsaved_, pages);
    if (history_) workpiece::save_steps(*history_, pages);
    unsaved_.clear();
    return {};
}

// ---- Light and changed tiles

Result<void> Sculpture::keep_light(const compute::Lamp& lamp_object) {
    if (light_) return light_->set_lamp(lamp_object);
    compute::SurfaceLight light(surface_.lattice(), compute::Lamp{});
    BURIN_TRY_DO(light.set_lamp(lamp_object));
    light_.emplace(std::move(light));
    light_->follow(engine_->solid(), surface_, pool_);
    return {};
}

std::size_t Sculpture::bake_light(const Vec3& near_object, std::size_t most_tiles) {
    if (!light_) return 0;
    const std::size_t baked = light_->step(near_object, most_tiles, pool_);
    for (const std::uint32_t tile : light_->take_baked()) tile_changed_[tile] = true;
    return baked;
}

void Sculpture::note_changed_tiles() {
    for (const std::uint32_t tile : surface_.changed_tiles()) tile_changed_[tile] = true;
    if (light_) light_->follow(engine_->solid(), surface_, pool_);
}

std::vector<std::uint32_t> Sculpture::take_changed_tiles() {
    std::vector<std::uint32_t> changed;
    for (std::uint32_t tile = 0; tile < tile_changed_.size(); ++tile) {
        if (tile_changed_[tile]) changed.push_back(tile);
    }
    tile_changed_.assign(tile_changed_.size(), false);
    return changed;
}

bool Sculpture::has_changed_tiles() const { return std::ranges::find(tile_changed_, true) != tile_changed_.end(); }

}  // namespace burin::sculpt
