// SPDX-License-Identifier: MIT
// The hands of a live session as its state sees them: where each begins, with which handle, and what the ticks of each
// of its parts are told. Thread: the frame's.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "session/hands/session_hands.hpp"
#include "session/live/activity_side.hpp"
#include "session/live/scene_side.hpp"
#include "session/options/session_setup.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {

class HandSide {
public:
    // Handles by hand (OpenedRoom); null: a stylus, or one that holds a tool.
    using Handles = std::vector<std::shared_ptr<const HeldHandle>>;

    // pace: as SessionHands has it.
    HandSide(const SessionSetup& setup, double pace);

    void use(Handles handles) { handles_ = std::move(handles); }
    // Opens the devices, each with its hand where the state has it. brought: the first hand; null: the session's own.
    [[nodiscard]] Result<void> open(const SessionSetup& setup, const SessionState& state, const Room& room,
                                    const BroughtHand* brought, Clock& clock);
    // Returns where the hands' tools are before the first tick. spacing_m: of the workpiece's lattice; known_m: how far
    // the activity wants the scene to be known at least.
    [[nodiscard]] std::vector<SceneSide::Beginning> beginnings(const SessionState& state, const Room& room,
                                                               double spacing_m, double known_m) const;
    // Tells the ticks of all parts what the state says, and what the activity adds.
    void publish_parameters(const SessionState& state, const Room& room, const ActivitySide& activity);
    // Has what is known around each hand reach all points of its handle: the scene has been scaled, or the motion.
    void spread(const SessionState& state, const Room& room, SceneSide& scene, const SceneSide::Give& give) const;

    // Returns, once for each hand and before anything is touched, what of the world's materials its device cannot
    // render.
    [[nodiscard]] std::vector<std::string> more_than_rendered(const SessionState& state, const Room& room) const;
    // Switches the amplifiers of a hand's device. Returns what became of it.
    struct Switched {
        bool done = false;
        std::string told;
    };
    [[nodiscard]] Switched switch_amplifiers(std::size_t hand, bool on);
    // Writes the devices as --device names them, with what was found when they were opened, into the options.
    void settle(HandsSetup& setup) const;
    // The tools that a step has, of each part.
    void take_tools(std::span<const haptics::ToolState> tools) { tools_.assign(tools.begin(), tools.end()); }
    [[nodiscard]] std::span<const haptics::ToolState> tools() const { return tools_; }
    // Returns the tool of a hand, by its first part, and those of all hands.
    [[nodiscard]] const haptics::ToolState& tool_of(std::size_t hand) const { return tools_[hands_.first_part(hand)]; }
    [[nodiscard]] std::vector<haptics::ToolState> tools_of_hands() const;

    [[nodiscard]] SessionHands& all() { return hands_; }
    [[nodiscard]] const SessionHands& all() const { return hands_; }
    [[nodiscard]] const Handles& handles() const { return handles_; }

private:
    [[nodiscard]] double spread_of(std::size_t hand, const SessionState& state, const Room& room) const;
    [[nodiscard]] Vec3 place_at_rest(std::size_t hand, const SessionState& state, const Room& room) const;

    SessionHands hands_;
    Handles handles_;
    std::vector<haptics::ToolState> tools_;
};

}  // namespace burin::session
