// SPDX-License-Identifier: MIT
// Runs of exercises as tests keep them, and a folder for them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/progress/kept_run.hpp"

namespace burin::activities {

inline KeptRun run_of(unsigned participant, const std::string& date, double score, double level = 1,
                      const std::string& ended = "done") {
    const auto finger = [](const char* name, double force_N) {
        return Json{{"finger", name},
                    {"peak_force_N", force_N},
                    {"mean_force_N", 0.5 * force_N},
                    {"range_of_motion_rad", Json::array({0.1, 0.5, 0.4, 0.3})},
                    {"mean_speed_rad_per_s", 1.0},
                    {"fractionation", Json()}};
    };
    return {participant,
            date,
            "10:15:00",
            "simulated-glove",
            {{"exercise", "ball"},
             {"settings", {{"colour", "red"}, {"level", level}}},
             {"ended", ended},
             {"score", score},
             {"time_s", 31.5},
             {"counts", {{"repetitions", 5}}},
             {"fingers", Json::array({finger("thumb", 2.0), finger("index", 1.0)})}}};
}

inline unsigned levels_of_ball(std::string_view exercise) { return exercise == "ball" ? 3 : 0; }

inline std::vector<const KeptRun*> all_of(const KeptRuns& kept) {
    std::vector<const KeptRun*> all;
    for (const KeptRun& run : kept.runs) all.push_back(&run);
    return all;
}

class KeptRunsFolder : public testing::Test {
protected:
    void SetUp() override { std::filesystem::remove_all(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }
    void keep(const KeptRun& run) {
        ASSERT_TRUE(prepare_results(folder, run.participant));
        const auto path = keep_run(folder, run);
        ASSERT_TRUE(path) << path.error().line();
    }
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "burin-kept-runs";
};

}  // namespace burin::activities
