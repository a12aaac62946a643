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
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "haptics/tick_parameters.hpp"
#include "haptics/tick_record.hpp"
#include "picture/picture.hpp"
#include "scene/contact_events.hpp"
#include "scene/scene_changes.hpp"
#include "scene/scene_part.hpp"
#include "session/input/input_event.hpp"
#include "session/objects/world_objects.hpp"

namespace burin::session {

// Something that can be done in the activity: `do NAME ARGUMENTS`.
struct Act {
    std::string_view name;       // "next"
    std::string_view arguments;  // "NAME"; empty: none; [ ]: optional; ... at the end: more
    std::string_view help;       // one line
};

using scene::PartOfHand;

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

// A trial for the recording's table of trials, of which one is under way at a time.
struct TrialMark {
    Nanoseconds time_ns = 0;  // on the loop's clock
    std::string name;         // of one that begins; empty: the one under way ends
    std::string state = {};   // how it ended, in a word or two: "done", "given up"
};

// A row of the recording's table of events, in words: what happened, and of what.
struct EventMark {
    Nanoseconds time_ns = 0;  // on the loop's clock
    std::string name, value;
    bool operator==(const EventMark&) const = default;
};
// What an activity writes into the recording of its session besides its trials, in order.
struct ActivityRecord {
    std::vector<EventMark> events;
};

// Has parts of hands take hold of an object: from the scene's next update on it moves with the frame of them all
// (scene::grip_frame()), from where it and they are then. A hold that there was gives way. By nobody: lets go of it,
// and it stays fixed where it was.
struct HoldObject {
    std::string object;
    std::vector<PartOfHand> by;
    bool felt = false;  // by the parts that hold it (scene::HeldMotion)
    bool operator==(const HoldObject&) const = default;
};

// What it wants done; filled in order.
struct ActivityOrders {
    std::vector<EditObject> edits;
    std::vector<HoldObject> holds;
    std::vector<std::string> messages;     // for the user, on panel and terminal
    std::vector<std::string> screenshots;  // names
    std::vector<TrialMark> trials;         // kept where a session file is recorded
    // Done on the scene's thread before its next update, in order: what its own part of the scene is told. Whatever a
    // function refers to must outlive the session.
    std::vector<std::function<void()>> on_scene;
    bool parameters = false;  // adjust() has changed
    bool quit = false;
};

// Where a desk's mouse leads the hand of a glove: over which box of the scene, and how the hand is turned there.
struct LedHand {
    Box reach_scene;
    Quat rest_device{1.0, 0.0, 0.0, 0.0};  // fingers along +Y, the palm looks along -Z
};

// Its section of the panel, from top to bottom.
struct ActivityPanel {
    struct Row {
        std::string name, value;
        bool operator==(const Row&) const = default;
    };
    struct Button {
        std::string title;
        std::vector<std::string> act;  // the words behind `do`
        bool enabled = true;
        std::string asks = {};  // a question that the panel asks before it gives the act; empty: it gives it at once
        std::optional<Key> key = std::nullopt;  // that gives the act too, before it is any short cut
        bool operator==(const Button&) const = default;
    };
    // What a person is doing now, drawn large over the picture: forces against what is asked, how long they are to be
    // held, and what comes next.
    struct Task {
        struct Bar {
            std::string name;               // "index"
            double asked_N = 0.0;           // what the device is told to give
            std::optional<double> given_N;  // what it measures that it gives
            double target_N = 0.0;          // 0: none is asked
            double full_N = 1.0;            // the bar's length
            std::uint32_t colour_srgb = 0;  // 0xRRGGBB
            bool operator==(const Bar&) const = default;
        };
        std::string state;          // "Paused"; empty: it is under way
        std::string next;           // "Squeeze the ball"
        std::string progress = {};  // "2 of 5"
        std::vector<Bar> bars = {};
        double hold_s = 0.0, held_s = 0.0;  // how long it is to be held, and has been; 0: it is not
        bool operator==(const Task&) const = default;
    };
    // A table for who leads the session, which a panel in a window of its own shows. Cells of a row: as many as heads.
    struct Table {
        std::string title;
        std::vector<std::string> heads;
        std::vector<std::vector<std::string>> rows;
        bool operator==(const Table&) const = default;
    };
    std::string title, aside;  // the aside stands right of the title, in a word or two
    std::string page;          // a paragraph for the person; empty: none
    std::vector<Row> rows;
    std::vector<Button> buttons;  // side by side, in several rows where there are many
    std::string field = {};       // the act that a line of text is for, behind the buttons; empty: there is no field
    // All that is felt and seen is the activity's alone (governed.hpp): no panel, key or command changes it, and the
    // panel shows none of its sections. Buttons and field then stand at the panel's foot, where nothing moves them.
    bool governs = false;
    // The panel shows none of the scene's sections, since they are no matter of the person's; all else stays as it is.
    bool hides_scene = false;
    std::optional<Task> task = std::nullopt;
    std::vector<Table> tables = {};      // for who leads the session
    std::vector<std::string> help = {};  // paragraphs, before all other help
    bool operator==(const ActivityPanel&) const = default;
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
    // Carries out one of its acts: words[0] is one of acts(). The Error says what would be right; nothing has changed
    // then.
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
    // Returns how the hand of a glove is led by a desk, where its scene asks for something of its own; nothing: over
    // all that is seen, with the palm down. Asked once, when the session begins.
    [[nodiscard]] virtual std::optional<LedHand> led_hand() const { return std::nullopt; }
    // Returns whether stage() draws the hands, so that no tools are drawn for them.
    [[nodiscard]] virtual bool draws_hands() const { return false; }
    // Changes what a screen shows.
    virtual void stage(picture::Picture& /*scene*/, std::size_t /*screen*/) const {}
    [[nodiscard]] virtual ActivityPanel panel() const = 0;
    // Called when the session has ended and no tick comes any more: writes what it leaves.
    [[nodiscard]] virtual Result<void> finish() { return {}; }
};

// Checks that the words are an act of the activity with its arguments, with the nearest name in the Error; null: there
// is none, and every act fails.
[[nodiscard]] Result<void> check_act(const Activity* activity, std::span<const std::string> words);

}  // namespace burin::session
