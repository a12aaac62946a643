// SPDX-License-Identifier: MIT
// The figures of a tool in the groove that it cuts: their points as a file, and what is drawn of them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/haptics/groove_figure.hpp"
#include "tests/support/run_command.hpp"

namespace burin::bench {
namespace {

const std::vector<GroovePoint> kSomeGroove{{"sinks", "mill", "law", 128, 1.5, 3.0},
                                           {"sinks", "mill", "now", 128, 1.5, 3.0625},
                                           {"lifted", "mill", "now", 256, 0.25, 0.1}};

}  // namespace

TEST(GrooveFigure, IsReadAsItIsWrittenAsOfItsVersion) {
    const auto points = groove_points(groove_csv(kSomeGroove), "old.csv", "before");
    ASSERT_TRUE(points.has_value()) << points.error().line();
    ASSERT_EQ(points->size(), kSomeGroove.size());
    for (std::size_t i = 0; i < points->size(); ++i) {
        const GroovePoint &read = (*points)[i], &written = kSomeGroove[i];
        EXPECT_EQ(read.kind, written.kind);
        EXPECT_EQ(read.tool, written.tool);
        EXPECT_EQ(read.what, written.what == "now" ? "before" : written.what);
        EXPECT_EQ(read.resolution, written.resolution);
        EXPECT_EQ(read.x, written.x);
        EXPECT_EQ(read.y, written.y);
    }
}

TEST(GrooveFigure, RefusesOtherFilesByTheirLine) {
    for (const char* bad : {"sinks,mill,now,128,1.5", "bores,mill,now,128,1.5,3", "sinks,mill,now,128,1.5,nan",
                            "sinks,mill,now,-1,1.5,3"}) {
        const auto points = groove_points(groove_csv(kSomeGroove) + bad + "\n", "old.csv", "before");
        ASSERT_FALSE(points.has_value()) << bad;
        EXPECT_NE(points.error().line().find("old.csv, line 5"), std::string::npos) << points.error().line();
    }
    EXPECT_FALSE(groove_points("", "old.csv", "before").has_value());
}

TEST(GrooveFigure, ShowsTheLawTheLatticesAndWhatWasBefore) {
    std::vector<GroovePoint> points = *groove_points(groove_csv(kSomeGroove), "old.csv", "before");
    points.insert(points.end(), kSomeGroove.begin(), kSomeGroove.end());
    const std::string sinking = sinking_svg(kSomeGroove), lifted = lifted_svg(points);
    for (const char* said : {"mill", "law", "N = 128", "yields"}) EXPECT_NE(sinking.find(said), std::string::npos);
    for (const char* said : {"mill", "before", "now", "floor"}) EXPECT_NE(lifted.find(said), std::string::npos);
    EXPECT_EQ(lifted.find("N = 128"), std::string::npos);
}

TEST(GrooveFigure, IsMeasuredAndDrawnByTheCommand) {
    const Workplace place;
    const std::string bench = std::string(kBurinCommand) + " bench haptics --quick ";
    const auto first = place.run(bench + "--groove .");
    ASSERT_EQ(first.status, 0) << first.output;
    const auto points = groove_points(place.read("groove.csv"), "groove.csv", "now");
    ASSERT_TRUE(points.has_value());
    // Below its yield a ball nearly holds still, on so coarse a lattice, and above it sinks.
    std::size_t judged = 0;
    for (const GroovePoint& point : *points) {
        if (point.kind != "sinks" || point.what != "now") continue;
        ++judged;
        EXPECT_EQ(point.y > 1.0, point.x > 1.0) << point.x;
    }
    EXPECT_EQ(judged, 2u);
    EXPECT_NE(place.read("sinking.svg").find("N = 64"), std::string::npos);
    ASSERT_EQ(place.run("mv groove.csv old.csv").status, 0);
    const auto second = place.run(bench + "--groove . --before old.csv");
    ASSERT_EQ(second.status, 0) << second.output;
    EXPECT_NE(place.read("lifted.svg").find("before"), std::string::npos);
    const auto alone = place.run(bench + "--before old.csv");
    EXPECT_NE(alone.status, 0);
    EXPECT_NE(alone.output.find("--groove"), std::string::npos) << alone.output;
}

}  // namespace burin::bench
