// SPDX-License-Identifier: MIT
// A person's baseline: the newest assessment of a hand that was carried to its end. It gives the other exercises their
// settings of the person (activities/rehab/exercise/person_range.hpp), and stands on the page. Pure; any thread.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/exercise/exercise_settings.hpp"
#include "activities/rehab/progress/kept_run.hpp"
#include "activities/rehab/progress/page_texts.hpp"

namespace burin::activities {

inline constexpr std::string_view kUsualSide = "right";
// Returns the side of the hand that a run was of; of before there was a side, a right one.
[[nodiscard]] std::string side_of(const KeptRun& run);

struct Baseline {
    std::string date, time;
    std::optional<double> open, closed;  // both or none
    std::optional<double> most_N;        // 0: no finger pressed
};
// Returns the newest that there is of this participant and side. The runs are in order of time.
[[nodiscard]] std::optional<Baseline> baseline_of(std::span<const KeptRun> runs, unsigned participant,
                                                  std::string_view side = kUsualSide);

// The settings with what the baseline says of the person where neither file nor option has said it.
struct FittedValues {
    SettingValues values;
    std::vector<std::string> taken;  // the settings' keys; empty: nothing was
    std::string left_out;            // what of it cannot be a setting, and why; empty: nothing
};
[[nodiscard]] FittedValues fitted_by(const SettingValues& values, const Baseline& baseline);
// Says so in a line: "the assessment of 2026-11-03 10:15:00: open 0.1, closed 0.45, most_N 3.2".
[[nodiscard]] std::string text_of(const Baseline& baseline, const FittedValues& fitted);

// Returns a hand's assessments as a table for the page, in its language, under a title: range, strength, speed and
// fractionation of each finger, of the first as of the newest. The runs are assessments, in order of time; at least
// one.
[[nodiscard]] std::string baseline_table(std::span<const KeptRun* const> runs, const PageTexts& texts);

}  // namespace burin::activities
