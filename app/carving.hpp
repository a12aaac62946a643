// SPDX-License-Identifier: MIT
// The carving side of a session: one stroke is one update, and one update is a straight path: apply the tool to the
// rays, mesh the cells anew that changed, count what was done. Or all of it happens on a Vulkan device, one submission an update
// that nobody waits for before the next (mesh_on_device).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/apply.hpp"
#include "compute/device_surface.hpp"
#include "compute/history.hpp"
#include "compute/surface.hpp"
#include "compute/surface_light.hpp"

namespace burin {

struct CarvingFigures {
    std::uint64_t updates = 0;
    std::uint64_t sweeps = 0;
    std::uint64_t rays_touched = 0;  // summed over the updates
    std::uint64_t rays_changed = 0;
    std::uint64_t tiles_remeshed = 0;
    std::uint64_t triangles_remeshed = 0;
    std::vector<double> update_ms;  // wall time of each; on a device it waits for the one before, and not for its own
};

class Carving {
public:
    // Meshes the whole solid. The pool must outlive the object.
    Carving(std::unique_ptr<CarvingEngine> engine, WorkerPool& pool);

    [[nodiscard]] Result<void> update(std::span<const ToolSweep> sweeps);

    // From now on the device of a Vulkan engine meshes as well, and hands back only what local_surface asks for; surface() and
    // engine().solid() are as the last bring_home() left them. Does nothing with another engine, or with a history, which has
    // to see the rays of each update at once. Ends, with a bring_home(), at a sweep that is not a ball's.
    [[nodiscard]] Result<void> mesh_on_device();
    [[nodiscard]] Result<void> bring_home();
    // As gather_local_surface.
    [[nodiscard]] Result<void> local_surface(const Vec3& center_object, double radius_m, LocalSurface& out);

    // From now on strokes can be taken back. Costs time and memory, so whoever never undoes does without.
    void keep_history(std::size_t budget_bytes) { history_.emplace(budget_bytes); }
    // What was updated since the last call is one stroke.
    void end_stroke() {
        if (history_) history_->end_stroke();
    }
    [[nodiscard]] Result<std::uint8_t> add_material(const Material& material) { return engine_->add_material(material); }
    // Takes back up to so many strokes, the last first; says how many there were. Redo likewise.
    [[nodiscard]] Result<std::size_t> undo(std::size_t strokes);
    [[nodiscard]] Result<std::size_t> redo(std::size_t strokes);
    [[nodiscard]] History* history() { return history_ ? &*history_ : nullptr; }

    // From now on the light on the surface is kept up to date, for pictures; without it carving pays nothing for it.
    [[nodiscard]] Result<void> keep_light(const Lamp& lamp_object);
    void drop_light() { light_.reset(); }
    // Null without keep_light(). Not while the device meshes (bring_home).
    [[nodiscard]] const SurfaceLight* light() const { return light_ ? &*light_ : nullptr; }
    // Bakes up to so many of the tiles that wait for it, the nearest to a place first; how many it did.
    std::size_t bake_light(const Vec3& near_object, std::size_t most_tiles);

    [[nodiscard]] const CarvingEngine& engine() const { return *engine_; }
    [[nodiscard]] const Surface& surface() const { return surface_; }
    [[nodiscard]] const CarvingFigures& figures() const { return figures_; }
    [[nodiscard]] double initial_volume_m3() const { return initial_volume_m3_; }
    [[nodiscard]] double first_mesh_ms() const { return first_mesh_ms_; }
    // Tiles meshed or lit anew since the last call, for whoever draws them.
    [[nodiscard]] std::vector<std::uint32_t> take_changed_tiles();

private:
    using HistoryStep = Result<bool> (History::*)(CarvingEngine&);
    [[nodiscard]] Result<std::size_t> walk_history(std::size_t strokes, HistoryStep step);
    void follow_engine();
    void note_changed_tiles();
    [[nodiscard]] Result<void> update_on_host(std::span<const ToolSweep> sweeps);
    [[nodiscard]] Result<void> update_on_device(std::span<const BallSweep> sweeps);
    [[nodiscard]] Result<void> finish_on_device();

    std::unique_ptr<CarvingEngine> engine_;
    WorkerPool& pool_;
    Surface surface_;
    std::unique_ptr<DeviceSurface> on_device_;
    bool under_way_ = false;       // an update on the device, not counted yet
    DeviceSurfaceCounts counted_;  // before it
    double asked_radius_m_ = 0.0;  // of the last local surface; 0: none yet
    std::optional<History> history_;
    std::optional<SurfaceLight> light_;
    CarvingFigures figures_;
    std::vector<bool> tile_changed_;
    double initial_volume_m3_ = 0.0;
    double first_mesh_ms_ = 0.0;
};

}  // namespace burin
