// SPDX-License-Identifier: MIT
#include "study/report/power_report.hpp"

#include <cmath>

#include "base/text.hpp"

namespace burin::study {
namespace {

constexpr const char* kModel =
    "each participant's value normal with one standard deviation in both groups; two-sided Mann-Whitney U test";

const char* p_method(const Power& power) { return std::isnan(power.level) ? "normal approximation" : "exact p"; }

// Where there is no effect: the most that the share may be, two standard errors above the test's exact level.
double bound_of(const Power& power) {
    return power.level + 2.0 * std::sqrt(power.level * (1.0 - power.level) / static_cast<double>(power.studies));
}

bool judges_level(const PowerOptions& options, const Power& power) {
    return options.effect == 0.0 && !std::isnan(power.level);
}

}  // namespace

std::string power_text(const PowerOptions& options, const Power& power) {
    std::string text =
        formatted("effect of %g standard deviations, %zu participants (%zu and %zu), alpha %g\n", options.effect,
                  options.first + options.second, options.first, options.second, options.alpha);
    text += formatted("p <= %g in %zu of %zu simulated studies: power %.4f, standard error %.4f\n", options.alpha,
                      power.significant, power.studies, power.power, power.standard_error);
    if (!std::isnan(power.level)) text += formatted("exact level of the test: %.6f\n", power.level);
    if (judges_level(options, power)) {
        text += formatted("no effect: at most %.4f (exact level and two standard errors) is expected; %s\n",
                          bound_of(power), power.power <= bound_of(power) ? "kept" : "EXCEEDED");
    }
    text += formatted("[%s, %s; seed %llu]\n", kModel, p_method(power), static_cast<unsigned long long>(options.seed));
    return text;
}

Json power_json(const PowerOptions& options, const Power& power) {
    Json json = {{"effect_sd", options.effect},  {"participants", options.first + options.second},
                 {"first_group", options.first}, {"second_group", options.second},
                 {"alpha", options.alpha},       {"seed", options.seed},
                 {"studies", power.studies},     {"significant", power.significant},
                 {"power", power.power},         {"standard_error", power.standard_error},
                 {"exact_level", power.level},   {"model", kModel},
                 {"p", p_method(power)}};
    if (judges_level(options, power)) {
        json["null_bound"] = bound_of(power);
        json["null_bound_kept"] = power.power <= bound_of(power);
    }
    return json;
}

}  // namespace burin::study
