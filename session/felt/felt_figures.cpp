// SPDX-License-Identifier: MIT
#include "session/felt/felt_figures.hpp"

#include "haptics/channels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace burin::session {
namespace {

// Ticks of the closeup before the first tick that cuts.
constexpr std::size_t kLeadTicks = 100;

// Names the flags of a degraded tick.
struct Degraded {
    std::uint32_t flag;
    const char* words;
};
constexpr std::array kDegraded{Degraded{haptics::kTickLate, "tick began late"},
                               Degraded{haptics::kTickLoopGap, "ticks were lost before this one"},
                               Degraded{haptics::kTickWorkLimited, "the work of a tick was used up"},
                               Degraded{haptics::kTickForceSaturated, "the force limit cut"},
                               Degraded{haptics::kTickSlewLimited, "the slew limit cut"},
                               Degraded{haptics::kTickPassivityActs, "the passivity controller added damping"},
                               Degraded{haptics::kTickPushedOut, "the tool was inside material and was put outside"},
                               Degraded{haptics::kTickDoubted, "no sound contact was found: its force faded out"},
                               Degraded{haptics::kTickHeldOver, "a part was held on its last planes"}};

}  // namespace

FigureKeeper::FigureKeeper(FeltFigures& figures, double duration_s, double period_s) : figures_(figures) {
    const double ticks = std::ceil(duration_s / period_s);
    stretch_ = static_cast<std::uint64_t>(std::max(1.0, std::ceil(ticks / double{kMostTracePoints})));
    figures_.trace_period_s = static_cast<double>(stretch_) * period_s;
}

void FigureKeeper::finish(const haptics::HapticChannels& channels) {
    if (pending_force_N_ >= 0.0) figures_.trace.push_back(pending_);
    pending_force_N_ = -1.0;
    const auto mean = [](double sum, std::uint64_t count) {
        return count > 0 ? sum / static_cast<double>(count) : 0.0;
    };
    figures_.force_mean_in_contact_N = mean(force_sum_N_, figures_.ticks_in_contact);
    figures_.force_mean_cutting_N = mean(cutting_sum_N_, figures_.ticks_cutting);
    figures_.records_lost = channels.records.refused();
}

void FigureKeeper::add(const haptics::TickRecord& record) {
    if (figures_.ticks == 0) start_ns_ = record.time_ns;
    ++figures_.ticks;
    const double force_N = glm::length(record.gate.given.force_device_N);
    figures_.force_max_N = std::max(figures_.force_max_N, force_N);
    if ((record.flags & haptics::kTickInContact) != 0) {
        ++figures_.ticks_in_contact;
        force_sum_N_ += force_N;
        figures_.penetration_max_m = std::max(figures_.penetration_max_m, record.deepest().penetration_m);
    }
    if ((record.flags & haptics::kTickCutting) != 0) {
        ++figures_.ticks_cutting;
        cutting_sum_N_ += force_N;
    }
    if ((record.flags & haptics::kTickSampleDropped) != 0) ++figures_.samples_dropped;
    for (const Degraded& kind : kDegraded)
        if ((record.flags & kind.flag) != 0) note(figures_.degraded, kind.words, record);
    if (record.contact.stiffness_bound != haptics::StiffnessBound::none)
        note(figures_.limited, haptics::text(record.contact.stiffness_bound), record);
    if (record.gate.cause != haptics::GateCause::none) note(figures_.silent, haptics::text(record.gate.cause), record);
    trace(record);
}

// Counts an occurrence and reports the first one.
void FigureKeeper::note(std::map<std::string, Occurrence>& where, const std::string& what,
                        const haptics::TickRecord& record) {
    Occurrence& o = where[what];
    const double now_s = seconds(record.time_ns - start_ns_);
    if (o.ticks == 0) {
        o.first_s = now_s;
        if (&where != &figures_.degraded) std::fprintf(stderr, "burin: at %.3f s: %s\n", now_s, what.c_str());
    }
    if (o.ticks == 0 || record.tick != o.last_tick + 1) ++o.times;
    ++o.ticks;
    o.last_tick = record.tick;
}

void FigureKeeper::trace(const haptics::TickRecord& record) {
    const TracePoint point{seconds(record.time_ns - start_ns_),
                           record.deepest().hip_object_m,
                           record.deepest().proxy_object_m,
                           record.contact.cut_object_m,
                           record.deepest().normal_object,
                           record.gate.given.force_device_N,
                           record.contact.wrench.torque_device_Nm,
                           record.deepest().penetration_m,
                           record.flags};
    const bool begun = figures_.ticks_cutting > 0;
    if (figures_.closeup.size() < kCloseupTicks) {
        if (!begun && figures_.closeup.size() >= kLeadTicks) figures_.closeup.erase(figures_.closeup.begin());
        figures_.closeup.push_back(point);
    }
    const double force_N = glm::length(point.force_device_N);
    if (force_N > pending_force_N_) {
        pending_force_N_ = force_N;
        pending_ = point;
    }
    if (figures_.ticks % stretch_ != 0) return;
    figures_.trace.push_back(pending_);
    pending_force_N_ = -1.0;
}

}  // namespace burin::session
