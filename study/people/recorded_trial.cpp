// SPDX-License-Identifier: MIT
#include "study/people/recorded_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/csv.hpp"
#include "base/text.hpp"
#include "study/felt/repeated_stage.hpp"
#include "study/metrics/even_motion.hpp"
#include "study/metrics/path.hpp"
#include "study/metrics/trial_metrics.hpp"
#include "study/people/learner.hpp"

namespace burin::study {
namespace {

constexpr std::size_t kPlacesOfCentreline = 201;
constexpr double kMillimetres = 1000.0;
// In the table's order.
constexpr std::array kColumns{"deviation_mm",
                              "time_s",
                              "deviation_top_mm",
                              "deviation_bottom_mm",
                              "from_axis_mean_mm",
                              "from_axis_most_mm",
                              "along_axis_mean_mm",
                              "frechet_mm",
                              "path_m",
                              "economy",
                              "sparc",
                              "ldlj",
                              "effectiveness_index",
                              kFailedFigure,
                              kInterruptedFigure,
                              "proxy_deviation_mm",
                              "deviations_differ",
                              "contact_s",
                              "contacts",
                              "force_mean_N",
                              "force_largest_N",
                              kTorqueFigure};

double mean_outside_mm(const StudyWorld& world, const std::vector<Vec3>& points_m, std::span<const double> weights) {
    std::vector<Vec3> collisions_m;
    collisions_m.reserve(points_m.size());
    for (const Vec3& p : points_m) collisions_m.push_back(within_tube(world, p));
    return kMillimetres * mean_deviation_m(points_m, collisions_m, weights);
}

// Mean deviations of the two points, in millimetres.
struct Deviations {
    std::array<double, 2> proxy_mm{}, wall_mm{};

    [[nodiscard]] double differ_mm() const {
        return std::max(std::abs(proxy_mm[0] - wall_mm[0]), std::abs(proxy_mm[1] - wall_mm[1]));
    }
};

Deviations deviations_of(const StudyWorld& world, const ModelTouch& model) {
    Deviations d;
    const std::vector<double> weights = tick_seconds(model.times_ns);
    for (std::size_t i = 0; i < 2; ++i) {
        d.proxy_mm[i] = kMillimetres * mean_deviation_m(model.points_m[i], model.collision_points_m[i], weights);
        d.wall_mm[i] = mean_outside_mm(world, model.points_m[i], weights);
    }
    return d;
}

// Both points' forces together, tick by tick.
std::vector<Vec3> sums_of(const ModelTouch& model) {
    std::vector<Vec3> sums;
    for (std::size_t i = 0; i < model.forces_N[0].size(); ++i)
        sums.push_back(model.forces_N[0][i] + model.forces_N[1][i]);
    return sums;
}

// Largest torque of both points' forces about the middle between them, where the handle is held.
double largest_torque_Nm(const ModelTouch& model) {
    double largest_Nm = 0.0;
    for (std::size_t tick = 0; tick < model.forces_N[0].size(); ++tick) {
        const Vec3 middle_m = 0.5 * (model.points_m[0][tick] + model.points_m[1][tick]);
        Vec3 torque_Nm(0.0);
        for (std::size_t i = 0; i < 2; ++i)
            torque_Nm += glm::cross(model.points_m[i][tick] - middle_m, model.forces_N[i][tick]);
        largest_Nm = std::max(largest_Nm, glm::length(torque_Nm));
    }
    return largest_Nm;
}

void add_contact(Json& record, const ModelTouch& model) {
    const ContactFigures contact = contact_figures(sums_of(model), model.times_ns);
    record["contact_s"] = contact.time_s;
    record["contacts"] = contact.episodes;
    record["force_mean_N"] = contact.episodes > 0 ? contact.mean_force_N : 0.0;
    record["force_largest_N"] = contact.peak_force_N;
    record[kTorqueFigure] = largest_torque_Nm(model);
}

}  // namespace

Json trial_record(const StudyWorld& world, const StageState& end, std::span<const StageEvent> events,
                  const ModelTouch& model) {
    if (end.result != StageResult::valid_exit) return {};
    std::vector<Vec3> middle_m;
    for (std::size_t i = 0; i < model.points_m[0].size(); ++i)
        middle_m.push_back(0.5 * (model.points_m[0][i] + model.points_m[1][i]));
    const std::vector<Vec3> centreline_m = resampled(world.spine_m, kPlacesOfCentreline);
    const Deviations deviation = deviations_of(world, model);
    const double top_mm = deviation.wall_mm[0], bottom_mm = deviation.wall_mm[1];
    const bool differ = deviation.differ_mm() > kDeviationsAgree_mm;
    const Distances nearest = distances_to_centreline(middle_m, world.spine_m, tick_seconds(model.times_ns));
    const MotionFigures motion = motion_figures(middle_m, model.times_ns);
    std::size_t failed = 0, interrupted = 0;
    for (const StageEvent& e : events) {
        if (e.kind != StageEventKind::attempt_failed) continue;
        ++(is_of_person(e.failure) ? failed : interrupted);
    }
    Json record{{"deviation_mm", top_mm + bottom_mm},
                {"time_s", trial_time_s(end)},
                {"deviation_top_mm", top_mm},
                {"deviation_bottom_mm", bottom_mm},
                {"proxy_deviation_mm", deviation.proxy_mm[0] + deviation.proxy_mm[1]},
                {"proxy_deviation_top_mm", deviation.proxy_mm[0]},
                {"proxy_deviation_bottom_mm", deviation.proxy_mm[1]},
                {"deviations_differ", differ ? 1 : 0},
                {"from_axis_mean_mm", kMillimetres * nearest.mean_m},
                {"from_axis_most_mm", kMillimetres * nearest.largest_m},
                {"along_axis_mean_mm", kMillimetres * arc_length_matched(middle_m, world.spine_m).mean_m},
                {"frechet_mm", kMillimetres * frechet_distance_m(middle_m, centreline_m)},
                {"path_m", motion.path_length_m},
                {"economy", path_length_m(world.spine_m) / motion.path_length_m},
                {"sparc", motion.spectral_arc_length},
                {"ldlj", motion.log_dimensionless_jerk},
                {"low_pass_Hz", kMotionCutoff_Hz},
                {"effectiveness_index", effectiveness_index(top_mm, bottom_mm)},
                {kFailedFigure, failed},
                {kInterruptedFigure, interrupted}};
    // The forces of a proxy that hangs where the hand is not say nothing of the wall.
    if (!differ) add_contact(record, model);
    return record;
}

Json as_kept_before(Json figures, const Json& kept) {
    if (!figures.is_object()) return figures;
    if (!kept.contains(kTorqueFigure)) figures.erase(kTorqueFigure);
    if (kept.contains(kInterruptedFigure) || !figures.contains(kInterruptedFigure)) return figures;
    figures[kFailedFigure] = figures[kFailedFigure].get<std::size_t>() + figures[kInterruptedFigure].get<std::size_t>();
    figures.erase(kInterruptedFigure);
    return figures;
}

Json forces_record(const FeltForces& forces) {
    return Json{{"contact_s", forces.contact_s},
                {"contacts", forces.contacts},
                {"force_mean_N", forces.mean_N()},
                {"force_largest_N", forces.largest_N},
                {kTorqueFigure, forces.largest_torque_Nm},
                {"limited_s", forces.limited_s},
                {"without_force_ticks", forces.faults},
                {"late_ticks", forces.late_ticks},
                {"ticks", forces.ticks}};
}

std::string simulated_fact(std::span<const TrialRow> rows) {
    std::map<std::string, Hand> hands;  // of each participant the least real one
    for (const TrialRow& row : rows) {
        if (!row.reason.empty()) continue;
        const auto [at, fresh] = hands.emplace(row.participant, row.hand);
        if (!fresh) at->second = std::min(at->second, row.hand);
    }
    const auto count = [&](Hand hand) {
        return static_cast<std::size_t>(
            std::ranges::count_if(hands, [&](const auto& one) { return one.second == hand; }));
    };
    const std::size_t learners = count(Hand::learner), scripts = count(Hand::script);
    std::string fact;
    if (learners + scripts > 0)
        fact = formatted(
            "%zu of %zu participants of these trials are simulated, no person (learners: %zu, by a script: %zu).",
            learners + scripts, hands.size(), learners, scripts);
    const auto add = [&](Hand hand, const char* what) {
        if (const std::size_t held = count(hand); held > 0)
            fact += formatted("%s%zu of %zu ", fact.empty() ? "" : " ", held, hands.size()) + what;
    };
    add(Hand::recording, "are a recording that was played again, no person.");
    add(Hand::simulated_device, "held a simulated device (mouse, keys or a log).");
    add(Hand::emulated_device, "held a device's driver with an emulated device behind it, which no person felt.");
    add(Hand::untold, "held what an earlier Burin calls a simulated wand, be it one or not.");
    return fact;
}

namespace {

std::string csv_count(const std::optional<std::size_t>& count) { return count ? std::to_string(*count) : ""; }

// As in the table, without what it begins and ends with.
std::string measures_of(const TrialRow& row) {
    std::string text;
    for (const std::string_view column : kColumns) {
        text += ",";
        if (column == kFailedFigure) {
            text += csv_count(row.failed_attempts);
        } else if (column == kInterruptedFigure) {
            text += csv_count(row.interrupted_attempts);
        } else if (row.reason.empty()) {
            const auto found = row.record.find(column);
            if (found != row.record.end() && found->is_number()) text += csv_number(found->get<double>());
        }
    }
    return text;
}

}  // namespace

std::string trials_csv(std::span<const TrialRow> rows) {
    std::string text =
        "# made by burin study of the folder's journal and data; deviation is by distance to the tube's wall, "
        "proxy_deviation to the proxy of the haptic model; path_m, economy, sparc and ldlj are of the middle's motion "
        "after a low-pass of " +
        formatted("%g Hz\n", kMotionCutoff_Hz) +
        "# trial counts the protocol's trials, valid or not; a row with a reason has no measures and is not analysed; "
        "failed_attempts are the person's, interrupted_attempts the operator's and the device's\n";
    if (const std::string fact = simulated_fact(rows); !fact.empty()) text += "# " + fact + " See the column hand.\n";
    text += "participant,group,trial";
    for (const char* column : kColumns) text += std::string(",") + column;
    text += ",place,run,reason,world,day,stage,stratum,hand\n";
    for (const TrialRow& row : rows) {
        text += row.participant + "," + row.group + "," + std::to_string(row.number) + measures_of(row);
        text += formatted(",%zu,%zu,", row.place, row.run) + csv_field(row.reason) + "," + csv_field(row.world) +
                formatted(",%zu,", row.day) + csv_field(row.stage) + "," + csv_field(row.stratum) + "," +
                name_of(row.hand) + "\n";
    }
    return text;
}

}  // namespace burin::study
