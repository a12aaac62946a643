// SPDX-License-Identifier: MIT
// What hands touch, as events: one when a part of a hand comes into contact with an object, one when it leaves it. Made
// once, by the scene's service (scene/scene_service.hpp), of the contacts that the ticks themselves have found;
// everybody else reads them. Box2D's contact events are the model (begin and end, with the numbers of both).
//
// Data flow: the ticks of one part, in order -> ContactFollower -> events, at most one for each object and tick.
// An object is touched while a triangle of it bears at least one point of the part's probe. A point that is held over
// (kTickHeldOver) finds no triangle; it goes on touching what it did while its last plane bears it. A contact at the
// edge of the force may come and go from tick to tick; nothing is smoothed here.
// Pure, deterministic; one thread.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/clock.hpp"
#include "geometry/contact/local_surface.hpp"
#include "haptics/tick_record.hpp"
#include "scene/scene_object.hpp"

namespace burin::scene {

// A part of a hand, by the numbers of both: the first hand's third finger is {0, 2}.
struct PartOfHand {
    std::size_t hand = 0, part = 0;
    friend auto operator<=>(const PartOfHand&, const PartOfHand&) = default;
};

// The object of contacts with what has no number of its own: the carved workpiece.
inline constexpr ObjectId kCarvedObject = geometry::LocalSurface::kUnnumbered;

struct ContactEvent {
    enum class What : std::uint8_t { begin, end };

    PartOfHand by;
    ObjectId object = 0;  // from 1; or kCarvedObject
    What what = What::begin;
    Nanoseconds time_ns = 0;  // of the tick that found it, on the loop's clock

    friend bool operator==(const ContactEvent&, const ContactEvent&) = default;
};

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
