// SPDX-License-Identifier: MIT
// The same path steered at any rate gives the same groove. Once it did not: one target a frame, reached in at most 50
// ms, made ribs of 0.2 to 0.6 cells at 10 frames a second, and a string of beads of 0.7 to 2.1 cells at 5.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/sculpt/steered_groove.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::sculpt {
namespace {

constexpr double kSame_cells = 0.1;

struct NamedPath {
    std::string name;
    double speed_mm_per_s = 0.0;
    GroovePath path;
    // The part that is compared. The hand goes down into the block and up again in one interval of 5 targets a second
    // each. On a circle two more intervals pass until enough targets after the corner tell how it is bent, and one does
    // before its end.
    double from_s = 0.0, to_s = 0.0;

    NamedPath(std::string called, double speed, GroovePath along, double after_s, double before_s)
        : name(std::move(called)),
          speed_mm_per_s(speed),
          path(std::move(along)),
          from_s(path.begin_s + kGrooveDown_s + after_s),
          to_s(path.end_s - kGrooveDown_s - before_s) {}
};

NamedPath line(double speed_mm_per_s) {
    return {"line", speed_mm_per_s, line_path(1e-3 * speed_mm_per_s, speed_mm_per_s > 100.0 ? 0.8 : 1.2), 0.1, 0.1};
}

// From target to target, at 5 a second, by a third of a radian; by 0.6 at 150 mm/s, where the workspace allows no more.
NamedPath circle(double speed_mm_per_s) {
    const double radius_m = speed_mm_per_s > 100.0 ? 0.05 : 1e-3 * 0.6 * speed_mm_per_s;
    return {"circle", speed_mm_per_s, circle_path(1e-3 * speed_mm_per_s, radius_m, speed_mm_per_s > 100.0 ? 2.0 : 1.6),
            0.6, 0.4};
}

NamedPath corners(double speed_mm_per_s) {
    return {"corners", speed_mm_per_s, corner_path(1e-3 * speed_mm_per_s), 0.1, 0.1};
}

std::string text(const GrooveDifference& d, const GroovePath& path) {
    return std::to_string(d.most_cells) + " cells at " + std::to_string(d.at_s - path.begin_s) + " s, p99 " +
           std::to_string(d.p99_cells) + ", of a groove of " + std::to_string(d.deepest_cells) + " cells, " +
           std::to_string(d.rays) + " rays";
}

struct NamedSampling {
    std::string name;
    Sampling sampling;
};

// The groove of 240 targets a second, which all others are compared with: carved once for all tests.
const Groove& often(const NamedPath& along) {
    static std::map<std::pair<std::string, double>, Groove> carved;
    const auto [at, is_new] = carved.try_emplace({along.name, along.speed_mm_per_s});
    if (is_new) at->second = carve_steered(along.path, deliver(along.path, {.rate_Hz = 240.0}));
    return at->second;
}

void expect_same(const NamedPath& along, const NamedSampling& one) {
    const Groove groove = carve_steered(along.path, deliver(along.path, one.sampling));
    const GrooveDifference d = difference(often(along), groove, along.path, along.from_s, along.to_s);
    EXPECT_LT(d.most_cells, kSame_cells) << along.name << " at " << along.speed_mm_per_s << " mm/s, " << one.name
                                         << ": " << text(d, along.path);
    EXPECT_GT(d.rays, 100u);
    EXPECT_GT(d.deepest_cells, 0.8) << along.name;  // there is a groove
}

// A path, and with which of the samplings it is tried in an ordinary run; the soak tries all paths with all of them.
struct Tried {
    NamedPath along;
    std::vector<std::size_t> samplings;
};

void expect_same_for_all(const std::vector<Tried>& tried, const std::vector<NamedSampling>& samplings) {
    const bool all = burin::test::costly_cases(10) == 10;
    for (const Tried& one : tried)
        for (std::size_t i = 0; i < samplings.size(); ++i)
            if (all || std::ranges::find(one.samplings, i) != one.samplings.end()) expect_same(one.along, samplings[i]);
}

}  // namespace

// Few targets a second are the hardest.
TEST(SteeredGroove, IsTheSameAtFiveTenSixtyAnd240TargetsASecond) {
    expect_same_for_all(
        {{line(20.0), {}},
         {circle(20.0), {0}},
         {corners(20.0), {}},
         {line(60.0), {0}},
         {circle(60.0), {0, 1}},
         {corners(60.0), {0, 2}},
         {line(150.0), {0}},
         {circle(150.0), {0}},
         {corners(150.0), {0, 1}}},
        {{"5 a second", {.rate_Hz = 5.0}}, {"10 a second", {.rate_Hz = 10.0}}, {"60 a second", {.rate_Hz = 60.0}}});
}

// Frames that are drawn slowly tell all that has happened meanwhile at once.
TEST(SteeredGroove, IsTheSameWhereTargetsComeInBurstsOrLate) {
    expect_same_for_all({{line(150.0), {0, 3}}, {circle(60.0), {1, 4}}, {corners(60.0), {2}}},
                        {{"240 a second, in 5 frames", {.rate_Hz = 240.0, .frames_Hz = 5.0}},
                         {"60 a second, in 10 frames", {.rate_Hz = 60.0, .frames_Hz = 10.0}},
                         {"120 a second, in 60 frames", {.rate_Hz = 120.0, .frames_Hz = 60.0}},
                         {"5 a second, up to 60 ms late", {.rate_Hz = 5.0, .lateness = 0.3, .seed = 3}},
                         {"60 a second, up to 5 ms late", {.rate_Hz = 60.0, .lateness = 0.3, .seed = 5}}});
}

// Targets at uneven times, by 30 % of an interval; corners are targets, since what lies between targets is not told.
TEST(SteeredGroove, IsTheSameWhereTargetsAreUnevenInTime) {
    expect_same_for_all({{line(60.0), {2}}, {line(150.0), {0}}, {circle(60.0), {0}}, {corners(60.0), {0, 1}}},
                        {{"10 a second", {.rate_Hz = 10.0, .jitter = 0.3, .seed = 4, .keeps_corners = true}},
                         {"60 a second", {.rate_Hz = 60.0, .jitter = 0.3, .seed = 5, .keeps_corners = true}},
                         {"240 a second", {.rate_Hz = 240.0, .jitter = 0.3, .seed = 6, .keeps_corners = true}}});
}

}  // namespace burin::sculpt
