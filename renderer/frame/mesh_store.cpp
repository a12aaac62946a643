// SPDX-License-Identifier: MIT
#include "renderer/frame/mesh_store.hpp"

#include <algorithm>
#include <utility>

#include "base/try.hpp"
#include "geometry/contact/surface_tile.hpp"

namespace burin::renderer {
namespace {

constexpr std::uint64_t kLeastVertices = 4096;  // of a buffer
constexpr std::uint64_t kVertexBytes = sizeof(shared::SurfaceVertex), kLightBytes = sizeof(geometry::VertexLight),
                        kIndexBytes = sizeof(std::uint32_t);

}  // namespace

// Whether all that are not there yet fit beside the others.
bool MeshStore::fit(std::span<const std::shared_ptr<const picture::DrawnMesh>> meshes) const {
    std::uint64_t vertices = used_vertices_, indices = used_indices_;
    for (const auto& mesh : meshes) {
        if (stored_.contains(mesh.get())) continue;
        vertices += mesh->vertices.size();
        indices += mesh->indices.size();
    }
    return vertices * kVertexBytes <= vertices_.size_bytes() && indices * kIndexBytes <= indices_.size_bytes();
}

Result<void> MeshStore::put(gpu::Device& device, gpu::Commands& commands,
                            std::span<const std::shared_ptr<const picture::DrawnMesh>> meshes) {
    const auto is_there = [&](const auto& mesh) { return stored_.contains(mesh.get()); };
    if (std::ranges::all_of(meshes, is_there)) return {};
    std::vector<Replaced> replaced;
    for (const auto& mesh : meshes)
        if (!is_there(mesh))
            if (const auto indices = take_place(mesh, meshes)) replaced.push_back({mesh.get(), *indices});
    // The scene's own meshes alone are put into larger buffers; others come back when a scene shows them. Decided
    // before anything is recorded: commands must not fill a buffer that is given up before they are submitted.
    if (!fit(meshes)) {
        BURIN_TRY_DO(begin_anew(device, meshes));
        replaced.clear();
    }
    for (const Replaced& one : replaced) write(commands, *one.mesh, at(*one.mesh), one.with_indices);
    for (const auto& mesh : meshes)
        if (!is_there(mesh)) append(commands, mesh);
    return {};
}

Result<void> MeshStore::begin_anew(gpu::Device& device,
                                   std::span<const std::shared_ptr<const picture::DrawnMesh>> meshes) {
    std::uint64_t vertices = 0, indices = 0;
    for (const auto& mesh : meshes) {
        vertices += mesh->vertices.size();
        indices += mesh->indices.size();
    }
    // Twice what is needed, so that a scene that gains one mesh after another is seldom put anew.
    vertices = std::max(2 * vertices, kLeastVertices);
    indices = std::max(2 * indices, 3 * kLeastVertices);
    BURIN_TRY(made_vertices, gpu::Buffer::create(device, gpu::BufferUse::vertex, vertices * kVertexBytes, "meshes"));
    BURIN_TRY(made_lights,
              gpu::Buffer::create(device, gpu::BufferUse::vertex, vertices * kLightBytes, "meshes' light"));
    BURIN_TRY(made_indices,
              gpu::Buffer::create(device, gpu::BufferUse::index, indices * kIndexBytes, "meshes' indices"));
    vertices_ = std::move(made_vertices);
    lights_ = std::move(made_lights);
    indices_ = std::move(made_indices);
    used_vertices_ = used_indices_ = 0;
    stored_.clear();
    return {};
}

std::optional<bool> MeshStore::take_place(const std::shared_ptr<const picture::DrawnMesh>& mesh,
                                          std::span<const std::shared_ptr<const picture::DrawnMesh>> meshes) {
    const auto gone = std::ranges::find_if(stored_, [&](const auto& entry) {
        const picture::DrawnMesh& old = *entry.second.mesh;
        return old.vertices.size() == mesh->vertices.size() && old.indices.size() == mesh->indices.size() &&
               std::ranges::find(meshes, entry.second.mesh) == meshes.end();
    });
    if (gone == stored_.end()) return std::nullopt;
    const Kept old = gone->second;
    stored_.erase(gone);
    stored_.emplace(mesh.get(), Kept{mesh, old.place});
    return old.mesh->indices != mesh->indices;
}

void MeshStore::write(gpu::Commands& commands, const picture::DrawnMesh& mesh, const StoredMesh& place,
                      bool with_indices) {
    if (mesh.indices.empty()) return;
    const std::vector<geometry::VertexLight> full(mesh.lights.empty() ? mesh.vertices.size() : 0);
    const std::span<const geometry::VertexLight> lights = mesh.lights.empty() ? full : mesh.lights;
    const auto first = static_cast<std::uint64_t>(place.first_vertex);
    commands.upload(vertices_, first * kVertexBytes, std::as_bytes(std::span(mesh.vertices)));
    commands.upload(lights_, first * kLightBytes, std::as_bytes(lights));
    if (with_indices)
        commands.upload(indices_, place.first_index * kIndexBytes, std::as_bytes(std::span(mesh.indices)));
}

void MeshStore::append(gpu::Commands& commands, const std::shared_ptr<const picture::DrawnMesh>& mesh) {
    const StoredMesh place{static_cast<std::uint32_t>(used_indices_), static_cast<std::uint32_t>(mesh->indices.size()),
                           static_cast<std::int32_t>(used_vertices_)};
    write(commands, *mesh, place, true);
    stored_.emplace(mesh.get(), Kept{mesh, place});
    used_vertices_ += mesh->vertices.size();
    used_indices_ += mesh->indices.size();
}

}  // namespace burin::renderer
