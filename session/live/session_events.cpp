// SPDX-License-Identifier: MIT
#include "session/live/session_events.hpp"

#include "scene/contact_events.hpp"
#include "scene/scene_object.hpp"
#include "session/hands/session_hands.hpp"
#include "session/objects/world_objects.hpp"

namespace burin::session {

EventMark event_of(const scene::ContactEvent& contact, const SessionHands& hands, const WorldObjects* world) {
    EventMark mark{contact.time_ns, contact.what == scene::ContactEvent::What::begin ? "touches" : "leaves", ""};
    const auto part = hands.parts() > 1 ? hands.number_of(contact.by) : std::nullopt;
    if (part) mark.name = hands.name_of(*part) + " " + mark.name;
    const scene::SceneObject* const object = world != nullptr ? world->find(contact.object) : nullptr;
    if (object != nullptr)
        mark.value = object->name;
    else if (contact.object == scene::kCarvedObject)
        mark.value = "workpiece";
    else
        mark.value = "object " + std::to_string(contact.object);
    return mark;
}

}  // namespace burin::session
