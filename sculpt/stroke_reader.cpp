// SPDX-License-Identifier: MIT
#include "sculpt/stroke_reader.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sculpt/tool_mesh.hpp"

namespace burin::sculpt {
namespace {

constexpr double kSweepTolerance = 0.05;  // of a cell
constexpr double kKeepsEverySample = -1.0;
constexpr double kReachMargin = 3.0;  // cells: how far beyond itself a tool looks, when it smooths
// What the tick looks at around a tool (haptics/forces/tool_surface.hpp), of the tool's size.
constexpr double kSurroundings = 1.0;

double around(const Tool& tool) { return reach_of(tool.shape) + kSurroundings * size_of(tool.shape); }

}  // namespace

haptics::ToolAction action_of(compute::Operation operation) {
    switch (operation) {
        case compute::Operation::cut: return haptics::ToolAction::cut;
        case compute::Operation::fill: return haptics::ToolAction::fill;
        case compute::Operation::paint: return haptics::ToolAction::paint;
        case compute::Operation::smooth: break;
    }
    return haptics::ToolAction::touch;
}

StrokeReader::StrokeReader(haptics::HapticChannels& channels, const Tool& tool, double hardness_Ns_per_m3,
                           double cell_m)
    : channels_(channels),
      tool_(tool),
      hardness_Ns_per_m3_(hardness_Ns_per_m3),
      around_m_(around(tool)),
      cell_m_(cell_m) {}

void StrokeReader::use_tool(const Tool& tool, double hardness_Ns_per_m3) {
    tool_ = tool;
    around_m_ = around(tool);
    hardness_Ns_per_m3_ = hardness_Ns_per_m3;
    working_ = false;
}

void StrokeReader::take(std::uint64_t last_tick) {
    while (const haptics::StrokeSample* oldest = channels_.stroke.oldest()) {
        if (oldest->tick > last_tick) break;
        waiting_.push_back(*oldest);
        channels_.stroke.drop();
        tool_position_object_ = waiting_.back().proxy_object_m;
        last_tick_ = waiting_.back().tick;
        last_ns_ = waiting_.back().time_ns;
    }
}

SweptSamples StrokeReader::read(Nanoseconds before_ns, bool each_sample_alone) {
    SweptSamples swept;
    std::vector<Pose> run;  // points at which the tool worked without a break
    std::vector<Nanoseconds> times_ns;
    bool continues = working_;  // the run began before this read, and its first point has been carved already
    const auto add_point = [&] {
        run.push_back(last_pose_object_);
        times_ns.push_back(last_worked_ns_);
    };
    if (continues) add_point();
    const auto end_run = [&] {
        if (run.size() >= 2 || (run.size() == 1 && !continues)) {
            const double tolerance_m = each_sample_alone ? kKeepsEverySample : kSweepTolerance * cell_m_;
            std::ranges::copy(sweeps_along(run, tool_, tolerance_m), std::back_inserter(swept.sweeps));
            if (each_sample_alone)
                swept.ends_ns.insert(swept.ends_ns.end(), times_ns.begin() + (run.size() > 1 ? 1 : 0), times_ns.end());
        }
        run.clear();
        times_ns.clear();
        continues = false;
    };
    while (!waiting_.empty() && !swept.stroke_ended && waiting_.front().time_ns < before_ns) {
        const haptics::StrokeSample sample = waiting_.front();
        waiting_.pop_front();
        ++swept.samples;
        const bool was_pressed = std::exchange(pressed_, (sample.buttons & 1u) != 0);
        swept.stroke_ended = was_pressed && !pressed_;
        const std::optional<Vec3> point = working_point(sample);
        working_ = point.has_value();
        if (!working_) {
            end_run();
            continue;
        }
        last_pose_object_ = {*point, tool_.turns() ? sample.orientation_object : Quat{1, 0, 0, 0}};
        last_worked_ns_ = sample.time_ns;
        // A tool that stands still need not work twice, but where another works at the same place.
        if (run.empty() || each_sample_alone || run.back() != last_pose_object_) add_point();
    }
    end_run();
    return swept;
}

std::optional<Nanoseconds> StrokeReader::oldest_ns() const {
    if (waiting_.empty()) return std::nullopt;
    return waiting_.front().time_ns;
}

std::optional<Nanoseconds> StrokeReader::release_ns(Nanoseconds before_ns) const {
    bool pressed = pressed_;
    for (const haptics::StrokeSample& sample : waiting_) {
        if (sample.time_ns >= before_ns) break;
        const bool was_pressed = std::exchange(pressed, (sample.buttons & 1u) != 0);
        if (was_pressed && !pressed) return sample.time_ns;
    }
    return std::nullopt;
}

Box StrokeReader::reach_object(Nanoseconds before_ns) const {
    Box box;
    for (const haptics::StrokeSample& sample : waiting_) {
        if (sample.time_ns >= before_ns) break;
        if (const std::optional<Vec3> point = working_point(sample)) box.include(*point);
    }
    if (box.empty()) return box;
    if (working_) box.include(last_pose_object_.position_m);
    const Vec3 reach_m(reach_of(tool_.shape) + kReachMargin * cell_m_);
    return {box.lo - reach_m, box.hi + reach_m};
}

// Returns where the tool works in this sample; nothing where it only moves.
std::optional<Vec3> StrokeReader::working_point(const haptics::StrokeSample& sample) const {
    if ((sample.buttons & 1u) == 0 || sample.phase != haptics::WorkspacePhase::editing) return std::nullopt;
    switch (tool_.operation) {
        case compute::Operation::cut:
            if (hardness_Ns_per_m3_ == 0.0) return sample.position_object_m;
            if ((sample.flags & haptics::kTickCutting) != 0) return sample.cut_object_m;
            return std::nullopt;
        case compute::Operation::fill: return sample.proxy_object_m;
        case compute::Operation::paint:
        case compute::Operation::smooth:
            if ((sample.flags & haptics::kTickInContact) != 0) return sample.position_object_m;
            return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace burin::sculpt
