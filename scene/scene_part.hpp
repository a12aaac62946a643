// SPDX-License-Identifier: MIT
// A part of a scene: what it owns in there is touched, seen and edited through it alone. A carved workpiece is a part,
// the meshes of a world are one, bodies another.
//
// Data flow of an update: the scene's service (scene/scene_service.hpp) hands each part the ticks of all
// hands, calls its update(), and then has the touch publisher (scene/touch_publisher.hpp) ask every part for what lies
// near each hand's probe. What it has changed it tells the frames by take_changes(). The orders that it carries out are
// its own affair: whoever gives them knows which part it is for.
// Frame: the scene's, metres, which LocalSurface calls the object frame.
// Threads: one at a time, the service's or, where time is simulated, the caller's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/space.hpp"
#include "scene/part_steps.hpp"
#include "scene/scene_update.hpp"

namespace burin::geometry {
struct LocalSurface;  // geometry/contact/local_surface.hpp
}  // namespace burin::geometry

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::scene {

struct ContactEvent;  // scene/contact_events.hpp
struct Pages;         // scene/pages.hpp
struct SceneChanges;  // scene/scene_changes.hpp

// The ball around a hand's probe within which the surface must be known until the next publication.
struct ProbeBall {
    std::size_t hand = 0;
    Vec3 center_scene{0.0};
    double radius_m = 0.0;  // of the probe, and how far it may move until then
};

class ScenePart {
public:
    ScenePart() = default;
    virtual ~ScenePart() = default;
    ScenePart(const ScenePart&) = delete;
    ScenePart& operator=(const ScenePart&) = delete;

    // Takes what a part of a hand has done since the last update, tick by tick, just before the next one. `part` counts
    // the parts of all hands, a stylus' one and a glove's fingertips alike, as the service was given them. A scene part
    // that needs none of it leaves it.
    virtual void take_ticks(std::size_t part, std::span<const haptics::TickRecord> ticks);
    // Takes what all hands have begun and ended to touch since the last update, in the order of time, after their
    // ticks.
    virtual void take_contacts(std::span<const ContactEvent> events);
    // Brings the part to the present. `recorded`: what a recorded update saw, which this one sees again; null in a live
    // one. Fails when the part cannot go on; it is then as it was before the update.
    [[nodiscard]] virtual Result<void> update(Nanoseconds now_ns, const PartSeen* recorded) = 0;
    // Returns what the last update saw.
    [[nodiscard]] virtual const PartSeen& seen() const = 0;
    // Says, before the first update, that time is real: what a device has not done yet may be left to a later update,
    // as PartSeen notes. Otherwise each update waits, and every run gives the same bits.
    virtual void let_lag() {}
    // Adds what lies in the ball to a draft, which begins empty and holds the ball; other parts add to it as well. One
    // part of a scene alone may set origin, tiles and loose triangles; the others add meshes. A part that knows its
    // surface in a smaller ball only lowers radius_m. Sequence and time are the publisher's.
    [[nodiscard]] virtual Result<void> add_near(const ProbeBall& ball, geometry::LocalSurface& draft) = 0;
    // Does what hands need not wait for, such as light: called at the end of an update, when all surfaces are
    // published.
    virtual void after_publication() {}
    // Adds what has changed since the last call, at first all, for the frames. Called after an update.
    virtual void take_changes(SceneChanges& changes);
    // Returns the longest time until the next update that the part allows; it may change with each.
    [[nodiscard]] virtual Nanoseconds period_ns() const = 0;
    // Waits for all work that goes on elsewhere.
    virtual void finish() {}
    // Puts what a document keeps of the part into the pages, in the middle of no update: all, or what has changed since
    // the last call, as they ask. Fails where the part cannot be saved, with the reason. What was saved is loaded by
    // whoever makes the part.
    [[nodiscard]] virtual Result<void> save(Pages& pages);
    // Puts what has changed since the last call into the pages, or all where they ask for it, as save() does, for a
    // journal; what save() gives next is the same as without. Returns false, and does nothing, while a step goes on.
    [[nodiscard]] virtual bool note(Pages& pages);
    // Returns whether save() and note() can give it.
    [[nodiscard]] virtual bool is_kept() const { return false; }
    // Returns which steps there are that lead back and forward; none where nothing that it does is undone.
    [[nodiscard]] virtual PartSteps undo_steps() const { return {}; }
    // Takes its last step back, repeats the one that was taken back last, or forgets those; an order, which is counted
    // in PartSteps::walked once it is carried out, also where there is no such step. What goes on is ended before.
    virtual void go(StepWay way);
};

}  // namespace burin::scene
