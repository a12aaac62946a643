// SPDX-License-Identifier: MIT
// The scene that frames are measured on, the measuring itself with a subject that only counts, and what is told about
// it.
#include "bench/frame/frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/frame/frame_display.hpp"
#include "bench/frame/frame_peers.hpp"
#include "bench/measure/bumpy_sphere.hpp"
#include "bench/measure/flip.hpp"
#include "bench/measure/timing.hpp"

namespace burin::bench {
namespace {

constexpr BumpySphere kTrueSurface{.radius_m = 1.0, .bumps = 0.02, .waves = 12.0};

const FrameScene& small_scene() {
    static const FrameScene scene = make_frame_scene(20'000);
    return scene;
}

// Draws nothing: its picture has a given share of surface.
class CountingSubject final : public FrameSubject {
public:
    explicit CountingSubject(double covered) : covered_(covered) {}
    std::string name() const override { return "Burin"; }
    FrameWay way() const override { return kSessionWay; }
    Result<std::uint64_t> settle() override { return ++settled_; }
    Result<void> draw(const FrameStep& step) override {
        if (drawn_ == fails_at) return fail("frame", "was lost", "try again");
        ++drawn_;
        changes_ += step.changes.size();
        heads_.push_back(step.viewer.head_world.position_m);
        return {};
    }
    Result<StereoImage> picture() override {
        Image image{{100, 10}, {}};
        const FrameLook look;
        for (unsigned i = 0; i < 1000; ++i) {
            const Vec3 colour = 255.0 * (i < 1000.0 * covered_ ? look.surface : look.background);
            for (int k = 0; k < 3; ++k) image.rgba.push_back(static_cast<std::uint8_t>(std::lround(colour[k])));
            image.rgba.push_back(255);
        }
        return StereoImage{image, image};
    }
    FrameCounters counters() const override { return {{"number", static_cast<double>(drawn_)}}; }

    unsigned fails_at = 1'000'000;
    unsigned drawn_ = 0;
    std::uint64_t settled_ = 0;
    std::size_t changes_ = 0;
    std::vector<Vec3> heads_;

private:
    double covered_;
};

FrameOptions few_frames() {
    FrameOptions options;
    options.frames = 5;
    options.warm_up = 2;
    return options;
}

double covered_from_the_middle() {
    return expected_coverage(small_scene(), wall::eyes_of(still_viewer(small_scene())).left_world);
}

}  // namespace

TEST(FrameScene, IsTheTrueSurfaceWithItsNormals) {
    for (const FrameVertex& v : small_scene().whole.vertices) {
        const Vec3 p(v.position_world_m);
        ASSERT_LT(std::abs(kTrueSurface.distance_m(p)), 2e-7);  // rounded to float
        // Central differences of the distance, another way than the gradient's formula.
        Vec3 slope(0.0);
        for (int k = 0; k < 3; ++k) {
            Vec3 step(0.0);
            step[k] = 1e-5;
            slope[k] = kTrueSurface.value_m(p + step) - kTrueSurface.value_m(p - step);
        }
        ASSERT_GT(glm::dot(glm::normalize(slope), Vec3(v.normal_world)), 1.0 - 1e-6);
    }
}

TEST(FrameScene, HasEachTriangleInExactlyOnePatch) {
    const FrameScene& scene = small_scene();
    std::map<std::array<std::uint32_t, 3>, int> seen;
    for (std::size_t t = 0; t < scene.whole.indices.size(); t += 3)
        ++seen[{scene.whole.indices[t], scene.whole.indices[t + 1], scene.whole.indices[t + 2]}];
    for (std::size_t p = 0; p < scene.patches.size(); ++p) {
        const FrameMesh& patch = scene.patches[p];
        const std::vector<std::uint32_t>& whole = scene.whole_vertices[p];
        ASSERT_EQ(patch.vertices.size(), whole.size());
        for (std::size_t i = 0; i < whole.size(); ++i)
            ASSERT_EQ(patch.vertices[i].position_world_m, scene.whole.vertices[whole[i]].position_world_m);
        for (std::size_t t = 0; t < patch.indices.size(); t += 3)
            --seen[{whole[patch.indices[t]], whole[patch.indices[t + 1]], whole[patch.indices[t + 2]]}];
    }
    for (const auto& [triangle, count] : seen) ASSERT_EQ(count, 0);
    EXPECT_EQ(seen.size(), scene.triangles());
    EXPECT_NEAR(static_cast<double>(scene.triangles()), 20'000.0, 400.0);
}

TEST(FrameScene, CoversAlmostTheWholePictureFromEveryPlaceOfTheHead) {
    double least = 1.0;
    for (unsigned frame = 0; frame < kFramesAround; frame += 15) {
        const wall::Eyes eyes = wall::eyes_of(moving_viewer(small_scene(), frame));
        for (const Vec3& eye : {eyes.left_world, eyes.right_world}) {
            least = std::min(least, expected_coverage(small_scene(), eye));
            EXPECT_LT(expected_coverage(small_scene(), eye),
                      0.999);  // something of the background shows, so that it can be told
        }
    }
    EXPECT_GT(least, 0.93);
    EXPECT_NEAR(covered_from_the_middle(), 0.97, 0.01);
}

TEST(FrameScene, MovesTheHeadWithinATenthOfAMetreAndBackInSixtyFrames) {
    Box path;
    for (unsigned frame = 0; frame < kFramesAround; ++frame)
        path.include(moving_viewer(small_scene(), frame).head_world.position_m);
    EXPECT_NEAR(path.extent().x, 0.1, 1e-3);
    EXPECT_NEAR(path.extent().y, 0.1, 1e-3);
    EXPECT_EQ(moving_viewer(small_scene(), 7).head_world.position_m,
              moving_viewer(small_scene(), 7 + kFramesAround).head_world.position_m);
}

TEST(FrameScene, DentsAFewPatchesAndClosesTheSurfaceBehind) {
    const FrameScene& scene = small_scene();
    std::vector<FrameVertex> now = scene.whole.vertices;
    for (unsigned frame = 0; frame < 2 * kFramesAround; frame += 1) {
        const auto changes = wandering_dent(scene, frame);
        EXPECT_GE(changes.size(), 1u);
        EXPECT_LE(changes.size(), 8u);
        for (const PatchChange& change : changes) {
            ASSERT_EQ(change.vertices.size(), scene.patches[change.patch].vertices.size());
            for (std::size_t i = 0; i < change.vertices.size(); ++i)
                now[scene.whole_vertices[change.patch][i]] = change.vertices[i];
        }
        // Nothing is left behind: whatever differs from the first surface is this frame's dent, which is 0.12 m across.
        Box dent;
        double deepest = 0.0;
        for (std::size_t i = 0; i < now.size(); ++i) {
            const double depth = glm::distance(now[i].position_world_m, scene.whole.vertices[i].position_world_m);
            if (depth > 0.0) dent.include(Vec3(now[i].position_world_m));
            deepest = std::max(deepest, depth);
        }
        EXPECT_LT(std::max(dent.extent().x, dent.extent().y), 0.121) << frame;
        EXPECT_GT(deepest, 0.002);
        EXPECT_LT(deepest, 0.0041);
    }
}

TEST(FrameScene, ChangesSeamsAlikeInBothPatches) {
    const FrameScene& scene = small_scene();
    std::map<std::uint32_t, Vec3f> at;
    for (const PatchChange& change : wandering_dent(scene, 11))
        for (std::size_t i = 0; i < change.vertices.size(); ++i) {
            const Vec3f p = change.vertices[i].position_world_m;
            const auto [known, is_new] = at.try_emplace(scene.whole_vertices[change.patch][i], p);
            EXPECT_EQ(known->second, p);
        }
}

TEST(FrameTimes, DropTheWarmUpAndAverageTheCounters) {
    CountingSubject subject(covered_from_the_middle());
    const auto times = time_frames(subject, small_scene(), FrameMotion::still, few_frames());
    ASSERT_TRUE(times.has_value()) << times.error().line();
    EXPECT_EQ(subject.drawn_, 7u);
    EXPECT_EQ(times->cpu_ms.size(), 5u);
    EXPECT_EQ(times->wall_ms.size(), 5u);
    EXPECT_DOUBLE_EQ(times->counters.at(0).second, 5.0);  // of 3, 4, 5, 6, 7
    EXPECT_EQ(subject.changes_, 0u);
    for (const Vec3& head : subject.heads_) EXPECT_EQ(head, subject.heads_.front());
}

TEST(FrameTimes, CountTheLevelsOfDetailMadeBeforeAndAfterTheFrames) {
    CountingSubject subject(covered_from_the_middle());
    const auto times = time_frames(subject, small_scene(), FrameMotion::still, few_frames());
    ASSERT_TRUE(times.has_value()) << times.error().line();
    EXPECT_EQ(times->way, kSessionWay);
    EXPECT_EQ(times->levels.patches, 3u);  // 1 and 2, after the two frames of the warm-up
    EXPECT_EQ(times->levels_after.patches, 3u);
    EXPECT_GE(times->levels.cpu_ms, 0.0);
}

TEST(FrameTimes, MoveTheHeadOrChangePatchesAsAsked) {
    const double covered = covered_from_the_middle();
    CountingSubject carved(covered), moved(covered);
    ASSERT_TRUE(time_frames(carved, small_scene(), FrameMotion::carving, few_frames()).has_value());
    EXPECT_GE(carved.changes_, 7u);
    ASSERT_TRUE(time_frames(moved, small_scene(), FrameMotion::moving, few_frames()).has_value());
    EXPECT_EQ(moved.changes_, 0u);
    EXPECT_NE(moved.heads_[0], moved.heads_[1]);
}

TEST(FrameTimes, AreRefusedWhenThePictureIsNotWhatWasToBeDrawn) {
    CountingSubject half(0.5);
    const auto times = time_frames(half, small_scene(), FrameMotion::still, few_frames());
    ASSERT_FALSE(times.has_value());
    EXPECT_NE(times.error().line().find("50 % of the pixels instead of 97 %"), std::string::npos)
        << times.error().line();
    CountingSubject lost(1.0);
    lost.fails_at = 3;
    EXPECT_EQ(time_frames(lost, small_scene(), FrameMotion::still, few_frames()).error().what, "was lost");
}

TEST(FrameTimes, OfIdlingCountTheProcessorTimeOfAllThreads) {
    CountingSubject subject(1.0);
    const auto idle = time_idle(subject, 0.05);
    ASSERT_TRUE(idle.has_value());
    EXPECT_GE(idle->seconds, 0.05);
    EXPECT_GE(idle->cpu_share, 0.0);
}

TEST(FrameReport, ComparesWithTheFasterVariantOfAPeer) {
    FrameReport report;
    const auto add = [&](const std::string& name, FrameMotion motion, std::vector<double> ms, FrameWay way = {}) {
        FrameTimes times;
        times.subject = name;
        times.motion = motion;
        times.way = way;
        times.cpu_ms = times.wall_ms = std::move(ms);
        report.times.push_back(times);
    };
    add("Burin", FrameMotion::moving, {30, 10, 20}, kSessionWay);
    report.times.back().levels = {7, 50.0};
    add("OpenSceneGraph, patches", FrameMotion::moving, {90, 80, 70});
    add("OpenSceneGraph, one drawable", FrameMotion::moving, {40, 40, 40});
    add("VTK", FrameMotion::still, {100});
    EXPECT_DOUBLE_EQ(own_over_peer(report, FrameMotion::moving, "OpenSceneGraph").value(), 0.5);
    EXPECT_FALSE(own_over_peer(report, FrameMotion::moving, "VTK").has_value());
    EXPECT_FALSE(own_over_peer(report, FrameMotion::still, "VTK").has_value());  // our own was not measured

    const auto json = frame_json(report);
    EXPECT_EQ(json["times"].size(), 4u);
    EXPECT_EQ(json["times"][0]["cpu_median_ms"], 20.0);
    EXPECT_EQ(json["times"][0]["cpu_min_ms"], 10.0);
    EXPECT_EQ(json["ratios"][0]["own_over_osg"], 0.5);
    const std::string csv = frame_csv(report);
    EXPECT_EQ(std::ranges::count(csv, '\n'), 6);
    EXPECT_NE(csv.find("\"OpenSceneGraph, patches\",moving"), std::string::npos);
    const std::string table = frame_table(report);
    EXPECT_NE(table.find("moving, as set up: Burin uses 0.500 of what OpenSceneGraph uses"), std::string::npos)
        << table;
    EXPECT_NE(table.find("of 7 patches made before in 50.0 ms, 2.5 frames' worth"), std::string::npos) << table;
    EXPECT_DOUBLE_EQ(levels_in_frames(report).value(), 2.5);
    EXPECT_EQ(json["times"][0]["levels_ms"], 50.0);
    EXPECT_TRUE(json["times"][1]["levels_ms"].is_null());  // a peer has none
}

TEST(FrameReport, SetsEachWayAgainstItsOwn) {
    FrameReport report;
    report.machine = "a machine, load 0.1";
    const auto add = [&](const std::string& name, double ms, FrameWay way) {
        FrameTimes times;
        times.subject = name;
        times.way = way;
        times.cpu_ms = times.wall_ms = {ms};
        report.times.push_back(times);
    };
    using enum LitAt;
    using enum FrameLight;
    add("Burin", 10, {vertices, burins, true});
    add("Burin", 20, {pixels, burins, true});
    add("Burin", 80, {pixels, burins, false});
    add("VTK", 100, {pixels, simple, false});
    add("VTK", 50, {vertices, simple, false});
    add("VTK", 160, {pixels, burins, false});
    const std::map<std::string, double> expected{{"as set up", 0.1},
                                                 {"both at pixels", 0.2},
                                                 {"both at vertices", 0.2},
                                                 {"same light at pixels", 0.125},
                                                 {"same light and triangles at pixels", 0.5}};
    for (const FrameComparison& compared : kComparisons) {
        const auto ratio = own_over_peer(report, FrameMotion::moving, "VTK", compared);
        const auto known = expected.find(compared.name);
        ASSERT_EQ(ratio.has_value(), known != expected.end()) << compared.name;
        if (ratio) {
            EXPECT_DOUBLE_EQ(*ratio, known->second) << compared.name;
        }
    }
    EXPECT_EQ(frame_json(report)["ratios"].size(), expected.size());
    const std::string rows = ratio_rows(report, "1", true);
    EXPECT_EQ(std::ranges::count(rows, '\n'), 6);
    EXPECT_NE(rows.find("0,1,1,moving,as set up,VTK,0.1000,,,\"a machine, load 0.1\"\n"), std::string::npos) << rows;
    EXPECT_EQ(std::ranges::count(ratio_rows(report, "1", false), '\n'), 5);
}

TEST(FramePeers, SayHowToGetThemWhereTheyAreNotBuilt) {
    if (has_frame_peers()) GTEST_SKIP() << "they are built in";
    for (const auto& subject :
         {open_osg(small_scene(), 1, OsgDrawables::one).error(), open_vtk(small_scene(), 1).error()}) {
        EXPECT_NE(subject.line().find("scripts/setup --peers"), std::string::npos) << subject.line();
        EXPECT_NE(subject.line().find("BURIN_WITH_PEERS"), std::string::npos) << subject.line();
    }
}

TEST(FramePeers, DrawTheSameSurfaceThroughTheSameEyes) {
    if (!has_frame_peers()) GTEST_SKIP() << "built without OpenSceneGraph and VTK (scripts/setup --peers)";
    const auto display = FrameDisplay::open();
    if (!display) GTEST_SKIP() << display.error().line();
    FrameScene scene = make_frame_scene(5'000);
    scene.size = {320, 180};
    const FrameStep step{moving_viewer(scene, 9), {}};
    std::vector<StereoImage> pictures;
    for (auto& subject :
         {open_osg(scene, 1, OsgDrawables::patches), open_osg(scene, 1, OsgDrawables::one), open_vtk(scene, 1)}) {
        ASSERT_TRUE(subject.has_value()) << subject.error().line();
        ASSERT_TRUE((*subject)->draw(step).has_value());
        pictures.push_back((*subject)->picture().value());
    }
    const wall::Eyes eyes = wall::eyes_of(step.viewer);
    for (const StereoImage& picture : pictures) {
        EXPECT_NEAR(coverage(scene.look, picture.left), expected_coverage(scene, eyes.left_world), 0.015);
        EXPECT_NEAR(coverage(scene.look, picture.right), expected_coverage(scene, eyes.right_world), 0.015);
        // The eyes see the same corner cut differently: exchanged, they would not fit the first subject's.
        std::size_t differ = 0, differ_exchanged = 0;
        for (std::size_t i = 0; i < picture.left.rgba.size(); i += 4) {
            const int red = pictures[0].left.rgba[i];
            if (std::abs(picture.left.rgba[i] - red) > 12) ++differ;
            if (std::abs(picture.right.rgba[i] - red) > 12) ++differ_exchanged;
        }
        EXPECT_LT(differ, picture.left.rgba.size() / 4 / 20);
        EXPECT_GT(differ_exchanged, 3 * differ + 100);
    }
}

TEST(FramePeers, LightWhereAndAsTheyAreAsked) {
    if (!has_frame_peers()) GTEST_SKIP() << "built without OpenSceneGraph and VTK (scripts/setup --peers)";
    const auto display = FrameDisplay::open();
    if (!display) GTEST_SKIP() << display.error().line();
    FrameScene scene = make_frame_scene(20'000);
    scene.size = {320, 180};
    const FrameStep step{still_viewer(scene), {}};
    const auto drawn = [&](Result<std::unique_ptr<FrameSubject>> subject) {
        EXPECT_TRUE(subject.has_value());
        EXPECT_TRUE((*subject)->draw(step).has_value());
        return (*subject)->picture().value().left;
    };
    for (const FrameLight light : {FrameLight::simple, FrameLight::burins}) {
        const FrameWay pixels{LitAt::pixels, light, false}, vertices{LitAt::vertices, light, false};
        const Image osg = drawn(open_osg(scene, 1, OsgDrawables::one, pixels));
        const std::array others{drawn(open_osg(scene, 1, OsgDrawables::one, vertices)),
                                drawn(open_vtk(scene, 1, pixels)), drawn(open_vtk(scene, 1, vertices))};
        EXPECT_NEAR(coverage(scene.look, osg), expected_coverage(scene, wall::eyes_of(step.viewer).left_world), 0.015);
        for (const Image& other : others) EXPECT_LT(flip(osg, other)->mean, 0.05) << name_of(light);
        EXPECT_NE(osg.rgba, others[0].rgba);  // triangles of some pixels: lit at vertices they do look different
    }
    // What README and table say of VTK: asked for Gouraud's interpolation, it lights pixels as before.
    EXPECT_EQ(drawn(open_vtk(scene, 1, {}, true)).rgba, drawn(open_vtk(scene, 1, {}, false)).rgba);
}

TEST(FrameStart, LiesInThePastAndDoesNotMove) {
    const double first = wall_since_start_ms(), second = wall_since_start_ms();
    EXPECT_GE(first, 0.0);
    EXPECT_GE(second, first);
    EXPECT_LT(second, 86'400'000.0);  // this test began within the last day
}

}  // namespace burin::bench
