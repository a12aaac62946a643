// SPDX-License-Identifier: MIT
#include "activities/rehab/exercise/run_control.hpp"

#include <array>
#include <string>

namespace burin::activities {
namespace {

constexpr std::array<std::string_view, 4> kRunOrders{"start", "pause", "rest", "stop"};

}  // namespace

std::string_view name_of(RunOrder order) { return kRunOrders[static_cast<std::size_t>(order)]; }

bool RunControl::takes(RunOrder order) const {
    if (phase == RunPhase::stopped) return false;
    const bool goes_on = phase == RunPhase::runs || phase == RunPhase::settles;
    switch (order) {
        case RunOrder::start: return !goes_on;
        case RunOrder::pause: return goes_on || phase == RunPhase::rests;
        case RunOrder::rest: return goes_on || phase == RunPhase::paused;
        case RunOrder::stop: return true;
    }
    return false;
}

Result<RunControl> with_order(RunControl control, RunOrder order) {
    if (!control.takes(order)) {
        const std::string what = "do " + std::string(name_of(order));
        if (control.phase == RunPhase::stopped) return fail(what, "comes too late: it has been stopped", "begin anew");
        if (control.phase == RunPhase::ready) return fail(what, "comes too early", "begin with do start");
        if (order == RunOrder::start) return fail(what, "is of no use: it is under way", "do pause, rest or stop");
        return fail(what, "is of no use: it is so already", "do start to go on");
    }
    control.was_told = true;
    switch (order) {
        case RunOrder::start:
            control.settles_s = 0.0;
            control.phase = control.phase == RunPhase::ready ? RunPhase::runs : RunPhase::settles;
            break;
        case RunOrder::pause:
            control.phase = RunPhase::paused;
            ++control.pauses;
            break;
        case RunOrder::rest:
            control.phase = RunPhase::rests;
            ++control.rests;
            break;
        case RunOrder::stop: control.phase = RunPhase::stopped; break;
    }
    return control;
}

RunControl with_turn(RunControl control, Nanoseconds now_ns, bool let_go) {
    const Nanoseconds since_ns = control.last_ns > 0 ? now_ns - control.last_ns : 0;
    control.last_ns = now_ns;
    if (control.phase == RunPhase::runs) return control;
    control.away_ns += since_ns;
    if (control.phase == RunPhase::paused) control.paused_s += seconds(since_ns);
    if (control.phase == RunPhase::rests) control.rested_s += seconds(since_ns);
    if (control.phase != RunPhase::settles) return control;
    control.settles_s += seconds(since_ns);
    if (control.settles_s >= RunControl::kFadesIn_s && let_go) control.phase = RunPhase::runs;
    return control;
}

}  // namespace burin::activities
