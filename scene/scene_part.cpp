// SPDX-License-Identifier: MIT
#include "scene/scene_part.hpp"

#include "haptics/tick_record.hpp"
#include "scene/contact_events.hpp"

namespace burin::scene {

void ScenePart::take_ticks(std::size_t /*part*/, std::span<const haptics::TickRecord> /*ticks*/) {}

void ScenePart::take_contacts(std::span<const ContactEvent> /*events*/) {}

void ScenePart::take_changes(SceneChanges& /*changes*/) {}

void ScenePart::go(StepWay /*way*/) {}

Result<void> ScenePart::save(Pages& /*pages*/) {
    return fail("a part of the scene", "cannot be saved yet", "export it, or save a session without it");
}

bool ScenePart::note(Pages& /*pages*/) { return false; }

}  // namespace burin::scene
