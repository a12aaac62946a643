// SPDX-License-Identifier: MIT
// The comparison's arithmetic and its outputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/plot/figures.hpp"
#include "bench/peers/peers.hpp"
#include "bench/stroke/pareto.hpp"

namespace burin::bench {
namespace {

// Every element is closed, in order, and every attribute quoted: what an XML reader insists on.
void expect_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
        const std::size_t end = xml.find('>', at);
        ASSERT_NE(end, std::string::npos);
        const std::string tag = xml.substr(at + 1, end - at - 1);
        EXPECT_EQ(std::ranges::count(tag, '"') % 2, 0) << tag;
        EXPECT_EQ(tag.find('<'), std::string::npos) << tag;
        const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
        if (tag.starts_with('/')) {
            ASSERT_FALSE(open.empty());
            EXPECT_EQ(name, "/" + open.back());
            open.pop_back();
        } else if (!tag.ends_with('/')) {
            open.push_back(name);
        }
    }
    EXPECT_TRUE(open.empty());
    for (std::size_t at = xml.find('&'); at != std::string::npos; at = xml.find('&', at + 1)) {
        const std::string entity = xml.substr(at, xml.find(';', at) - at + 1);
        EXPECT_TRUE(entity == "&amp;" || entity == "&lt;" || entity == "&gt;" || entity == "&quot;") << entity;
    }
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

}  // namespace

TEST(TimeAtError, FollowsAPowerLaw) {
    // time = error^-2
    const std::vector<TimeAndError> points{{1.0, 1.0}, {100.0, 0.1}, {10000.0, 0.01}};
    EXPECT_NEAR(*time_at_error(points, 0.5), 4.0, 1e-12);
    EXPECT_NEAR(*time_at_error(points, 0.02), 2500.0, 1e-9);
    EXPECT_NEAR(*time_at_error(points, 0.1), 100.0, 1e-10);
}

TEST(TimeAtError, GivesNoTimeForWhatWasNotReached) {
    const std::vector<TimeAndError> points{{1.0, 0.5}, {2.0, 0.25}};
    EXPECT_EQ(*time_at_error(points, 3.0), 1.0);  // the coarsest is good enough
    EXPECT_FALSE(time_at_error(points, 0.2).has_value());
    EXPECT_FALSE(time_at_error({}, 0.2).has_value());
    EXPECT_FALSE(time_at_error(points, 0.0).has_value());
}

TEST(SvgFigure, IsWellFormedWithHostileText) {
    const plot::PlotSeries bad{"a <b> & \"c\"", {{1.0, 1.0, "<&>"}, {2.0, 0.5, ""}}};
    const std::string svg = plot::svg_figure("1 < 2 & 3", {{"t<", "x&", "y\"", {bad}}, {"t", "x", "y", {bad}}});
    expect_well_formed(svg);
    EXPECT_EQ(svg.find("a <b>"), std::string::npos);
}

TEST(SvgFigure, StaysInItsFrameAndLeavesOutWhatHasNoLogarithm) {
    const double infinity = std::numeric_limits<double>::infinity();
    const plot::PlotSeries series{
        "s", {{1e-3, 1e-9, ""}, {1e3, 1e6, ""}, {0.0, 1.0, ""}, {1.0, -1.0, ""}, {1.0, infinity, ""}}};
    const std::string svg = plot::svg_figure("wide", {{"t", "x", "y", {series}}});
    expect_well_formed(svg);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    std::size_t circles = 0;
    for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) {
        ++circles;
        const double x = std::stod(svg.substr(svg.find("cx=\"", at) + 4)),
                     y = std::stod(svg.substr(svg.find("cy=\"", at) + 4));
        EXPECT_GT(x, 0.0);
        EXPECT_LT(x, 430.0);
        EXPECT_GT(y, 0.0);
        EXPECT_LT(y, 520.0);
    }
    EXPECT_EQ(circles, 3u);  // two points and the legend
    expect_well_formed(plot::svg_figure("nothing", {}));
    expect_well_formed(plot::svg_figure("empty", {{"t", "x", "y", {}}}));
}

TEST(Pareto, RunsBothEnginesAndWritesTableCsvAndFigure) {
    ParetoOptions options;
    options.smallest = 16;
    options.largest = 32;
    options.threads = 2;
    options.updates = 8;
    options.cgal_updates = 2;
    std::size_t told = 0;
    const auto pareto = run_pareto(options, [&](const std::string& line) { told += line.empty() ? 0 : 1; });
    ASSERT_TRUE(pareto.has_value());
    EXPECT_EQ(told, pareto->rows.size());
    const auto rows_with = [&](const std::string& part) {
        return std::ranges::count_if(pareto->rows, [&](const auto& row) {
            return row["series"].template get<std::string>().find(part) != std::string::npos;
        });
    };
    EXPECT_EQ(rows_with("Burin cpu, 2 threads"), 2);
    EXPECT_TRUE(rows_with("Burin vulkan") == 2 || !pareto->left_out.empty());
    if (has_peers()) {
        EXPECT_EQ(rows_with("OpenVDB"), 4);
        EXPECT_EQ(rows_with("CGAL"), 3);
    } else {
        EXPECT_NE(pareto->left_out.back().find("scripts/setup --peers"), std::string::npos);
    }
    const auto csv = lines_of(pareto_csv(*pareto));
    ASSERT_EQ(csv.size(), pareto->rows.size() + 2);
    EXPECT_TRUE(csv[0].starts_with("# "));
    for (std::size_t i = 1; i < csv.size(); ++i) {
        EXPECT_EQ(std::ranges::count(csv[i], ','), std::ranges::count(csv[1], ',')) << csv[i];
    }
    EXPECT_EQ(lines_of(pareto_table(*pareto)).size(), pareto->rows.size() + 2 + pareto->left_out.size());
    expect_well_formed(pareto_svg(*pareto));
}

}  // namespace burin::bench
