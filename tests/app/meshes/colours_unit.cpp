// SPDX-License-Identifier: MIT
// Colours through burin convert: what the faces of a file show, the files written of it show at the same places.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kRedFace{255, 0, 0}, kBlueFace{0, 0, 255};

constexpr const char* kTwoColours =
    "# units mm\nmtllib two_colours.mtl\nv 0 0 0\nv 40 0 0\nv 40 30 0\nv 0 30 0\nv 0 0 20\nv 40 0 20\nv 40 30 20\n"
    "v 0 30 20\nusemtl red\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nusemtl blue\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

class ColoursOfFiles : public testing::Test {
protected:
    void SetUp() override {
        place.write("two_colours.obj", kTwoColours);
        place.write("two_colours.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    }
    Workplace::Outcome convert(const std::string& arguments) const {
        return place.run(std::string(kBurinCommand) + " convert " + arguments);
    }
    // Returns how many triangles have each colour; those of several colours are none of these.
    std::map<Rgb, int> faces_of(const std::string& name) const {
        const auto read = geometry::import_mesh(place / name);
        EXPECT_TRUE(read) << read.error().line();
        std::map<Rgb, int> counts;
        if (!read) return counts;
        const geometry::TriangleMesh& mesh = read->mesh;
        EXPECT_TRUE(geometry::examine(mesh).closed) << name;
        EXPECT_EQ(mesh.positions_m.size(), 8u) << name;
        EXPECT_TRUE(mesh.colours.empty()) << name << ": vertices have none beside the faces";
        for (const std::uint8_t material : mesh.triangle_materials) ++counts[mesh.materials.at(material).colour];
        return counts;
    }
    Workplace place;
};

}  // namespace

TEST_F(ColoursOfFiles, ThatMeetAtAVertexStayOnTheirFaces) {
    const std::map<Rgb, int> expected{{kRedFace, 6}, {kBlueFace, 6}};
    for (const char* const arguments :
         {"two_colours.obj out.obj", "two_colours.obj out.obj --center", "two_colours.obj out.ply",
          "two_colours.obj out.ply --center --scale -2", "out.ply out.obj --export-units in",
          "out.obj out.ply --weld 1e-6", "out.ply out.obj --simplify 1e-6", "out.obj out.ply --close-holes"}) {
        const auto outcome = convert(arguments);
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        const std::string line = arguments;
        EXPECT_EQ(faces_of(line.contains(" out.obj") ? "out.obj" : "out.ply"), expected) << line;
    }
}

TEST_F(ColoursOfFiles, OfAnObjStandBesideItOverNoneOfTheInputs) {
    const auto told = convert("two_colours.obj out.obj");
    EXPECT_TRUE(told.output.contains("the colours of its faces in out.mtl")) << told.output;
    place.write("b.obj", kTwoColours);
    const std::string before = place.read("two_colours.mtl");
    const auto refused = convert("b.obj two_colours.obj");
    EXPECT_EQ(refused.status, 1) << refused.output;
    EXPECT_TRUE(refused.output.contains("two_colours.mtl")) << refused.output;
    EXPECT_EQ(place.read("two_colours.mtl"), before);
    EXPECT_EQ(place.read("two_colours.obj"), kTwoColours);
    EXPECT_EQ(convert("two_colours.obj out.obj").status, 0) << "again, over what was written before";
    place.write("chair.mtl", "# precious\n");
    const auto foreign = convert("two_colours.obj chair.obj");
    EXPECT_EQ(foreign.status, 1) << foreign.output;
    EXPECT_TRUE(foreign.output.contains("chair.mtl: would be overwritten")) << foreign.output;
    EXPECT_EQ(place.read("chair.mtl"), "# precious\n");
}

TEST_F(ColoursOfFiles, ThatAnStlCannotHoldAreToldOf) {
    const auto told = convert("two_colours.obj out.stl");
    EXPECT_TRUE(told.output.contains("its colours are left out, as STL has none; .ply and .obj have")) << told.output;
    EXPECT_FALSE(convert("out.stl again.stl").output.contains("colours"));
    for (const char* const command :
         {" sculpt two_colours.obj --resolution 32 --export o.stl",
          " combine two_colours.obj two_colours.obj --operation union --resolution 32 --export o.stl"}) {
        const auto carved = place.run(std::string(kBurinCommand) + command);
        EXPECT_TRUE(carved.output.contains("its colours are left out, as STL has none")) << carved.output;
    }
}

// Three different corners have their mean, as of a picture, and not that of the first; two alike decide.
TEST_F(ColoursOfFiles, OfVerticesThatDifferBecomeTheMeanOfAFace) {
    place.write("corners.ply",
                "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 4\n"
                "property list uchar int vertex_indices\nend_header\n"
                "0 0 0 255 0 0\n10 0 0 0 255 0\n0 10 0 0 0 255\n0 0 10 0 0 255\n"
                "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
    const auto mesh = geometry::import_mesh(place / "corners.ply");
    ASSERT_TRUE(mesh) << mesh.error().line();
    ASSERT_EQ(mesh->mesh.triangle_materials.size(), 4u);
    const auto colour = [&](std::size_t t) { return mesh->mesh.materials[mesh->mesh.triangle_materials[t]].colour; };
    EXPECT_EQ(colour(0), (std::array<std::uint8_t, 3>{85, 85, 85}));
    EXPECT_EQ(colour(2), (std::array<std::uint8_t, 3>{0, 0, 255}));
}

}  // namespace burin::app
