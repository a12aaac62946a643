// SPDX-License-Identifier: MIT
// The workpiece's surface on the GPU: thousands of patches in one vertex, one light and one index buffer.
//
// Data flow: set() keeps a reference to a patch that never changes (geometry/surface_tile.hpp), set_light() the light on its vertices;
// flush() records the copies of all that changed since the last frame into the frame's commands, growing the buffers by doubling where
// needed. next_detail() and take() lend out patches that are drawn and have no coarser levels, and take these when they are worked out
// (detail_worker.hpp); they come over with the next flush. Indices are stored absolute, so that patches that are neighbours in the buffer merge into one draw call.
// Limits: 128 MiB a buffer on the software driver, which is 6.7 million vertices and 11 million triangles; beyond: Error.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/surface_tile.hpp"
#include "gpu/commands.hpp"
#include "renderer/surface/detail_worker.hpp"
#include "renderer/surface/range_allocator.hpp"
#include "renderer/surface/visibility.hpp"

namespace burin {

// How a patch is shaded: lit at its vertices, or at every pixel, or smooth triangles in the first way and the others in the second.
enum class ShadingRate : std::uint8_t { vertex, by_triangle, pixel };

class PatchStore {
public:
    struct Level {
        std::uint32_t first_index = 0, index_count = 0;  // of the finest with padding: triangles without area
        std::uint32_t smooth_count = 0;                  // of them, from the first on (smooth_first)
        double error_m = 0.0;                            // 0: the patch as it is
    };
    // How it stands in the picture now.
    struct Drawn {
        std::uint8_t level = 0;
        ShadingRate rate = ShadingRate::pixel;
        bool operator==(const Drawn&) const = default;
    };
    struct Patch {
        std::shared_ptr<const SurfaceTile> surface;
        std::vector<VertexLight> light;  // empty: full
        PatchShape shape;
        std::uint32_t first_vertex = 0, vertex_count = 0;
        std::vector<Level> levels;      // from fine to coarse; the first is always there
        std::vector<PatchLevel> ready;  // worked out, not on the GPU yet
        bool refined = false;           // nothing more is to be worked out, or it is being done
        std::uint64_t changed_at = 0;   // which flush brought another surface or other light than the first; 0: none did
        bool wanted = false;            // it was in view when the picture was last drawn as a whole
        Drawn drawn;
    };

    void set(std::uint32_t id, std::shared_ptr<const SurfaceTile> surface);  // null or empty: remove
    void set_light(std::uint32_t id, std::span<const VertexLight> light);  // one for each vertex; an unknown id is fine
    void remove(std::uint32_t id) { set(id, nullptr); }
    void clear();

    struct Flushed {
        std::uint64_t bytes = 0;   // brought over
        std::vector<Box> changed;  // around patches that came or went and what looks different of others
    };
    // The GPU must not be drawing from the buffers on another submission.
    [[nodiscard]] Result<Flushed> flush(gpu::Device& device, gpu::Commands& commands);

    // The next patch that is wanted and has no levels yet, to be worked out by whoever asks; all of them in turn. resting: also one that
    // changed a moment ago, and may soon change again.
    [[nodiscard]] std::optional<DetailJob> next_detail(bool resting);
    // Levels of a patch, if it still is as it was; they come over with the next flush. Whether there were any.
    bool take(DetailDone done);

    // In the order of the index buffer, after flush.
    [[nodiscard]] std::span<Patch* const> in_order() const { return in_order_; }
    [[nodiscard]] const gpu::Buffer& vertex_buffer() const { return vertices_; }
    [[nodiscard]] const gpu::Buffer& light_buffer() const { return lights_; }
    [[nodiscard]] const gpu::Buffer& index_buffer() const { return indices_; }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::uint32_t patches() const { return static_cast<std::uint32_t>(placed_.size()); }
    [[nodiscard]] const Box& bounds() const { return bounds_; }  // of the positions as given; empty when there is none
    // From the bounds' centre to the farthest corner of any patch: the radius of a ball around the surface, which is
    // tighter than the bounds' own diagonal when there are many patches.
    [[nodiscard]] double reach_m() const { return reach_m_; }

private:
    struct Pending {
        std::shared_ptr<const SurfaceTile> surface;  // null: remove
        std::vector<VertexLight> light;
    };
    void release(std::uint32_t id);
    void release_levels(Patch& patch, std::size_t keep);
    [[nodiscard]] Result<void> make_room(gpu::Device& device, gpu::Commands& commands);
    [[nodiscard]] Result<void> place(gpu::Device& device, gpu::Commands& commands, std::uint32_t id, Pending& pending);
    [[nodiscard]] Result<std::optional<std::uint32_t>> room_for(gpu::Device& device, gpu::Commands& commands,
                                                                std::uint32_t indices, bool needed);
    [[nodiscard]] Result<void> place_finest(gpu::Device& device, gpu::Commands& commands, Patch& patch);
    void upload_finest(gpu::Commands& commands, Patch& patch);
    void upload_indices(gpu::Commands& commands, std::uint32_t first, std::span<const std::uint32_t> indices);
    [[nodiscard]] Result<void> place_ready(gpu::Device& device, gpu::Commands& commands, Patch& patch);
    [[nodiscard]] Result<void> place_ready_levels(gpu::Device& device, gpu::Commands& commands);
    static void note_change(const Patch& was, const Patch& now, std::vector<Box>& changed);
    void upload_light(gpu::Commands& commands, const Patch& patch);
    void enter(Patch& patch);
    void leave(const Patch& patch);
    void measure();

    // In order of id, so that the layout does not depend on the order of calls.
    std::map<std::uint32_t, Pending> pending_;
    std::map<std::uint32_t, std::vector<VertexLight>> pending_light_;
    std::map<std::uint32_t, Patch> placed_;
    bool cleared_ = false, levels_ready_ = false;
    std::uint64_t bytes_ = 0;  // of the flush that goes on
    RangeAllocator vertex_ranges_, index_ranges_;
    gpu::Buffer vertices_, lights_, indices_;
    std::vector<Patch*> in_order_;
    std::uint64_t triangles_ = 0;
    bool measured_ = true;  // bounds_ and reach_m_ are right
    Box bounds_;
    double reach_m_ = 0.0;
    std::uint64_t flushes_ = 0;
    std::uint32_t refine_from_ = 0;  // the id after the last one that was lent out
};

}  // namespace burin
