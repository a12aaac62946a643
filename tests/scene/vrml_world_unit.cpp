// SPDX-License-Identifier: MIT
// Objects of a VRML world: names, materials, poses, and which side is felt.
#include "scene/vrml_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/mesh_part.hpp"
#include "tests/support/run_command.hpp"

namespace burin::scene {
namespace {

const std::string kHead = R"(#VRML V2.0 utf8
PROTO HapticMaterial [ field SFFloat stiffness 700 field SFFloat damping 0.5
                       field SFFloat staticFriction 0.4 field SFFloat dynamicFriction 0.3
                       field SFFloat coulombVelocity 0.02 ] { Material { } }
)";

class VrmlWorldFile : public testing::Test {
protected:
    WorldOrProblems read(const std::string& text) {
        place_.write("w.wrl", kHead + text);
        return read_any_world(place_ / "w.wrl");
    }
    Workplace place_;
};

Box bounds(const SceneObject& object) {
    Box box;
    for (const Vec3& p : object.mesh->positions_m) box.include(object.pose * (object.scale * p));
    return box;
}

}  // namespace

// One shape of the name is a closed box that is felt from outside; whether it stands first or last, the other's word
// that both sides are felt holds for the object.
TEST_F(VrmlWorldFile, AnObjectIsFeltFromBothSidesWhereAnyOfItsShapesSaysSo) {
    const std::string solid = "Shape { geometry Box { size 0.1 0.1 0.1 } }";
    const std::string open = R"(Transform { translation 1 0 0 children Shape { geometry IndexedFaceSet { solid FALSE
        coord Coordinate { point [0 0 0, 1 0 0, 0 1 0, 0 0 1] }
        coordIndex [0 2 1 -1, 0 1 3 -1, 0 3 2 -1, 1 2 3 -1] } } })";
    for (const std::string& shapes : {open + "\n" + solid, solid + "\n" + open, solid + "\n" + open + "\n" + solid}) {
        const WorldOrProblems world = read("DEF Thing Transform { children [\n" + shapes + "\n] }\n");
        ASSERT_TRUE(world) << world.error().front().line();
        ASSERT_EQ(world->objects.size(), 1u);
        EXPECT_TRUE(world->objects[0].both_sides) << shapes;
        EXPECT_TRUE(world->remarks.empty()) << "it is closed: the file's own word made it so";
    }
    const WorldOrProblems closed = read("DEF Thing Transform { children [\n" + solid + "\n] }\n");
    ASSERT_TRUE(closed);
    EXPECT_FALSE(closed->objects[0].both_sides);
}

TEST_F(VrmlWorldFile, NamesObjectsAndGivesThemTheirMaterial) {
    const WorldOrProblems world = read(R"(
DEF Block Transform { translation 1 0 0 scale 2 2 2 children [
    Shape { appearance Appearance { material HapticMaterial { stiffness 250 } } geometry Box { size 0.1 0.2 0.3 } }
    Transform { translation 0 1 0 children Shape { geometry Sphere { radius 0.1 } } } ] }
Shape { geometry Box { size 1 1 1 } }
)");
    ASSERT_TRUE(world) << world.error().front().line();
    ASSERT_EQ(world->objects.size(), 2u);
    const SceneObject& block = world->objects[0];
    EXPECT_EQ(block.name, "Block");
    EXPECT_EQ(block.material.stiffness_N_per_m, 250.0);
    EXPECT_EQ(block.material.damping_Ns_per_m, 0.5);
    EXPECT_EQ(block.material.static_friction, 0.4);
    EXPECT_EQ(block.material.dynamic_friction, 0.3);
    EXPECT_EQ(block.material.coulomb_velocity_m_per_s, 0.02);
    EXPECT_FALSE(block.both_sides);
    const Box box = bounds(block);
    EXPECT_NEAR(box.lo.y, -0.2, 1e-6);
    EXPECT_NEAR(box.hi.y, 2.2, 1e-6) << "the sphere belongs to it, in the world's frame";
    EXPECT_NEAR(box.lo.x, 0.8, 2e-3);
    EXPECT_EQ(world->objects[1].name, "shape-1");
    EXPECT_EQ(world->objects[1].material, HapticMaterial{});
    EXPECT_TRUE(world->remarks.empty());
    MaterialTable materials;
    EXPECT_TRUE(MeshPart::create(world->objects, materials)) << "it can be touched";
}

TEST_F(VrmlWorldFile, HasOpenSurfacesFeltFromBothSidesAndTellsSo) {
    const WorldOrProblems world = read(R"(
DEF Sheet Shape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] }
                                            coordIndex [0 1 2 3 -1] } }
DEF Open Shape { geometry Cylinder { top FALSE } }
DEF Told Shape { geometry IndexedFaceSet { solid FALSE coord Coordinate { point [0 0 0, 1 0 0, 1 1 0] }
                                           coordIndex [0 1 2 -1] } }
)");
    ASSERT_TRUE(world);
    EXPECT_TRUE(std::ranges::all_of(world->objects, &SceneObject::both_sides));
    ASSERT_EQ(world->remarks.size(), 2u) << "the third says itself that it is two-sided";
    EXPECT_NE(world->remarks[0].find("Sheet is no closed surface"), std::string::npos) << world->remarks[0];
}

TEST_F(VrmlWorldFile, ListsImpossibleMaterialsAndEmptyWorlds) {
    const WorldOrProblems world = read(R"(
DEF A Shape { appearance Appearance { material HapticMaterial { stiffness 1e9 } } geometry Box { } }
DEF B Shape { appearance Appearance { material HapticMaterial { dynamicFriction 20 } } geometry Box { } }
)");
    ASSERT_FALSE(world);
    EXPECT_GE(world.error().size(), 2u);
    for (const Error& error : world.error()) EXPECT_FALSE(error.remedy.empty()) << error.line();
    EXPECT_NE(world.error()[0].where.find(": A: "), std::string::npos) << world.error()[0].where;
    const WorldOrProblems empty = read("Group { }");
    ASSERT_FALSE(empty);
    EXPECT_FALSE(empty.error().front().remedy.empty()) << empty.error().front().line();
    EXPECT_FALSE(read("Shape { geometry Bax { } "));
}

}  // namespace burin::scene
