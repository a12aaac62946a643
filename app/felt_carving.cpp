// SPDX-License-Identifier: MIT
#include "app/felt_carving.hpp"

#include <algorithm>
#include <iterator>

namespace burin {
namespace {

constexpr double kSweepTolerance = 0.05;  // of a cell
// What is known around the tool: its own ball, and what the tick looks at to see how deep it lies (haptics/forces/engagement.hpp).
constexpr double kSurroundings = 1.6;

}  // namespace

ToolAction action_of(Operation operation) {
    switch (operation) {
        case Operation::cut: return ToolAction::cut;
        case Operation::fill: return ToolAction::fill;
        case Operation::paint: return ToolAction::paint;
        case Operation::smooth: break;
    }
    return ToolAction::touch;
}

CarvingSide::CarvingSide(Carving& carving, HapticChannels& channels, const Tool& tool, double hardness_Ns_per_m3,
                         double reach_m)
    : carving_(carving), channels_(channels), tool_(tool), hardness_Ns_per_m3_(hardness_Ns_per_m3), reach_m_(reach_m) {}

void CarvingSide::use_tool(const Tool& tool, double hardness_Ns_per_m3) {
    tool_ = tool;
    hardness_Ns_per_m3_ = hardness_Ns_per_m3;
    working_ = false;
}

Result<void> CarvingSide::update(Nanoseconds now_ns, std::uint64_t last_tick) {
    const std::vector<ToolSweep> sweeps = drain(last_tick);
    if (!sweeps.empty()) {
        if (const auto updated = carving_.update(sweeps); !updated) return updated;
    }
    return publish(now_ns);
}

Result<void> CarvingSide::publish(Nanoseconds now_ns) {
    LocalSurface& surface = channels_.surface.draft();
    const double radius_m = kSurroundings * tool_.ball_radius_m() + reach_m_;
    if (const auto done = carving_.local_surface(tool_position_, radius_m, surface); !done) return done;
    surface.sequence = ++sequence_;
    surface.made_ns = now_ns;
    channels_.surface.publish();
    return {};
}

// What the working tool has swept since the last update.
std::vector<ToolSweep> CarvingSide::drain(std::uint64_t last_tick) {
    std::vector<ToolSweep> sweeps;
    std::vector<Pose> run;    // where the tool worked without a break
    bool goes_on = working_;  // the run began before this update: its first point has been cut already
    if (goes_on) run.push_back({last_point_});
    const double tolerance_m = kSweepTolerance * carving_.surface().lattice().spacing_m;
    const auto end_run = [&] {
        if (run.size() >= 2 || (run.size() == 1 && !goes_on)) {
            std::ranges::copy(sweeps_along(run, tool_, tolerance_m), std::back_inserter(sweeps));
        }
        run.clear();
        goes_on = false;
    };
    while (const StrokeSample* oldest = channels_.stroke.oldest()) {
        if (oldest->tick > last_tick) break;
        StrokeSample sample;
        channels_.stroke.pop(sample);
        last_tick_ = sample.tick;
        tool_position_ = sample.proxy_object_m;
        pressed_ = (sample.buttons & 1u) != 0;
        const std::optional<Vec3> point = working_at(sample);
        working_ = point.has_value();
        if (!working_) {
            end_run();
            continue;
        }
        last_point_ = *point;
        last_worked_ns_ = sample.time_ns;
        if (run.empty() || run.back().position_m != last_point_) run.push_back({last_point_});
    }
    end_run();
    return sweeps;
}

std::optional<Vec3> CarvingSide::working_at(const StrokeSample& sample) const {
    if ((sample.buttons & 1u) == 0 || sample.phase != WorkspacePhase::editing) return std::nullopt;
    switch (tool_.operation) {
        case Operation::cut:
            if (hardness_Ns_per_m3_ == 0.0) return sample.position_object_m;
            if ((sample.flags & kTickCutting) != 0) return sample.cut_object_m;
            return std::nullopt;
        case Operation::fill: return sample.proxy_object_m;
        case Operation::paint:
        case Operation::smooth:
            if ((sample.flags & kTickInContact) != 0) return sample.position_object_m;
            return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace burin
