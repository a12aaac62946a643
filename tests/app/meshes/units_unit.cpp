// SPDX-License-Identifier: MIT
// Parts in millimetres, as CAD programs write them, through the command and back: nobody gives an option.
#include <gtest/gtest.h>

#include <array>

#include "base/json.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kUnitsBurin = kBurinCommand;

// A cube from the origin on, ASCII STL without a word about units.
std::string cube_stl(double side, const std::string& name = "part") {
    constexpr int kQuads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    std::string text = "solid " + name + "\n";
    for (const auto& q : kQuads) {
        for (const auto& t : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
            text += "facet normal 0 0 0\nouter loop\n";
            for (const int corner : t) {
                text += "vertex";
                for (int axis = 0; axis < 3; ++axis)
                    text += " " + std::to_string((corner >> axis & 1) != 0 ? side : 0.0);
                text += "\n";
            }
            text += "endloop\nendfacet\n";
        }
    }
    return text + "endsolid\n";
}

// Pressed into the middle of the top of a cube of 50 mm, along it, and lifted.
std::string groove() {
    return kStrokeHeader +
           "0,0.01,0.025,0.05,0,0,0,1,1\n0.5,0.025,0.025,0.05,0,0,0,1,1\n1,0.04,0.025,0.05,0,0,0,1,1\n"
           "1.1,0.04,0.025,0.06,0,0,0,1,0\n";
}

bool says(const Workplace::Outcome& outcome, const std::string& text) {
    return outcome.output.find(text) != std::string::npos;
}

}  // namespace

TEST(Units, APartInMillimetresIsCarvedAndExportedInMillimetresWithoutAnOption) {
    const Workplace place;
    place.write("part.stl", cube_stl(50.0));
    place.write("s.csv", groove());
    const auto carved = place.run(kUnitsBurin +
                                  " sculpt part.stl --stroke s.csv --resolution 64 --export out.stl"
                                  " --export out.ply --export out.obj --report r.json");
    ASSERT_EQ(carved.status, 0) << carved.output;
    EXPECT_EQ(place.run(kUnitsBurin + " sculpt part.stl --workpiece part.stl --stroke s.csv").status, 2)
        << "two workpieces";
    EXPECT_TRUE(
        says(carved,
             "part.stl: 50 x 50 x 50 mm (no unit that Burin knows is given in the file; read as millimetres, since its "
             "longest side is above 5; --units m reads it as metres)"))
        << carved.output;
    const Json report = Json::parse(place.read("r.json"));
    EXPECT_EQ(report["tool"]["shape"], "ball:0.0025");  // 5 % of 50 mm
    EXPECT_EQ(report["workpiece"]["import"]["unit"], "mm");
    EXPECT_EQ(report["workpiece"]["import"]["unit_source"], "guessed");
    EXPECT_EQ(report["export_unit"], "mm");
    // Half a capsule of 2.5 mm radius and 30 mm length, but for the lattice.
    EXPECT_NEAR(report["carving"]["volume_removed_m3"].get<double>(), 3.27e-7, 0.1e-7);
    EXPECT_TRUE(place.read("out.stl").starts_with("binary STL by Burin, UNITS=mm"));
    EXPECT_NE(place.read("out.ply").find("comment units mm\n"), std::string::npos);
    EXPECT_NE(place.read("out.obj").find("# units mm\n"), std::string::npos);
    for (const std::string file : {"out.stl", "out.ply", "out.obj"}) {
        EXPECT_TRUE(says(carved, file + ": written in millimetres")) << carved.output;
        const auto again = place.run(kUnitsBurin + " convert " + file + " again.ply");
        EXPECT_TRUE(says(again, file + ": 50 x 50 x 50 mm (its numbers are millimetres, as the file says in "))
            << again.output;
    }
}

TEST(Units, GivenUnitsAreReadAndWritten) {
    const Workplace place;
    place.write("part.stl", cube_stl(2.0));
    const auto inches = place.run(kUnitsBurin + " convert --units in --export-units cm part.stl out.obj");
    ASSERT_EQ(inches.status, 0) << inches.output;
    EXPECT_TRUE(says(inches, "part.stl: 50.8 x 50.8 x 50.8 mm (read as inches, as --units or the recording says)"))
        << inches.output;
    EXPECT_TRUE(says(inches, "out.obj: written in centimetres")) << inches.output;
    EXPECT_NE(place.read("out.obj").find("v 5.08 0 0\n"), std::string::npos) << place.read("out.obj");
    const auto wrong = place.run(kUnitsBurin + " convert --units yards part.stl out.obj");
    EXPECT_EQ(wrong.status, 2);
    const auto shape = place.run(kUnitsBurin + " sculpt --workpiece block:50,50,50 --units mm --export out.ply");
    EXPECT_EQ(shape.status, 1);
    EXPECT_TRUE(says(shape, "--units mm: is for mesh files, and block:50,50,50 is in metres")) << shape.output;
}

TEST(Units, FilesInDifferentUnitsMeetInOneSolid) {
    const Workplace place;
    place.write("part.stl", cube_stl(50.0));
    place.write("hole.stl", cube_stl(2.5, "hole UNITS=cm"));
    const auto outcome = place.run(kUnitsBurin +
                                   " combine part.stl hole.stl --operation difference --resolution 64"
                                   " --export out.ply --report r.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(says(outcome, "hole.stl: 25 x 25 x 25 mm (its numbers are centimetres, as the file says in line 1)"))
        << outcome.output;
    EXPECT_NEAR(Json::parse(place.read("r.json"))["mesh"]["volume_m3"].get<double>(), 0.875 * 1.25e-4, 1e-7);
    EXPECT_NE(place.read("out.ply").find("comment units mm\n"), std::string::npos);
}

TEST(Units, AToolThatDoesNotSuitTheWorkpieceIsToldWithBothSizes) {
    const Workplace place;
    place.write("part.stl", cube_stl(50.0));
    place.write("s.csv", groove());
    const std::string common =
        kUnitsBurin + " sculpt --workpiece part.stl --stroke s.csv --resolution 32 --report r.json ";
    const auto small = place.run(common + "--units m --tool ball:0.01");
    EXPECT_TRUE(says(small, "the tool ball:0.01 is 20 mm wide, narrower than a cell of the lattice, which is "))
        << small.output;
    EXPECT_TRUE(says(small, "longest side is 50000 mm; take one such as ball:2.5")) << small.output;
    const auto large = place.run(common + "--tool ball:0.1");
    EXPECT_TRUE(says(large,
                     "the tool ball:0.1 is 200 mm wide, wider than the whole workpiece, whose longest side is 50 mm; "
                     "take one such as ball:0.0025, or check the workpiece's size and unit (--units)"))
        << large.output;
    const auto fits = place.run(common + "--tool ball:0.004");
    EXPECT_FALSE(says(fits, "wide")) << fits.output;
}

TEST(Units, AToolsFileIsReadByTheSameRule) {
    const Workplace place;
    place.write("part.stl", cube_stl(50.0));
    place.write("tool.stl", cube_stl(10.0));
    place.write("s.csv", kStrokeHeader + "0,0.02,0.02,0.045,0,0,0,1,1\n");
    const auto outcome = place.run(kUnitsBurin +
                                   " sculpt --workpiece part.stl --tool mesh:tool.stl --stroke s.csv"
                                   " --resolution 64 --report r.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(says(outcome, "tool.stl: 10 x 10 x 10 mm (no unit that Burin knows is given in the file"))
        << outcome.output;
    EXPECT_NEAR(Json::parse(place.read("r.json"))["carving"]["volume_removed_m3"].get<double>(), 5e-7, 1e-9);
}

}  // namespace burin::app
