// SPDX-License-Identifier: MIT
// What hands touch, as events: one when a part of a hand comes into contact with an object, one when it leaves it. Made
// once, by the scene's service (scene/scene_service.hpp), of the contacts that the ticks themselves have found
// (scene/contact_follower.hpp); everybody else reads them. Box2D's contact events are the model (begin and end, with
// the numbers of both).
// Plain data.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

#include "base/clock.hpp"
#include "scene/object_id.hpp"

namespace burin::scene {

// A part of a hand, by the numbers of both: the first hand's third finger is {0, 2}.
struct PartOfHand {
    std::size_t hand = 0, part = 0;
    friend auto operator<=>(const PartOfHand&, const PartOfHand&) = default;
};

struct ContactEvent {
    enum class What : std::uint8_t { begin, end };

    PartOfHand by;
    ObjectId object = 0;  // from 1; or kCarvedObject
    What what = What::begin;
    Nanoseconds time_ns = 0;  // of the tick that found it, on the loop's clock

    friend bool operator==(const ContactEvent&, const ContactEvent&) = default;
};

}  // namespace burin::scene
