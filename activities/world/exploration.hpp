// SPDX-License-Identifier: MIT
// A world explored by a hand that a script leads, as an activity: it brings the hand, says what its ticks are told, and
// hands on what was felt. A session file that is recorded of it is a live session's
// (session/drive/headless_session.hpp); of the settings in its facts, and the wand, replay makes it anew.
//
//   script -> device -> haptic loop (1 kHz) -> the scene's service (100 Hz) -> step() -> on_tick, on_update
//
// Frame: the scene's, metres; forces at the device, newtons. Thread: the frame's.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "activities/world/exploration_settings.hpp"
#include "record/record_reader.hpp"
#include "session/activity/activity.hpp"
#include "session/activity/brought_hand.hpp"
#include "session/activity/recorded_activity.hpp"

namespace burin::activities {

// Functions that are told how an exploration goes; each may be null.
struct FeltBy {
    std::function<void(const haptics::TickRecord& tick)> on_tick = {};
    // At the beginning, and whenever an update of the scene has been felt; a failure ends the exploration.
    std::function<Result<void>()> on_update = {};
};

class Exploration final : public session::Activity {
public:
    static constexpr std::string_view kName = "world";

    // The hand's place is as the settings have it, whose mapping, start and reach count.
    Exploration(const ExplorationSettings& settings, session::BroughtHand hand, FeltBy felt_by = {});

    [[nodiscard]] std::string settings() const override { return std::string(kName) + " --stroke"; }
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> facts() const override;
    [[nodiscard]] Result<void> act(std::span<const std::string> words, session::ActivityOrders& orders) override;
    void step(const session::ActivityView& view, session::ActivityOrders& orders) override;
    void adjust(session::PartOfHand of, haptics::TickParameters& parameters) const override;
    [[nodiscard]] const session::BroughtHand* brought_hand() const override { return &hand_; }
    [[nodiscard]] session::ActivityPanel panel() const override;

    // Returns why it ended before its script; nothing where it did not.
    [[nodiscard]] const Result<void>& outcome() const { return outcome_; }

private:
    ExplorationSettings settings_;
    session::BroughtHand hand_;
    FeltBy felt_by_;
    bool has_begun_ = false;
    Result<void> outcome_;
};

// The fact of a recording that has the settings of its exploration.
inline constexpr const char* kExplorationFact = "exploration";
// Returns the settings of a recorded exploration, also of one from before it was a session. Fails on a recording of
// anything else.
[[nodiscard]] Result<ExplorationSettings> recorded_settings(const record::RecordReader& reader);
// Makes it anew of a recording's facts, without the script that led it.
[[nodiscard]] Result<session::MadeActivity> exploration_as_recorded(const std::string& settings,
                                                                    const session::RecordedFact& fact);

}  // namespace burin::activities
