// SPDX-License-Identifier: MIT
// Every procedure, and the smoothness of a movement, against SciPy and R on random groups, half of them with ties. Both
// run as child processes at the time of the test; where one is not installed, its test is skipped. Each is asked only
// for what it does right.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "study/analysis/analysis.hpp"
#include "study/metrics/smoothness.hpp"
#include "study/statistics/agreement.hpp"
#include "study/statistics/distributions.hpp"
#include "study/statistics/effect_size.hpp"
#include "study/statistics/mann_whitney.hpp"
#include "study/statistics/permutation.hpp"
#include "study/statistics/ranks.hpp"
#include "study/statistics/spearman.hpp"
#include "study/table/trial_table.hpp"
#include "tests/study/decimal_studies.hpp"
#include "tests/support/places.hpp"
#include "tests/support/property_cases.hpp"
#include "tests/support/run_command.hpp"

namespace burin::study {
namespace {

using Values = std::vector<double>;
using Figures = std::map<std::string, double>;

constexpr std::size_t kPairsOfGroups = 60;
constexpr double kConfidence = 0.9;

struct Groups {
    Values a, b;
};

std::vector<Groups> random_groups() {
    std::mt19937_64 random(test::property_cases().seed);
    std::vector<Groups> groups(kPairsOfGroups);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const bool tied = i % 2 == 0;
        for (Values* values : {&groups[i].a, &groups[i].b}) {
            const std::size_t n = 2 + random() % (i % 3 == 0 ? 4 : 11);
            for (std::size_t k = 0; k < n; ++k) {
                const double uniform = static_cast<double>(random() >> 11) * 0x1p-53;
                values->push_back(tied ? 0.25 * std::floor(7.0 * uniform) : std::tan(3.0 * (uniform - 0.5)));
            }
        }
    }
    return groups;
}

Values first_of(const Values& values, std::size_t count) {
    return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count)};
}

std::string text_of(const std::vector<Groups>& groups) {
    std::string text;
    for (const Groups& pair : groups) {
        for (const Values& values : {pair.a, pair.b}) {
            for (std::size_t i = 0; i < values.size(); ++i) text += formatted(i == 0 ? "%.17g" : " %.17g", values[i]);
            text += "\n";
        }
    }
    return text;
}

// What a program says of the groups, by pair and name; nothing where it cannot run, with its words in `why`.
struct Reference {
    std::vector<Figures> figures;
    std::string why;
};

Reference ask(const std::string& program, const std::vector<Groups>& groups) {
    const Workplace place;
    place.write("groups.txt", text_of(groups));
    const auto outcome = place.run(program + " groups.txt");
    if (outcome.status != 0) return {.figures = {}, .why = outcome.output};
    Reference reference{.figures = std::vector<Figures>(groups.size()), .why = {}};
    std::istringstream lines(outcome.output);
    std::size_t pair = 0;
    std::string name, value;
    while (lines >> pair >> name >> value) {
        if (pair < groups.size()) reference.figures[pair][name] = std::strtod(value.c_str(), nullptr);
    }
    return reference;
}

Figures our_figures(const Groups& pair) {
    const auto& [a, b] = pair;
    Figures ours;
    const Outcome u = mann_whitney(a, b), normal = mann_whitney_normal(a, b);
    ours["u"] = u.statistic;
    ours["u_exact_p"] = u.p;
    ours["u_normal_p"] = normal.p;
    ours["means_p"] = permutation_of_means(a, b).p;
    const Estimate delta = rank_biserial(a, b, kConfidence), shift = hodges_lehmann(a, b, kConfidence);
    ours["delta"] = delta.value;
    ours["delta_low"] = delta.low;
    ours["delta_high"] = delta.high;
    ours["shift"] = shift.value;
    ours["shift_low"] = shift.low;
    ours["shift_high"] = shift.high;
    Values all = a;
    all.insert(all.end(), b.begin(), b.end());
    const Values ranks = midranks(all);
    for (std::size_t i = 0; i < ranks.size(); ++i) ours["rank" + std::to_string(i)] = ranks[i];
    return ours;
}

void add_paired_figures(Figures& ours, const Groups& pair) {
    const std::size_t common = std::min(pair.a.size(), pair.b.size());
    const Values x = first_of(pair.a, common), y = first_of(pair.b, common);
    const Outcome r = spearman(x, y);
    const double freedom = static_cast<double>(common) - 2.0;
    ours["r"] = r.statistic;
    ours["r_exact_p"] = r.p;
    ours["r_t_p"] = student_two_sided(r.statistic * std::sqrt(freedom / (1.0 - r.statistic * r.statistic)), freedom);
    std::vector<Values> trials;
    for (std::size_t i = 0; i < common; ++i) trials.push_back({x[i], y[i]});
    const Estimate icc = intraclass_correlation(trials);
    ours["icc"] = icc.value;
    ours["icc_low"] = icc.low;
    ours["icc_high"] = icc.high;
}

void add_distributions(Figures& ours, const Values& a) {
    const auto n = static_cast<double>(a.size());
    const double p = std::abs(std::sin(a[0] + 0.1));
    ours["normal_quantile"] = normal_quantile(p);
    ours["normal_two_sided"] = normal_two_sided(a[0]);
    ours["f"] = f_distribution(std::abs(a[0]), n, 2.5 * n);
    ours["f_quantile"] = f_quantile(p, n, 2.5 * n);
    ours["t_two_sided"] = student_two_sided(a[0], 2.5 * n);
}

void add_smoothness(Figures& ours, Values speeds) {
    for (double& speed : speeds) speed = std::abs(speed);
    ours["sparc"] = spectral_arc_length(speeds, 50.0);
    ours["jerk"] = dimensionless_jerk(speeds, 50.0);
}

// Compares everything that the reference says with ours, and counts how often it said each name.
std::map<std::string, int> compare_all(const Reference& reference, const std::vector<Groups>& groups) {
    std::map<std::string, int> said;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        Figures ours = our_figures(groups[i]);
        add_paired_figures(ours, groups[i]);
        add_distributions(ours, groups[i].a);
        add_smoothness(ours, groups[i].a);
        for (const auto& [name, value] : reference.figures[i]) {
            ++said[name];
            const auto our = ours.find(name);
            if (our == ours.end()) {
                ADD_FAILURE() << "no figure of ours is called " << name;
                continue;
            }
            // 1e-9 is asked of all of them; large values, of quantiles and far outliers, to as many digits.
            EXPECT_NEAR(our->second, value, 1e-9 * std::max(1.0, std::abs(value))) << name << " of pair " << i << "\n"
                                                                                   << text_of({groups[i]});
        }
    }
    return said;
}

std::string script(const std::string& name) { return std::string(kStudyTests) + "/" + name; }

Reference ask_scipy(const std::vector<Groups>& groups) {
    Reference reference;
    for (const char* python : {"/usr/bin/python3", "python3"}) {
        reference = ask(std::string(python) + " '" + script("reference_scipy.py") + "'", groups);
        if (!reference.figures.empty()) break;
    }
    return reference;
}

Values numbers_of(const std::vector<std::int64_t>& whole) { return {whole.begin(), whole.end()}; }

// SciPy's floats would round the means; it is given their ranks instead, and has the same U, p and r_s to find.
TEST(Reference, OfSciPyIsMetByTheAnalysisOfDecimalsWhoseRanksItIsGiven) {
    using test_decimals::DecimalPerson;
    const auto studies = test_decimals::random_decimal_studies(30, test::property_cases().seed);
    std::vector<Groups> groups;  // of each study the ranks of deviations in both groups, and of time and deviation in A
    for (const test_decimals::DecimalStudy& study : studies) {
        test_decimals::Twelfths pooled = study.values(0, &DecimalPerson::deviations, true);
        const auto first = static_cast<std::ptrdiff_t>(pooled.size());
        const test_decimals::Twelfths other = study.values(1, &DecimalPerson::deviations, true);
        pooled.insert(pooled.end(), other.begin(), other.end());
        const Values ranks = numbers_of(test_decimals::twice_ranks(pooled));
        groups.push_back({{ranks.begin(), ranks.begin() + first}, {ranks.begin() + first, ranks.end()}});
        groups.push_back({numbers_of(test_decimals::twice_ranks(study.values(0, &DecimalPerson::times, true))),
                          numbers_of(test_decimals::twice_ranks(study.values(0, &DecimalPerson::deviations, true)))});
    }
    const Reference reference = ask_scipy(groups);
    if (reference.figures.empty()) {
        ASSERT_TRUE(reference.why.contains("not found") || reference.why.contains("No module")) << reference.why;
        GTEST_SKIP() << "python3-scipy is not installed: " << reference.why;
    }
    std::size_t correlations = 0;
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const UnitAnalysis unit = analyse(parse_trials(studies[i].csv()).table).participants;
        const Comparison& deviation = unit.comparisons.at(1);
        Figures of_groups = reference.figures[2 * i], of_pairs = reference.figures[2 * i + 1];
        EXPECT_EQ(deviation.mann_whitney.statistic, of_groups.at("u")) << studies[i].csv();
        EXPECT_NEAR(deviation.rank_biserial.value, of_groups.at("delta"), 1e-15);
        if (of_groups.contains("u_exact_p")) {
            EXPECT_NEAR(deviation.mann_whitney.p, of_groups.at("u_exact_p"), 1e-12) << studies[i].csv();
        }
        if (!of_pairs.contains("r")) continue;
        ++correlations;
        EXPECT_NEAR(unit.groups.at(0).deviation_with_time.statistic, of_pairs.at("r"), 1e-14) << studies[i].csv();
    }
    EXPECT_GT(correlations, studies.size() / 3);
}

TEST(Reference, OfSciPyIsMet) {
    const std::vector<Groups> groups = random_groups();
    const Reference reference = ask_scipy(groups);
    if (reference.figures.empty()) {
        ASSERT_TRUE(reference.why.contains("not found") || reference.why.contains("No module")) << reference.why;
        GTEST_SKIP() << "python3-scipy is not installed: " << reference.why;
    }
    const auto said = compare_all(reference, groups);
    for (const char* name : {"u", "u_normal_p", "u_exact_p", "means_p", "delta", "delta_low", "r", "r_t_p", "r_exact_p",
                             "rank0", "normal_quantile", "f_quantile"})
        EXPECT_TRUE(said.contains(name) && said.at(name) >= 10) << name;
}

TEST(Reference, OfRIsMet) {
    const std::vector<Groups> groups = random_groups();
    const Reference reference = ask("Rscript --vanilla '" + script("reference_r.R") + "'", groups);
    if (reference.figures.empty()) {
        ASSERT_TRUE(reference.why.contains("not found") || reference.why.contains("no package")) << reference.why;
        GTEST_SKIP() << "r-base-core and r-cran-coin are not installed: " << reference.why;
    }
    const auto said = compare_all(reference, groups);
    for (const char* name :
         {"u", "u_exact_p", "shift", "shift_low", "shift_high", "r", "r_exact_p", "icc", "icc_low", "icc_high"})
        EXPECT_TRUE(said.contains(name) && said.at(name) >= 10) << name;
}

}  // namespace
}  // namespace burin::study
