// SPDX-License-Identifier: MIT
// What a mesh file says is what the commands take it for: closed solids whose corners were rounded in two ways, and
// walls and gaps that a lattice is too coarse for.
#include <gtest/gtest.h>

#include <array>

#include "base/json.hpp"
#include "base/text.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kTrulyBurin = kBurinCommand;

// A box as an OBJ in metres whose six faces have corners of their own, each face's by `apart` times its number off.
std::string box_obj(const std::array<double, 3>& lo, const std::array<double, 3>& hi, double apart = 0.0) {
    constexpr int kQuads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    std::string text = "# units m\n";
    for (int face = 0; face < 6; ++face) {
        for (const int corner : kQuads[face]) {
            text += "v";
            for (std::size_t axis = 0; axis < 3; ++axis)
                text += formatted(" %.17g", ((corner >> axis & 1) != 0 ? hi : lo)[axis] + apart * face);
            text += "\n";
        }
        text += "f -4 -3 -2 -1\n";
    }
    return text;
}

bool told(const Workplace::Outcome& outcome, const std::string& text) {
    return outcome.output.find(text) != std::string::npos;
}

}  // namespace

TEST(ReadTruly, ASolidWhoseCornersDifferByARoundingIsClosedForEveryCommandAndThatIsTold) {
    const Workplace place;
    place.write("seam.obj", box_obj({0, 0, 0}, {0.1, 0.1, 0.1}, 4e-17));
    place.write("w.toml", "[[object]]\nname = \"box\"\nmesh = \"seam.obj\"\n");
    const std::string joined = "corners up to ";
    const auto carved =
        place.run(kTrulyBurin + " sculpt --workpiece seam.obj --resolution 32 --export x.stl --report r.json");
    EXPECT_EQ(carved.status, 0) << carved.output;
    EXPECT_TRUE(told(carved, joined)) << carved.output;
    const Json report = Json::parse(place.read("r.json"));
    EXPECT_NEAR(report["mesh"]["volume_m3"].get<double>(), 1e-3, 1e-9);
    EXPECT_EQ(report["workpiece"]["joined"]["vertices"], 16);
    EXPECT_EQ(report["workpiece"]["health"]["closed"], true);
    const auto combined =
        place.run(kTrulyBurin + " combine seam.obj seam.obj --operation union --resolution 32 --export u.stl");
    EXPECT_EQ(combined.status, 0) << combined.output;
    EXPECT_TRUE(told(combined, joined)) << combined.output;
    const auto tool =
        place.run(kTrulyBurin + " sculpt --workpiece block:1,1,1 --tool mesh:seam.obj --resolution 32 --export x.stl");
    EXPECT_EQ(tool.status, 0) << tool.output;
    const auto converted = place.run(kTrulyBurin + " convert seam.obj out.stl --close-holes");
    EXPECT_TRUE(told(converted, joined) && told(converted, "closed 0 holes") && told(converted, "volume 1000 cm3"))
        << converted.output;
    const auto checked = place.run(kTrulyBurin + " world check w.toml");
    EXPECT_EQ(checked.status, 0) << checked.output;
    EXPECT_TRUE(told(checked, joined)) << checked.output;
    const auto alone = place.run(kTrulyBurin + " world check seam.obj");
    EXPECT_FALSE(told(alone, "both sides")) << alone.output;
}

TEST(ReadTruly, AWiderCrackIsRefusedWithTheLengthThatClosesItAndClosedByIt) {
    const Workplace place;
    place.write("crack.obj", box_obj({0, 0, 0}, {0.1, 0.1, 0.1}, 4e-6));
    const auto refused = place.run(kTrulyBurin + " sculpt --workpiece crack.obj --resolution 32 --export x.stl");
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(told(refused, "crack.obj: is not closed")) << refused.output;
    EXPECT_TRUE(told(refused, "pass --weld 0.0001 to have corners joined")) << refused.output;
    const auto carved =
        place.run(kTrulyBurin + " sculpt --workpiece crack.obj --resolution 32 --export x.stl --weld 0.0001");
    EXPECT_EQ(carved.status, 0) << carved.output;
    EXPECT_TRUE(told(carved, "16 corners up to 0.0")) << carved.output;
    EXPECT_EQ(place
                  .run(kTrulyBurin +
                       " combine crack.obj crack.obj --operation union --resolution 32 --weld 0.0001 --export u.stl")
                  .status,
              0);
    const auto converted = place.run(kTrulyBurin + " convert crack.obj out.stl --weld 0.0001");
    EXPECT_TRUE(told(converted, "16 corners up to 0.0")) << converted.output;
    EXPECT_FALSE(told(place.run(kTrulyBurin + " convert out.stl again.ply"), "only one triangle"));
    for (const std::string command :
         {"sculpt --workpiece crack.obj --export x.stl --weld ", "convert crack.obj out.stl --weld "}) {
        for (const std::string length : {"0", "-1", "nan", "0.05"}) {
            const auto wrong = place.run(kTrulyBurin + " " + command + length);
            EXPECT_NE(wrong.status, 0) << command << length;
            EXPECT_TRUE(told(wrong, "--weld")) << wrong.output;
        }
    }
}

TEST(ReadTruly, AWallThinnerThanACellIsNamedWithTheResolutionThatShowsIt) {
    const Workplace place;
    place.write("plate.obj", box_obj({0, 0, 0}, {0.1, 0.1, 0.0005}));
    place.write("rod.obj", box_obj({0.04, 0.04, 0}, {0.06, 0.06, 0.0005}));
    for (const std::string command : {"sculpt --workpiece plate.obj --resolution 64",
                                      "combine plate.obj rod.obj --operation difference --resolution 64"}) {
        const auto outcome = place.run(kTrulyBurin + " " + command + " --export out.stl");
        EXPECT_EQ(outcome.status, 1) << outcome.output;
        EXPECT_TRUE(told(outcome, "a cell is 1.562 mm wide")) << outcome.output;
        EXPECT_TRUE(told(outcome, "which --resolution 2")) << outcome.output;  // 0.1 m / 0.0005 m = 200, and a little
        EXPECT_FALSE(told(outcome, "units")) << "their units are not the reason";
    }
    const auto fine = place.run(kTrulyBurin + " sculpt --workpiece plate.obj --resolution 208 --export out.stl");
    EXPECT_EQ(fine.status, 0) << fine.output;
    EXPECT_FALSE(told(fine, "thinner than the mesh can show")) << fine.output;
}

TEST(ReadTruly, APinBetweenAllRaysIsNamedWithTheResolutionThatKeepsIt) {
    const Workplace place;
    const std::string plate = box_obj({0, 0, 0}, {0.1, 0.1, 0.01});
    place.write("pin.obj", plate + box_obj({0.014524, 0.01679, 0.009}, {0.014824, 0.01709, 0.039}));
    place.write("plate.obj", plate);
    for (const std::string command : {"sculpt --workpiece pin.obj --report r.json --resolution ",
                                      "combine pin.obj plate.obj --operation union --report r.json --resolution "}) {
        const auto coarse = place.run(kTrulyBurin + " " + command + "64 --export out.stl");
        EXPECT_EQ(coarse.status, 0) << coarse.output;
        EXPECT_TRUE(told(coarse,
                         "no ray met what reaches 29 mm farther along +z (a cell is 1.562 mm wide), which "
                         "--resolution 4"))
            << coarse.output;
        const Json report = Json::parse(place.read("r.json"));
        const Json& piece = report.contains("workpiece") ? report["workpiece"] : report["a"];
        ASSERT_EQ(piece["unmet"].size(), 1u) << piece;
        EXPECT_EQ(piece["unmet"][0]["along"], "+z");
        EXPECT_NEAR(piece["unmet"][0]["length_m"].get<double>(), 0.029, 1e-5);
        EXPECT_NEAR(piece["unmet"][0]["width_m"].get<double>(), 0.0003, 2e-6);
        const auto fine = place.run(kTrulyBurin + " " + command +
                                    std::to_string(piece["unmet"][0]["resolution"].get<int>()) + " --export out.stl");
        EXPECT_EQ(fine.status, 0) << fine.output;
        EXPECT_FALSE(told(fine, "no ray met")) << fine.output;
        EXPECT_FALSE(told(place.run(kTrulyBurin + " convert out.stl again.stl"), "x 10 mm")) << "the pin is there";
    }
    const auto whole = place.run(kTrulyBurin + " sculpt --workpiece plate.obj --resolution 64 --export out.stl");
    EXPECT_FALSE(told(whole, "no ray met")) << whole.output;
}

// A cup whose walls are 5 mm thick and whose rim is open, far from the origin and in whole millimetres.
TEST(ReadTruly, AnOpenRimIsRefusedAndNotPressedTogether) {
    const Workplace place;
    std::string cup = "# units m\n";
    for (const double in : {0.0, 0.005}) {
        for (const double z : {in, 0.06}) {
            for (const auto& [x, y] : {std::array{in, in}, {0.1 - in, in}, {0.1 - in, 0.1 - in}, {in, 0.1 - in}})
                cup += formatted("v %.3f %.3f %.3f\n", 500.0 + x, 800.0 + y, 10.0 + z);
        }
    }
    cup += "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    cup += "f 9 10 11 12\nf 14 10 9 13\nf 15 11 10 14\nf 16 12 11 15\nf 13 9 12 16\n";
    place.write("cup.obj", cup);
    const auto open = place.run(kTrulyBurin + " sculpt --workpiece cup.obj --resolution 64 --export out.obj");
    EXPECT_EQ(open.status, 1) << open.output;
    EXPECT_TRUE(told(open, "is not closed")) << open.output;
    EXPECT_TRUE(told(open, "pass --close-holes")) << open.output;
    EXPECT_FALSE(told(open, "which closes it")) << open.output;
    const auto pressed =
        place.run(kTrulyBurin + " sculpt --workpiece cup.obj --resolution 64 --export out.obj --weld 0.0049");
    EXPECT_EQ(pressed.status, 1) << pressed.output;
    const auto closed =
        place.run(kTrulyBurin + " sculpt --workpiece cup.obj --resolution 64 --export out.obj --close-holes");
    EXPECT_EQ(closed.status, 0) << closed.output;
}

TEST(ReadTruly, AGapThatIsClosedByTheLatticeIsCountedByCombineAsBySculpt) {
    const Workplace place;
    place.write("a.obj", box_obj({0, 0, 0}, {0.02, 0.02, 0.02}));
    place.write("b.obj", box_obj({0.0201, 0, 0}, {0.04, 0.02, 0.02}));
    const auto run = [&](int resolution) {
        const auto outcome = place.run(kTrulyBurin +
                                       " combine a.obj b.obj --operation union --export u.stl --report "
                                       "r.json --resolution " +
                                       std::to_string(resolution));
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        return outcome;
    };
    const auto coarse = run(64);
    Json report = Json::parse(place.read("r.json"));
    EXPECT_GT(report["slivers"]["gaps"][0], 900) << "32 x 32 rays along x";
    EXPECT_TRUE(told(coarse, "places are thinner than the mesh can show")) << coarse.output;
    const int shows = report["slivers"]["resolution"].get<int>();
    EXPECT_GE(shows, 400);
    EXPECT_LT(shows, 450);
    const auto fine = run(shows);
    report = Json::parse(place.read("r.json"));
    EXPECT_EQ(report["mesh"]["shells"], 2);
    EXPECT_NEAR(report["mesh"]["volume_m3"].get<double>(), 15.96e-6, 1e-9);
    EXPECT_FALSE(told(fine, "thinner than the mesh")) << fine.output;
}

}  // namespace burin::app
