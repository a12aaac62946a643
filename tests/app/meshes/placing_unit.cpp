// SPDX-License-Identifier: MIT
// Meshes far from their origin, of the wrong size and mirrored, through burin convert and back.
#include <gtest/gtest.h>

#include <array>

#include "base/text.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

// A block of 40.001 x 30.002 x 20.003 mm whose first corner is at `first`, with a colour for each corner.
std::string block_obj(const std::array<double, 3>& first) {
    std::string text = "# units mm\n";
    for (int corner = 0; corner < 8; ++corner) {
        const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        text += formatted("v %.3f %.3f %.3f %d %d %d\n", first[0] + 40.001 * x, first[1] + 30.002 * y,
                          first[2] + 20.003 * z, x, y, z);
    }
    return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

class Placing : public testing::Test {
protected:
    // Where a survey has it: in floats a step there is 0.25 mm.
    void SetUp() override { place.write("far.obj", block_obj({4000000.125, 5400000.25, 310.5})); }
    Workplace::Outcome convert(const std::string& arguments) const {
        return place.run(std::string(kBurinCommand) + " convert " + arguments);
    }
    geometry::TriangleMesh mesh(const std::string& name) const {
        auto read = geometry::import_mesh(place / name);
        EXPECT_TRUE(read) << read.error().line();
        return read ? std::move(read->mesh) : geometry::TriangleMesh{};
    }
    Workplace place;
};

constexpr double kStep = 4e-9;  // of a float in a file of millimetres at 40 mm, in metres

void expect_box(const geometry::TriangleMesh& mesh, const Vec3& middle_m, const Vec3& size_m, double within) {
    const Box box = geometry::examine(mesh).bounds_m;
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(box.center()[k], middle_m[k], within) << "middle " << k;
        EXPECT_NEAR(box.extent()[k], size_m[k], within) << "size " << k;
    }
}

}  // namespace

TEST_F(Placing, AMeshFarFromItsOriginIsMovedThereBeforeItIsRounded) {
    for (const char* const name : {"near.stl", "near.ply", "near.obj"}) {
        const auto moved = convert(std::string("far.obj --center ") + name);
        ASSERT_EQ(moved.status, 0) << moved.output;
        EXPECT_TRUE(moved.output.contains("placed: the middle of its box is at 0, 0, 0 m")) << moved.output;
        EXPECT_FALSE(moved.output.contains("single-precision")) << moved.output;
        expect_box(mesh(name), Vec3(0.0), {0.040001, 0.030002, 0.020003}, kStep);
    }
}

// In a national grid, in millimetres: no number near 5e9 is a float, nor as metres a double of as many digits.
TEST_F(Placing, AMeshBeyondWhatIsReadWhereItLiesIsMovedInItsOwnNumbers) {
    place.write("utm.obj",
                "# units mm\nv 691234125.0 5334567250.0 512500.0\nv 691234165.0 5334567250.0 512500.0\n"
                "v 691234125.0 5334567280.0 512500.0\nv 691234125.0 5334567250.0 512520.0\n"
                "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const auto refused = convert("utm.obj moved.obj");
    EXPECT_EQ(refused.status, 1) << refused.output;
    EXPECT_TRUE(
        refused.output.contains("utm.obj:2: a coordinate lies beyond 1e9; bring the mesh to its origin with "
                                "burin convert IN OUT --center"))
        << refused.output;
    for (const char* name : {"moved.obj", "moved.stl", "moved.ply"}) {
        const auto moved = convert(std::string("utm.obj --center ") + name);
        ASSERT_EQ(moved.status, 0) << moved.output;
        EXPECT_FALSE(moved.output.contains("single-precision")) << moved.output;
        const Box box = geometry::examine(mesh(name)).bounds_m;
        EXPECT_EQ(box.hi, Vec3(0.020, 0.015, 0.010)) << name;
        EXPECT_EQ(box.lo, Vec3(-0.020, -0.015, -0.010)) << name;
    }
    EXPECT_TRUE(place.read("moved.obj").contains("v 20 -15 -10\n")) << place.read("moved.obj");
    ASSERT_EQ(convert("utm.obj --place 1,2,3 placed.obj").status, 0);
    EXPECT_NEAR(geometry::examine(mesh("placed.obj")).bounds_m.hi.y, 2.015, 1e-15);
    place.write("apart.obj", "# units mm\nv -9e8 0 0\nv 1.2e9 0 0\nv 0 1 0\nv 5e12 0 0\nf 1 2 3\nf 1 2 4\n");
    const auto apart = convert("apart.obj --center moved.obj");
    EXPECT_EQ(apart.status, 1) << apart.output;
    EXPECT_TRUE(apart.output.contains("apart.obj:3: a coordinate lies more than 1e9 from others")) << apart.output;
}

TEST_F(Placing, AMeshThatRoundingWouldBendNamesTheCommandThatMovesIt) {
    const auto rounded = convert("far.obj far.stl");
    ASSERT_EQ(rounded.status, 0) << rounded.output;
    EXPECT_TRUE(rounded.output.contains("move its corners by up to 0.")) << rounded.output;
    EXPECT_TRUE(rounded.output.contains("--center")) << rounded.output;
    // Farther off nothing is left of it.
    place.write("farther.obj", block_obj({9.9e8, 9.9e8, 9.9e8}));
    const auto refused = convert("farther.obj far.stl");
    EXPECT_EQ(refused.status, 1) << refused.output;
    EXPECT_TRUE(refused.output.contains("burin convert IN OUT --center")) << refused.output;
}

TEST_F(Placing, ItsMiddleGoesToThePlaceInMetresWhateverTheUnitsAndItsSize) {
    const auto moved = convert("far.obj out.ply --place -0.1,0.2,0.05 --scale 2 --export-units in");
    ASSERT_EQ(moved.status, 0) << moved.output;
    EXPECT_TRUE(moved.output.contains("at -0.1, 0.2, 0.05 m, 2 times as large")) << moved.output;
    expect_box(mesh("out.ply"), {-0.1, 0.2, 0.05}, {0.080002, 0.060004, 0.040006}, 1e-7);
    // The order in which they are given does not count.
    ASSERT_EQ(convert("--scale 2 --place -0.1,0.2,0.05 far.obj again.ply --export-units in").status, 0);
    EXPECT_EQ(place.read("out.ply"), place.read("again.ply"));
}

TEST_F(Placing, ScaleAloneIsAboutTheOrigin) {
    place.write("block.obj", block_obj({10.0, 20.0, 30.0}));
    ASSERT_EQ(convert("block.obj out.obj --scale 10").status, 0);
    EXPECT_TRUE(place.read("out.obj").contains("v 100 200 300 0 0 0\n")) << place.read("out.obj");
    expect_box(mesh("out.obj"), {0.300005, 0.35001, 0.400015}, {0.40001, 0.30002, 0.20003}, 1e-12);
}

TEST_F(Placing, AMirroredMeshStillFacesOutwardsAndKeepsItsColours) {
    const auto mirrored = convert("far.obj out.obj --center --scale -1");
    ASSERT_EQ(mirrored.status, 0) << mirrored.output;
    EXPECT_TRUE(mirrored.output.contains("mirrored; what faced outwards still does")) << mirrored.output;
    const geometry::MeshHealth health = geometry::examine(mesh("out.obj"));
    EXPECT_TRUE(health.closed);
    EXPECT_NEAR(health.signed_volume_m3, 0.040001 * 0.030002 * 0.020003, 1e-12);
    const geometry::TriangleMesh was = mesh("far.obj"), is = mesh("out.obj");
    ASSERT_EQ(was.colours.size(), is.colours.size());
    EXPECT_EQ(was.colours, is.colours) << "corner for corner";
    EXPECT_NEAR(is.positions_m[0].x, 0.0200005, 1e-9) << "the first corner is on the other side now";
}

TEST_F(Placing, NumbersThatAreNoneAreRefusedWithTheRemedy) {
    const std::size_t files = place.files();
    const std::array<std::array<std::string, 2>, 12> refused{{{"--scale 0", "would leave nothing"},
                                                              {"--scale nan", "'nan' is no number"},
                                                              {"--scale inf", "'inf' is no number"},
                                                              {"--scale 1e-7", "1e-6 to 1e6"},
                                                              {"--scale=-1e7", "1e-6 to 1e6"},
                                                              {"--place 1,2", "such as 0.1,0,-0.25"},
                                                              {"--place 1,2,3,4", "such as 0.1,0,-0.25"},
                                                              {"--place 1,2,nan", "such as 0.1,0,-0.25"},
                                                              {"--place 1,2,3mm", "in metres"},
                                                              {"--place 0,0,1e9", "nearer to the origin"},
                                                              {"--place 1,2,3 --place 1,2,4", "give one"},
                                                              {"--place 1,2,3 --center", "give one of them"}}};
    for (const auto& [arguments, part] : refused) {
        const auto outcome = convert("far.obj out.obj " + arguments);
        EXPECT_NE(outcome.status, 0) << arguments;
        EXPECT_TRUE(outcome.output.contains(part)) << arguments << ": " << outcome.output;
    }
    const auto session = convert("a.session --to csv --center");
    EXPECT_EQ(session.status, 1);
    EXPECT_TRUE(session.output.contains("--center: is for meshes and documents")) << session.output;
    EXPECT_EQ(place.files(), files);
}

}  // namespace burin::app
