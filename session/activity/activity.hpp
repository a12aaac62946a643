// SPDX-License-Identifier: MIT
// An activity: what a person is there for, beyond what hands and scene do of themselves. A training trial is one, a
// search against the clock another. Whatever starts a session may give it one; the session knows no more of it than
// this, and docs/first-activity.md shows how one is written.
//
//   every tick of every part of the hands, in order, and what they begin and end to touch
//     -> step() -> edits of objects, what hands take hold of, messages, the end
//   `do WORDS` of a script, a button of its panel -> act() -> the same orders
//   write(): rows for the recording; check(): a number by which a replay is compared
//   adjust(): what the tick does besides; stage(): what the picture shows besides; panel(): what its section says
//
// It must depend on nothing but what it is given here: then a recording, which keeps its settings() and facts() and no
// more of it, is done again to the bit (activities/registry.hpp).
// Frame: the scene's. Thread: the frame's.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/space.hpp"
#include "haptics/tick_record.hpp"
#include "haptics/tool_state.hpp"
#include "scene/contact_events.hpp"
#include "scene/drawn_change.hpp"
#include "session/activity/activity_marks.hpp"
#include "session/activity/activity_orders.hpp"
#include "session/activity/activity_panel.hpp"
#include "session/input/command_form.hpp"

namespace burin::haptics {
struct TickParameters;  // haptics/tick_parameters.hpp
}  // namespace burin::haptics

namespace burin::picture {
struct Picture;  // picture/picture.hpp
}  // namespace burin::picture

namespace burin::scene {
class ScenePart;  // scene/scene_part.hpp
}  // namespace burin::scene

namespace burin::session {

// Something that can be done in the activity: `do NAME ARGUMENTS`. Its words are checked as those of the session's
// commands are, with the kinds that it gives for its arguments:
//   Act{"apart", "METRES", "Lay beads so far apart", {number_within(0.0001, 1.0, "m")}}
using Act = CommandForm;

struct BroughtHand;   // session/activity/brought_hand.hpp
struct WorldObjects;  // session/objects/world_objects.hpp

// A part of a hand in a step. A stylus and a wand are one part, a glove has one for each fingertip.
struct PartView {
    std::string_view name;  // within the hand: "index"; empty for the only part
    // Every tick since the step before, in order; a tick whose sample was lost is missing from the numbers. Their times
    // are of the loop's clock, and all parts of all hands are ticked at the same times.
    std::span<const haptics::TickRecord> ticks;
    haptics::ToolState tool;  // as the frame draws it
};
struct HandView {
    std::string_view name;            // "right"; empty for the only hand
    std::span<const PartView> parts;  // at least one
};

// What an activity may look at in a step; all of it is valid until step() returns.
struct ActivityView {
    Nanoseconds time_ns = 0;          // of the frame, since the session's start
    std::span<const HandView> hands;  // at least one
    // What all hands have begun and ended to touch since the step before, in the order of the scene's updates and
    // within each of time. An event never comes before the tick that found it.
    std::span<const scene::ContactEvent> contacts;
    const WorldObjects* world = nullptr;  // as of the last update of the scene; null: there is none
    // How parts of the scene have come to look in the updates that the frame has taken since the step before, the
    // newest last: what a part of its own (scene_part()) tells it to draw.
    std::span<const scene::DrawnShare> drawn = {};

    // Returns the first part of the first hand.
    [[nodiscard]] const PartView& first_part() const { return hands.front().parts.front(); }
};

// Where a desk's mouse leads the hand of a glove: over which box of the scene, and how the hand is turned there.
struct LedHand {
    Box reach_scene;
    Quat rest_device{1.0, 0.0, 0.0, 0.0};  // fingers along +Y, the palm looks along -Z
};

class Activity {
public:
    Activity() = default;
    virtual ~Activity() = default;
    Activity(const Activity&) = delete;
    Activity& operator=(const Activity&) = delete;

    // Returns its name, the command's that starts it, and all that its course depends on besides what it is given here;
    // on one line, at most a few hundred characters.
    [[nodiscard]] virtual std::string settings() const = 0;
    // Returns what a session file has to keep so that the activity can be made anew, where settings() has no room for
    // it: facts by their names.
    [[nodiscard]] virtual std::vector<std::pair<std::string, std::string>> facts() const { return {}; }
    [[nodiscard]] virtual std::span<const Act> acts() const { return {}; }
    // Carries out one of its acts: words[0] is one of acts(), the others are of its kinds. The Error says what would be
    // right; nothing has changed then.
    [[nodiscard]] virtual Result<void> act(std::span<const std::string> words, ActivityOrders& orders) = 0;
    // Goes on by the ticks since the last step. Called once a frame, and once after the last tick.
    virtual void step(const ActivityView& view, ActivityOrders& orders) = 0;
    // Writes what has happened in the step before, where somebody wants to know it later: figures, marks, answers. Kept
    // where a session file is recorded, and compared when that is done again.
    virtual void write(ActivityRecord& /*record*/) {}
    // Returns a number for all that its further course depends on, which a recording keeps with each frame: a replay
    // whose activity has gone another way is told by it. 0: nothing is kept.
    [[nodiscard]] virtual std::uint64_t check() const { return 0; }
    // Returns whether frames are to be made although neither hand nor user stirs, since a clock runs.
    [[nodiscard]] virtual bool is_running() const { return false; }
    // Changes the parameters of a part's next ticks, such as guidance, once all else is in them.
    virtual void adjust(PartOfHand /*of*/, haptics::TickParameters& /*parameters*/) const {}
    // Returns what it brings into the scene besides, such as a body that gives: a part that is updated with the others,
    // on the scene's thread, as long as the session runs. Asked once, before the first update. Null: nothing.
    [[nodiscard]] virtual scene::ScenePart* scene_part() { return nullptr; }
    // Returns how far around each hand all of the scene is known to the ticks, where the scene is small; 0: as far as a
    // hand moves until the next update. Asked once, when the session begins.
    [[nodiscard]] virtual double known_m() const { return 0.0; }
    // Returns how the hand of a glove is led by a desk, where its scene asks for something of its own; nothing: over
    // all that is seen, with the palm down. Asked once, when the session begins.
    [[nodiscard]] virtual std::optional<LedHand> led_hand() const { return std::nullopt; }
    // Returns the hand that it brings, which leads the first device by itself; null: none. Asked when the session
    // opens, and valid as long as it lasts.
    [[nodiscard]] virtual const BroughtHand* brought_hand() const { return nullptr; }
    // Returns whether stage() draws the hands, so that no tools are drawn for them.
    [[nodiscard]] virtual bool draws_hands() const { return false; }
    // Changes what a screen shows.
    virtual void stage(picture::Picture& /*scene*/, std::size_t /*screen*/) const {}
    [[nodiscard]] virtual ActivityPanel panel() const = 0;
    // Returns ActivityPanel::governs of its panel; asked in each step.
    [[nodiscard]] virtual bool governs() const { return panel().governs; }
    // Called when the session has ended and no tick comes any more: writes what it leaves.
    [[nodiscard]] virtual Result<void> finish() { return {}; }
};

// Checks that the words are an act of the activity with its arguments, with the nearest name or what an argument may be
// in the Error; null: there is none, and every act fails.
[[nodiscard]] Result<void> check_act(const Activity* activity, std::span<const std::string> words);

}  // namespace burin::session
