// SPDX-License-Identifier: MIT
#include "bench/stability/stability.hpp"

#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "base/worker_pool.hpp"
#include "bench/stability/whole_ticks.hpp"

namespace burin::bench {
namespace {

// Range of the scan, N/m. Stiffness that is stable up to kHighest counts as "any".
constexpr double kLowest = 10.0, kHighest = 1e5;
constexpr double kStep = 1.005, kQuickStep = 1.1;  // ratio of neighbours

// The rows, and the scans that are still to be run for them.
struct Plan {
    struct Cell {
        std::size_t row = 0;
        StabilityCase what;
        double lowest_N_per_m = kLowest, highest_N_per_m = kHighest;
    };
    std::vector<Json> rows;
    std::vector<Cell> cells;

    void add(const Json& row, const StabilityCase& what, double lowest = kLowest, double highest = kHighest) {
        cells.push_back({rows.size(), what, lowest, highest});
        rows.push_back(row);
    }
    void run(double ratio) {
        WorkerPool().run(cells.size(), [&](std::size_t i) {
            const Cell& cell = cells[i];
            const StiffnessScan scan = scan_stiffness(cell.what, cell.lowest_N_per_m, cell.highest_N_per_m, ratio);
            Json& row = rows[cell.row];
            row["largest_stable_stiffness_N_per_m"] = scan.stable_up_to_N_per_m;
            row["first_failure_N_per_m"] =
                scan.first_failure_N_per_m > 0.0 ? Json(scan.first_failure_N_per_m) : Json(nullptr);
            row["failing_share_above"] = scan.failing_share;
            row["any_stiffness"] = scan.first_failure_N_per_m == 0.0;
            if (row.contains("theory_N_per_m"))
                row["ratio"] = scan.stable_up_to_N_per_m / row["theory_N_per_m"].get<double>();
        });
    }
};

StabilityCase held_by(const NamedGrip& grip) {
    StabilityCase c;
    c.task = grip.task;
    c.grip = grip.grip;
    return c;
}

const NamedGrip& grip_called(const std::string& name) {
    for (const NamedGrip& g : grips()) {
        if (name == g.name) return g;
    }
    return grips().front();
}

const char* name_of(haptics::VelocityMethod method) {
    switch (method) {
        case haptics::VelocityMethod::adaptive_window: return "adaptive window";
        case haptics::VelocityMethod::moving_average: return "moving average";
        case haptics::VelocityMethod::difference: return "difference";
    }
    return "";
}

std::string controller_of(const StabilityCase& c) {
    if (c.coupling.stiffness_N_per_m > 0.0) return "coupling";
    if (c.control && c.limit) return "limiter and passivity";
    return c.control ? "passivity" : c.limit ? "limiter" : "none";
}

Json conditions(const char* section, const char* grip, const StabilityCase& c) {
    return {{"section", section},
            {"grip", grip},
            {"rate_Hz", c.device.rate_Hz},
            {"delay_ms", 1e3 * c.device.delay_s},
            {"force_alpha", c.signals.force_alpha},
            {"velocity", name_of(c.signals.velocity)},
            {"wall_damping_Ns_per_m", c.wall_damping_Ns_per_m},
            {"controller", controller_of(c)}};
}

// `published` is the same figure from another simulation; 0: none.
void stiffest(Plan& plan, const char* section, const NamedGrip& grip, const StabilityCase& c, double published = 0.0) {
    Json row = conditions(section, grip.name, c);
    row["published_N_per_m"] = published > 0.0 ? Json(published) : Json(nullptr);
    plan.add(row, c);
}

// Without friction, encoder steps, limits or a hand, a wall becomes unstable at K = b / (T/2 + t_d): 2 b / T without
// delay (Colgate and Schenkel). That holds where the device's own damping is slow compared with a period.
constexpr double kApplies = 0.1;  // b T / m

void add_theory(Plan& plan, bool quick) {
    for (const double rate : {250.0, 1000.0, 4000.0}) {
        for (const double damping : {0.05, 0.2, 1.0, 3.0}) {
            for (const int delay : {0, 1, 2}) {
                if (quick && (rate != 1000.0 || damping > 1.0 || damping < 0.2 || delay > 1)) continue;
                StabilityCase c;
                c.task = HandTask::none;
                c.device.friction_N = c.device.resolution_m = c.device.max_force_N = 0.0;
                c.device.damping_Ns_per_m = damping;
                c.device.rate_Hz = rate;
                c.device.delay_s = delay / rate;
                Json row = conditions("theory", "no hand", c);
                const double theory = damping / (0.5 / rate + c.device.delay_s);
                row["device_damping_Ns_per_m"] = damping;
                row["theory_N_per_m"] = theory;
                row["theory_applies"] = damping / rate / c.device.apparent_mass_kg <= kApplies;
                plan.add(row, c, 0.2 * theory, 10.0 * theory);
            }
        }
    }
}

// A published simulation of the same hand on the same device, with a settling rule of its own.
struct Published {
    double at, stiffness_N_per_m;
};
constexpr Published kRates[] = {{100, 1720}, {250, 5770}, {500, 15623}, {1000, 35321}, {2000, 76763}, {4000, 121540}};
constexpr Published kDelays_ms[] = {{0, 35321}, {1, 7853}, {2, 3834}, {5, 1371}, {10, 637}, {30, 223}};
constexpr Published kAlphas[] = {{0, 35321},  {0.3, 18008}, {0.5, 9287}, {0.7, 3992},
                                 {0.8, 2335}, {0.9, 1131},  {0.95, 728}};

// Calls `each` for every point, in a quick run for every other one, the first included.
template <typename Each>
void over(std::span<const Published> points, bool quick, Each&& each) {
    for (std::size_t i = 0; i < points.size(); i += quick ? 2 : 1) each(points[i]);
}

bool left_out(const NamedGrip& grip, bool quick) { return quick && std::string(grip.name) != "hand"; }

bool is_published_hand(const NamedGrip& grip) { return std::string(grip.name) == "hand"; }

void add_rates(Plan& plan, bool quick) {
    for (const NamedGrip& grip : grips()) {
        if (left_out(grip, quick)) continue;
        over(kRates, quick, [&](const Published& p) {
            StabilityCase c = held_by(grip);
            c.device.rate_Hz = p.at;
            stiffest(plan, "rate", grip, c, is_published_hand(grip) ? p.stiffness_N_per_m : 0.0);
        });
    }
}

void add_delays(Plan& plan, bool quick) {
    for (const NamedGrip& grip : grips()) {
        if (left_out(grip, quick)) continue;
        over(kDelays_ms, quick, [&](const Published& p) {
            StabilityCase c = held_by(grip);
            c.device.delay_s = 1e-3 * p.at;
            stiffest(plan, "delay", grip, c, is_published_hand(grip) ? p.stiffness_N_per_m : 0.0);
        });
    }
}

// Sweeps the filter without delay, as published, and with the Omni's one millisecond.
void add_filters(Plan& plan, bool quick) {
    for (const double delay_s : {0.0, 0.001}) {
        for (const NamedGrip& grip : grips()) {
            if (left_out(grip, quick)) continue;
            if (grip.task == HandTask::none && delay_s > 0.0) continue;
            over(kAlphas, quick, [&](const Published& p) {
                StabilityCase c = held_by(grip);
                c.device.delay_s = delay_s;
                c.signals.force_alpha = p.at;
                const bool published = delay_s == 0.0 && is_published_hand(grip);
                stiffest(plan, "filter", grip, c, published ? p.stiffness_N_per_m : 0.0);
            });
        }
    }
}

void add_velocities(Plan& plan, bool quick) {
    const NamedGrip& grip = grip_called("hand");
    for (const auto method : {haptics::VelocityMethod::adaptive_window, haptics::VelocityMethod::moving_average,
                              haptics::VelocityMethod::difference}) {
        for (const double damping : {0.5, 2.0, 5.0}) {
            if (quick && damping != 2.0) continue;
            StabilityCase c = held_by(grip);
            c.device.delay_s = 0.001;
            c.signals.velocity = method;
            c.wall_damping_Ns_per_m = damping;
            stiffest(plan, "velocity", grip, c);
        }
    }
}

std::vector<StabilityCase> controllers(const StabilityCase& plain) {
    std::vector<StabilityCase> all(5, plain);
    all[1].control = true;
    all[2].coupling = {1000.0, 1.0};
    all[3].limit = true;
    all[4].limit = all[4].control = true;
    return all;
}

void add_controllers(Plan& plan, bool quick) {
    for (const NamedGrip& grip : grips()) {
        if (left_out(grip, quick) || grip.task == HandTask::none) continue;
        StabilityCase plain = held_by(grip);
        plain.device.delay_s = 0.001;
        for (const StabilityCase& c : controllers(plain)) stiffest(plan, "controller", grip, c);
    }
}

// Measures a tap on the wall: what is felt, and the energy that the wall has given out.
void add_contacts(std::vector<Json>& rows, bool quick) {
    for (const char* name : {"light", "hand", "firm", "rigid"}) {
        if (quick && std::string(name) != "hand") continue;
        for (const double speed : {0.02, 0.05, 0.1, 0.3, 0.6}) {
            for (const double stiffness : {600.0, 1500.0, 5000.0, 15000.0}) {
                if (quick && speed != 0.3) continue;
                const NamedGrip& grip = grip_called(name);
                StabilityCase plain = held_by(grip);
                plain.device.delay_s = 0.001;
                plain.tap_speed_m_per_s = speed;
                for (const StabilityCase& c : controllers(plain)) {
                    const StabilityRun run = run_wall(c, stiffness);
                    Json row = conditions("contact", grip.name, c);
                    row["tap_speed_m_per_s"] = speed;
                    row["wanted_stiffness_N_per_m"] = stiffness;
                    row["rendered_stiffness_N_per_m"] = run.rendered.stiffness_N_per_m;
                    row["settles"] = stable(c, run);
                    row["limit_cycle_mm"] = 1e3 * run.swing_m;
                    row["force_change_a_tick_N"] = run.force_change_N;
                    row["late_force_change_a_tick_N"] = run.late_change_N;
                    row["net_energy_mJ"] = 1e3 * run.net_energy_J;
                    row["deepest_mm"] = 1e3 * run.deepest_m;
                    row["controller_ticks"] = run.acted_ticks;
                    rows.push_back(row);
                }
            }
        }
    }
}

}  // namespace

const std::vector<NamedGrip>& grips() {
    static const std::vector<NamedGrip> all{{"no hand", HandTask::none, {}},
                                            {"light", HandTask::tap, {0.05, 50.0, 1.0}},
                                            {"hand", HandTask::tap, {0.1, 100.0, 3.0}},
                                            {"firm", HandTask::tap, {0.2, 600.0, 12.0}},
                                            {"rigid", HandTask::tap, {1.0, 20000.0, 100.0}}};
    return all;
}

Stability run_stability(bool quick) {
    Plan plan;
    add_theory(plan, quick);
    add_rates(plan, quick);
    add_delays(plan, quick);
    add_filters(plan, quick);
    add_velocities(plan, quick);
    add_controllers(plan, quick);
    plan.run(quick ? kQuickStep : kStep);
    Stability s;
    s.rows = std::move(plan.rows);
    add_contacts(s.rows, quick);
    s.whole_ticks = run_whole_ticks(quick);
    s.figure7 = run_figure7(quick);
    return s;
}

}  // namespace burin::bench
