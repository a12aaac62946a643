// SPDX-License-Identifier: MIT
#include "session/live/session_watch.hpp"

#include <utility>

#include "renderer/scene/frame_setup.hpp"

namespace burin::session {
namespace {

// Turn of the lamp, in radians, after which shadows are computed anew while the workpiece is being turned.
constexpr double kShadowsFollow = 0.1;

}  // namespace

std::optional<std::string> ComfortWatch::look(const SessionState& state, const Room& room,
                                              const haptics::ToolState& tool) {
    if (wall::needs_of(state.output.mode).one_eye_point) return std::nullopt;
    const wall::ComfortFinding finding = comfort_of(state, room, tool);
    const bool strains = finding.crossed_too_much || finding.uncrossed_too_much;
    if (std::exchange(strained_, strains) || !strains) return std::nullopt;
    return wall::warning_of(finding, room.wall.setup.budget);
}

std::optional<std::string> TrackerWatch::look(const SessionState& state, const Room& room, Nanoseconds time_ns) {
    if (!state.head.tracked) return std::nullopt;
    const wall::TrackerState before = report_.state;
    report_ = wall::report(wall::head_settings(room.wall.setup), state.head.track, time_ns);
    if (report_.state == before) return std::nullopt;
    if (report_.state == wall::TrackerState::ok) {
        if (before == wall::TrackerState::waiting) return std::nullopt;
        return "the tracker sees the head again";
    }
    // A loss is reported once, until the tracker has been well again.
    if (before != wall::TrackerState::ok && before != wall::TrackerState::waiting) return std::nullopt;
    return "head tracker: " + report_.cause;
}

// While the workpiece turns its shadows follow in steps.
std::optional<compute::Lamp> LampWatch::look(const SessionState& state) {
    const Vec3 direction = inverse(state.world_from_object.orientation) * renderer::direction_to_light();
    const bool turning = state.desk.drag.has_value();
    if (glm::length(direction - direction_object_) <= (turning ? kShadowsFollow : 1e-9)) return std::nullopt;
    direction_object_ = direction;
    return compute::Lamp{direction, renderer::kLightHalfAngleTangent};
}

}  // namespace burin::session
