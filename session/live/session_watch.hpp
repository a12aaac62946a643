// SPDX-License-Identifier: MIT
// Watches over a live session: each looks at a frame's state, keeps what it saw before, and reports when something
// begins or ends, since a message or an order per frame would help nobody. Thread: the frame's.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compute/light/surface_light.hpp"
#include "scene/surface_update.hpp"
#include "session/activity/activity.hpp"
#include "session/hands/session_hands.hpp"
#include "session/notices/message_kind.hpp"
#include "session/state/leader.hpp"

namespace burin::toolbox {
struct Tool;  // toolbox/tool_options.hpp
struct ToolSettings;
}  // namespace burin::toolbox

namespace burin::session {

// Watches where the lamp stands relative to the workpiece. The lamp is fixed in the world, so that a workpiece that
// turns is lit from elsewhere.
class LampWatch {
public:
    // Returns the lamp in the object frame when the workpiece has turned and has rested since, and at first. While it
    // turns, its shadows turn with it. turns_it: somebody holds what turns it.
    [[nodiscard]] std::optional<compute::Lamp> look(const SessionState& state, bool turns_it, Nanoseconds time_ns);

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
    void take(const scene::SurfaceUpdate& update);
    // Returns what a stroke that has changed nothing did not do, and why, once it is over. depth_m: of a stroke as the
    // mouse leads it; spacing_m: of the lattice.
    [[nodiscard]] std::optional<std::string> look(const SessionState& state, const haptics::ToolState& tool,
                                                  double depth_m, double spacing_m, Nanoseconds time_ns);
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
    [[nodiscard]] std::optional<std::string> look(const toolbox::ToolSettings& settings, const toolbox::Tool& tool,
                                                  double longest_side_m, double spacing_m);

private:
    bool silent_ = false, misfits_ = false;
};

}  // namespace burin::session
