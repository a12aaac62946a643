// SPDX-License-Identifier: MIT
// Makes contact events of ticks.
//
// Data flow: the ticks of one part, in order -> ContactFollower -> events, at most one for each object and tick.
// An object is touched while a triangle of it bears at least one point of the part's probe. A point that is held over
// (kTickHeldOver) finds no triangle; it goes on touching what it did while its last plane bears it. A contact at the
// edge of the force may come and go from tick to tick; nothing is smoothed here.
// Pure, deterministic; one thread.
#pragma once

#include <array>
#include <vector>

#include "haptics/contact/probe.hpp"
#include "scene/contact_events.hpp"
#include "scene/object_id.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::scene {

// The object that each point of a part's probe touches; 0: nothing.
using TouchedObjects = std::array<ObjectId, haptics::kMostProbePoints>;

// Returns what a part's points touch in a tick, after what they touched in the tick before.
[[nodiscard]] TouchedObjects touched_in(const haptics::TickRecord& tick, const TouchedObjects& before) noexcept;

// Follows what one part of a hand touches.
class ContactFollower {
public:
    explicit ContactFollower(PartOfHand of = {}) : of_(of) {}

    // Adds what the part's next tick has begun and ended to touch: first the ends, then the begins, each in the order
    // of the probe's points.
    void follow(const haptics::TickRecord& tick, std::vector<ContactEvent>& events);

private:
    PartOfHand of_;
    TouchedObjects touched_{};  // in the last tick
};

}  // namespace burin::scene
