// SPDX-License-Identifier: MIT
// Worlds as people have them: their colours are drawn, their numbers are read in the unit that is said.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/text.hpp"
#include "scene/object_property.hpp"
#include "scene/vrml_world.hpp"
#include "scene/world_settings.hpp"
#include "tests/support/run_command.hpp"

namespace burin::scene {
namespace {

const std::string kVrml = "#VRML V2.0 utf8\n";
constexpr Colour kRed{255, 0, 0}, kGreen{0, 255, 0}, kBlue{0, 0, 255};

class WorldOfAnybody : public testing::Test {
protected:
    World read(const std::string& name, const std::string& text, const WorldReading& reading = {}) {
        place.write(name, text);
        WorldOrProblems world = read_any_world(place / name, reading);
        if (world) return std::move(*world);
        for (const Error& error : world.error()) ADD_FAILURE() << error.line();
        return {};
    }
    std::string why_not(const std::string& name, const std::string& text, const WorldReading& reading = {}) {
        place.write(name, text);
        const WorldOrProblems world = read_any_world(place / name, reading);
        return world ? "" : world.error().front().line();
    }
    static Vec3 size(const SceneObject& object) {
        Box box;
        for (const Vec3& p : object.mesh->positions_m) box.include(p);
        return box.extent();
    }
    static bool tells(const World& world, const std::string& words) {
        return std::ranges::any_of(world.remarks, [&](const std::string& r) { return r.contains(words); });
    }
    Workplace place;
};

std::string two_faces(const std::string& colours) {
    return kVrml +
           "DEF A Shape { geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ 0 0 0, .1 0 0, .1 .1 0, "
           "0 .1 0, .1 0 .05, .1 .1 .05 ] } coordIndex [ 0 1 2 3 -1 1 4 5 2 -1 ] " +
           colours + " } }";
}

}  // namespace

TEST_F(WorldOfAnybody, HasOneColourWhereAllItsFacesHaveThat) {
    const World world =
        read("a.wrl", two_faces("color Color { color [ 1 0 0 ] } colorPerVertex FALSE colorIndex [ 0 0 ]"));
    EXPECT_EQ(world.objects.at(0).colour, kRed);
    EXPECT_EQ(world.objects[0].corner_colours, nullptr);
}

TEST_F(WorldOfAnybody, HasTheColourOfEachFaceAndOfEachCorner) {
    const World faces =
        read("a.wrl", two_faces("color Color { color [ 1 0 0, 0 0 1 ] } colorPerVertex FALSE colorIndex [ 0 1 ]"));
    ASSERT_TRUE(faces.objects.at(0).corner_colours);
    const CornerColours& of_faces = *faces.objects[0].corner_colours;
    ASSERT_EQ(of_faces.size(), 4u) << "one for each triangle";
    EXPECT_EQ(of_faces[0], (std::array{kRed, kRed, kRed}));
    EXPECT_EQ(of_faces[3], (std::array{kBlue, kBlue, kBlue}));
    const World corners =
        read("b.wrl", two_faces("color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 0 0, 0 1 0, 0 0 1 ] }"));
    const SceneObject& object = corners.objects.at(0);
    ASSERT_TRUE(object.corner_colours);
    const std::array<Colour, 6> of_point{kRed, kGreen, kBlue, kRed, kGreen, kBlue};
    for (std::size_t t = 0; t < object.mesh->triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = object.mesh->positions_m[object.mesh->triangles[t][k]];
            const std::array<Vec3, 6> points{Vec3(0), {.1, 0, 0}, {.1, .1, 0}, {0, .1, 0}, {.1, 0, .05}, {.1, .1, .05}};
            const auto at = static_cast<std::size_t>(std::ranges::find(points, p) - points.begin());
            ASSERT_LT(at, 6u);
            EXPECT_EQ((*object.corner_colours)[t][k], of_point[at]);
        }
    }
}

// A shape that is mirrored is turned inside out, and its corners keep their colours.
TEST_F(WorldOfAnybody, HasTheColourOfEachCornerHoweverItIsMirrored) {
    const std::array<Vec3, 6> points{Vec3(0), {.1, 0, 0}, {.1, .1, 0}, {0, .1, 0}, {.1, 0, .05}, {.1, .1, .05}};
    const std::array<Colour, 6> of_point{kRed, kGreen, kBlue, kBlue, kRed, kGreen};
    const std::string shape =
        two_faces("color Color { color [ 1 0 0, 0 1 0, 0 0 1, 0 0 1, 1 0 0, 0 1 0 ] }").substr(kVrml.size());
    for (int mirrored = 0; mirrored < 8; ++mirrored) {
        const Vec3 scale((mirrored & 1) != 0 ? -1.0 : 1.0, (mirrored & 2) != 0 ? -1.0 : 1.0,
                         (mirrored & 4) != 0 ? -1.0 : 1.0);
        const World world =
            read("m.wrl", kVrml + "Transform { scale " + formatted("%g %g %g", scale.x, scale.y, scale.z) +
                              " children [ " + shape + " ] }");
        const SceneObject& object = world.objects.at(0);
        ASSERT_TRUE(object.corner_colours);
        for (std::size_t t = 0; t < object.mesh->triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 p = scale * object.mesh->positions_m[object.mesh->triangles[t][k]];
                const auto at = std::ranges::find_if(points, [&](const Vec3& q) { return glm::distance(p, q) < 1e-9; });
                ASSERT_TRUE(at != points.end()) << mirrored;
                EXPECT_EQ((*object.corner_colours)[t][k], of_point[static_cast<std::size_t>(at - points.begin())])
                    << mirrored << ", triangle " << t;
            }
    }
}

TEST_F(WorldOfAnybody, OfSeveralShapesHasTheColourOfEach) {
    const World world = read("a.wrl", kVrml + R"(DEF Two Transform { scale -1 1 1 children [
        Shape { appearance Appearance { material Material { diffuseColor 1 0 0 } } geometry Box { size .1 .1 .1 } }
        Transform { translation 1 0 0 children Shape {
            appearance Appearance { material Material { diffuseColor 0 0 1 } }
            geometry Box { size .1 .1 .1 } } } ] })");
    const CornerColours& colours = *world.objects.at(0).corner_colours;
    ASSERT_EQ(colours.size(), 24u);
    EXPECT_EQ(colours.front()[2], kRed);
    EXPECT_EQ(colours.back()[2], kBlue);
}

TEST_F(WorldOfAnybody, InAMeshFileHasItsColours) {
    const std::string obj =
        "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 0 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    const World vertices = read("a.obj", obj);
    ASSERT_TRUE(vertices.objects.at(0).corner_colours);
    EXPECT_EQ((*vertices.objects[0].corner_colours)[0], (std::array{kRed, kBlue, kGreen}));
    const std::string plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    place.write("a.mtl", "newmtl r\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n");
    const World materials =
        read("b.obj", "mtllib a.mtl\n" + plain + "usemtl r\nf 1 3 2\nf 1 2 4\nusemtl b\nf 2 3 4\nf 1 4 3\n");
    ASSERT_TRUE(materials.objects.at(0).corner_colours);
    EXPECT_EQ((*materials.objects[0].corner_colours)[1], (std::array{kRed, kRed, kRed}));
    EXPECT_EQ((*materials.objects[0].corner_colours)[2], (std::array{kBlue, kBlue, kBlue}));
    const World ply = read("c.ply",
                           "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                           "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                           "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
                           "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n0 0 1 255 0 0\n"
                           "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
    ASSERT_TRUE(ply.objects.at(0).corner_colours);
    EXPECT_EQ((*ply.objects[0].corner_colours)[0], (std::array{kRed, kBlue, kGreen}));
    const World told = read("d.toml", "[[object]]\nname = \"A\"\nmesh = \"a.obj\"\ncolour = \"#102030\"\n");
    EXPECT_EQ(told.objects.at(0).corner_colours, nullptr) << "the world's colour counts";
    EXPECT_EQ(told.objects[0].colour, (Colour{16, 32, 48}));
}

TEST_F(WorldOfAnybody, WhoseColourIsSetHasThatEverywhere) {
    const World world =
        read("a.wrl", two_faces("color Color { color [ 1 0 0, 0 0 1 ] } colorPerVertex FALSE colorIndex [ 0 1 ]"));
    const Result<SceneObject> changed = edited(world.objects.at(0), SetColour{kGreen});
    ASSERT_TRUE(changed);
    EXPECT_EQ(changed->corner_colours, nullptr);
    EXPECT_EQ(changed->colour, kGreen);
}

TEST_F(WorldOfAnybody, InOtherUnitsThanMetresIsToldAndReadAsItIsSaid) {
    const std::string mm = kVrml + "DEF A Shape { geometry Box { size 100 40 60 } }";
    const World guessed = read("mm.wrl", mm);
    EXPECT_EQ(size(guessed.objects.at(0)), Vec3(100, 40, 60));
    EXPECT_TRUE(tells(guessed, "--units mm"));
    const World said = read("mm.wrl", mm, {.unit = "mm"});
    EXPECT_NEAR(size(said.objects.at(0)).x, 0.1, 1e-15);
    EXPECT_TRUE(said.remarks.empty());
    const World parts =
        read("k.wrl", kVrml + "DEF Body Shape { geometry Box { size 5.512 5.512 0.433 } }", {.unit = "2.54mm"});
    EXPECT_NEAR(size(parts.objects.at(0)).x, 0.0140005, 1e-6);
    EXPECT_EQ(why_not("mm.wrl", mm, {.unit = "pt"}),
              "--units: is pt; write m, cm, mm, in or ft, or how many of one: 2.54mm");
    EXPECT_TRUE(why_not("mm.wrl", mm, {.unit = "-1mm"}).contains("is -1mm"));
}

TEST_F(WorldOfAnybody, HasItsUnitInTheSettingsBesideIt) {
    const std::string mm = kVrml + "DEF A Shape { geometry Box { size 100 40 60 } }";
    place.write("mm.toml", "[world]\nunit = \"mm\"\n[[object]]\nname = \"A\"\nposition = [0.5, 0, 0]\n");
    const World world = read("mm.wrl", mm);
    EXPECT_NEAR(size(world.objects.at(0)).x, 0.1, 1e-15);
    EXPECT_EQ(world.objects[0].pose.position_m.x, 0.5) << "settings are in metres as ever";
    EXPECT_EQ(size(read("mm.wrl", mm, {.unit = "cm"}).objects.at(0)), Vec3(1, 0.4, 0.6)) << "what is said counts";
    EXPECT_EQ(settings_of("a/mm.wrl.gz"), "a/mm.toml");
    place.write("mm.toml", "[world]\nunit = \"yd\"\n");
    EXPECT_TRUE(why_not("mm.wrl", mm).contains("mm.toml: [world] unit: is yd")) << why_not("mm.wrl", mm);
    place.write("mm.toml", "[world]\nunits = \"mm\"\n");
    EXPECT_TRUE(why_not("mm.wrl", mm).contains("units")) << why_not("mm.wrl", mm);
}

TEST_F(WorldOfAnybody, InAMeshFileIsReadInTheUnitThatIsSaid) {
    const std::string stl = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    EXPECT_NEAR(size(read("a.obj", stl, {.unit = "cm"}).objects.at(0)).x, 0.01, 1e-15);
    EXPECT_TRUE(why_not("a.obj", stl, {.unit = "2.54mm"}).contains("2.54mm"));
    place.write("b.toml", "[[object]]\nname = \"A\"\nmesh = \"a.obj\"\n");
    EXPECT_TRUE(why_not("b.toml", place.read("b.toml"), {.unit = "cm"}).contains("mesh_units"));
}

// ---- Turning and scaling

namespace {

Vec3 seen_at(const SceneObject& object, const Vec3& p) { return object.pose * (object.scale * p); }

SceneObject changed_by(const SceneObject& object, ObjectProperty property, const PropertyValue& value) {
    const Result<SceneObject> changed = edited(object, edit_of(object, property, value));
    EXPECT_TRUE(changed);
    return changed ? *changed : object;
}

const std::string kPark = kVrml + R"(
Transform { translation 0.0 0.15 0.05 children DEF Post Shape { geometry Cylinder { radius 0.02 height 0.08 } } }
DEF Door Transform { translation 1 0 0 center -0.5 0 0 children
    Transform { translation 0 2 0 children Shape { geometry Box { size 1 2 0.1 } } } }
DEF Loose Shape { geometry Box { size 2 2 2 } }
DEF Held Group { children Transform { translation 0 0 -3 children Shape { geometry Box { size 0.2 0.2 0.2 } } } }
)";

void expect_near(const Vec3& is, const Vec3& wanted) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(is[k], wanted[k], 1e-12) << k;
}

}  // namespace

TEST_F(WorldOfAnybody, TurnsAndScalesAboutTheCentreOfItsOwnTransform) {
    const World world = read("park.wrl", kPark);
    const std::map<std::string, Vec3> pivots{
        {"Post", {0, 0.15, 0.05}}, {"Door", {0.5, 0, 0}}, {"Loose", {0, 0, 0}}, {"Held", {0, 0, -3}}};
    for (const SceneObject& object : world.objects) {
        SCOPED_TRACE(object.name);
        const Vec3 pivot = pivots.at(object.name);
        expect_near(object.pivot_m, pivot);
        const SceneObject turned = changed_by(object, ObjectProperty::orientation, {0, 0, 1, 0.6});
        expect_near(seen_at(turned, pivot), pivot);
        const SceneObject small = changed_by(turned, ObjectProperty::scale, {0.5});
        expect_near(seen_at(small, pivot), pivot);
        EXPECT_NEAR(glm::distance(seen_at(small, pivot + Vec3(0.1, 0, 0)), pivot), 0.05, 1e-12);
        const SceneObject moved = changed_by(small, ObjectProperty::position, {0.1, 0.2, 0.3});
        expect_near(seen_at(moved, pivot), pivot + Vec3(0.1, 0.2, 0.3));
        const PropertyValue position = value_of(moved, ObjectProperty::position);
        expect_near(Vec3(position[0], position[1], position[2]), Vec3(0.1, 0.2, 0.3));
        expect_near(seen_at(changed_by(moved, ObjectProperty::scale, {1.0}), pivot), pivot + Vec3(0.1, 0.2, 0.3));
    }
}

TEST_F(WorldOfAnybody, IsTurnedAboutThatByItsSettingsAsWell) {
    place.write("park.toml",
                "[[object]]\nname = \"Door\"\norientation = [0, 1, 0, 0]\nscale = 2\n"
                "[[object.path]]\ntime = 0\n[[object.path]]\ntime = 1\norientation = [0, 1, 0, 1]\n"
                "[[object.path]]\ntime = 2\n"
                "[[object]]\nname = \"Post\"\npivot = [0, 0, 0]\nscale = 3\n");
    const World world = read("park.wrl", kPark);
    const SceneObject& post = world.objects.at(0);
    const SceneObject& door = world.objects.at(1);
    ASSERT_EQ(door.name, "Door");
    const Vec3 hinge(0.5, 0, 0);
    expect_near(seen_at(door, hinge), hinge);
    const auto& path = std::get<PathMotion>(door.motion);
    expect_near(composed(door.pose, pose_on(path, 0.7)) * (door.scale * hinge), hinge);
    expect_near(seen_at(post, Vec3(0.1)), Vec3(0.3));
}

TEST_F(WorldOfAnybody, OfAMeshIsTurnedAboutItsMiddleUnlessAPivotIsNamed) {
    const std::string obj = "v 1 1 1\nv 3 1 1\nv 1 3 1\nv 1 1 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    place.write("a.obj", obj);
    const std::string head = "[[object]]\nname = \"A\"\nmesh = \"a.obj\"\n";
    const World plain = read("a.toml", head + "scale = 2\nposition = [1, 0, 0]\n");
    expect_near(seen_at(plain.objects.at(0), Vec3(1)), Vec3(3, 2, 2));
    const SceneObject turned = changed_by(plain.objects[0], ObjectProperty::orientation, {0, 1, 0, 1.0});
    expect_near(seen_at(turned, Vec3(2)), seen_at(plain.objects[0], Vec3(2)));
    const World named = read("b.toml", head + "scale = 2\npivot = [1, 1, 1]\n");
    expect_near(seen_at(named.objects.at(0), Vec3(1)), Vec3(1));
}

TEST_F(WorldOfAnybody, ThatAHandHoldsGrowsWhereItIs) {
    SceneObject held = read("park.wrl", kPark).objects.at(0);
    const Pose hand_from_object{{0.3, -0.1, 0.2}, glm::angleAxis(0.7, glm::normalize(Vec3(1, 2, 3)))};
    held.motion = HeldMotion{{0}, hand_from_object, false};
    const Result<SceneObject> grown = edited(held, SetScale{1.5});
    ASSERT_TRUE(grown);
    expect_near(std::get<HeldMotion>(grown->motion).hand_from_object * (1.5 * held.pivot_m),
                hand_from_object * held.pivot_m);
}

}  // namespace burin::scene
