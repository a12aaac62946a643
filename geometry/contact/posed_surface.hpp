// SPDX-License-Identifier: MIT
// A LocalSurface as it is at one moment: with its moving meshes where they are then. This is what a tick queries.
//
// A LocalSurface holds the poses that were published; the tick works out where the meshes are at its own time and lays
// those poses beside it (haptics/contact/moving_bodies.hpp). A LocalSurface converts to one with its published poses.
// Triangle ids are the surface's own. Refers to surface and poses, which must outlive it. Copies cost a few words.
// Frame: as geometry/contact/local_surface.hpp. No heap, lock, throw.
#pragma once

#include <span>

#include "geometry/contact/local_surface.hpp"

namespace burin::geometry {

class PosedSurface {
public:
    // How many of a surface's moving meshes, counted from the first of them, are followed between publications. Those
    // beyond are touched where they were published, and each publication is a jump to them. Resting meshes do not
    // count.
    static constexpr std::uint32_t kMostFollowed = 24;

    PosedSurface(const LocalSurface& surface) noexcept : surface_(&surface) {}
    // poses: object_from_mesh of the meshes with these indices; for the others the published ones hold.
    PosedSurface(const LocalSurface& surface, std::span<const std::uint32_t> meshes,
                 std::span<const Pose> poses) noexcept
        : surface_(&surface), followed_(meshes), poses_(poses) {}

    // The same surface with one mesh alone, or with all that rests. Ids stay the same.
    [[nodiscard]] PosedSurface only_mesh(std::uint32_t mesh) const noexcept {
        PosedSurface part = *this;
        part.shown_ = mesh;
        return part;
    }
    [[nodiscard]] PosedSurface only_resting() const noexcept {
        PosedSurface part = *this;
        part.shown_ = kResting;
        return part;
    }

    [[nodiscard]] const LocalSurface& surface() const noexcept { return *surface_; }
    [[nodiscard]] const Vec3& origin_object() const noexcept { return surface_->origin_object; }
    [[nodiscard]] double mean_edge_m() const noexcept { return surface_->mean_edge_m(); }
    [[nodiscard]] std::uint8_t material(std::uint32_t id) const noexcept { return surface_->material(id); }
    [[nodiscard]] bool two_sided(std::uint32_t id) const noexcept { return surface_->two_sided(id); }

    // Whether tiles and loose triangles are part of it, or this mesh is.
    [[nodiscard]] bool shows_ground() const noexcept { return shown_ >= kResting; }
    [[nodiscard]] bool shows(std::uint32_t mesh) const noexcept {
        const TouchedMesh& m = surface_->meshes[mesh];
        if (!m.snapshot || (m.has_pose() && !is_sensible(m.motion))) return false;
        return shown_ == kAll || (shown_ == kResting ? !m.moves() : shown_ == mesh);
    }
    [[nodiscard]] const Pose& pose(std::uint32_t mesh) const noexcept {
        for (std::size_t i = 0; i < followed_.size(); ++i)
            if (followed_[i] == mesh) return poses_[i];
        return surface_->meshes[mesh].motion.object_from_mesh;
    }
    // Returns the corner normals of a triangle, in the object frame.
    [[nodiscard]] CornerNormals corner_normals(std::uint32_t id) const noexcept {
        CornerNormals normals = surface_->corner_normals(id);
        const std::uint32_t mesh = surface_->mesh_of(id);
        if (mesh == LocalSurface::kNoMesh || !surface_->meshes[mesh].has_pose()) return normals;
        for (Vec3f& normal : normals.normals) normal = Vec3f(pose(mesh).orientation * Vec3(normal));
        return normals;
    }

private:
    static constexpr std::uint32_t kResting = 0xfffffffeu, kAll = 0xffffffffu;

    const LocalSurface* surface_;
    std::span<const std::uint32_t> followed_;  // indices of meshes
    std::span<const Pose> poses_;
    std::uint32_t shown_ = kAll;
};

}  // namespace burin::geometry
