// SPDX-License-Identifier: MIT
// Reads the stroke samples that the haptic thread has written and turns them into sweeps of the tool.
//
// Where the tool works depends on its operation:
//   cut            at the cutting point (StrokeSample::cut_object_m) while the tool eats its way in; material without
//                  hardness gives way wherever the hand is
//   fill           where the tool rests on the surface
//   paint, smooth  where the hand is, while it touches
// Frame: object, metres. Thread: the carving thread, the only reader of the ring.
#pragma once

#include <optional>
#include <vector>

#include "haptics/channels.hpp"
#include "sculpt/tool_options.hpp"

namespace burin::sculpt {

// Returns what the tick does while the tool works with this operation. Smoothing has no force of its own: its tool only
// touches.
[[nodiscard]] haptics::ToolAction action_of(compute::Operation operation);

// Motion of the working tool since the previous read, up to the first release of the button.
struct SweptSamples {
    std::vector<compute::ToolSweep> sweeps;
    bool stroke_ended = false;  // the button came up in the last sample read; more samples may wait
};

class StrokeReader {
public:
    // Samples are merged into one sweep where that moves the tool by less than a twentieth of `cell_m`.
    StrokeReader(haptics::HapticChannels& channels, const Tool& tool, double hardness_Ns_per_m3, double cell_m);

    // Reads samples of ticks up to `last_tick`, and stops after a sample in which the button came up.
    [[nodiscard]] SweptSamples read(std::uint64_t last_tick);
    // Changes the tool from the next sample on. Its material must be in the solid's table.
    void use_tool(const Tool& tool, double hardness_Ns_per_m3);
    // Sets where the tool is before the first sample.
    void start_at(const Vec3& position_object) { tool_position_object_ = position_object; }

    [[nodiscard]] const Tool& tool() const { return tool_; }
    // Returns the radius of a ball about the tool's place that holds the tool and what the tick looks at around it.
    [[nodiscard]] double around_m() const { return around_m_; }
    // Returns whether the button was down in the last sample. A stroke lasts until the button comes up, even where the
    // tool loses contact on the way.
    [[nodiscard]] bool pressed() const { return pressed_; }
    [[nodiscard]] const Vec3& tool_position_object() const { return tool_position_object_; }
    // Returns the time of the last sample in which the tool worked; 0 before the first.
    [[nodiscard]] Nanoseconds last_worked_ns() const { return last_worked_ns_; }
    // Returns the tick of the last sample; 0 before the first.
    [[nodiscard]] std::uint64_t last_tick() const { return last_tick_; }

private:
    [[nodiscard]] std::optional<Vec3> working_point(const haptics::StrokeSample& sample) const;

    haptics::HapticChannels& channels_;
    Tool tool_;
    double hardness_Ns_per_m3_;
    double around_m_, tolerance_m_;
    Vec3 tool_position_object_{0.0};
    Pose last_pose_object_;  // where the tool worked last
    bool working_ = false;   // in the last sample
    bool pressed_ = false;   // in the last sample
    Nanoseconds last_worked_ns_ = 0;
    std::uint64_t last_tick_ = 0;
};

}  // namespace burin::sculpt
