// SPDX-License-Identifier: MIT
// Watches over a live session: each looks at a frame's state, keeps what it saw before, and reports when something
// begins or ends, since a message or an order per frame would help nobody. Thread: the frame's.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compute/light/surface_light.hpp"
#include "session/activity/activity.hpp"
#include "session/hands/session_hands.hpp"
#include "session/state/session_state.hpp"
#include "wall/head_prediction.hpp"

namespace burin::session {

// Watches the parallax of what is drawn.
class ComfortWatch {
public:
    // Returns a warning when the parallax has gone beyond the viewer's budget.
    [[nodiscard]] std::optional<std::string> look(const SessionState& state, const Room& room,
                                                  const haptics::ToolState& tool);

private:
    bool strained_ = false;  // the last frame's parallax was beyond the budget
};

// Watches the head's tracker.
class TrackerWatch {
public:
    // Returns a message when the tracker has lost the head, or sees it again. time_ns: session time.
    [[nodiscard]] std::optional<std::string> look(const SessionState& state, const Room& room, Nanoseconds time_ns);
    // Returns the last report; meaningless without a tracker.
    [[nodiscard]] const wall::TrackerReport& report() const { return report_; }

private:
    wall::TrackerReport report_;
};

// Watches whether wands are where they can be.
class WandWatch {
public:
    // Returns a message when a wand's tracker begins to have it farther away than any hall is long.
    [[nodiscard]] std::optional<std::string> look(const WandState& wands);

private:
    bool far_ = false;
};

// Watches whether a tracker speaks at all: one that sends elsewhere, or is off, is otherwise silent without a word.
class FirstWordWatch {
public:
    static constexpr Nanoseconds kPatience_ns = 5'000'000'000;
    explicit FirstWordWatch(std::string tracker) : tracker_(std::move(tracker)) {}
    // heard: something came since the last call. time_ns: on one clock, which begins with the first call. Returns a
    // message once, when nothing has ever come for kPatience_ns; and once more when something comes after all.
    [[nodiscard]] std::optional<std::string> look(bool heard, Nanoseconds time_ns);

private:
    std::string tracker_;  // as --tracker names it
    std::optional<Nanoseconds> begun_ns_;
    bool heard_ = false, told_ = false;
};

// Watches where the lamp stands relative to the workpiece. The lamp is fixed in the world, so that a workpiece that
// turns is lit from elsewhere.
class LampWatch {
public:
    // Returns the lamp in the object frame when the workpiece has turned and has rested since, and at first. While it
    // turns, its shadows turn with it.
    [[nodiscard]] std::optional<compute::Lamp> look(const SessionState& state, Nanoseconds time_ns);

private:
    Vec3 direction_object_{0.0}, seen_object_{0.0};  // last returned, zero: not yet; and at the last look
    Nanoseconds turned_ns_ = 0;                      // when it was another than at the look before
};

// Watches the devices of the hands: one that faults, stops sending or reports a place that cannot be gives no force,
// and nobody sees that a force is missing. A fault that comes back within kWell_ns is the same one.
class DeviceWatch {
public:
    static constexpr Nanoseconds kWell_ns = 500'000'000;

    struct News {
        std::string message;  // for the user
        EventMark event;      // for the recording
        MessageKind kind = MessageKind::error;
    };
    // Returns what has begun or ended with these tools, one of each part. A device whose parts are all lost at once is
    // named as a whole.
    [[nodiscard]] std::vector<News> look(const SessionHands& hands, std::span<const haptics::ToolState> tools);

private:
    struct Part {
        bool lost = false;
        Nanoseconds last_ns = 0;  // when it was last seen without force for its device's sake
    };
    std::vector<Part> parts_;
};

// Watches whether strokes of the mouse change anything: what seems to do nothing must say why.
class StrokeWatch {
public:
    // What a stroke has changed is known this long after it.
    static constexpr Nanoseconds kSettled_ns = 300'000'000;

    // Takes what has changed of the surface.
    void take(const sculpt::SurfaceUpdate& update);
    // Returns what a stroke that has changed nothing did not do, and why, once it is over. spacing_m: of the lattice.
    [[nodiscard]] std::optional<std::string> look(const SessionState& state, const haptics::ToolState& tool,
                                                  double spacing_m, Nanoseconds time_ns);
    // Returns when a stroke is to be judged; nothing where none is.
    [[nodiscard]] std::optional<Nanoseconds> due_ns() const { return due_ns_; }

private:
    std::size_t undoable_ = 0, undoable_before_ = 0;  // strokes, now and before this one
    bool pressed_ = false, touched_ = false;
    bool changed_ = false;  // the strokes have become more or fewer since it began
    bool told_ = false;     // the workpiece itself has told something since it began
    std::optional<Nanoseconds> due_ns_;
};

// Watches whether tool and workpiece suit one another.
class MisfitWatch {
public:
    // silent: says nothing.
    void begin(bool silent) { silent_ = silent; }
    // Returns what is wrong when that begins.
    [[nodiscard]] std::optional<std::string> look(const sculpt::ToolSettings& settings, const sculpt::Tool& tool,
                                                  double longest_side_m, double spacing_m);

private:
    bool silent_ = false, misfits_ = false;
};

}  // namespace burin::session
