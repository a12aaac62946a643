// SPDX-License-Identifier: MIT
// What the renderer spares does not show: pictures drawn with all savings, and with each alone, beside pictures drawn
// by brute force (all patches, all triangles, light worked out at every pixel), weighed by FLIP from ten heads.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>

#include "bench/measure/bumpy_sphere.hpp"
#include "bench/measure/flip.hpp"
#include "compute/rays/normal_code.hpp"
#include "renderer/frame/renderer.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::bench {
namespace {

constexpr ImageSize kSize{240, 180};
constexpr double kMostFlip = 0.01;  // asked for: a mean that nobody sees
constexpr renderer::Savings kNone{false, false, false, false, false, false};

struct Patch {
    geometry::SurfaceTile tile;
    std::vector<geometry::VertexLight> light;
};
struct Workpiece {
    std::string name;
    std::vector<Patch> patches;
    std::vector<Box> inner;
};

std::uint32_t code(const Vec3& colour) {
    const glm::uvec3 c(glm::round(255.0 * colour));
    return c.x | c.y << 8U | c.z << 16U | 255U << 24U;
}

void add_vertex(Patch& patch, const Vec3& p, const Vec3& normal, const Vec3& colour, geometry::VertexLight light) {
    patch.tile.vertices.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                                   compute::normal_code(glm::normalize(normal)), code(colour)});
    patch.light.push_back(light);
}

// The bench's own surface, in cubes.
Workpiece bumpy_sphere(std::size_t triangles) {
    constexpr double kRadius_m = 0.08, kCube_m = 0.025;
    const BumpySphere shape{.radius_m = kRadius_m};
    const geometry::TriangleMesh mesh = mesh_of(shape, squares_for(triangles));
    std::map<std::array<int, 3>, std::pair<Patch, std::map<std::uint32_t, std::uint32_t>>> cubes;
    for (const auto& triangle : mesh.triangles) {
        const Vec3 at =
            glm::floor((mesh.positions_m[triangle[0]] + mesh.positions_m[triangle[1]] + mesh.positions_m[triangle[2]]) /
                       (3.0 * kCube_m));
        auto& [patch, places] = cubes[{int(at.x), int(at.y), int(at.z)}];
        for (const std::uint32_t i : triangle) {
            const auto [place, fresh] = places.emplace(i, static_cast<std::uint32_t>(patch.tile.vertices.size()));
            const Vec3& p = mesh.positions_m[i];
            if (fresh) add_vertex(patch, p, shape.gradient(p), {0.8, 0.74, 0.66}, {});
            patch.tile.indices.push_back(place->second);
        }
    }
    Workpiece made{"bumpy sphere of " + std::to_string(mesh.triangles.size()), {}, {}};
    for (auto& [cube, patch] : cubes) made.patches.push_back(std::move(patch.first));
    made.inner.push_back({Vec3(-0.55 * kRadius_m), Vec3(0.55 * kRadius_m)});
    return made;
}

// A plate with grooves along y that have sharp edges and painted walls, and a shadow's edge across them: each facet of
// the profile has vertices of its own. `step` is the distance between vertices.
Workpiece grooved_plate(double step_m) {
    constexpr double kHalf_m = 0.1;
    constexpr std::array<Vec2, 4> kProfile{{{0.0, 0.0}, {0.012, 0.0}, {0.016, -0.006}, {0.020, 0.0}}};  // x, z; repeats
    Workpiece made{"grooved plate at " + std::to_string(1e3 * step_m) + " mm", {}, {}};
    for (double x = -kHalf_m; x < kHalf_m - 1e-9; x += 0.020) {
        for (std::size_t facet = 0; facet < 3; ++facet) {
            const Vec2 from = kProfile[facet], to = kProfile[facet + 1];
            const int across = std::max(1, int(std::lround(glm::length(to - from) / step_m)));
            for (double y = -kHalf_m; y < kHalf_m - 1e-9; y += 0.025) {
                Patch patch;
                const int along = std::max(1, int(std::lround(0.025 / step_m)));
                for (int j = 0; j <= along; ++j)
                    for (int i = 0; i <= across; ++i) {
                        const double s = double(i) / across, py = y + 0.025 * j / along;
                        const Vec2 at = glm::mix(from, to, s);
                        const Vec3 p{x + at.x, py, at.y};
                        const Vec3 normal = glm::cross(Vec3(to.x - from.x, 0, to.y - from.y), Vec3(0, 1, 0));
                        const double to_edge = (p.x + 0.4 * p.y) / 0.006;  // soft over 12 mm
                        const double sun = glm::smoothstep(-1.0, 1.0, to_edge), open = 1.0 + 60.0 * at.y;
                        const bool painted = facet > 0 || std::fmod(py + 1.0, 0.04) < 0.01;
                        add_vertex(patch, p, normal, painted ? Vec3(0.25, 0.45, 0.7) : Vec3(0.82, 0.8, 0.76),
                                   {static_cast<std::uint8_t>(std::lround(255.0 * sun)),
                                    static_cast<std::uint8_t>(std::lround(255.0 * open))});
                    }
                const auto row = static_cast<std::uint32_t>(across + 1);
                for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(along); ++j)
                    for (std::uint32_t i = 0; i + 1 < row; ++i) {
                        const std::uint32_t a = j * row + i;
                        patch.tile.indices.insert(patch.tile.indices.end(),
                                                  {a, a + 1, a + row + 1, a, a + row + 1, a + row});
                    }
                made.patches.push_back(std::move(patch));
            }
        }
    }
    return made;
}

picture::Picture scene_of() {
    picture::Picture scene;
    scene.wall = {0.4, 0.3};
    scene.screen = wall::screen_of(scene.wall);
    scene.show_wall_frame = false;
    scene.world_from_object.position_m = {0.0, 0.15, 0.0};
    scene.tool = {
        0.006, {0.03, 0.18, 0.09}, {0.85, 0.45, 0.15}, {{0.03, 0.18, 0.09}, glm::angleAxis(-0.7, Vec3{1, 0, 0})}, true};
    return scene;
}

wall::Viewer head(int i) {
    const double turn = 2.0 * std::numbers::pi * i / 10.0;
    wall::Viewer viewer;
    viewer.head_world.position_m = {0.15 * std::sin(turn), 0.15 + 0.1 * std::sin(2.0 * turn),
                                    0.45 + 0.15 * std::cos(turn)};
    return viewer;
}

struct Outcome {
    double mean = 0.0, worst = 0.0;  // of the heads' mean FLIP
    renderer::PatchCounts counts;    // summed
};

class SavingsTest : public gpu::DeviceTest {
protected:
    void SetUp() override {
        gpu::DeviceTest::SetUp();
        if (!IsSkipped()) draw_at(kSize);
    }
    void TearDown() override {
        tried_.reset();
        plain_.reset();
        gpu::DeviceTest::TearDown();
    }

    void draw_at(ImageSize size) {
        for (auto* renderer : {&tried_, &plain_}) {
            auto made = renderer::Renderer::create(device(), size, {.samples = 1, .savings = kNone});
            ASSERT_TRUE(made) << made.error().line();
            renderer->emplace(std::move(*made));
        }
    }

    Outcome compare(const Workpiece& workpiece, const renderer::Savings& savings, int heads, double scale = 1.0) {
        picture::Picture scene = scene_of();
        scene.world_from_object.scale = scale;
        return compare(workpiece, savings, heads, scene);
    }
    Outcome compare(const Workpiece& workpiece, const renderer::Savings& savings, int heads, picture::Picture scene) {
        for (auto* renderer : {&*tried_, &*plain_}) {
            renderer->surface().clear_patches();
            for (std::uint32_t id = 0; id < workpiece.patches.size(); ++id) {
                const Patch& patch = workpiece.patches[id];
                renderer->surface().set_patch(id, patch.tile.vertices, patch.tile.indices);
                renderer->surface().set_patch_light(id, patch.light);
            }
            renderer->surface().set_occluders(workpiece.inner);
        }
        tried_->set_savings(savings);
        Outcome outcome;
        for (int i = 0; i < heads; ++i) {
            scene.viewer = head(i * 10 / heads);
            EXPECT_TRUE(tried_->render(scene));
            static_cast<void>(tried_->surface().refine(100'000));
            tried_->forget_picture();
            const auto spared = tried_->render(scene), full = plain_->render(scene);
            EXPECT_TRUE(spared && full);
            const auto map = flip(full->left, spared->left);
            EXPECT_TRUE(map);
            outcome.mean += map->mean / heads;
            outcome.worst = std::max(outcome.worst, map->mean);
            const renderer::PatchCounts& c = tried_->stats().patch_counts;
            outcome.counts.beside += c.beside;
            outcome.counts.turned_away += c.turned_away;
            outcome.counts.behind += c.behind;
            outcome.counts.coarser += c.coarser;
            outcome.counts.vertex_rate += c.vertex_rate;
        }
        std::printf("%s: mean FLIP %.5f, worst head %.5f; beside %u, away %u, behind %u, coarser %u, vertex rate %u\n",
                    workpiece.name.c_str(), outcome.mean, outcome.worst, outcome.counts.beside,
                    outcome.counts.turned_away, outcome.counts.behind, outcome.counts.coarser,
                    outcome.counts.vertex_rate);
        return outcome;
    }

private:
    std::optional<renderer::Renderer> tried_, plain_;
};

}  // namespace

TEST_F(SavingsTest, AllTogetherDoNotShowOnABumpySphere) {
    const Outcome all = compare(bumpy_sphere(30'000), renderer::Savings{}, 10);
    EXPECT_LE(all.worst, kMostFlip);
    EXPECT_GT(all.counts.turned_away, 0u);
    EXPECT_GT(all.counts.vertex_rate, 0u);
    EXPECT_GT(all.counts.coarser, 0u);
}

TEST_F(SavingsTest, AllTogetherDoNotShowOnSharpPaintedAndShadedGrooves) {
    const Outcome all = compare(grooved_plate(0.0015), renderer::Savings{}, 10);
    EXPECT_LE(all.worst, kMostFlip);
    EXPECT_GT(all.counts.vertex_rate, 0u);
    EXPECT_GT(all.counts.coarser, 0u);
}

// What lies behind solid material is left to tests/renderer/visibility_prop.cpp: here it is turned away as well.
TEST_F(SavingsTest, CullingAloneChangesNoPixel) {
    constexpr double kBeyondTheScreen = 3.0;
    renderer::Savings one = kNone;
    one.cull_beside = true;
    const Outcome beside = compare(bumpy_sphere(6'000), one, 3, kBeyondTheScreen);
    EXPECT_EQ(beside.worst, 0.0);
    EXPECT_GT(beside.counts.beside, 0u);
    one = kNone;
    one.cull_turned_away = true;
    const Outcome away = compare(bumpy_sphere(6'000), one, 3);
    EXPECT_EQ(away.worst, 0.0);
    EXPECT_GT(away.counts.turned_away, 0u);
}

// Before the screen and cut by its edge, where the fade of parallax bends what is drawn.
TEST_F(SavingsTest, NoneShowsWhereParallaxFades) {
    picture::Picture scene = scene_of();
    scene.world_from_object.position_m = {0.13, 0.15, 0.08};
    scene.edge_fade = 1.0;
    scene.edge_fade_band = 0.4;
    renderer::Savings culling = kNone;
    culling.cull_beside = culling.cull_turned_away = culling.cull_behind = true;
    const Outcome culled = compare(bumpy_sphere(6'000), culling, 3, scene);
    EXPECT_EQ(culled.worst, 0.0);
    EXPECT_GT(culled.counts.beside + culled.counts.turned_away, 0u);
    const Outcome all = compare(bumpy_sphere(30'000), renderer::Savings{}, 4, scene);
    EXPECT_LE(all.worst, kMostFlip);
    EXPECT_GT(all.counts.coarser, 0u);
    EXPECT_GT(all.counts.vertex_rate, 0u);
    EXPECT_LE(compare(grooved_plate(0.0015), renderer::Savings{}, 4, scene).worst, kMostFlip);
}

TEST_F(SavingsTest, CoarserLevelsAloneDoNotShow) {
    renderer::Savings one = kNone;
    one.coarser_levels = true;
    EXPECT_LE(compare(bumpy_sphere(30'000), one, 3).worst, kMostFlip);
    const Outcome plate = compare(grooved_plate(0.001), one, 3);
    EXPECT_LE(plate.worst, kMostFlip);
    EXPECT_GT(plate.counts.coarser, 0u);
}

TEST_F(SavingsTest, LightAtVerticesAloneDoesNotShow) {
    renderer::Savings one = kNone;
    one.vertex_rate = true;
    EXPECT_LE(compare(bumpy_sphere(6'000), one, 3).worst, kMostFlip);
    EXPECT_LE(compare(grooved_plate(0.002), one, 3).worst, kMostFlip);
}

// Edges of some 20 to 60 pixels: smooth triangles are lit at vertices, those across a groove's edge at pixels.
TEST_F(SavingsTest, LightAtVerticesOfLargeTrianglesDoesNotShow) {
    draw_at({720, 540});
    renderer::Savings one = kNone;
    one.vertex_rate = true;
    constexpr double kNear = 1.6;
    const Outcome sphere = compare(bumpy_sphere(6'000), one, 3, kNear),
                  plate = compare(grooved_plate(0.006), one, 3, kNear);
    EXPECT_LE(sphere.worst, kMostFlip);
    EXPECT_GT(sphere.counts.vertex_rate, 0u);
    EXPECT_LE(plate.worst, kMostFlip);
    EXPECT_GT(plate.counts.vertex_rate, 0u);
}

}  // namespace burin::bench
