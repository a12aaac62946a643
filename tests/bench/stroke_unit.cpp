// SPDX-License-Identifier: MIT
// burin bench stroke on a small lattice: the run, its report, and that the engines' figures that must agree do.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "bench/stroke/stroke_report.hpp"
#include "geometry/mesh/mesh_health.hpp"
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
                                             "update_cpu_ms_median",
                                             "update_with_undo_ms_median",
                                             "update_with_undo_ms_p99",
                                             "update_with_undo_cpu_ms_median",
                                             "update_with_light_ms_median",
                                             "update_with_light_ms_p99",
                                             "update_with_light_cpu_ms_median"};

CarveScene short_scene() { return beginning_of(stroke_1000_scene(), 30, 400); }

Json report_of(const CarveScene& scene, const StrokeRun& run) {
    return describe(scene, run, measure(run.mesh, scene, run.cell_m), count_self_intersections(run.mesh, 1));
}

geometry::TriangleMesh octahedron() {
    geometry::TriangleMesh mesh;
    mesh.positions_m = {{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return mesh;
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
    EXPECT_EQ(run->intervals->lost, 0u);
    EXPECT_EQ(run->intervals->extra, 0u);
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
    EXPECT_EQ(run->intervals->lost + run->intervals->extra, 0u);
    EXPECT_NE(table(report).find("crease_rms_h"), std::string::npos);
}

TEST(Stroke, TimesTheSameUpdatesWithUndoAndWithLightWhereAsked) {
    const CarveScene scene = short_scene();
    const auto plain = run_stroke(scene, {32, false, 1}), both = run_stroke(scene, {32, false, 1, true, true});
    ASSERT_TRUE(plain.has_value() && both.has_value());
    EXPECT_TRUE(plain->with_undo.update_ms.empty() && plain->with_light.update_ms.empty());
    EXPECT_TRUE(report_of(scene, *plain)["update_with_undo_ms_median"].is_null());
    EXPECT_EQ(both->with_undo.update_ms.size(), 30u);
    EXPECT_EQ(both->with_undo.cpu_ms.size(), 30u);
    EXPECT_EQ(both->strokes_kept, 1u);  // of 100 updates, had there been so many
    EXPECT_EQ(both->with_light.update_ms.size(), 30u);
    EXPECT_GT(both->tiles_lit, 30u);
    EXPECT_LE(both->tiles_lit, 120u);  // the budget of a session: 4 tiles an update
    EXPECT_GT(report_of(scene, *both)["update_with_light_ms_median"].get<double>(), 0.0);
    EXPECT_EQ(plain->rays_touched, both->rays_touched);
}

TEST(Stroke, AStrokeEndsAsOftenAsInASession) {
    const auto run = run_stroke(beginning_of(stroke_1000_scene(), 230, 100), {16, false, 1, true});
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->strokes_kept, 3u);  // 100, 100 and 30 updates
}

TEST(Stroke, OfATurnedCubeIsJudgedByTheSameClosedForms) {
    const CarveScene scene = turned(short_scene());
    const auto run = run_stroke(scene, {48, false, 1});
    ASSERT_TRUE(run.has_value());
    EXPECT_NEAR(run->cell_m, 1.0 / 48, 0.01 / 48);
    EXPECT_EQ(run->intervals->lost, 0u);
    EXPECT_EQ(run->intervals->extra, 0u);
    const auto report = report_of(scene, *run);
    EXPECT_EQ(report["scene"], "stroke-1000 (first 30)-turned");
    EXPECT_EQ(report["bad_edges"], 0);
    EXPECT_LT(report["cut_rms_h"].get<double>(), 0.1);
    EXPECT_LT(report["edge_rms_h"].get<double>(), 0.1);
    EXPECT_LT(std::abs(report["volume_error_over_removed"].get<double>()), 0.05);
    const auto unturned = report_of(short_scene(), *run);  // the wrong reference
    EXPECT_GT(unturned["surface_rms_h"].get<double>(), 1.0);
}

TEST(Stroke, OnAMeshIsMeasuredAsFarAsItsAnswerIsKnown) {
    const auto whole = stroke_on_mesh_scene("octahedron", octahedron(), false);
    ASSERT_TRUE(whole.has_value());
    const CarveScene scene = beginning_of(*whole, 40, 0);
    ASSERT_EQ(scene.sweeps.size(), 40u);
    for (const compute::BallSweep& stamp : scene.sweeps) {
        const Vec3 from_centre = glm::abs(stamp.start_object_m - Vec3(0.5));
        const double outside = (from_centre.x + from_centre.y + from_centre.z - 0.5) / std::sqrt(3.0);
        EXPECT_LT(std::abs(outside), 0.046);  // as deep as in the cube, or less where the line is oblique
    }
    const auto run = run_stroke(scene, {48, false, 1});
    ASSERT_TRUE(run.has_value());
    EXPECT_GT(run->rays_changed, 100u);
    EXPECT_EQ(run->intervals->lost, 0u);
    EXPECT_EQ(run->intervals->extra, 0u);
    const auto report = report_of(scene, *run);
    EXPECT_EQ(report["disagreeing_edges"], 0);
    EXPECT_LT(report["cut_rms_h"].get<double>(), 0.1);
    EXPECT_TRUE(report["volume_error_over_removed"].is_null());
    EXPECT_TRUE(report["edge_rms_h"].is_null());
}

TEST(Stroke, ScenesAreSortedByFaultsAndThenByError) {
    const auto row = [](const char* scene, int lost, double cut_rms_h) {
        Json report = {{"scene", scene},         {"disagreeing_edges", 0}, {"self_intersections", nullptr},
                       {"lost_intervals", lost}, {"extra_intervals", 0},   {"cut_rms_h", cut_rms_h}};
        for (const char* key : {"updates", "update_ms_median", "update_ms_p99", "update_with_undo_ms_median",
                                "update_with_light_ms_median", "cut_max_h", "edge_rms_h", "rim_rms_h", "crease_rms_h"})
            report[key] = nullptr;
        return report;
    };
    std::vector<Json> reports{row("fine", 0, 0.01), row("coarse", 0, 0.02), row("faulty", 1, 0.001)};
    sort_worst_first(reports);
    const std::string text = scene_table(reports);
    EXPECT_LT(text.find("faulty"), text.find("coarse"));
    EXPECT_LT(text.find("coarse"), text.find("fine"));
}

// What the ball removes of the cube in a few cuts that do not meet each other, the other tools do too, to a tenth.
TEST(Stroke, WithAnotherToolRemovesAboutWhatTheBallDoes) {
    CarveScene scene = stroke_1000_scene();
    const std::vector<compute::BallSweep> all = scene.sweeps;
    scene.sweeps.clear();
    for (std::size_t i = 0; i < all.size(); i += 100) scene.sweeps.push_back(all[i]);
    const auto removed_m3 = [&](StrokeTool tool) {
        const auto run = run_stroke(scene, {.resolution = 48, .threads = 1, .tool = tool});
        EXPECT_TRUE(run.has_value());
        if (!run) return 0.0;
        EXPECT_EQ(run->intervals.has_value(), tool == StrokeTool::ball);
        EXPECT_EQ(run->disagreeing_edges, 0u) << name_of(tool);
        return 1.0 - geometry::examine(run->mesh).signed_volume_m3;
    };
    const double ball_m3 = removed_m3(StrokeTool::ball);
    EXPECT_GT(ball_m3, 0.004);
    for (const StrokeTool tool : {StrokeTool::cylinder, StrokeTool::cone, StrokeTool::bullnose, StrokeTool::box})
        EXPECT_NEAR(removed_m3(tool) / ball_m3, 1.0, 0.1) << name_of(tool);
}

TEST(Stroke, OfAToolWithoutClosedFormsReportsNoErrorsButAllElse) {
    const CarveScene scene = beginning_of(stroke_1000_swept_scene(), 10, 1);
    const auto run = run_stroke(scene, {.resolution = 32, .threads = 1, .tool = StrokeTool::cone});
    ASSERT_TRUE(run.has_value());
    const Json report = describe(scene, *run, std::nullopt, count_self_intersections(run->mesh, 1));
    for (const char* key : {"cut_rms_h", "surface_max_h", "volume_error_over_removed", "lost_intervals"})
        EXPECT_TRUE(report[key].is_null()) << key;
    EXPECT_GT(report["triangles"], 1000);
    EXPECT_EQ(report["bad_edges"], 0);
    EXPECT_GT(report["rays_changed"], 100);
    EXPECT_TRUE(report["counts_per_update"].is_null()) << "there is no device";
    EXPECT_TRUE(counts_table(report).empty());
    std::vector<Json> both{report, report_of(short_scene(), *run_stroke(short_scene(), {32, false, 1}))};
    sort_worst_first(both);
    EXPECT_FALSE(scene_table(both).empty());
}

TEST(Stroke, TellsTheSpreadOfWhatUpdatesAskOfADevice) {
    const CarveScene scene = short_scene();
    auto run = run_stroke(scene, {32, false, 1});
    ASSERT_TRUE(run.has_value());
    EXPECT_TRUE(run->counts.submissions.empty()) << "there is no device";
    for (int i = 1; i <= 100; ++i) {
        run->counts.submissions.push_back(i == 100 ? 7.0 : 1.0);
        for (auto* counts : {&run->counts.blocking_waits, &run->counts.bytes_to_device, &run->counts.rays_changed})
            counts->push_back(i);
        run->counts.bytes_to_host.push_back(1000.0 * i);
    }
    const Json report = report_of(scene, *run);
    EXPECT_EQ(report["counts_per_update"]["submissions"]["median"], 1.0);
    EXPECT_EQ(report["counts_per_update"]["submissions"]["most"], 7.0);
    EXPECT_EQ(report["counts_per_update"]["submissions"]["all"], 106.0);
    EXPECT_EQ(report["counts_per_update"]["bytes_to_host"]["most"], 100'000.0);
    const std::string text = counts_table(report);
    EXPECT_EQ(std::ranges::count(text, '\n'), 6) << text;
    EXPECT_NE(text.find("all updates"), std::string::npos);
    EXPECT_EQ(table(report).find("counts_per_update"), std::string::npos);
}

TEST(Stroke, ThatSmoothsGoesOverWhatItsToolHasCut) {
    const auto cut = run_stroke(short_scene(), {.resolution = 48, .threads = 1});
    const auto smoothed = run_stroke(short_scene(), {.resolution = 48, .threads = 1, .smooths = true});
    ASSERT_TRUE(cut.has_value() && smoothed.has_value());
    EXPECT_GT(smoothed->rays_changed, 0u);
    EXPECT_FALSE(smoothed->intervals.has_value()) << "there is no closed form";
    EXPECT_NEAR(geometry::examine(smoothed->mesh).signed_volume_m3 / geometry::examine(cut->mesh).signed_volume_m3, 1.0,
                0.01);
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
