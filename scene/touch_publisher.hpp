// SPDX-License-Identifier: MIT
// Writes the local surface of each hand, and is the only one to do so.
//
// Data flow of a publication: the hand's draft, which holds some publication of long ago, is cleared of everything ->
// each part of the scene adds what lies near the probe -> meshes are put in order: those that move before those that
// rest, the nearer before the farther -> those beyond what a surface can hold are left out, and the ball within which
// the surface is known ends before the nearest of them -> sequence and time are stamped, and the haptic thread may take
// it. The haptic side never learns what made a triangle.
// Hardest case: more bodies move around the probe than can be followed (PosedSurface::kMostFollowed). A body that is
// not followed would jump a hundred times a second, so it is left out; where that is too near, the tick is outside of
// what is known and gives no force.
// Threads: one at a time, that of the scene's service. Does not allocate once drafts have grown to their size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene_part.hpp"

namespace burin {
template <typename T>
class NewestSlot;  // base/newest_slot.hpp
}  // namespace burin

namespace burin::geometry {
struct LocalSurface;  // geometry/contact/local_surface.hpp
struct TouchedMesh;
}  // namespace burin::geometry

namespace burin::scene {

// A mesh counts as being where its velocity can take it within this time: the longest until the next publication.
inline constexpr double kAhead_s = 0.05;

// Returns a lower bound of the distance from a point to a mesh within kAhead_s: 0 inside its bounding box.
[[nodiscard]] double distance_ahead_m(const geometry::TouchedMesh& mesh, const Vec3& point_scene) noexcept;

class TouchPublisher {
public:
    using Slot = NewestSlot<geometry::LocalSurface>;

    // Meshes in a surface: a tick's query visits each. Of those that move, PosedSurface::kMostFollowed.
    static constexpr std::uint32_t kMaxMeshes = 128;

    // One slot for each hand, null for none; they must outlive the publisher.
    explicit TouchPublisher(std::span<Slot* const> hands);
    ~TouchPublisher();

    // Publishes what the parts have near a hand's probe. Fails when a part does, or offers a mesh of a material that a
    // tick does not know; nothing is published then.
    [[nodiscard]] Result<void> publish(const ProbeBall& ball, std::span<ScenePart* const> parts, Nanoseconds now_ns);
    // Returns the number of surfaces published for a hand so far.
    [[nodiscard]] std::uint64_t published(std::size_t hand) const { return hands_[hand].sequence; }

private:
    struct Hand {
        Slot* slot = nullptr;
        std::uint64_t sequence = 0;
    };
    struct Placed;  // a mesh, and how near it is
    void arrange(geometry::LocalSurface& draft);

    std::vector<Hand> hands_;
    std::vector<Placed> sorted_;  // empty between publications
};

}  // namespace burin::scene
