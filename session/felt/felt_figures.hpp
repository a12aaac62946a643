// SPDX-License-Identifier: MIT
// Summarises the tick records of a felt session: forces, what was touched and cut, when the force was silent and why,
// and a trace for plots. Takes every record; reports on standard error, as soon as it happens, that the force goes
// silent or that a material is rendered less stiff than it is.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "haptics/tick_record.hpp"
#include "haptics/tool_state.hpp"

namespace burin::haptics {
struct HapticChannels;  // haptics/channels.hpp
}  // namespace burin::haptics

namespace burin::session {

// One tick of the trace.
struct TracePoint {
    double time_s = 0.0;
    Vec3 hip_object_m{0.0}, proxy_object_m{0.0}, cut_object_m{0.0};
    Vec3 normal_object{0.0};  // of the contact
    Vec3 force_device_N{0.0};
    // Of the contact on the tool, about the place where the hand holds it, whether the device drives torques or not.
    Vec3 torque_device_Nm{0.0};
    double penetration_m = 0.0;
    std::uint32_t flags = 0;
};

// Counts a condition that holds in some ticks and not in others.
struct Occurrence {
    std::uint64_t ticks = 0;
    std::uint64_t times = 0;  // runs of consecutive ticks
    double first_s = 0.0;     // since the session's start
    std::uint64_t last_tick = 0;
};

// Timing of a loop in real time.
struct LoopTimes {
    bool known = false;
    std::uint64_t skipped_deadlines = 0;
    double late_us_median = 0.0, late_us_p99 = 0.0, late_us_p999 = 0.0, late_us_max = 0.0;
    double tick_us_median = 0.0, tick_us_p99 = 0.0, tick_us_p999 = 0.0, tick_us_max = 0.0;
};

struct FeltFigures {
    Similarity object_from_device;  // how the stroke was fitted into the device's workspace
    Vec3 workspace_device_m{0.0};
    double duration_s = 0.0;
    std::uint64_t ticks = 0;
    std::uint64_t ticks_in_contact = 0;
    std::uint64_t ticks_cutting = 0;
    std::uint64_t samples_dropped = 0;
    std::uint64_t records_lost = 0;
    std::uint64_t surfaces_published = 0;
    double force_max_N = 0.0;
    double force_mean_in_contact_N = 0.0;
    double force_mean_cutting_N = 0.0;
    double penetration_max_m = 0.0;             // in the object frame
    std::map<std::string, Occurrence> silent;   // by the gate's cause, in words
    std::map<std::string, Occurrence> limited;  // limited stiffness by the bound, in words
    // Late ticks, lost ticks, damping that the controller added, and the like.
    std::map<std::string, Occurrence> degraded;
    std::vector<TracePoint> trace;       // decimated
    std::vector<TracePoint> closeup;     // every tick of about the first second in which the tool cuts
    double trace_period_s = 0.0;         // between the trace's points
    std::vector<std::uint32_t> tick_ns;  // cost of each tick in simulated time; empty in real time
    LoopTimes loop;                      // in real time
    std::vector<std::string> notices;    // e.g. no real-time priority
    haptics::ToolState last_tool;
};

class FigureKeeper {
public:
    // Prepares for a session of this length. The trace has at most kMostTracePoints points; each is the tick with the
    // largest force of its interval.
    FigureKeeper(FeltFigures& figures, double duration_s, double period_s);

    static constexpr std::uint64_t kMostTracePoints = 4000;
    static constexpr std::size_t kCloseupTicks = 1000;

    void add(const haptics::TickRecord& record);
    void finish(const haptics::HapticChannels& channels);

private:
    void note(std::map<std::string, Occurrence>& where, const std::string& what, const haptics::TickRecord& record);
    void trace(const haptics::TickRecord& record);

    FeltFigures& figures_;
    std::uint64_t stretch_ = 1;  // ticks for each point of the trace
    Nanoseconds start_ns_ = 0;
    double force_sum_N_ = 0.0, cutting_sum_N_ = 0.0;
    TracePoint pending_;
    double pending_force_N_ = -1.0;
};

// ---- Plots (felt_plot.cpp)

// Returns the SVG: the whole session at the left, the first second in which the tool cuts at the right, with heights
// along its mean contact normal across the direction of motion.
[[nodiscard]] std::string felt_figure(const FeltFigures& felt);

// Returns the trace as CSV, one point a line: time_s; HIP, proxy and cutting point in the object frame (metres); force
// at the device (newtons); torque of the contact (newton metres); penetration (metres); in_contact and cutting (0 or
// 1).
[[nodiscard]] std::string felt_table(const FeltFigures& felt);

// Paths of the files: report.json -> report-felt.svg, report-felt.csv; report-depth.svg, the force over the depth.
[[nodiscard]] std::string felt_figure_path(const std::string& report);
[[nodiscard]] std::string felt_table_path(const std::string& report);
[[nodiscard]] std::string felt_depth_path(const std::string& report);

}  // namespace burin::session
