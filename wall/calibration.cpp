// SPDX-License-Identifier: MIT
#include "wall/calibration.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/space.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "wall/rectangle_fit.hpp"

namespace burin::wall {
namespace {

constexpr double kOutlierSigmas = 5.0;  // 1.5e-5 of the samples of a Gaussian in three dimensions exceed it
constexpr double kOutlierFloor_m = 0.0005;
constexpr double kLeastSize_m = 0.05;
constexpr double kMostSize_m = 100.0;
constexpr int kMostRounds = 10;

struct NamedPlace {
    const char* name;
    ScreenPlace place;
};
const std::array<NamedPlace, 8> kPlaces{{{"lower_left", {0.0, 0.0}},
                                         {"lower_right", {1.0, 0.0}},
                                         {"upper_left", {0.0, 1.0}},
                                         {"upper_right", {1.0, 1.0}},
                                         {"left", {0.0, std::nullopt}},
                                         {"right", {1.0, std::nullopt}},
                                         {"bottom", {std::nullopt, 0.0}},
                                         {"top", {std::nullopt, 1.0}}}};

std::optional<double> share(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0.0 && value <= 1.0))
        return std::nullopt;
    return value;
}

std::string sample_name(std::size_t index, const std::string& place) {
    return "sample " + std::to_string(index + 1) + " (" + place + ")";
}

Result<std::vector<FitPoint>> points_of(std::span<const CalibrationSample> samples) {
    std::vector<FitPoint> points;
    points.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto place = screen_place(samples[i].place);
        const std::string where = sample_name(i, samples[i].place);
        if (!place) {
            return fail(where, "names no place on a screen",
                        "use lower_left, lower_right, upper_left, upper_right, left, right, bottom, top or u:v from 0 "
                        "to 1");
        }
        if (!finite(samples[i].tip_tracker)) {
            return fail(where, "is not a number", "leave it out, and touch that place again");
        }
        points.push_back({*place, samples[i].tip_tracker});
    }
    return points;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// Reduces each place whose both coordinates are known to one point: the medians of its samples' coordinates.
std::vector<FitPoint> medians(std::span<const CalibrationSample> samples, std::span<const FitPoint> points) {
    std::vector<FitPoint> result;
    std::vector<bool> done(points.size(), false);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (done[i] || !points[i].place.u || !points[i].place.v) continue;
        std::array<std::vector<double>, 3> coordinates;
        for (std::size_t j = i; j < points.size(); ++j) {
            if (samples[j].place != samples[i].place) continue;
            done[j] = true;
            for (int axis = 0; axis < 3; ++axis) {
                coordinates[static_cast<std::size_t>(axis)].push_back(points[j].at_tracker[axis]);
            }
        }
        result.push_back({points[i].place, {median(coordinates[0]), median(coordinates[1]), median(coordinates[2])}});
    }
    return result;
}

Error underdetermined() {
    return {"the samples do not fix the screen: they must cover three corners at least, not on a line", "samples",
            "touch lower_left, lower_right and upper_left, better all four corners, three times each"};
}

// Standard deviation of one coordinate from the median of the magnitudes, with the correction for few samples and
// kUnknowns parameters of Rousseeuw and Leroy ("Robust Regression and Outlier Detection", 1987). Infinite for too few
// samples, so that none is an outlier.
double standard_deviation(const std::vector<double>& sizes) {
    constexpr double kOfAGaussian = 1.4826, kUnknowns = 8.0;
    const double spare = static_cast<double>(sizes.size()) - kUnknowns;
    return spare > 0.0 ? kOfAGaussian * (1.0 + 5.0 / spare) * median(sizes) : HUGE_VAL;
}

// Flags the samples that are not outliers of the rectangle.
std::vector<bool> inliers(std::span<const FitPoint> points, const FitRectangle& rectangle) {
    std::vector<double> coordinates, distances;
    for (const FitPoint& p : points) {
        const FitResidual r = residual(rectangle, p);
        for (const double c : {r.right_m, r.up_m, r.out_m})
            if (c != 0.0) coordinates.push_back(std::abs(c));  // 0: a coordinate that an edge leaves free
        distances.push_back(r.length_m());
    }
    const double sigma_m = standard_deviation(coordinates);
    std::vector<bool> near;
    near.reserve(points.size());
    for (const double d : distances) near.push_back(d <= std::max(kOutlierSigmas * sigma_m, kOutlierFloor_m));
    return near;
}

Result<FitRectangle> fit_without_outliers(std::span<const FitPoint> points, FitRectangle rectangle,
                                          const std::optional<ScreenSize>& size, std::vector<bool>& used) {
    for (int round = 0; round < kMostRounds; ++round) {
        std::vector<bool> near = inliers(points, rectangle);
        if (round > 0 && near == used) break;
        used = std::move(near);
        std::vector<FitPoint> kept;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (used[i]) kept.push_back(points[i]);
        }
        const auto better = refine(rectangle, kept, size.has_value());
        if (!better) return std::unexpected(underdetermined());
        rectangle = *better;
    }
    return rectangle;
}

Result<void> check_places(std::span<const CalibrationSample> samples, const std::vector<bool>& used) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        int all = 0, good = 0;
        for (std::size_t j = 0; j < samples.size(); ++j) {
            if (samples[j].place != samples[i].place) continue;
            ++all;
            good += used[j] ? 1 : 0;
        }
        if (2 * good > all) continue;
        return fail("place " + samples[i].place,
                    formatted("%d of its %d samples do not fit the others' rectangle", all - good, all),
                    "touch it again, and see that the tracker sees the wand there");
    }
    return {};
}

void add_residuals(ScreenFit& fit, std::span<const CalibrationSample> samples, std::span<const FitPoint> points,
                   const FitRectangle& rectangle, const std::vector<bool>& used) {
    double sum_mm2 = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double mm = 1e3 * residual(rectangle, points[i]).length_m();
        if (!used[i]) {
            fit.outliers.push_back({i, samples[i].place, mm});
            continue;
        }
        auto at = std::ranges::find(fit.places, samples[i].place, &PlaceResidual::place);
        if (at == fit.places.end()) at = fit.places.insert(at, {samples[i].place, 0, 0.0});
        ++at->samples;
        at->rms_mm += mm * mm;  // sum of squares; divided and rooted below
        sum_mm2 += mm * mm;
        ++count;
        fit.max_mm = std::max(fit.max_mm, mm);
    }
    for (PlaceResidual& p : fit.places) p.rms_mm = std::sqrt(p.rms_mm / p.samples);
    fit.rms_mm = std::sqrt(sum_mm2 / count);
}

Result<ScreenFit> described(const FitRectangle& r) {
    if (!(r.width_m >= kLeastSize_m && r.height_m >= kLeastSize_m && r.width_m <= kMostSize_m &&
          r.height_m <= kMostSize_m)) {
        return fail("samples", formatted("they make a screen of %.3g by %.3g m", r.width_m, r.height_m),
                    "look at the samples' unit and at the names of the places");
    }
    const Vec3 right = r.width_m * r.right, up = r.height_m * r.up, corner = r.centre - 0.5 * right - 0.5 * up;
    ScreenFit fit;
    fit.lower_left_tracker = corner;
    fit.lower_right_tracker = corner + right;
    fit.upper_left_tracker = corner + up;
    fit.width_m = r.width_m;
    fit.height_m = r.height_m;
    return fit;
}

}  // namespace

std::optional<ScreenPlace> screen_place(const std::string& name) {
    for (const NamedPlace& p : kPlaces) {
        if (name == p.name) return p.place;
    }
    const std::size_t colon = name.find(':');
    if (colon == std::string::npos) return std::nullopt;
    const auto u = share(std::string_view(name).substr(0, colon)), v = share(std::string_view(name).substr(colon + 1));
    if (!u || !v) return std::nullopt;
    return ScreenPlace{u, v};
}

Result<ScreenFit> fit_screen(std::span<const CalibrationSample> samples, const std::optional<ScreenSize>& known_size) {
    BURIN_TRY(points, points_of(samples));
    auto start = rough_rectangle(medians(samples, points));
    if (!start) return std::unexpected(underdetermined());
    if (known_size) start->width_m = known_size->width_m, start->height_m = known_size->height_m;
    std::vector<bool> used;
    BURIN_TRY(rectangle, fit_without_outliers(points, *start, known_size, used));
    BURIN_TRY_DO(check_places(samples, used));
    auto fit = described(rectangle);
    if (fit) add_residuals(*fit, samples, points, rectangle, used);
    return fit;
}

Result<SampleDistances> distances_from(const WallScreen& screen, std::span<const CalibrationSample> samples) {
    BURIN_TRY(points, points_of(samples));
    const Vec3 right = screen.lower_right_tracker - screen.lower_left_tracker;
    const Vec3 up = screen.upper_left_tracker - screen.lower_left_tracker;
    const FitRectangle rectangle{0.5 * (screen.lower_right_tracker + screen.upper_left_tracker), glm::normalize(right),
                                 glm::normalize(up), glm::length(right), glm::length(up)};
    SampleDistances distances;
    double sum_mm2 = 0.0;
    for (const FitPoint& p : points) {
        const double mm = 1e3 * residual(rectangle, p).length_m();
        sum_mm2 += mm * mm;
        distances.max_mm = std::max(distances.max_mm, mm);
    }
    if (!points.empty()) distances.rms_mm = std::sqrt(sum_mm2 / static_cast<double>(points.size()));
    return distances;
}

}  // namespace burin::wall
