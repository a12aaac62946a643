// SPDX-License-Identifier: MIT
// Reads the stroke samples that the haptic thread has written and turns them into sweeps of the tool.
//
// Where the tool works depends on its operation:
//   cut            at the cutting point (StrokeSample::cut_object_m) while the tool eats its way in; material without
//                  hardness gives way wherever the hand is
//   fill           where the tool rests on the surface
//   paint, smooth  where the hand is, while it touches
// Samples are read up to a time, so that those of several hands can be carved in the order of their times. Where this
// order matters, each sample is a sweep of its own; else as few sweeps as possible stand for them.
// Frame: object, metres. Thread: the carving thread, the only reader of the ring.
#pragma once

#include <cstdint>
#include <deque>
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
    std::vector<Nanoseconds> ends_ns;  // of each sweep, where each sample has its own: the time of that sample
    std::size_t samples = 0;           // read
    bool stroke_ended = false;         // the button came up in the last sample read; more samples may wait
};

class StrokeReader {
public:
    // Samples are merged into one sweep where that moves the tool by less than a twentieth of `cell_m`.
    StrokeReader(haptics::HapticChannels& channels, const Tool& tool, double hardness_Ns_per_m3, double cell_m);

    // Takes the samples of ticks up to `last_tick` from the ring; they wait here until they are read.
    void take(std::uint64_t last_tick);
    // Reads samples of times before `before_ns`, and stops after a sample in which the button came up.
    [[nodiscard]] SweptSamples read(Nanoseconds before_ns, bool each_sample_alone = false);
    // Changes the tool from the next sample on. Its material must be in the solid's table.
    void use_tool(const Tool& tool, double hardness_Ns_per_m3);
    // Sets where the tool is before the first sample.
    void start_at(const Vec3& position_object) { tool_position_object_ = position_object; }

    [[nodiscard]] const Tool& tool() const { return tool_; }
    // Returns the radius of a ball about the tool's place that holds the tool and what the tick looks at around it.
    [[nodiscard]] double around_m() const { return around_m_; }
    // Returns whether the button was down in the last sample read. A stroke lasts until the button comes up, even where
    // the tool loses contact on the way.
    [[nodiscard]] bool pressed() const { return pressed_; }
    // Returns the time of the last sample read in which the tool worked; 0 before the first.
    [[nodiscard]] Nanoseconds last_worked_ns() const { return last_worked_ns_; }

    // Of the last sample taken: where the tool is, its tick and its time; 0 before the first.
    [[nodiscard]] const Vec3& tool_position_object() const { return tool_position_object_; }
    [[nodiscard]] std::uint64_t last_tick() const { return last_tick_; }
    [[nodiscard]] Nanoseconds last_ns() const { return last_ns_; }

    // What waits to be read: the time of the oldest sample, if any; of the first before `before_ns` in which the button
    // comes up; and the box of all that the tool reaches where it works in those before `before_ns`.
    [[nodiscard]] std::optional<Nanoseconds> oldest_ns() const;
    [[nodiscard]] std::optional<Nanoseconds> release_ns(Nanoseconds before_ns) const;
    [[nodiscard]] Box reach_object(Nanoseconds before_ns) const;

private:
    [[nodiscard]] std::optional<Vec3> working_point(const haptics::StrokeSample& sample) const;

    haptics::HapticChannels& channels_;
    Tool tool_;
    double hardness_Ns_per_m3_;
    double around_m_;  // how far from its place the tool and what it is felt by reach
    double cell_m_;
    std::deque<haptics::StrokeSample> waiting_;
    Vec3 tool_position_object_{0.0};
    Pose last_pose_object_;  // where the tool worked last
    bool working_ = false;   // in the last sample read
    bool pressed_ = false;   // in the last sample read
    Nanoseconds last_worked_ns_ = 0;
    std::uint64_t last_tick_ = 0;
    Nanoseconds last_ns_ = 0;
};

}  // namespace burin::sculpt
