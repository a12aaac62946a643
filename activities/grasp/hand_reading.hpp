// SPDX-License-Identifier: MIT
// Reads a hand out of a glove's ticks: the bend of its fingers, its pose, and the objects that each finger touches.
// Pure.
// Frames: the scene's (the object frame of the ticks) and the hand's (geometry/hand/hand_model.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "devices/gloves/glove_hand.hpp"
#include "geometry/hand/hand_model.hpp"
#include "haptics/tick_record.hpp"

namespace burin::activities {

inline constexpr std::size_t kFelt = devices::kGloveFingers;  // fingers with a piston: thumb, index, middle, ring

// A fingertip in one tick.
struct FingerReading {
    geometry::FingerBend bend{};
    std::uint64_t object = 0;  // that it touches; 0: none
    Vec3 normal_scene{0.0};    // of that contact
    Vec3 out_scene_m{0.0};     // from where the fingertip is to where it rests on the surface
    Vec3 at_scene_m{0.0};      // where the fingertip is
};

struct HandReading {
    Nanoseconds time_ns = 0;
    geometry::HandBend bend{};  // the little finger's is the ring finger's
    Similarity scene_from_hand;
    std::array<FingerReading, kFelt> fingers{};
};

// Reads the ticks of a glove's parts of one turn. The hand's place follows from the first of them.
[[nodiscard]] HandReading reading_of(const std::array<const haptics::TickRecord*, kFelt>& ticks);

// Returns the bend with which a hand is drawn: a finger that touches is opened until its tip rests on the surface, as
// far as its flexion takes it there.
[[nodiscard]] geometry::HandBend drawn_bend(const HandReading& hand);

// Returns the object that each finger holds against another one: a finger's contact counts where another finger touches
// the same object from a side that is turned from its own by more than 75 degrees. Two fingertips on a table grasp
// nothing. The little finger touches nothing.
[[nodiscard]] std::array<std::uint64_t, geometry::kHandFingers> opposed_contacts(const HandReading& hand);

}  // namespace burin::activities
