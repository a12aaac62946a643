// SPDX-License-Identifier: MIT
// The solid that is carved, with its surface and, where asked for, its light and its undo history.
//
// Data flow of an update: sweeps of the tool, and their mirror images -> the engine changes rays, at once or while
// other work is done -> as its Delta is taken, the surface's cells around the changed rays are made anew, or taken over
// from the engine's device, which has made them behind the cut -> the history keeps what the rays held -> the light
// follows. A device that fails ends nothing: the processor goes on, with one notice
// (compute/vulkan/standby_engine.hpp). Which engine there is, is not known here (compute/engine/engine.hpp).
// Frame: object, metres. Thread: one; the pool's threads work only within a call.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compute/engine/engine.hpp"
#include "compute/engine/history.hpp"
#include "compute/light/surface_light.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/tools/apply.hpp"
#include "sculpt/stroke_mirror.hpp"
#include "workpiece/saved_changes.hpp"
#include "workpiece/saved_solid.hpp"

namespace burin::sculpt {

// Work done and time taken since the sculpture was made. The counts are summed over the updates.
struct SculptFigures {
    std::uint64_t updates = 0;
    std::uint64_t sweeps = 0;
    std::uint64_t rays_touched = 0;
    std::uint64_t rays_changed = 0;
    std::uint64_t tiles_remeshed = 0;
    std::uint64_t cells_remeshed = 0;
    std::uint64_t triangles_remeshed = 0;  // of whole tiles
    std::vector<double> update_ms;         // wall time of each update
    // Parts of each update's time: changing the rays, with the making of cells where a device makes them, and meshing.
    // The rest is history and light.
    std::vector<double> carve_ms, mesh_ms;
};

class Sculpture {
public:
    // Meshes the whole solid, as far as the watch wants it. The pool must outlive the object.
    Sculpture(std::unique_ptr<compute::CarvingEngine> engine, WorkerPool& pool, WorkWatch* watch = nullptr);

    // Carries out the sweeps in order and brings the surface, the history and the light's bookkeeping up to date. Fails
    // on an invalid sweep, and then changes nothing (compute/tools/apply.hpp).
    [[nodiscard]] Result<void> update(std::span<const compute::ToolSweep> sweeps);
    // The same in two: begins an update without waiting for a device, and follows those that it has done, for which it
    // is waited briefly. The end of a stroke, undo, redo and save() wait for all of them first.
    [[nodiscard]] Result<void> begin(std::span<const compute::ToolSweep> sweeps);
    [[nodiscard]] Result<void> follow_done();
    // Follows the updates, one by one, until only so many are left: as a recording says (scene::PartSeen).
    [[nodiscard]] Result<void> follow_until(std::size_t left);
    [[nodiscard]] std::size_t under_way() const { return engine_->under_way(); }
    // Has the sweeps of later updates carved on the other sides of these planes as well; they go through the middle of
    // the workpiece as it was made. An update with its images is undone as one.
    void mirror(const toolbox::Mirror& mirror) { mirror_.set(mirror); }
    // Sets `out` to the surface within a ball, ready for contact; leaves its sequence and time as they are.
    void local_surface(const Vec3& center_object, double radius_m, geometry::LocalSurface& out) const;

    // Returns what the user should know of, since the last call: of strokes that cannot be undone any more, and of a
    // device that the processor goes on for.
    [[nodiscard]] std::vector<std::string> take_notices();

    // Keeps what each stroke changes, so that it can be undone, from the next update on. Costs time and memory.
    void keep_history(std::size_t budget_bytes) { history_.emplace(budget_bytes); }
    // Goes on with that of an earlier session, whose last stroke led to this solid.
    void keep_history(compute::History earlier) { history_.emplace(std::move(earlier)); }
    // Makes one stroke of the updates since the last call.
    void end_stroke();
    // Undoes or repeats up to `strokes` strokes, the last first; returns how many there were.
    [[nodiscard]] Result<std::size_t> undo(std::size_t strokes);
    [[nodiscard]] Result<std::size_t> redo(std::size_t strokes);
    // Puts the solid into the pages: all of it, or what has changed since the last call, as they ask
    // (workpiece/saved_solid.hpp). Ends the stroke that is open, so that undo goes to what was saved.
    [[nodiscard]] Result<void> save(scene::Pages& pages);
    // Says that the solid, and its history where it has one, is as a document holds it: save() gives what changes.
    void is_saved();
    // Puts all of the solid and the newest steps of its history into the pages; what save() gives next is the same as
    // without.
    void copy(scene::Pages& pages) const;
    // Notes which rays change, for a journal, from the next update on.
    void note_changes() { noted_.emplace(engine_->solid().lattice); }
    // Puts the next change since the last call into the pages: each stroke, undo and redo is one of its own. Returns
    // whether there was any.
    [[nodiscard]] bool take_change(scene::Pages& pages);
    // Returns null without keep_history().
    [[nodiscard]] compute::History* history() { return history_ ? &*history_ : nullptr; }

    // Keeps the light on the surface up to date, for pictures, or moves the lamp of a light that is kept. Without it
    // carving does no work for the light.
    [[nodiscard]] Result<void> keep_light(const compute::Lamp& lamp_object);
    void drop_light() { light_.reset(); }
    // Returns null without keep_light().
    [[nodiscard]] const compute::SurfaceLight* light() const { return light_ ? &*light_ : nullptr; }
    // Bakes up to `most_tiles` of the tiles whose light has to be computed anew, those near `near_object` first;
    // returns how many it baked.
    std::size_t bake_light(const Vec3& near_object, std::size_t most_tiles);

    [[nodiscard]] Result<std::uint8_t> add_material(const geometry::Material& material) {
        return engine_->add_material(material);
    }
    [[nodiscard]] const compute::CarvingEngine& engine() const { return *engine_; }
    [[nodiscard]] const compute::Surface& surface() const { return surface_; }
    [[nodiscard]] const SculptFigures& figures() const { return figures_; }
    [[nodiscard]] double initial_volume_m3() const { return initial_volume_m3_; }
    [[nodiscard]] double first_mesh_ms() const { return first_mesh_ms_; }  // of the whole solid, on the host
    // Returns the tiles with a new mesh or new light since the last call, in increasing order.
    [[nodiscard]] std::vector<std::uint32_t> take_changed_tiles();
    [[nodiscard]] bool has_changed_tiles() const;  // since then

private:
    [[nodiscard]] Result<std::size_t> walk_history(std::size_t strokes, compute::HistoryStep step);
    void follow_engine();
    [[nodiscard]] Result<void> begin_all(std::span<const compute::ToolSweep> sweeps);
    [[nodiscard]] Result<bool> follow_next(compute::Wait wait);
    void settle();
    void note_step(compute::HistoryStep step);
    void note_changed_tiles();

    std::unique_ptr<compute::CarvingEngine> engine_;
    WorkerPool& pool_;
    compute::Surface surface_;
    StrokeMirror mirror_;
    std::optional<compute::History> history_;
    std::optional<compute::SurfaceLight> light_;
    std::vector<bool> tile_changed_;
    workpiece::ChangedPages unsaved_;
    std::optional<workpiece::ChangedRays> noted_;
    std::deque<scene::Pages> noted_changes_;  // that nobody has taken
    SculptFigures figures_;
    double initial_volume_m3_ = 0.0;
    double first_mesh_ms_ = 0.0;
    double begun_ms_ = 0.0;  // that it took to begin the last update, for its figures
};

}  // namespace burin::sculpt
