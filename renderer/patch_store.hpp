// SPDX-License-Identifier: MIT
// The workpiece's surface on the GPU: thousands of patches in one vertex and one index buffer.
//
// Data flow: set() keeps a copy; flush() records the copies of all that changed since the last frame into the frame's
// commands, growing the buffers by doubling where needed; draws() lists what to draw. Indices are stored absolute, so that
// neighbouring patches merge into one draw call: a fresh surface of any number of patches is a single one.
// Limits: 128 MiB a buffer on the software driver, which is 6.7 million vertices and 11 million triangles; beyond: Error.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/space.hpp"
#include "gpu/commands.hpp"
#include "renderer/range_allocator.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin {

class PatchStore {
public:
    struct DrawRange {
        std::uint32_t first_index = 0;
        std::uint32_t index_count = 0;
    };

    void set(std::uint32_t id, std::span<const shared::SurfaceVertex> vertices, std::span<const std::uint32_t> indices);
    void remove(std::uint32_t id);
    void clear();

    // The bytes that were brought over. The GPU must not be drawing from the buffers on another submission.
    [[nodiscard]] Result<std::uint64_t> flush(gpu::Device& device, gpu::Commands& commands);

    // After flush.
    [[nodiscard]] std::span<const DrawRange> draws() const { return draws_; }
    [[nodiscard]] const gpu::Buffer& vertex_buffer() const { return vertices_; }
    [[nodiscard]] const gpu::Buffer& index_buffer() const { return indices_; }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::uint32_t patches() const { return static_cast<std::uint32_t>(placed_.size()); }
    [[nodiscard]] const Box& bounds() const { return bounds_; }  // of the positions as given; empty when there is none
    // From the bounds' centre to the farthest corner of any patch: the radius of a ball around the surface, which is
    // tighter than the bounds' own diagonal when there are many patches.
    [[nodiscard]] double reach_m() const { return reach_m_; }

private:
    struct Pending {
        std::vector<shared::SurfaceVertex> vertices;  // empty: remove
        std::vector<std::uint32_t> indices;
    };
    struct Placed {
        std::uint32_t first_vertex = 0, vertex_count = 0;
        std::uint32_t first_index = 0, index_count = 0;  // index_count includes the padding
        std::uint64_t triangles = 0;
        Box bounds;
    };
    void release(std::uint32_t id);
    [[nodiscard]] Result<void> make_room(gpu::Device& device, gpu::Commands& commands);
    [[nodiscard]] Result<void> place(gpu::Device& device, gpu::Commands& commands, std::uint32_t id, Pending& patch);
    void list_draws();

    std::map<std::uint32_t, Pending>
        pending_;  // in order of id, so that the layout does not depend on the order of calls
    std::unordered_map<std::uint32_t, Placed> placed_;
    bool cleared_ = false;
    RangeAllocator vertex_ranges_, index_ranges_;
    gpu::Buffer vertices_, indices_;
    std::vector<DrawRange> draws_;
    std::uint64_t triangles_ = 0;
    Box bounds_;
    double reach_m_ = 0.0;
};

}  // namespace burin
