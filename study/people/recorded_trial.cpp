// SPDX-License-Identifier: MIT
#include "study/people/recorded_trial.hpp"

#include <array>
#include <cmath>

#include "base/text.hpp"
#include "study/metrics/path.hpp"
#include "study/metrics/smoothness.hpp"
#include "study/metrics/trial_metrics.hpp"

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
                              "failed_attempts"};

double mean_outside_m(const StudyWorld& world, const std::vector<Vec3>& points_m) {
    std::vector<Vec3> collisions_m;
    collisions_m.reserve(points_m.size());
    for (const Vec3& p : points_m) collisions_m.push_back(within_tube(world, p));
    return mean_deviation_m(points_m, collisions_m);
}

}  // namespace

Json trial_record(const StudyWorld& world, const SimulatedStage& stage) {
    if (stage.end.result != StageResult::valid_exit) return {};
    std::vector<Vec3> middle_m;
    for (std::size_t i = 0; i < stage.top_m.size(); ++i) middle_m.push_back(0.5 * (stage.top_m[i] + stage.bottom_m[i]));
    const std::vector<Vec3> centreline_m = resampled(world.spine_m, kPlacesOfCentreline);
    const double top_mm = kMillimetres * mean_outside_m(world, stage.top_m);
    const double bottom_mm = kMillimetres * mean_outside_m(world, stage.bottom_m);
    const Distances nearest = distances_to_centreline(middle_m, world.spine_m);
    const std::vector<double> speeds = speeds_m_per_s(middle_m, kSimulatedRate_Hz);
    std::size_t failed = 0;
    for (const StageEvent& e : stage.events) failed += e.kind == StageEventKind::attempt_failed ? 1 : 0;
    return Json{{"deviation_mm", top_mm + bottom_mm},
                {"time_s", trial_time_s(stage.end)},
                {"deviation_top_mm", top_mm},
                {"deviation_bottom_mm", bottom_mm},
                {"from_axis_mean_mm", kMillimetres * nearest.mean_m},
                {"from_axis_most_mm", kMillimetres * nearest.largest_m},
                {"along_axis_mean_mm", kMillimetres * arc_length_matched(middle_m, world.spine_m).mean_m},
                {"frechet_mm", kMillimetres * frechet_distance_m(middle_m, centreline_m)},
                {"path_m", path_length_m(middle_m)},
                {"economy", economy_of_path(middle_m, path_length_m(world.spine_m))},
                {"sparc", spectral_arc_length(speeds, kSimulatedRate_Hz)},
                {"ldlj", log_dimensionless_jerk(speeds, kSimulatedRate_Hz)},
                {"effectiveness_index", effectiveness_index(top_mm, bottom_mm)},
                {"failed_attempts", failed}};
}

std::string trials_csv(std::span<const TrialRow> rows, bool simulated) {
    std::string text = "# made by burin study of the folder's journal and data; deviation by distance to the wall\n";
    if (simulated) text += "# simulated learners: no person took part, no force acted on the hand\n";
    text += "participant,group,trial";
    for (const char* column : kColumns) text += std::string(",") + column;
    text += ",day,stage,stratum\n";
    for (const TrialRow& row : rows) {
        text += row.participant + "," + row.group + "," + std::to_string(row.number);
        for (const char* column : kColumns) {
            const auto found = row.record.find(column);
            const bool known = found != row.record.end() && found->is_number();
            text += known ? formatted(",%.17g", found->get<double>()) : ",";
        }
        text += "," + std::to_string(row.day) + "," + row.stage + "," + row.stratum + "\n";
    }
    return text;
}

}  // namespace burin::study
