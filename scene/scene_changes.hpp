// SPDX-License-Identifier: MIT
// What a scene has to tell the frames after an update: what each of its parts has changed, and what the hands have
// done. The frame goes through it without knowing which part a change is of. Plain data.
// Frame: the scene's.
#pragma once

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "haptics/tick_record.hpp"
#include "scene/contact_events.hpp"
#include "scene/drawn_change.hpp"
#include "scene/haptic_material.hpp"
#include "scene/part_steps.hpp"
#include "scene/scene_object.hpp"

namespace burin::scene {

// What the frame has to know of an object that has changed.
struct ObjectUpdate {
    ObjectId id = 0;
    Similarity scene_from_mesh;
    bool seen = true;
    Colour colour{};
    bool has_own_colours = false;  // those of its file, and not `colour`
    Pose pose;                     // its own: on a path, without the path
    ObjectMotion motion;           // as it is now: a hand may hold it, or have left it where it is
    double opacity = 1.0;
};

// What the hands have done in some updates of the scene.
struct HandNews {
    std::vector<std::vector<haptics::TickRecord>> ticks;  // of each part of the hands, by its number, if they are kept
    std::vector<ContactEvent> contacts;

    [[nodiscard]] bool has_ticks() const {
        return std::ranges::any_of(ticks, [](const auto& of_part) { return !of_part.empty(); });
    }
    // Adds later news.
    void add(HandNews later) {
        if (ticks.size() < later.ticks.size()) ticks.resize(later.ticks.size());
        for (std::size_t part = 0; part < later.ticks.size(); ++part) {
            if (ticks[part].empty())
                ticks[part] = std::move(later.ticks[part]);  // a tick is several kilobytes
            else
                std::ranges::move(later.ticks[part], std::back_inserter(ticks[part]));
        }
        std::ranges::move(later.contacts, std::back_inserter(contacts));
    }
};

// The steps of a part, by its number among those of the scene.
struct StepsOfPart {
    std::size_t part = 0;
    PartSteps steps;
};

struct SceneChanges {
    std::vector<StepsOfPart> steps;          // where they have changed
    std::vector<ObjectUpdate> objects;       // the newest last
    std::optional<MaterialTable> materials;  // where they have changed
    std::vector<std::shared_ptr<DrawnChange>> drawn;
    HandNews hands;
};

}  // namespace burin::scene
