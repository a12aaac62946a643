// SPDX-License-Identifier: MIT
#include "bench/devices/tap_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace burin::bench {
namespace {

constexpr double kLookDeviations = 4.16;       // each of two looks has half the probability of 4
constexpr double kElsewhereDeviations = 4.47;  // and a quarter of that each of four comparisons
constexpr double kAlongDeviations = 2.0;
constexpr double kLooseGrip_N_per_m = 2000.0;  // the firmest that counts as loose
constexpr double kLeastStep_m = 0.00002;       // of an encoder that says nothing of its step

struct TapContrast {
    double mean_m = 0.0, doubt_m = 0.0, control_m = 0.0;
};

struct TapGroup {
    double sum = 0.0, squares = 0.0;
    double count = 0.0;
    [[nodiscard]] double mean() const { return sum / count; }
};

// Returns the group's mean, and the squares about it: in two passes, as the values may be far from zero.
TapGroup group_of(std::span<const Tap> taps, const Vec3& weights, int way) {
    TapGroup group;
    for (const Tap& tap : taps) {
        if (tap.way != way) continue;
        group.sum += glm::dot(weights, tap.moved_m);
        group.count += 1.0;
    }
    for (const Tap& tap : taps)
        if (tap.way == way) group.squares += std::pow(glm::dot(weights, tap.moved_m) - group.mean(), 2.0);
    return group;
}

// Returns the taps without what the tap before each of them has left behind: the part that follows its way, by least
// squares within the three kinds of tap.
std::vector<Tap> without_remnants(std::span<const Tap> taps) {
    std::array<double, 3> count{}, before{};
    std::array<Vec3, 3> moved_m{};
    const auto kind = [&](std::size_t i) { return static_cast<std::size_t>(taps[i].way + 1); };
    const auto way_before = [&](std::size_t i) { return i > 0 ? static_cast<double>(taps[i - 1].way) : 0.0; };
    for (std::size_t i = 0; i < taps.size(); ++i) {
        count[kind(i)] += 1.0;
        before[kind(i)] += way_before(i);
        moved_m[kind(i)] += taps[i].moved_m;
    }
    const auto other = [&](std::size_t i) { return way_before(i) - before[kind(i)] / count[kind(i)]; };
    Vec3 product_m(0.0);
    double square = 0.0;
    for (std::size_t i = 0; i < taps.size(); ++i) {
        product_m += other(i) * (taps[i].moved_m - moved_m[kind(i)] / count[kind(i)]);
        square += other(i) * other(i);
    }
    std::vector<Tap> left(taps.begin(), taps.end());
    if (square > 0.0)
        for (std::size_t i = 0; i < taps.size(); ++i) left[i].moved_m -= way_before(i) * product_m / square;
    return left;
}

bool is_enough(const TapGroup& group) { return group.count >= 3.0; }

TapContrast contrast_of(std::span<const Tap> taps, const Vec3& weights, const TapQuestion& question,
                        double deviations = kLookDeviations) {
    const TapGroup none = group_of(taps, weights, 0), forwards = group_of(taps, weights, 1);
    const TapGroup backwards = question.is_one_way ? TapGroup{} : group_of(taps, weights, -1);
    // One more degree of freedom went into the remnants.
    const double none_freedom = none.count - 2.0;
    const double force_freedom = forwards.count - 2.0 + (question.is_one_way ? 0.0 : backwards.count - 1.0);
    const double step_m = std::max(kLeastStep_m, question.resolution_m);
    const double control_m = std::sqrt(none.squares / none_freedom);
    const double s_m = std::max({control_m, std::sqrt((forwards.squares + backwards.squares) / force_freedom), step_m});
    const TapGroup& other = question.is_one_way ? none : backwards;
    const double deviation_m = s_m * std::sqrt(1.0 / forwards.count + 1.0 / other.count);
    return {forwards.mean() - other.mean(),
            deviation_m * student_quantile(deviations, std::min(none_freedom, force_freedom)), control_m};
}

// Tells whether the handle answered the force along its axis, and whether along another one, in either direction.
struct TapDirection {
    bool is_along = true, is_elsewhere = false;
};

TapDirection direction_of(std::span<const Tap> taps, const TapQuestion& question) {
    TapDirection direction;
    if (question.is_one_way) return direction;
    for (int other = 0; other < 3; ++other) {
        if (other == question.axis) continue;
        for (const double sign : {1.0, -1.0}) {
            Vec3 weights(0.0);
            weights[question.axis] = 1.0;
            weights[other] = -sign;
            const double less_m = contrast_of(taps, weights, question).mean_m;
            const auto doubt_m = [&](double deviations) {
                return contrast_of(taps, weights, question, deviations).doubt_m;
            };
            direction.is_along = direction.is_along && less_m > doubt_m(kAlongDeviations);
            direction.is_elsewhere = direction.is_elsewhere || less_m < -doubt_m(kElsewhereDeviations);
        }
    }
    return direction;
}

}  // namespace

TapAnswer judge_taps(std::span<const Tap> measured, const TapQuestion& question) {
    const std::vector<Tap> taps = without_remnants(measured);
    Vec3 along(0.0);
    along[question.axis] = 1.0;
    for (const int way : {0, 1, -1})
        if (!(question.is_one_way && way < 0) && !is_enough(group_of(taps, along, way))) return {};
    const TapContrast found = contrast_of(taps, along, question);
    const TapDirection direction = direction_of(taps, question);
    TapAnswer answer{TapFinding::unclear, found.mean_m, found.doubt_m, found.control_m};
    if (found.mean_m < -found.doubt_m)
        answer.finding = TapFinding::against;
    else if (direction.is_elsewhere)
        answer.finding = TapFinding::elsewhere;
    else if (found.mean_m > found.doubt_m && direction.is_along)
        answer.finding = TapFinding::felt;
    else if (found.mean_m + found.doubt_m < question.working_m)
        answer.finding = TapFinding::absent;
    return answer;
}

double working_m(double force_N, double friction_N, bool is_one_way) {
    return (is_one_way ? 1.0 : 2.0) * (force_N - 2.0 * friction_N) / kLooseGrip_N_per_m;
}

double student_quantile(double deviations, double degrees_of_freedom) {
    const double z = deviations, n = degrees_of_freedom, z2 = z * z;
    const double first = z * (z2 + 1.0) / 4.0;
    const double second = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
    const double third = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
    const double fourth = z * ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
    return z + (first + (second + (third + fourth / n) / n) / n) / n;
}

}  // namespace burin::bench
