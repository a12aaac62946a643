// SPDX-License-Identifier: MIT
// What an update of a scene has seen: all that it depends on but the orders themselves, so that a recording can do it
// again to the bit (scene/scene_service.hpp). Plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/clock.hpp"

namespace burin::scene {

// What an update of a part depended on besides orders, samples and time; with it a recording can repeat the update.
struct PartSeen {
    bool background_ended = false;  // it was the first to find its work on another thread complete, such as an export
    std::size_t behind = 0;         // so many updates of its solid were under way on a device, and not taken
    friend bool operator==(const PartSeen&, const PartSeen&) = default;
};

// Inputs of an update.
struct SceneUpdate {
    Nanoseconds time_ns = 0;
    std::size_t orders = 0;                 // carried out just before it; counted by whoever gives them
    std::vector<std::uint64_t> last_ticks;  // for each hand, the last one that was read
    std::vector<PartSeen> parts;            // for each part
    friend bool operator==(const SceneUpdate&, const SceneUpdate&) = default;
};

}  // namespace burin::scene
