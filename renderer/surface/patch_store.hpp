// SPDX-License-Identifier: MIT
// The workpiece's surface on the GPU: thousands of patches in one vertex, one light and one index buffer.
//
// Data flow: set() keeps a reference to an immutable patch (geometry/contact/surface_tile.hpp), set_light() the light
// on its vertices; flush() records the upload of all that changed since the last frame into the frame's commands, and
// doubles the buffers where needed. How each screen draws the patches is in its DrawnPatches (drawn_patches.hpp), to
// which flush() reports what has changed. next_detail() returns jobs for patches that any screen draws and that have no
// coarser levels; take() accepts the computed levels (detail_worker.hpp), which are uploaded by the next flush. Indices
// are stored absolute, so that patches that are neighbours in the buffer merge into one draw call.
// Limits: 128 MiB a buffer on the software driver, which is 6.7
// million vertices and 11 million triangles; beyond: Error.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/contact/surface_tile.hpp"
#include "gpu/commands.hpp"
#include "renderer/surface/detail_worker.hpp"
#include "renderer/surface/range_allocator.hpp"
#include "renderer/surface/visibility.hpp"

namespace burin::renderer {

class DrawnPatches;

class PatchStore {
public:
    struct Level {
        std::uint32_t first_index = 0, index_count = 0;  // the finest level is padded with triangles without area
        // Number of leading indices that belong to smooth triangles (smooth_first).
        std::uint32_t smooth_count = 0;
        double error_m = 0.0;  // 0: the finest level
    };
    struct Patch {
        std::shared_ptr<const geometry::SurfaceTile> surface;
        std::vector<geometry::VertexLight> light;  // empty: full light
        PatchShape shape;
        std::uint32_t slot = 0;  // small number of its own, for what each screen notes of it (DrawnPatches)
        std::uint32_t first_vertex = 0, vertex_count = 0;
        std::vector<Level> levels;      // from fine to coarse; the first always exists
        std::vector<PatchLevel> ready;  // computed, not uploaded yet
        bool refined = false;           // nothing more is to be computed, or a job is under way
        PatchGroup* group = nullptr;    // to which it belongs
        std::uint64_t changed_at = 0;   // number of the last flush that replaced its surface or light; 0: none
    };

    void set(std::uint32_t id, std::shared_ptr<const geometry::SurfaceTile> surface);  // null or empty: remove
    // One light value for each vertex; an unknown id is ignored.
    void set_light(std::uint32_t id, std::span<const geometry::VertexLight> light);
    void remove(std::uint32_t id) { set(id, nullptr); }
    void clear();

    // Records the uploads and returns their bytes. The GPU must not be drawing from the buffers in another submission.
    [[nodiscard]] Result<std::uint64_t> flush(gpu::Device& device, gpu::Commands& commands);

    // Returns a job for the next patch that any screen wants and that has no levels yet, round robin. resting: also
    // patches that changed a moment ago and may soon change again.
    [[nodiscard]] std::optional<DetailJob> next_detail(bool resting);
    // Returns one for the next group whose levels are not known, likewise.
    [[nodiscard]] std::optional<DetailJob> next_group(bool resting);
    // Accepts a patch's levels if the patch has not changed since; they are uploaded by the next flush. Returns the
    // patch, or null where none were accepted, and of a group.
    const Patch* take(DetailDone done);

    // Returns the patches in the order of the index buffer, as of the last flush.
    [[nodiscard]] std::span<Patch* const> in_order() const { return in_order_; }
    [[nodiscard]] const std::map<GroupPlace, PatchGroup>& groups() const { return groups_.all(); }
    [[nodiscard]] const gpu::Buffer& vertex_buffer() const { return vertices_; }
    [[nodiscard]] const gpu::Buffer& light_buffer() const { return lights_; }
    [[nodiscard]] const gpu::Buffer& index_buffer() const { return indices_; }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::uint32_t patches() const { return static_cast<std::uint32_t>(placed_.size()); }
    [[nodiscard]] const Box& bounds() const { return bounds_; }  // in the patches' frame; empty when there is none
    // Returns the distance from the bounds' centre to the farthest corner of any patch: the radius of a ball around the
    // surface, which is tighter than the bounds' own diagonal when there are many patches.
    [[nodiscard]] double reach_m() const { return reach_m_; }
    [[nodiscard]] std::uint64_t device_bytes() const {
        return vertices_.size_bytes() + lights_.size_bytes() + indices_.size_bytes();
    }

    // ---- The screens' pictures of it.
    void enrol(DrawnPatches& drawn) { pictures_.push_back(&drawn); }
    void leave(DrawnPatches& drawn) { std::erase(pictures_, &drawn); }
    void for_each_picture(const std::function<void(DrawnPatches&)>& report) const;
    [[nodiscard]] std::uint32_t slots() const { return slots_; }

private:
    struct Pending {
        std::shared_ptr<const geometry::SurfaceTile> surface;  // null: remove
        std::vector<geometry::VertexLight> light;
    };
    void release(std::uint32_t id);
    void release_levels(Patch& patch, std::size_t keep);
    [[nodiscard]] Result<void> make_room(gpu::Device& device, gpu::Commands& commands);
    [[nodiscard]] Result<void> place(gpu::Device& device, gpu::Commands& commands, std::uint32_t id, Pending& pending,
                                     std::optional<std::uint32_t> slot);
    [[nodiscard]] std::uint32_t take_slot();
    void remove_all();
    [[nodiscard]] Result<void> place_pending(gpu::Device& device, gpu::Commands& commands);
    void relight_pending(gpu::Commands& commands);
    [[nodiscard]] bool wanted(const Patch& patch) const;
    [[nodiscard]] Result<std::optional<std::uint32_t>> room_for(gpu::Device& device, gpu::Commands& commands,
                                                                std::uint32_t indices, bool needed);
    [[nodiscard]] Result<void> place_finest(gpu::Device& device, gpu::Commands& commands, Patch& patch);
    void upload_finest(gpu::Commands& commands, Patch& patch);
    void upload_indices(gpu::Commands& commands, std::uint32_t first, std::span<const std::uint32_t> indices);
    [[nodiscard]] Result<void> place_ready(gpu::Device& device, gpu::Commands& commands, Patch& patch);
    void changed_group(PatchGroup& group);
    void take_group(DetailDone done);
    [[nodiscard]] Result<void> place_ready_groups(gpu::Device& device, gpu::Commands& commands);
    [[nodiscard]] Result<void> place_ready_levels(gpu::Device& device, gpu::Commands& commands);
    void report_change(const Patch& was, const Patch& now, bool replaced) const;
    void upload_light(gpu::Commands& commands, const Patch& patch);
    void enter(Patch& patch);
    void leave(const Patch& patch);
    void measure();

    // Ordered by id, so that the layout does not depend on the order of calls.
    std::map<std::uint32_t, Pending> pending_;
    std::map<std::uint32_t, std::vector<geometry::VertexLight>> pending_light_;
    std::map<std::uint32_t, Patch> placed_;
    PatchGroups groups_;
    bool cleared_ = false, levels_ready_ = false;
    std::uint64_t bytes_ = 0;  // uploaded by the current flush
    RangeAllocator vertex_ranges_, index_ranges_;
    gpu::Buffer vertices_, lights_, indices_;
    std::vector<Patch*> in_order_;
    std::uint64_t triangles_ = 0;
    bool measured_ = true;  // bounds_ and reach_m_ are up to date
    Box bounds_;
    double reach_m_ = 0.0;
    std::uint64_t flushes_ = 0;
    std::uint32_t refine_from_ = 0;  // the id after that of the last job
    std::uint32_t slots_ = 0;        // taken so far, free ones among them
    std::vector<std::uint32_t> free_slots_;
    std::vector<DrawnPatches*> pictures_;
};

}  // namespace burin::renderer
