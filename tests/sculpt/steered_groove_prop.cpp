// SPDX-License-Identifier: MIT
// The same path steered at any rate gives the same groove. Once it did not: one target a frame, reached in at most 50
// ms, made ribs of 0.2 to 0.6 cells at 10 frames a second, and a string of beads of 0.7 to 2.1 cells at 5.
#include <gtest/gtest.h>

#include <string>

#include "tests/sculpt/steered_groove.hpp"

namespace burin::sculpt {
namespace {

constexpr double kSame_cells = 0.1;

struct NamedPath {
    std::string name;
    GroovePath path;
    // The part that is compared. The hand goes down into the block and up again in one interval of 5 targets a second
    // each. On a circle two more intervals pass until enough targets after the corner tell how it is bent, and one does
    // before its end.
    double from_s = 0.0, to_s = 0.0;

    NamedPath(std::string called, GroovePath along, double after_s, double before_s)
        : name(std::move(called)),
          path(std::move(along)),
          from_s(path.begin_s + kGrooveDown_s + after_s),
          to_s(path.end_s - kGrooveDown_s - before_s) {}
};

NamedPath line(double speed_mm_per_s) {
    return {"line", line_path(1e-3 * speed_mm_per_s, speed_mm_per_s > 100.0 ? 0.8 : 1.2), 0.1, 0.1};
}

// From target to target, at 5 a second, by a third of a radian; by 0.6 at 150 mm/s, where the workspace allows no more.
NamedPath circle(double speed_mm_per_s) {
    const double radius_m = speed_mm_per_s > 100.0 ? 0.05 : 1e-3 * 0.6 * speed_mm_per_s;
    return {"circle", circle_path(1e-3 * speed_mm_per_s, radius_m, speed_mm_per_s > 100.0 ? 2.0 : 1.6), 0.6, 0.4};
}

NamedPath corners(double speed_mm_per_s) { return {"corners", corner_path(1e-3 * speed_mm_per_s), 0.1, 0.1}; }

std::string text(const GrooveDifference& d, const GroovePath& path) {
    return std::to_string(d.most_cells) + " cells at " + std::to_string(d.at_s - path.begin_s) + " s, p99 " +
           std::to_string(d.p99_cells) + ", of a groove of " + std::to_string(d.deepest_cells) + " cells, " +
           std::to_string(d.rays) + " rays";
}

struct NamedSampling {
    std::string name;
    Sampling sampling;
};

void expect_same(const NamedPath& along, const std::vector<NamedSampling>& samplings) {
    const Groove often = carve_steered(along.path, deliver(along.path, {.rate_Hz = 240.0}));
    for (const NamedSampling& one : samplings) {
        const Groove groove = carve_steered(along.path, deliver(along.path, one.sampling));
        const GrooveDifference d = difference(often, groove, along.path, along.from_s, along.to_s);
        EXPECT_LT(d.most_cells, kSame_cells) << along.name << ", " << one.name << ": " << text(d, along.path);
        EXPECT_GT(d.rays, 100u);
        EXPECT_GT(d.deepest_cells, 0.8) << along.name;  // there is a groove
    }
}

}  // namespace

TEST(SteeredGroove, IsTheSameAtFiveTenSixtyAnd240TargetsASecond) {
    const std::vector<NamedSampling> rates{
        {"5 a second", {.rate_Hz = 5.0}}, {"10 a second", {.rate_Hz = 10.0}}, {"60 a second", {.rate_Hz = 60.0}}};
    for (const double speed : {20.0, 60.0, 150.0})
        for (const NamedPath& along : {line(speed), circle(speed), corners(speed)}) {
            SCOPED_TRACE(speed);
            expect_same(along, rates);
        }
}

// Frames that are drawn slowly tell all that has happened meanwhile at once.
TEST(SteeredGroove, IsTheSameWhereTargetsComeInBurstsOrLate) {
    const std::vector<NamedSampling> deliveries{
        {"240 a second, in 5 frames", {.rate_Hz = 240.0, .frames_Hz = 5.0}},
        {"60 a second, in 10 frames", {.rate_Hz = 60.0, .frames_Hz = 10.0}},
        {"120 a second, in 60 frames", {.rate_Hz = 120.0, .frames_Hz = 60.0}},
        {"5 a second, up to 60 ms late", {.rate_Hz = 5.0, .lateness = 0.3, .seed = 3}},
        {"60 a second, up to 5 ms late", {.rate_Hz = 60.0, .lateness = 0.3, .seed = 5}}};
    for (const NamedPath& along : {line(150.0), circle(60.0), corners(60.0)}) expect_same(along, deliveries);
}

// Targets at uneven times, by 30 % of an interval; corners are targets, since what lies between targets is not told.
TEST(SteeredGroove, IsTheSameWhereTargetsAreUnevenInTime) {
    const std::vector<NamedSampling> jittered{
        {"10 a second", {.rate_Hz = 10.0, .jitter = 0.3, .seed = 4, .keeps_corners = true}},
        {"60 a second", {.rate_Hz = 60.0, .jitter = 0.3, .seed = 5, .keeps_corners = true}},
        {"240 a second", {.rate_Hz = 240.0, .jitter = 0.3, .seed = 6, .keeps_corners = true}}};
    for (const NamedPath& along : {line(60.0), line(150.0), circle(60.0), corners(60.0)}) expect_same(along, jittered);
}

}  // namespace burin::sculpt
