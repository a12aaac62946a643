// SPDX-License-Identifier: MIT
#include "sculpt/sculpture.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/clock.hpp"
#include "base/try.hpp"
#include "compute/tools/tool_spans.hpp"

namespace burin::sculpt {
namespace {

bool is_for_device(const compute::ToolSweep& sweep) {
    return std::holds_alternative<compute::BallTool>(sweep.shape) && sweep.operation != compute::Operation::smooth;
}

Vec3 middle_of(const compute::Lattice& lattice) {
    const Vec3 cells(lattice.cells[0], lattice.cells[1], lattice.cells[2]);
    return lattice.origin_object + 0.5 * lattice.spacing_m * cells;
}

// A copy is a journal's beginning, which is written each time that a session begins.
constexpr std::size_t kMostCopiedSteps_bytes = std::size_t{64} << 20;

// Updates that the device alone knows of: they bound what has to be done again where it is lost.
constexpr std::size_t kMostOnDevice = 1024;

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
    if (on_device_ && std::ranges::all_of(sweeps, is_for_device)) return update_on_device(sweeps);
    if (on_device_) {
        read_back();
        on_device_.reset();
    }
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
    const compute::RemeshStats remeshed = surface_.update(engine_->solid(), delta->changes, pool_);
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

// ---- On the device

void Sculpture::mesh_on_device() {
    settle();
    if (!history_ && !noted_) on_device_ = engine_->mesh_on_device();
}

Result<void> Sculpture::update_on_device(std::span<const compute::ToolSweep> sweeps) {
    for (const compute::ToolSweep& sweep : sweeps) {
        BURIN_TRY_DO(compute::check_sweep(engine_->solid(), sweep));
    }
    if (only_on_device_.size() == kMostOnDevice) read_back();
    if (!on_device_) return begin_all(sweeps);  // it was lost just now
    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    only_on_device_.emplace_back(sweeps.begin(), sweeps.end());
    if (const auto begun = begin_on_device(sweeps); !begun) go_on_without_the_device(begun.error());
    ++figures_.updates;
    figures_.sweeps += sweeps.size();
    figures_.update_ms.push_back(milliseconds(start_ns, clock.now_ns()));
    return {};
}

// Submits the cut together with the triangles near the tool: local_surface() will be asked for them with the radius of
// the last time.
Result<void> Sculpture::begin_on_device(std::span<const compute::ToolSweep> sweeps) {
    std::vector<compute::BallSweep> balls;
    for (const compute::ToolSweep& sweep : sweeps) {
        balls.push_back({sweep.start.position_m, sweep.end.position_m,
                         std::get<compute::BallTool>(sweep.shape).radius_m, sweep.material, sweep.operation});
    }
    BURIN_TRY_DO(finish_on_device());
    std::optional<compute::MeshingDevice::Ball> touched;
    if (asked_radius_m_ > 0.0 && !balls.empty()) touched = {balls.back().end_object_m, asked_radius_m_};
    counts_before_ = on_device_->counts();
    under_way_ = true;
    return on_device_->carve(balls, touched);
}

Result<void> Sculpture::finish_on_device() {
    BURIN_TRY_DO(on_device_->finish());
    if (!under_way_) return {};
    under_way_ = false;
    figures_.rays_touched += on_device_->carved().rays_touched;
    figures_.rays_changed += on_device_->carved().rays_changed;
    figures_.tiles_remeshed += on_device_->counts().tiles - counts_before_.tiles;
    figures_.cells_remeshed += on_device_->counts().cells - counts_before_.cells;
    figures_.triangles_remeshed += on_device_->counts().triangles - counts_before_.triangles;
    if (const auto& times = on_device_->times()) {
        figures_.carve_ms.push_back(1e3 * times->cut_s);
        figures_.mesh_ms.push_back(1e3 * times->mesh_s);
    }
    return {};
}

void Sculpture::read_back() {
    settle();
    if (!on_device_) return;
    if (const auto fetched = fetch_from_device(); !fetched) return go_on_without_the_device(fetched.error());
    only_on_device_.clear();
    read_back_ = {figures_.rays_touched, figures_.rays_changed};
}

Result<void> Sculpture::fetch_from_device() {
    BURIN_TRY_DO(finish_on_device());
    BURIN_TRY_DO(on_device_->read_back());
    follow_engine();
    return {};
}

// The host's solid is that of the last read_back(): the processor carves anew what the device has carved since.
void Sculpture::go_on_without_the_device(const Error& why) {
    on_device_.reset();
    under_way_ = false;
    engine_->give_up_device(why);
    figures_.rays_touched = read_back_.rays_touched;
    figures_.rays_changed = read_back_.rays_changed;
    for (const std::vector<compute::ToolSweep>& sweeps : std::exchange(only_on_device_, {})) {
        // Cannot fail: the sweeps were checked when they came, and the processor's engine needs no device.
        if (const auto cut = engine_->carve(sweeps)) {
            figures_.rays_touched += cut->rays_touched;
            figures_.rays_changed += cut->rays_changed;
        }
    }
    follow_engine();
}

void Sculpture::local_surface(const Vec3& center_object, double radius_m, geometry::LocalSurface& out) {
    if (on_device_) {
        asked_radius_m_ = radius_m;
        auto gathered = finish_on_device();
        if (gathered) gathered = on_device_->local_surface(center_object, radius_m, out);
        if (gathered) return;
        go_on_without_the_device(gathered.error());
    }
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
    save_solid(engine_->solid(), ChangedPages(engine_->solid().lattice), pages);
    if (history_) copy_steps(*history_, kMostCopiedSteps_bytes, pages);
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
    if (on_device_) unsaved_.note_all();  // the device tells of no single rays
    read_back();
    if (pages.whole) unsaved_.note_all();
    save_solid(engine_->solid(), unsaved_, pages);
    if (history_) save_steps(*history_, pages);
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
