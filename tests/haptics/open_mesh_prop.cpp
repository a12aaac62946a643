// SPDX-License-Identifier: MIT
// An open mesh has no inside, so a scene has it felt from both sides (scene/world_file.hpp). A hand that goes about in
// free air, past its edges and through its holes, then feels nothing, however little work its ticks may do. Judged by
// the distance to every triangle, which knows no side.
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "bench/measure/rough_surfaces.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "tests/haptics/session_tools.hpp"
#include "tests/haptics/ticked_hand.hpp"

namespace burin::haptics {
namespace {

// Without the triangles of some patches, and without one triangle in `every` elsewhere.
geometry::TriangleMesh with_holes(const geometry::TriangleMesh& closed, double patch_m, std::size_t patches,
                                  std::size_t every, std::uint64_t seed) {
    std::mt19937_64 dice(seed);
    std::vector<Vec3> middles;
    for (std::size_t i = 0; i < patches; ++i) middles.push_back(closed.positions_m[dice() % closed.positions_m.size()]);
    geometry::TriangleMesh open = closed;
    std::erase_if(open.triangles, [&](const auto& t) {
        if (every > 0 && dice() % every == 0) return true;
        return std::ranges::any_of(middles,
                                   [&](const Vec3& m) { return glm::distance(m, closed.positions_m[t[0]]) < patch_m; });
    });
    return open;
}

struct FreeFigures {
    int ticks = 0, felt = 0, left_behind = 0;
};

struct FreeTool {
    std::string name;
    double radius_m = 0.0;  // of a ball
    ToolShape shape{};      // of a tool that is none
    double reach_m = 0.0;   // of what contains it, about its place
};

class FreeHand : test::TickedHand {
public:
    FreeHand(const geometry::TriangleMesh& mesh, const FreeTool& tool, double budget_us, bool both_sides = true)
        : mesh_(mesh), tree_(mesh.positions_m, mesh.triangles), reach_m_(tool.reach_m) {
        surface.sequence = 1;
        surface.radius_m = 1e3;
        surface.meshes = {{geometry::TouchMesh::create(mesh)->snapshot(), 0, both_sides}};
        parameters.sequence = 1;
        parameters.probe = ball_probe(tool.radius_m);
        parameters.shape = tool.shape;
        parameters.clearance_ratio = 0.0;
        parameters.max_surface_age_s = 0.0;
        parameters.work.pace = (1000.0 / 3.0) / budget_us;
    }

    // Wanders near the mesh and never touches it.
    void wander(int ticks, std::uint64_t seed, FreeFigures& figures) {
        state = {};  // the hand begins elsewhere
        std::mt19937_64 dice(seed);
        std::uniform_real_distribution<double> part(-1.0, 1.0);
        Vec3 at = mesh_.positions_m[dice() % mesh_.positions_m.size()], way(0.0);
        while (!is_free(at)) at += 0.5 * reach_m_ * Vec3(part(dice), part(dice), part(dice));
        for (int i = 0; i < ticks; ++i) {
            if (dice() % 40 == 0) way = 3e-4 * Vec3(part(dice), part(dice), part(dice));
            const Vec3 home = tree_nearest(at);
            Vec3 next = at + way;
            if (glm::distance(next, home) > 4.0 * reach_m_) next = at + 1e-4 * glm::normalize(home - at);
            for (int tries = 0; !is_free(next) && tries < 20; ++tries)
                next = at + 3e-4 * Vec3(part(dice), part(dice), part(dice));
            if (is_free(next)) at = next;
            tick(at);
            ++figures.ticks;
            figures.felt += record.in_contact() || record.gate.given.force_device_N != Vec3(0.0) ? 1 : 0;
            figures.left_behind += glm::distance(record.deepest().proxy_object_m, at) > reach_m_ ? 1 : 0;
        }
    }

private:
    [[nodiscard]] Vec3 tree_nearest(const Vec3& at) const {
        return mesh_.positions_m[mesh_.triangles[tree_.nearest(at, 0).triangle][0]];
    }
    [[nodiscard]] bool is_free(const Vec3& at) const { return tree_.nearest(at, 0).distance_m > 1.05 * reach_m_; }

    const geometry::TriangleMesh& mesh_;
    geometry::TriangleTree tree_;
    double reach_m_;
};

}  // namespace

TEST(OpenMesh, HoldsNoHandInFreeAir) {
    const geometry::TriangleMesh ball = bench::rough_ball(20'000);
    const std::vector<std::pair<const char*, geometry::TriangleMesh>> meshes{
        {"ball with holes", with_holes(ball, 0.012, 12, 0, 1)},
        {"half a ball", with_holes(ball, 0.07, 1, 0, 2)},
        {"ragged ball", with_holes(ball, 0.01, 6, 12, 3)}};
    std::vector<FreeTool> tools{{"ball of 2 mm", 0.002, {}, 0.002}, {"ball of 0.5 mm", 0.0005, {}, 0.0005}};
    for (const auto& [name, shape] : test::session_tools(0.004)) tools.push_back({name, 0.0, shape, shape.reach_m});
    for (const auto& [mesh_name, mesh] : meshes) {
        for (const FreeTool& tool : tools) {
            for (const double budget_us : {33.0, 100.0, 333.0}) {
                FreeHand hand(mesh, tool, budget_us);
                FreeFigures figures;
                for (std::uint64_t seed = 1; seed <= 3; ++seed) hand.wander(500, seed, figures);
                EXPECT_EQ(figures.felt, 0) << mesh_name << ", " << tool.name << ", " << budget_us << " us";
                EXPECT_EQ(figures.left_behind, 0) << mesh_name << ", " << tool.name << ", " << budget_us << " us";
                EXPECT_EQ(figures.ticks, 1500);
            }
        }
    }
    // As a closed mesh, which has an inside, the same would hold hands.
    FreeFigures wrong;
    FreeHand hand(meshes[1].second, tools[0], 333.0, false);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) hand.wander(500, seed, wrong);
    EXPECT_GT(wrong.felt, 0);
}

}  // namespace burin::haptics
