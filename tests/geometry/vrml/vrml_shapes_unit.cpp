// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numbers>

#include "tests/geometry/vrml/vrml_samples.hpp"

namespace burin::geometry::test {
namespace {

std::vector<std::string> names_of(const VrmlWorld& world) {
    std::vector<std::string> names;
    for (const VrmlShape& shape : world.shapes) names.push_back(shape.name);
    return names;
}

using Names = std::vector<std::string>;

Vec3 origin_of(const VrmlShape& shape) { return Vec3(shape.world_from_shape[3]); }

constexpr double kPoseRounding = 1e-15 * 8;

}  // namespace

TEST(VrmlShapes, ATransformIsAppliedStepByStep) {
    const VrmlWorld world = vrml_world(
        "Transform { translation 1 2 3 center 0.5 -1 2 rotation 0 0 2 0.7 scale 2 3 0.5 scaleOrientation 1 0 0 0.4\n"
        "children Shape { geometry Box { } } }");
    ASSERT_EQ(world.shapes.size(), 1u);
    // ISO/IEC 14772-1, 6.52, one step after the other on a point.
    const Vec3 center(0.5, -1, 2);
    const auto turned = [](const Vec3& p, int a, int b, double angle) {
        Vec3 q = p;
        q[a] = std::cos(angle) * p[a] - std::sin(angle) * p[b];
        q[b] = std::sin(angle) * p[a] + std::cos(angle) * p[b];
        return q;
    };
    for (const Vec3& start : {Vec3(0.0), Vec3(1, 2, 3), Vec3(-2, 0.5, 1)}) {
        Vec3 p = turned(start - center, 1, 2, -0.4);
        p = turned(p * Vec3(2, 3, 0.5), 1, 2, 0.4);
        p = turned(p, 0, 1, 0.7) + center + Vec3(1, 2, 3);
        EXPECT_LT(glm::length(Vec3(world.shapes[0].world_from_shape * glm::dvec4(start, 1.0)) - p), 1e-14);
    }
}

TEST(VrmlShapes, TransformsNestFromTheOutside) {
    const VrmlWorld world = vrml_world(
        "Transform { rotation 0 1 0 1.5707963267948966 children Transform { translation 1 0 0\n"
        "children Group { children [ Shape { geometry Sphere { } } ] } } }");
    ASSERT_EQ(world.shapes.size(), 1u);
    EXPECT_LT(glm::length(origin_of(world.shapes[0]) - Vec3(0, 0, -1)), kPoseRounding);
}

TEST(VrmlShapes, AMirroredShapeFacesOutwardsInTheWorld) {
    const VrmlWorld world =
        vrml_world("Transform { scale -1 2 1 translation 5 0 0 children Shape { geometry Box { size 1 2 3 } } }");
    ASSERT_EQ(world.shapes.size(), 1u);
    EXPECT_TRUE(world.shapes[0].mirrored());
    EXPECT_DOUBLE_EQ(examine(mesh_in_world(world.shapes[0])).signed_volume_m3, 12.0);
    EXPECT_EQ(examine(mesh_in_world(world.shapes[0])).bounds_m.lo, Vec3(4.5, -2, -1.5));
}

TEST(VrmlShapes, AScaleOfZeroLeavesItsPartOutWithARemark) {
    const VrmlWorld world = vrml_world(
        "Transform { scale 1 0 1 children Shape { geometry Box { } } }\nDEF Rest Shape { geometry Box { } }");
    EXPECT_EQ(names_of(world), Names{"Rest"});
    ASSERT_EQ(world.remarks.size(), 1u);
    EXPECT_EQ(world.remarks[0].where, "test.wrl:2:1");
}

TEST(VrmlShapes, AnObjectIsCalledByTheNearestName) {
    const VrmlWorld world = vrml_world(
        "DEF Body Transform { children [ Shape { geometry Box { } } DEF Arm Group { children [\n"
        "  Shape { geometry Box { } } DEF Hand Shape { geometry Box { } } Shape { geometry DEF Mesh Sphere { } } ] } ] "
        "}\n"
        "Shape { geometry DEF Ball Sphere { } } Shape { geometry Cone { } }");
    EXPECT_EQ(names_of(world), (Names{"Body", "Arm", "Hand", "Arm", "Ball", ""}));
}

TEST(VrmlShapes, ANodeUsedAgainHasANameOfItsOwnAndTheSameTriangles) {
    const VrmlWorld world = vrml_world(
        "DEF Leg Group { children [ Shape { geometry Box { } } Shape { geometry Sphere { } } ] }\n"
        "DEF Leg-2 Shape { geometry Cone { } } Transform { translation 1 0 0 children USE Leg }");
    EXPECT_EQ(names_of(world), (Names{"Leg", "Leg", "Leg-2", "Leg-3", "Leg-3"}));
    EXPECT_EQ(world.shapes[0].surface, world.shapes[3].surface);
    EXPECT_EQ(origin_of(world.shapes[3]), Vec3(1, 0, 0));
    EXPECT_EQ(world.triangles, 2 * (12 + world.shapes[1].surface->mesh.triangles.size()) +
                                   world.shapes[2].surface->mesh.triangles.size());
}

TEST(VrmlShapes, AnInstanceIsCalledByItsOwnNameAndNotByThoseInItsPrototype) {
    const std::string proto =
        "PROTO Wheel [ field SFFloat r 1 ] { DEF Turn Transform { children Shape { geometry DEF Tyre Sphere { radius "
        "IS r } "
        "} } }\n";
    EXPECT_EQ(names_of(vrml_world(proto + "DEF Left Wheel { } DEF Right Wheel { r 2 }")), (Names{"Left", "Right"}));
    EXPECT_EQ(names_of(vrml_world(proto + "Wheel { }")), Names{"Turn"});
    EXPECT_EQ(names_of(vrml_world("PROTO Frame [ field MFNode children [ ] ] { Group { children IS children } }\n"
                                  "DEF Outer Frame { children [ DEF Inner Shape { geometry Box { } } ] }")),
              Names{"Inner"});
}

TEST(VrmlShapes, PrototypesBindFieldsThroughEachOther) {
    const VrmlWorld world = vrml_world(
        "PROTO Ball [ field SFFloat radius 3 field SFColor tint 1 0 0 ] {\n"
        "  Shape { appearance Appearance { material Material { diffuseColor IS tint } } geometry Sphere { radius IS "
        "radius } }\n"
        "}\n"
        "PROTO Pair [ field SFFloat size 0.5 ] {\n"
        "  Group { children [ Ball { radius IS size } Transform { translation 2 0 0 children Ball { tint 0 0 1 } } ] "
        "}\n"
        "}\n"
        "Pair { } Pair { size 4 }");
    ASSERT_EQ(world.shapes.size(), 4u);
    const auto radius = [&](std::size_t i) { return examine(world.shapes[i].surface->mesh).bounds_m.hi.y; };
    EXPECT_DOUBLE_EQ(radius(0), 0.5);
    EXPECT_DOUBLE_EQ(radius(1), 3.0);
    EXPECT_DOUBLE_EQ(radius(2), 4.0);
    EXPECT_DOUBLE_EQ(radius(3), 3.0);
    EXPECT_EQ(world.shapes[0].colour, (VrmlColour{255, 0, 0}));
    EXPECT_EQ(world.shapes[1].colour, (VrmlColour{0, 0, 255}));
}

TEST(VrmlShapes, OnlyTheFirstNodeOfAPrototypeIsShown) {
    const VrmlWorld world = vrml_world(
        "PROTO One [ ] { Shape { geometry Box { } } Shape { geometry Sphere { } } TimeSensor { } }\nOne { }");
    ASSERT_EQ(world.shapes.size(), 1u);
    EXPECT_EQ(world.shapes[0].surface->mesh.triangles.size(), 12u);
    EXPECT_TRUE(world.skipped.empty());
}

TEST(VrmlShapes, ASwitchShowsItsChoiceAndALevelOfDetailItsFinest) {
    const std::string choice = "choice [ DEF A Shape { geometry Box { } } DEF B Shape { geometry Box { } } ] }";
    EXPECT_TRUE(vrml_world("Switch { " + choice).shapes.empty());
    EXPECT_EQ(names_of(vrml_world("Switch { whichChoice 1 " + choice)), Names{"B"});
    EXPECT_TRUE(vrml_world("Switch { whichChoice 2 " + choice).shapes.empty());
    EXPECT_EQ(names_of(vrml_world(
                  "LOD { range [ 10 ] level [ DEF A Shape { geometry Box { } } DEF B Shape { geometry Box { } "
                  "} ] }")),
              Names{"A"});
    EXPECT_EQ(names_of(vrml_world(
                  "Collision { proxy DEF P Shape { geometry Box { } } children Anchor { children Billboard {\n"
                  "children DEF C Shape { geometry Box { } } } } }")),
              Names{"C"});
}

TEST(VrmlShapes, ColourTransparencyAndHapticNumbersComeFromTheMaterial) {
    const VrmlWorld world = vrml_world(
        "PROTO HapticMaterial [ field SFFloat stiffness 700 field SFFloat damping 1 exposedField SFColor diffuseColor "
        "1 1 1 ]\n"
        "{ Material { diffuseColor IS diffuseColor } }\n"
        "Shape { appearance Appearance { material HapticMaterial { stiffness 350 diffuseColor 0 0.5 1 } } geometry Box "
        "{ } }\n"
        "Shape { appearance Appearance { material Material { transparency 0.25 } } geometry Box { } }\n"
        "Shape { geometry Box { } }");
    ASSERT_EQ(world.shapes.size(), 3u);
    EXPECT_EQ(world.shapes[0].haptics, (std::map<std::string, double>{{"damping", 1.0}, {"stiffness", 350.0}}));
    EXPECT_EQ(world.shapes[0].colour, (VrmlColour{0, 128, 255}));
    EXPECT_EQ(world.shapes[1].colour, (VrmlColour{204, 204, 204}));  // 0.8
    EXPECT_EQ(world.shapes[1].transparency, 0.25);
    EXPECT_TRUE(world.shapes[1].haptics.empty());
}

TEST(VrmlShapes, OtherNodesAreCountedAndTheRestIsRead) {
    const VrmlWorld world = vrml_world(
        "NavigationInfo { } Viewpoint { } Viewpoint { }\nEXTERNPROTO Far [ field SFFloat x ] \"far.wrl\"\nFar { x 2 }\n"
        "Transfrom { children Shape { geometry Box { } } }\nShape { geometry Text { string [ \"a \\\"b\\\"\" ] } }\n"
        "DEF S Script { field SFNode self USE S eventIn SFTime go eventOut SFBool out url \"javascript: { [ }\" }\n"
        "DEF End Shape { geometry Box { } }\nROUTE S.out TO End.set_x");
    EXPECT_EQ(names_of(world), Names{"End"});
    std::vector<std::pair<std::string, std::size_t>> skipped;
    for (const VrmlSkipped& s : world.skipped) skipped.emplace_back(s.type, s.count);
    EXPECT_EQ(skipped,
              (std::vector<std::pair<std::string, std::size_t>>{
                  {"NavigationInfo", 1}, {"Viewpoint", 2}, {"Far", 1}, {"Transfrom", 1}, {"Text", 1}, {"Script", 1}}));
    ASSERT_EQ(world.remarks.size(), 2u);
    const std::string far = world.remarks[0].line();
    EXPECT_TRUE(far.starts_with("test.wrl:3:37: far.wrl: does not exist; ")) << far;
    EXPECT_EQ(world.remarks[1].line(),
              "test.wrl:5:1: 'Transfrom' is no node of VRML 2.0; it is left out; the nearest name is 'Transform'");
}

TEST(VrmlShapes, AFieldThatItsNodeDoesNotHaveIsRemarkedOn) {
    const VrmlWorld world = vrml_world("Shape { geometry Box { sise 1 2 3 } }");
    ASSERT_EQ(world.remarks.size(), 1u);
    EXPECT_EQ(world.remarks[0].line(),
              "test.wrl:2:24: 'Box' has no field 'sise'; it has no effect; the nearest name is 'size'");
}

TEST(VrmlShapes, InlinedFilesStandInTheirPlace) {
    const std::map<std::string, std::string> files{
        {"parts/leg.wrl", kVrmlHead + "Transform { translation 0 1 0 children Inline { url \"../foot.wrl\" } }"},
        {"foot.wrl", kVrmlHead + "DEF Foot Shape { geometry Box { } }"}};
    const VrmlWorld world = vrml_world(
        "Transform { translation 1 0 0 children Inline { url [ \"lost.wrl\", \"parts/leg.wrl\" ] } }\n"
        "Inline { url \"foot.wrl\" }",
        files);
    EXPECT_EQ(names_of(world), (Names{"Foot", "Foot-2"}));
    EXPECT_EQ(origin_of(world.shapes[0]), Vec3(1, 1, 0));
    EXPECT_EQ(origin_of(world.shapes[1]), Vec3(0, 0, 0));
    EXPECT_EQ(world.shapes[0].surface, world.shapes[1].surface);
}

// ---- Inlines through PROTOs

const std::map<std::string, std::string> kInlined{{"foot.wrl", kVrmlHead + "DEF Foot Shape { geometry Box { } }"},
                                                  {"left hand.wrl", kVrmlHead + "DEF Hand Shape { geometry Box { } }"}};

TEST(VrmlShapes, AnInstanceNamesTheFileThatItsPrototypeInlines) {
    const VrmlWorld world = vrml_world(
        "PROTO Part [ field MFString file \"foot.wrl\" field SFVec3f at 0 0 0 ] {\n"
        "  Transform { translation IS at children Inline { url IS file } } }\n"
        "Part { } Part { file [ \"lost.wrl\", \"left%20hand.wrl\" ] at 1 2 3 }",
        kInlined);
    EXPECT_EQ(names_of(world), (Names{"Foot", "Hand"}));
    EXPECT_EQ(origin_of(world.shapes[1]), Vec3(1, 2, 3));
    EXPECT_TRUE(world.remarks.empty());
}

TEST(VrmlShapes, ANameOfAnInlineGoesThroughAnyNumberOfPrototypes) {
    const VrmlWorld world = vrml_world(
        "PROTO Inner [ field MFString deep \"lost.wrl\" ] { Group { children Inline { url IS deep } } }\n"
        "PROTO Outer [ field MFString file [ ] ] { Group { children Inner { deep IS file } } }\n"
        "Outer { file \"foot.wrl\" } Outer { file \"left hand.wrl\" }",
        kInlined);
    EXPECT_EQ(names_of(world), (Names{"Foot", "Hand"}));
}

TEST(VrmlShapes, OnlyAnInlineThatIsShownHasToNameAFile) {
    const std::string prototype = "PROTO Part [ field MFString file \"lost.wrl\" ] { Inline { url IS file } }\n";
    const VrmlOpener opener = [](const std::string& name) -> Result<std::string> {
        if (name != "foot.wrl") return fail(name, "does not exist", "check the path");
        return kInlined.at(name);
    };
    EXPECT_TRUE(vrml_faults(kVrmlHead + prototype + "Part { file \"foot.wrl\" }", opener).empty());
    const auto faults = vrml_faults(kVrmlHead + prototype + "Part { }", opener);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0], "test.wrl:2:34: lost.wrl: does not exist; check the path");
}

TEST(VrmlShapes, ACycleThroughAPrototypesFileIsAFault) {
    const std::string again = "PROTO P [ field MFString f [ ] ] { Inline { url IS f } }\n";
    const VrmlOpener opener = [&](const std::string&) -> Result<std::string> {
        return kVrmlHead + again + "P { f \"test.wrl\" }";
    };
    const auto faults = vrml_faults(kVrmlHead + again + "P { f \"other.wrl\" }", opener);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_TRUE(faults[0].starts_with("other.wrl:3:7: an Inline leads back to 'test.wrl'")) << faults[0];
}

TEST(VrmlShapes, CodedLettersOfAUrlLeadNoFartherThanPlainOnes) {
    std::vector<std::string> opened;
    const VrmlOpener opener = [&](const std::string& name) -> Result<std::string> {
        opened.push_back(name);
        return kVrmlHead;
    };
    const auto faults_for = [&](const std::string& url) {
        return vrml_faults(kVrmlHead + "Inline { url \"" + url + "\" }", opener).size();
    };
    EXPECT_EQ(faults_for("a%20b.wrl") + faults_for("50%.wrl") + faults_for("%zz.wrl") + faults_for("%c3%a4.wrl"), 0u);
    EXPECT_EQ(opened, (std::vector<std::string>{"a b.wrl", "50%.wrl", "%zz.wrl", "\u00e4.wrl"}));
    opened.clear();
    for (const char* url : {"%2e%2e/a.wrl", "%2fetc%2fpasswd", "http%3a//a.b/c.wrl", "a%00.wrl", "%2E%2E%2Fa.wrl"})
        EXPECT_EQ(faults_for(url), 1u) << url;
    EXPECT_TRUE(opened.empty());
}

}  // namespace burin::geometry::test
