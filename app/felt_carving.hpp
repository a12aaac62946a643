// SPDX-License-Identifier: MIT
// The carving side of the channels: stroke samples in, sweeps of the tool, surfaces out.
//
// Where the tool works, by what it does:
//   cut     along the cutting point (StrokeSample::cut_object_m), while the tool eats its way in; material of no hardness goes
//           away where the hand is
//   fill    where the tool rests on the surface
//   paint, smooth   where the hand is, while it touches
#pragma once

#include <optional>
#include <vector>

#include "app/carving.hpp"
#include "app/tool_option.hpp"
#include "haptics/channels.hpp"

namespace burin {

// What the tick does while the tool works so; a smoothing tool is only felt.
[[nodiscard]] ToolAction action_of(Operation operation);

class CarvingSide {
public:
    // reach_m: how far the tool may go until the next surface arrives.
    CarvingSide(Carving& carving, HapticChannels& channels, const Tool& tool, double hardness_Ns_per_m3,
                double reach_m);

    // With the samples that have come, but none after last_tick.
    [[nodiscard]] Result<void> update(Nanoseconds now_ns, std::uint64_t last_tick = UINT64_MAX);
    [[nodiscard]] Result<void> publish(Nanoseconds now_ns);

    void start_at(const Vec3& position_object) { tool_position_ = position_object; }
    // From the next sample on. The material that it leaves must be in the solid's table.
    void use_tool(const Tool& tool, double hardness_Ns_per_m3);
    // Whether the button was down in the last sample of all: what the tool does until it comes up is one stroke, also where it loses touch
    // on the way.
    [[nodiscard]] bool pressed() const { return pressed_; }
    [[nodiscard]] const Vec3& tool_position_object() const { return tool_position_; }
    // When the tool worked last, by the samples' clock; 0: never.
    [[nodiscard]] Nanoseconds last_worked_ns() const { return last_worked_ns_; }
    [[nodiscard]] std::uint64_t published() const { return sequence_; }
    // Of the last sample of all; 0: none yet.
    [[nodiscard]] std::uint64_t last_tick() const { return last_tick_; }

private:
    [[nodiscard]] std::vector<ToolSweep> drain(std::uint64_t last_tick);
    // Where the tool works in this sample; none when it only moves.
    [[nodiscard]] std::optional<Vec3> working_at(const StrokeSample& sample) const;

    Carving& carving_;
    HapticChannels& channels_;
    Tool tool_;
    double hardness_Ns_per_m3_;
    double reach_m_;
    Vec3 tool_position_{0.0};  // what the next surface is about
    Vec3 last_point_{0.0};     // where the tool worked last
    bool working_ = false;     // in the last sample of all
    bool pressed_ = false;     // likewise
    Nanoseconds last_worked_ns_ = 0;
    std::uint64_t sequence_ = 0, last_tick_ = 0;
};

}  // namespace burin
