// SPDX-License-Identifier: MIT
// A hand that rests pressed into a surface while its force is switched off and on again is felt again, and until then
// it feels nothing: whole ticks on rough meshes, with balls and with tools felt as shapes.
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "bench/measure/rough_surfaces.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "tests/haptics/ticked_hand.hpp"

namespace burin::haptics {
namespace {

struct AnewFigures {
    int starts = 0, never_found = 0, slowest = 0, felt_unfit = 0, far = 0;
};

class AnewHand : test::TickedHand {
public:
    AnewHand(const geometry::TriangleMesh& mesh, double radius_m, double friction)
        : mesh_(mesh), tree_(mesh.positions_m, mesh.triangles), radius_m_(radius_m) {
        surface.sequence = 1;
        surface.radius_m = 1e3;
        surface.meshes = {{geometry::TouchMesh::create(mesh)->snapshot(), 0}};
        parameters.sequence = 1;
        parameters.probe = ball_probe(radius_m);
        parameters.clearance_ratio = 0.0;
        parameters.max_surface_age_s = 0.0;
        for (TouchMaterial& m : parameters.materials) m.static_friction = m.dynamic_friction = friction;
    }

    // Presses at a vertex, switches the force off for 20 ticks and on again, and waits for a second.
    void start(std::size_t vertex, double depth_m, AnewFigures& figures) {
        const Vec3 normal = normal_at(vertex), rest = mesh_.positions_m[vertex] + (radius_m_ - depth_m) * normal;
        state = {};
        for (int i = 0; i < 150; ++i) tick(rest + std::max(0.006 - 6e-5 * i, 0.0) * normal, true);
        if (!record.in_contact()) return;
        ++figures.starts;
        for (int i = 0; i < 20; ++i) tick(rest, false);
        int found = -1;
        for (int i = 0; i < 1000 && found < 0; ++i) {
            tick(rest, true);
            const bool is_felt = record.in_contact();
            if (!is_felt) {
                EXPECT_EQ(glm::length(record.gate.given.force_device_N), 0.0);
                continue;
            }
            found = i;
            const double distance_m = tree_.nearest(record.deepest().proxy_object_m, 0).distance_m;
            figures.felt_unfit += distance_m < 0.95 * radius_m_ ? 1 : 0;
        }
        figures.never_found += found < 0 ? 1 : 0;
        figures.slowest = std::max(figures.slowest, found);
        for (int i = 0; i < 300; ++i) tick(rest, true);
        figures.far += record.deepest().penetration_m > 3.0 * radius_m_ + depth_m ? 1 : 0;
    }

private:
    [[nodiscard]] Vec3 normal_at(std::size_t vertex) const {
        Vec3 sum(0.0);
        for (const auto& t : mesh_.triangles)
            if (t[0] == vertex || t[1] == vertex || t[2] == vertex)
                sum += glm::cross(mesh_.positions_m[t[1]] - mesh_.positions_m[t[0]],
                                  mesh_.positions_m[t[2]] - mesh_.positions_m[t[0]]);
        return glm::normalize(sum);
    }
    void tick(const Vec3& at, bool enabled) {
        parameters.enabled = enabled;
        TickedHand::tick(at);
    }

    const geometry::TriangleMesh& mesh_;
    geometry::TriangleTree tree_;
    double radius_m_;
};

}  // namespace

TEST(SetAnew, AHandThatRestsPressedInIsFeltAgainWhereTheBallFits) {
    struct Scene {
        std::string name;
        geometry::TriangleMesh mesh;
    };
    const std::vector<Scene> scenes{{"rough ball", bench::rough_ball(20'000)},
                                    {"fine rough ball", bench::rough_ball(100'000)},
                                    {"file", bench::file_plate()},
                                    {"machined part", bench::machined_part()},
                                    {"needles", bench::needle_comb(20)}};
    for (const Scene& scene : scenes) {
        for (const double radius_m : {0.002, 0.001}) {
            AnewHand hand(scene.mesh, radius_m, 0.3);
            std::mt19937_64 dice(7);
            AnewFigures figures;
            for (int i = 0; i < 120; ++i)
                hand.start(dice() % scene.mesh.positions_m.size(), 0.0005 + 0.0005 * (i % 5), figures);
            std::cout << scene.name << ", ball of " << 1e3 * radius_m << " mm: " << figures.starts << " starts, "
                      << figures.never_found << " never felt, slowest " << figures.slowest << " ticks, "
                      << figures.felt_unfit << " felt where it does not fit, " << figures.far << " far off\n";
            EXPECT_EQ(figures.never_found, 0) << scene.name;
            EXPECT_EQ(figures.felt_unfit, 0) << scene.name;
        }
    }
}

}  // namespace burin::haptics
