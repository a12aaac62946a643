// SPDX-License-Identifier: MIT
// burin bench stroke on a small lattice: the run, its report, and that the engines' figures that must agree do.
#include <gtest/gtest.h>

#include <numeric>

#include "bench/stroke_report.hpp"
#include "gpu/device.hpp"

namespace burin::bench {
namespace {

// What issue trackers, plots and later comparisons read: a key that goes or changes its name breaks them.
const std::vector<std::string> kPromisedKeys{"update_ms_median",
                                             "update_ms_p99",
                                             "first_100_ms_median",
                                             "last_100_ms_median",
                                             "boolean_rays_per_s",
                                             "rays_touched",
                                             "rays_changed",
                                             "bytes_per_ray",
                                             "triangles",
                                             "volume_error_over_removed",
                                             "surface_rms_h",
                                             "surface_max_h",
                                             "cut_rms_h",
                                             "edge_rms_h",
                                             "rim_rms_h",
                                             "rim_max_h",
                                             "crease_rms_h",
                                             "crease_max_h",
                                             "bad_edges",
                                             "self_intersections",
                                             "lost_intervals",
                                             "engine",
                                             "threads",
                                             "resolution",
                                             "carve_ms_median",
                                             "mesh_ms_median",
                                             "publish_ms_median",
                                             "cells_per_update",
                                             "triangles_per_update",
                                             "update_cpu_ms_median"};

CarveScene short_scene() { return beginning_of(stroke_1000_scene(), 30, 400); }

Json report_of(const CarveScene& scene, const StrokeRun& run) {
    return describe(scene, run, measure(run.mesh, scene, run.cell_m), count_self_intersections(run.mesh, 1));
}

}  // namespace

TEST(Stroke, ReportsEveryPromisedFigure) {
    const CarveScene scene = short_scene();
    const auto run = run_stroke(scene, {32, false, 2});
    ASSERT_TRUE(run.has_value());
    const auto report = report_of(scene, *run);
    for (const std::string& key : kPromisedKeys) EXPECT_TRUE(report.contains(key)) << key;
    EXPECT_EQ(report["engine"], "cpu");
    EXPECT_EQ(report["threads"], 2);
    EXPECT_EQ(report["resolution"], 32);
    EXPECT_EQ(report["updates"], 30);
    const std::string text = table(report);
    for (const std::string& key : kPromisedKeys) EXPECT_NE(text.find("  " + key + " "), std::string::npos) << key;
}

TEST(Stroke, CarvesTheSceneAndPublishesIt) {
    const CarveScene scene = short_scene();
    const auto run = run_stroke(scene, {48, false, 1});
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->update_ms.size(), 30u);
    for (std::size_t i = 0; i < run->update_ms.size(); ++i) {
        EXPECT_DOUBLE_EQ(run->update_ms[i], run->carve_ms[i] + run->mesh_ms[i] + run->publish_ms[i]);
    }
    EXPECT_GT(run->triangles_published, 0u);
    EXPECT_GT(run->rays_touched, run->rays_changed);
    EXPECT_EQ(run->intervals.lost, 0u);
    EXPECT_EQ(run->intervals.extra, 0u);
    const auto report = report_of(scene, *run);
    EXPECT_EQ(report["bad_edges"], 0);
    EXPECT_LT(report["cut_rms_h"].get<double>(), 0.1);
    EXPECT_LT(std::abs(report["volume_error_over_removed"].get<double>()), 0.05);
    EXPECT_LT(report["edge_max_h"].get<double>(), 1e-3);
}

TEST(Stroke, SweepsHaveNoBallCreasesAndKeepAllElse) {
    const CarveScene swept = beginning_of(stroke_1000_swept_scene(), 20, 400);
    const auto run = run_stroke(swept, {32, false, 1});
    ASSERT_TRUE(run.has_value());
    const auto report = report_of(swept, *run);
    EXPECT_TRUE(report["crease_rms_h"].is_null());
    EXPECT_FALSE(report["rim_rms_h"].is_null());
    EXPECT_EQ(run->intervals.lost + run->intervals.extra, 0u);
    EXPECT_NE(table(report).find("crease_rms_h"), std::string::npos);
}

TEST(Stroke, GivesTheSameSurfaceOnAnyNumberOfThreads) {
    const CarveScene scene = short_scene();
    const auto one = run_stroke(scene, {32, false, 1}), three = run_stroke(scene, {32, false, 3});
    ASSERT_TRUE(one.has_value() && three.has_value());
    EXPECT_EQ(one->mesh.positions_m, three->mesh.positions_m);
    EXPECT_EQ(one->mesh.triangles, three->mesh.triangles);
    EXPECT_EQ(one->rays_touched, three->rays_touched);
}

TEST(Stroke, RefusesAResolutionThatIsNone) {
    const auto run = run_stroke(short_scene(), {4, false, 1});
    ASSERT_FALSE(run.has_value());
    EXPECT_FALSE(run.error().remedy.empty());
}

TEST(Stroke, FirstAndLastHundredAreTakenFromTheirEnds) {
    std::vector<double> times(250);
    std::iota(times.begin(), times.end(), 1.0);
    EXPECT_EQ(ageing(times).first_100_ms, 50.0);
    EXPECT_EQ(ageing(times).last_100_ms, 200.0);
    EXPECT_EQ(ageing({7.0}).first_100_ms, 7.0);
}

}  // namespace burin::bench
