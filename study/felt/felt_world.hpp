// SPDX-License-Identifier: MIT
// A study's world as a scene: what of it is felt, as the surface that a tick touches, and what is seen.
//
// Nothing of it moves and it is small, so that one surface holds all of it: it is made once and used by every tick of
// every stage. Which parts press on the hand is a matter of the tick's materials (stage_touch.hpp).
// Frame: the world's, which the tick calls the object frame. Immutable after create(); any number of threads may read
// it at once.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geometry/contact/local_surface.hpp"
#include "scene/mesh_part.hpp"
#include "study/protocol/protocol.hpp"

namespace burin::study {

// Indices into TickParameters::materials.
inline constexpr std::uint8_t kTubeMaterial = 0, kFunnelMaterial = 1;
// Numbers of the objects. The tube that is felt is not the one that is seen (tube_mesh.hpp).
inline constexpr scene::ObjectId kTubeObject = 1, kStartFunnelObject = 2, kEndFunnelObject = 3, kStartCapObject = 4,
                                 kEndCapObject = 5, kSeenTubeObject = 6;

class FeltWorld {
public:
    // Fails where the world cannot be touched: a spine that spans more than float positions resolve.
    [[nodiscard]] static Result<std::unique_ptr<const FeltWorld>> create(const StudyWorld& world);

    [[nodiscard]] const StudyWorld& world() const { return world_; }
    [[nodiscard]] const geometry::LocalSurface& surface() const { return surface_; }
    // For drawing: the tube, the funnels that there are, the caps.
    [[nodiscard]] const scene::MeshPart& part() const { return *part_; }
    [[nodiscard]] const std::vector<scene::ObjectId>& objects() const { return objects_; }
    // Of all triangles that are felt and of the world's numbers: SHA-256. A record names it.
    [[nodiscard]] const std::string& digest() const { return digest_; }
    // The middle of the box around all of it.
    [[nodiscard]] const Box& bounds() const { return bounds_; }

private:
    explicit FeltWorld(StudyWorld world) : world_(std::move(world)) {}

    StudyWorld world_;
    scene::MaterialTable materials_;
    std::unique_ptr<scene::MeshPart> part_;
    std::vector<scene::ObjectId> objects_;
    geometry::LocalSurface surface_;
    Box bounds_;
    std::string digest_;
};

}  // namespace burin::study
