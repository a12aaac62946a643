// SPDX-License-Identifier: MIT
// Reads the stroke samples that the haptic thread has written and turns them into sweeps of the tool.
//
// Where the tool works depends on its operation:
//   cut            at the cutting point (ContactRecord::cut_object_m) while the tool eats its way in; material without
//                  hardness gives way wherever the hand is
//   fill           where the tool rests on the surface; where the hand is in free flight (haptics::FillPlace), in
//                  which the tool touches nothing; with Tool::fills_at_hand where the hand is while it touches: it
//                  is led along the surface, and a tool that rests on what it has just added would climb while the
//                  hand stays. It begins when the hand has come down, and leaves no lump of its way there
//   paint          where the hand is, while it touches
//   smooth         a ball about the place of the surface that it touches, since it would only graze what it rests on;
//                  another tool where the hand is, while it touches
// Frame: object, metres. Thread: that of the scene's service, which reads the ring and hands the samples on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "haptics/tick_parameters.hpp"
#include "haptics/tick_record.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::sculpt {

// Motion of the working tool since the previous read, up to the first release of the button.
struct SweptSamples {
    std::vector<compute::ToolSweep> sweeps;
    bool stroke_ended = false;  // the button came up in the last sample read; more samples may wait
};

class StrokeReader {
public:
    // Samples are merged into one sweep where that moves the tool by less than a twentieth of `cell_m`.
    StrokeReader(const toolbox::Tool& tool, double hardness_Ns_per_m3, double cell_m);

    // Takes samples, in order, behind those that have not been read yet.
    void take(std::span<const haptics::TickRecord> ticks);
    // Reads the samples taken, and stops after one in which the button came up: then more may wait.
    [[nodiscard]] SweptSamples read();
    // Changes the tool from the next sample on. Its material must be in the solid's table.
    void use_tool(const toolbox::Tool& tool, double hardness_Ns_per_m3);

    [[nodiscard]] const toolbox::Tool& tool() const { return tool_; }
    [[nodiscard]] double around_m() const { return around_m_; }  // of the tool
    // Returns whether the button was down in the last sample. A stroke lasts until the button comes up, even where the
    // tool loses contact on the way.
    [[nodiscard]] bool pressed() const { return pressed_; }
    // Returns the time of the last sample in which the tool worked; 0 before the first.
    [[nodiscard]] Nanoseconds last_worked_ns() const { return last_worked_ns_; }

private:
    [[nodiscard]] std::optional<Vec3> working_point(const haptics::TickRecord& tick) const;
    [[nodiscard]] bool is_coming_down(const haptics::TickRecord& tick);

    std::vector<haptics::TickRecord> ticks_;
    std::size_t read_ = 0;  // of ticks_
    toolbox::Tool tool_;
    double hardness_Ns_per_m3_;
    double around_m_, tolerance_m_;
    Pose last_pose_object_;  // where the tool worked last
    bool working_ = false;   // in the last sample
    bool pressed_ = false;   // in the last sample
    // Of a stroke that fills at the hand: whether the hand has come down, how deep it was in the sample before, and
    // where it is on its way.
    bool is_down_ = false;
    std::optional<double> depth_m_;
    std::optional<Pose> on_its_way_object_;
    Nanoseconds last_worked_ns_ = 0;
};

}  // namespace burin::sculpt
