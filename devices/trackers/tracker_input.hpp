// SPDX-License-Identifier: MIT
// Reports of trackers as plain data: poses of a head and of wands, with the wands' buttons and sticks.
// Frame: world, metres (base/space.hpp). Times: arrival, on the process's one clock.
#pragma once

#include <cstdint>
#include <variant>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin::devices {

// Head pose; tracked false: the tracker has lost it, and the pose is the last one known.
struct HeadInput {
    Pose pose_world;
    bool tracked = true;
    friend bool operator==(const HeadInput&, const HeadInput&) = default;
};
struct WandInput {
    std::uint32_t wand = 0;
    Pose pose_world;
    bool tracked = true;
    friend bool operator==(const WandInput&, const WandInput&) = default;
};
struct WandClick {
    std::uint32_t wand = 0, button = 0;
    bool pressed = true;
    friend bool operator==(const WandClick&, const WandClick&) = default;
};
// Stick of a wand: -1 to 1 each, x to the right, y forwards.
struct WandStick {
    std::uint32_t wand = 0;
    Vec2 position{0.0};
    friend bool operator==(const WandStick&, const WandStick&) = default;
};

using TrackerInput = std::variant<HeadInput, WandInput, WandClick, WandStick>;

struct TrackerSample {
    Nanoseconds time_ns = 0;
    TrackerInput input;
};

}  // namespace burin::devices
