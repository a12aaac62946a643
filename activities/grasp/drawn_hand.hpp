// SPDX-License-Identifier: MIT
// A hand as pictures show it: its skin as an object whose shape changes with each frame, and its bones as the capsules
// that cast its shadow; a sleeve covers where the skin ends. What the fingers keep off each other and off the palm, of
// the lamp and of the room, is worked out at the skin's places in the same closed forms as the shaders'
// (shaders/lighting.glsl); a finger keeps nothing off itself. Frame: as its functions say. One thread at a time; a hand
// costs some milliseconds a frame.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/hand/hand_model.hpp"
#include "picture/picture.hpp"

namespace burin::activities {

class DrawnHand {
public:
    // The skin is made finer once or twice: 9,256 or 37,024 triangles.
    explicit DrawnHand(const geometry::HandModel& hand);

    // Adds the hand to a scene. The hand's frame (geometry/hand/hand_model.hpp) is in the world as world_from_hand has
    // it, at a scale if it has one.
    void add_to(picture::Picture& scene, const geometry::HandBend& bend, const Similarity& world_from_hand) const;

    [[nodiscard]] const geometry::HandModel& model() const { return hand_; }

private:
    using Capsules = std::array<geometry::BoneCapsule, geometry::kBoneCapsules>;
    [[nodiscard]] geometry::VertexLight light_at(std::size_t vertex, const Vec3& place, const Vec3& normal,
                                                 const Capsules& capsules, const Vec3& to_light) const;

    geometry::HandModel hand_;
    std::shared_ptr<const picture::DrawnMesh> sleeve_;  // over the skin's end at the wrist
    geometry::BoneCapsule forearm_;
    std::vector<std::uint32_t> colours_;  // of each place of the skin
    std::vector<std::uint32_t> others_;   // for each place a bit for each capsule that keeps light off it
};

}  // namespace burin::activities
