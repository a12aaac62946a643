// SPDX-License-Identifier: MIT
// An analysis as data: JSON with everything, and CSV tables. All numbers have as many digits as it takes to read the
// same value back; what is undefined is null in JSON and empty in CSV, with the reason beside it. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "study/analysis/analysis.hpp"
#include "study/published/published.hpp"

namespace burin::study {

[[nodiscard]] Json analysis_json(const Analysis& analysis);
[[nodiscard]] Json published_json(const PublishedComparison& comparison);

struct NamedText {
    std::string name, text;
};

// trials.csv: the trials as read. ranks-in-groups.csv: time, deviation, their ranks within the group, the ranks'
// difference d and its square, from which Spearman's correlation comes. ranks-of-time.csv, ranks-of-deviation.csv: the
// ranks of each two groups together, from which U comes. tests.csv: every figure with its method. The four with ranks
// and figures have both units of analysis.
[[nodiscard]] std::vector<NamedText> analysis_tables(const Analysis& analysis);

}  // namespace burin::study
