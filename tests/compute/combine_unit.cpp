// SPDX-License-Identifier: MIT
#include "compute/rays/set_algebra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compute/engine/engine.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/scan_convert.hpp"
#include "compute/tools/apply.hpp"
#include "compute/tools/mesh_tool.hpp"
#include "tests/compute/mesh_topology.hpp"
#include "tests/compute/random_solids.hpp"
#include "tests/compute/test_meshes.hpp"
#include "tests/compute/tool_reference.hpp"

namespace burin::compute::test {
namespace {

WorkerPool& pool() {
    static WorkerPool two(2);
    return two;
}

Solid on_lattice(const geometry::TriangleMesh& mesh, const Lattice& lattice) {
    auto converted = scan_convert_onto(mesh, lattice, pool());
    EXPECT_TRUE(converted) << converted.error().line();
    return converted ? std::move(converted->solid) : Solid{};
}

double volume(const Solid& solid) {
    Surface surface(solid.lattice);
    surface.mesh_all(solid, pool());
    EXPECT_EQ(topology_of(surface.welded()), MeshTopology{});
    return surface.volume_m3();
}

}  // namespace

TEST(Combine, BallsAndBoxesHaveTheirVolumes) {
    const Lattice lattice = *lattice_around(Box{Vec3(-0.6), Vec3(1.2)}, 96);
    const Solid box = on_lattice(box_mesh(Vec3(0), Vec3(1)), lattice);
    const Solid ball = on_lattice(ball_mesh(0.5, 6), lattice);  // about a corner of the box
    const double whole = 4.0 / 3.0 * std::numbers::pi * 0.125;
    EXPECT_NEAR(volume(*combine(box, ball, Combination::unite, pool())), 1 + whole * 7 / 8, 2e-3);
    EXPECT_NEAR(volume(*combine(box, ball, Combination::subtract, pool())), 1 - whole / 8, 2e-3);
    EXPECT_NEAR(volume(*combine(ball, box, Combination::subtract, pool())), whole * 7 / 8, 2e-3);
    EXPECT_NEAR(volume(*combine(box, ball, Combination::intersect, pool())), whole / 8, 2e-3);
}

TEST(Combine, DifferenceAndIntersectionPartitionEveryRay) {
    Random random(1);
    for (const Rays rays : {Rays::agree, Rays::unrelated}) {
        for (int i = 0; i < repeated(8); ++i) {
            const Solid a = noise_solid({17, 20, 14}, 0.5, rays, random.bits()),
                        b = noise_solid({17, 20, 14}, 0.4, rays, random.bits());
            const auto rest = combine(a, b, Combination::subtract, pool()),
                       taken = combine(a, b, Combination::intersect, pool());
            ASSERT_TRUE(rest && taken);
            EXPECT_TRUE(well_formed(*rest) && well_formed(*taken));
            const auto again = combine(*rest, *taken, Combination::unite, pool());
            EXPECT_TRUE(again->same_content(a));
            EXPECT_TRUE(combine(*rest, b, Combination::subtract, pool())->same_content(*rest));
            EXPECT_EQ(combine(*rest, *taken, Combination::intersect, pool())->sets[0].end_count(), 0u);
        }
    }
}

TEST(Combine, SubtractingAMeshIsCarvingWithIt) {
    const Lattice lattice = *lattice_around(Box{Vec3(-0.6), Vec3(1.2)}, 48);
    Solid box = on_lattice(box_mesh(Vec3(0), Vec3(1)), lattice);
    const geometry::TriangleMesh tool =
        transformed(box_mesh(Vec3(-0.2), Vec3(0.3), 2), Quat(std::sqrt(0.5), 0.5, 0.5, 0), Vec3(0.4));
    box.materials.push_back({"tool", {}});
    Solid other = on_lattice(tool, lattice);
    other.materials = {{"tool", {}}};
    const auto engine = make_cpu_engine(box, pool());
    ToolSweep sweep{*prepare_mesh_tool(std::make_shared<geometry::TriangleMesh>(tool)), {}, {}};
    sweep.material = 1;
    ASSERT_TRUE(engine->carve({&sweep, 1}));
    EXPECT_TRUE(engine->solid().same_content(*combine(box, other, Combination::subtract, pool())));
}

TEST(Combine, MaterialsOfBothAreKept) {
    const Lattice lattice = *lattice_around(Box{Vec3(-0.6), Vec3(1.2)}, 32);
    Solid a = on_lattice(box_mesh(Vec3(0), Vec3(1)), lattice), b = on_lattice(ball_mesh(0.5, 3), lattice);
    a.materials = {{"wood", {1, 2, 3}}, {"wax", {4, 5, 6}}};
    b.materials = {{"wax", {4, 5, 6}}, {"brass", {7, 8, 9}}};
    const auto both = combine(a, b, Combination::unite, pool());
    ASSERT_TRUE(both);
    ASSERT_EQ(both->materials.size(), 3u);
    EXPECT_EQ(both->materials[2].name, "brass");
    bool wood = false, wax = false;
    for (std::size_t r = 0; r < both->sets[0].ray_count(); ++r) {
        for (const shared::DexelEnd& end : both->sets[0].ends(r)) {
            wood = wood || material_of(end) == 0;
            wax = wax || material_of(end) == 1;  // b's first material
        }
    }
    EXPECT_TRUE(wood && wax);
    std::vector<geometry::Material> many(200);
    for (std::size_t i = 0; i < many.size(); ++i) many[i].name = std::to_string(i);
    a.materials = many;
    for (geometry::Material& m : many) m.name += "'";
    b.materials = many;
    EXPECT_FALSE(combine(a, b, Combination::unite, pool()));
}

TEST(Combine, MaterialsOfOneNameAndTwoColoursStayTwo) {
    const Lattice lattice = *lattice_around(Box{Vec3(-0.6), Vec3(1.2)}, 32);
    Solid a = on_lattice(box_mesh(Vec3(0), Vec3(1)), lattice), b = on_lattice(ball_mesh(0.5, 3), lattice);
    a.materials = {{"wax", {200, 0, 0}}};
    b.materials = {{"wax", {0, 0, 200}}};
    const auto both = combine(a, b, Combination::unite, pool());
    ASSERT_TRUE(both);
    ASSERT_EQ(both->materials.size(), 2u);
    EXPECT_EQ(both->materials[0].colour, a.materials[0].colour);
    EXPECT_EQ(both->materials[1].colour, b.materials[0].colour);
    // A ray along x through the ball's part outside the box, and one through the box's part outside the ball.
    const auto material_at_start = [&](const Vec3& on_ray) {
        const Vec3 cells = (on_ray - lattice.origin_object) / lattice.spacing_m;
        const auto ends =
            both->sets[0].ends(static_cast<int>(std::lround(cells.y)), static_cast<int>(std::lround(cells.z)));
        return ends.empty() ? -1 : static_cast<int>(material_of(ends.front()));
    };
    EXPECT_EQ(material_at_start(Vec3(0, -0.2, -0.2)), 1) << "blue";
    EXPECT_EQ(material_at_start(Vec3(0, 0.8, 0.8)), 0) << "red";
}

TEST(AddMaterial, FindsWhatIsThereByItsNameAndItsColour) {
    Solid solid = *make_block(Vec3(1), 16, {"wax", {200, 0, 0}});
    EXPECT_EQ(*add_material(solid, {"wax", {0, 0, 200}}), 1u) << "another colour is another material";
    EXPECT_EQ(*add_material(solid, {"clay", {200, 0, 0}}), 2u) << "another name is another material";
    EXPECT_EQ(*add_material(solid, {"wax", {200, 0, 0}}), 0u);
    EXPECT_EQ(*add_material(solid, {"wax", {0, 0, 200}}), 1u);
    ASSERT_EQ(solid.materials.size(), 3u);
    EXPECT_EQ(solid.materials[1].colour, (std::array<std::uint8_t, 3>{0, 0, 200}));
    for (int i = 3; i < 255; ++i) ASSERT_EQ(*add_material(solid, {std::to_string(i), {}}), i);
    EXPECT_FALSE(add_material(solid, {"one too many", {}}));
    EXPECT_EQ(*add_material(solid, {"clay", {200, 0, 0}}), 2u) << "a full table still knows its own";
    EXPECT_EQ(solid.materials.size(), 255u);
}

TEST(Combine, RefusesDifferentLatticesAndThreadsDoNotMatter) {
    const Solid a = noise_solid({17, 20, 14}, 0.5, Rays::agree, 1), b = noise_solid({17, 20, 14}, 0.5, Rays::agree, 2);
    WorkerPool one(1), five(5);
    EXPECT_TRUE(combine(a, b, Combination::subtract, one)->same_content(*combine(a, b, Combination::subtract, five)));
    const auto refused = combine(a, noise_solid({17, 20, 15}, 0.5, Rays::agree, 1), Combination::unite, pool());
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("lattices"), std::string::npos);
}

}  // namespace burin::compute::test
