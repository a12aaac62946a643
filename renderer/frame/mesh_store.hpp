// SPDX-License-Identifier: MIT
// The meshes of the scenes that a renderer has drawn, on the device: all in one vertex and one index buffer, each put
// there when a scene first shows it. A mesh that the scene shows no more gives its place to one of the same size, as a
// hand does that moves from frame to frame; room is given back otherwise when the buffers have to grow. Thread: that of
// the renderer's Device.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/error.hpp"
#include "gpu/commands.hpp"
#include "gpu/device.hpp"
#include "picture/drawn_mesh.hpp"

namespace burin::renderer {

// A mesh's place in the buffers; its indices count from its own first vertex.
struct StoredMesh {
    std::uint32_t first_index = 0, index_count = 0;
    std::int32_t first_vertex = 0;
};

class MeshStore {
public:
    // Puts the meshes that are not there yet, by commands that come before those that draw. Fails without memory; then
    // what was there is still there.
    [[nodiscard]] Result<void> put(gpu::Device& device, gpu::Commands& commands,
                                   std::span<const std::shared_ptr<const picture::DrawnMesh>> meshes);
    // Returns where a mesh lies that was put.
    [[nodiscard]] const StoredMesh& at(const picture::DrawnMesh& mesh) const { return stored_.at(&mesh).place; }
    [[nodiscard]] std::size_t meshes() const { return stored_.size(); }

    [[nodiscard]] const gpu::Buffer& vertices() const { return vertices_; }
    [[nodiscard]] const gpu::Buffer& lights() const { return lights_; }  // full light for every vertex
    [[nodiscard]] const gpu::Buffer& indices() const { return indices_; }

private:
    struct Kept {
        std::shared_ptr<const picture::DrawnMesh> mesh;  // so that no other mesh can have its address
        StoredMesh place;
    };
    [[nodiscard]] bool fit(std::span<const std::shared_ptr<const picture::DrawnMesh>> meshes) const;
    struct Replaced {
        const picture::DrawnMesh* mesh = nullptr;
        bool with_indices = false;
    };
    // Gives a mesh the place of one of its size that is not among `meshes`. Returns whether its indices are others;
    // none where there is no such place.
    [[nodiscard]] std::optional<bool> take_place(const std::shared_ptr<const picture::DrawnMesh>& mesh,
                                                 std::span<const std::shared_ptr<const picture::DrawnMesh>> meshes);
    void write(gpu::Commands& commands, const picture::DrawnMesh& mesh, const StoredMesh& place, bool with_indices);
    void append(gpu::Commands& commands, const std::shared_ptr<const picture::DrawnMesh>& mesh);
    [[nodiscard]] Result<void> begin_anew(gpu::Device& device,
                                          std::span<const std::shared_ptr<const picture::DrawnMesh>> meshes);

    gpu::Buffer vertices_, lights_, indices_;
    std::uint64_t used_vertices_ = 0, used_indices_ = 0;
    std::unordered_map<const picture::DrawnMesh*, Kept> stored_;
};

}  // namespace burin::renderer
