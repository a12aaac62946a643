// SPDX-License-Identifier: MIT
#include "sculpt/stroke_reader.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "toolbox/tool_mesh.hpp"
#include "workpiece/carve_order.hpp"

namespace burin::sculpt {
namespace {

constexpr double kSweepTolerance = 0.05;  // of a cell
// Of a tool's size, in a tick: a hand that goes deeper by less has come down.
constexpr double kComesDown = 0.001;

}  // namespace

StrokeReader::StrokeReader(const toolbox::Tool& tool, double hardness_Ns_per_m3, double cell_m)
    : tool_(tool),
      hardness_Ns_per_m3_(hardness_Ns_per_m3),
      around_m_(toolbox::around_m(tool)),
      tolerance_m_(kSweepTolerance * cell_m) {}

void StrokeReader::use_tool(const toolbox::Tool& tool, double hardness_Ns_per_m3) {
    tool_ = tool;
    around_m_ = toolbox::around_m(tool);
    hardness_Ns_per_m3_ = hardness_Ns_per_m3;
    working_ = false;
}

void StrokeReader::take(std::span<const haptics::TickRecord> ticks) {
    ticks_.erase(ticks_.begin(), ticks_.begin() + static_cast<std::ptrdiff_t>(read_));
    read_ = 0;
    ticks_.insert(ticks_.end(), ticks.begin(), ticks.end());
}

SweptSamples StrokeReader::read() {
    SweptSamples swept;
    std::vector<Pose> run;      // points at which the tool worked without a break
    bool continues = working_;  // the run began before this read, and its first point has been carved already
    if (continues) run.push_back(last_pose_object_);
    const auto end_run = [&] {
        if (run.size() >= 2 || (run.size() == 1 && !continues)) {
            std::ranges::copy(toolbox::sweeps_along(run, tool_, tolerance_m_), std::back_inserter(swept.sweeps));
        }
        run.clear();
        continues = false;
    };
    while (!swept.stroke_ended && read_ < ticks_.size()) {
        const haptics::TickRecord& tick = ticks_[read_++];
        const bool was_pressed = std::exchange(pressed_, (tick.sample.buttons & 1u) != 0);
        swept.stroke_ended = was_pressed && !pressed_;
        const std::optional<Vec3> point = working_point(tick);
        working_ = point.has_value() && !is_coming_down(tick);
        if (swept.stroke_ended && on_its_way_object_)
            run.push_back(*on_its_way_object_);  // a click: no time to come down
        if (!pressed_ || (tick.sample.buttons & workpiece::kOverAir) != 0) {
            is_down_ = false;
            depth_m_.reset();
            on_its_way_object_.reset();
        }
        if (!working_) {
            end_run();
            continue;
        }
        last_pose_object_ = {*point, tool_.turns() ? tick.motion.orientation_object : Quat{1, 0, 0, 0}};
        last_worked_ns_ = tick.time_ns;
        if (run.empty() || run.back() != last_pose_object_) run.push_back(last_pose_object_);
    }
    end_run();
    return swept;
}

// Returns whether the tool is to wait with its filling, because the hand is on its way down to the surface.
bool StrokeReader::is_coming_down(const haptics::TickRecord& tick) {
    if (tool_.operation != compute::Operation::fill || !tool_.fills_at_hand || is_down_) return false;
    const haptics::PointRecord& point = tick.contact.points[0];
    const double depth_m = glm::dot(point.proxy_object_m - point.hip_object_m, point.normal_object);
    const std::optional<double> before_m = std::exchange(depth_m_, depth_m);
    is_down_ = before_m && depth_m - *before_m < kComesDown * toolbox::size_of(tool_.shape);
    on_its_way_object_ = Pose{point.hip_object_m, tool_.turns() ? tick.motion.orientation_object : Quat{1, 0, 0, 0}};
    if (is_down_) on_its_way_object_.reset();
    return !is_down_;
}

// Returns where the tool works in this tick; nothing where it only moves.
std::optional<Vec3> StrokeReader::working_point(const haptics::TickRecord& tick) const {
    if ((tick.sample.buttons & 1u) == 0 || tick.motion.workspace.phase != haptics::WorkspacePhase::editing)
        return std::nullopt;
    switch (tool_.operation) {
        case compute::Operation::cut:
            if (hardness_Ns_per_m3_ == 0.0) return tick.contact.points[0].hip_object_m;
            if ((tick.flags & haptics::kTickCutting) != 0) return tick.contact.cut_object_m;
            return std::nullopt;
        case compute::Operation::fill:
            if (!tool_.fills_at_hand) return tick.contact.points[0].proxy_object_m;
            if ((tick.sample.buttons & workpiece::kOverAir) != 0) return std::nullopt;
            if ((tick.flags & haptics::kTickInContact) != 0) return tick.contact.points[0].hip_object_m;
            return std::nullopt;
        case compute::Operation::paint:
            if ((tick.flags & haptics::kTickInContact) != 0) return tick.contact.points[0].hip_object_m;
            return std::nullopt;
        case compute::Operation::smooth: {
            if ((tick.flags & haptics::kTickInContact) == 0) return std::nullopt;
            const haptics::PointRecord& point = tick.contact.points[0];
            if (tool_.turns()) return point.hip_object_m;
            return point.proxy_object_m - tool_.ball_radius_m() * point.normal_object;
        }
    }
    return std::nullopt;
}

}  // namespace burin::sculpt
