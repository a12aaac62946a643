// SPDX-License-Identifier: MIT
// Pictures as colours of corners: decoded, sampled, worn by an OBJ; what cannot be read is told.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/files/mesh_files.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/mesh_pictures.hpp"
#include "geometry/files/surface_colours.hpp"
#include "tests/geometry/picture_samples.hpp"
#include "tests/support/run_command.hpp"

namespace burin::geometry {
namespace {

const Colour kPureRed{255, 0, 0}, kPureGreen{0, 255, 0}, kPureBlue{0, 0, 255}, kPureWhite{255, 255, 255};

Result<Picture> decoded(const std::string& bytes) { return Picture::decode(std::as_bytes(std::span(bytes)), "p"); }

// A square of 1 m, its lower left corner at the lower left of the picture.
const std::string kSquare =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nmtllib m.mtl\nusemtl m\n"
    "f 1/1 2/2 3/3 4/4\n";

ImportedMesh square(const Workplace& place, const std::string& statement) {
    place.write("m.mtl", "newmtl m\nKd 0.2 0.2 0.2\n" + statement + "\n");
    place.write("s.obj", kSquare);
    auto read = import_mesh(place / "s.obj");
    EXPECT_TRUE(read) << read.error().line();
    return read ? std::move(*read) : ImportedMesh{};
}

bool remarks_hold(const ImportReport& report, const std::string& part) {
    return std::ranges::any_of(report.remarks, [&](const std::string& r) { return r.contains(part); });
}

}  // namespace

TEST(Pictures, CornersHaveTheColoursOfTheirPlaces) {
    const Result<Picture> picture = decoded(test::png_file(16, 16, test::four_colours()));
    ASSERT_TRUE(picture) << picture.error().line();
    EXPECT_FALSE(picture->is_grey());
    const std::array corners{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    const std::vector<Colour> colours = picture->colours_of(corners, {});
    for (std::size_t c = 0; c < 3; ++c) {  // a picture's edges are filtered, by no more than a third
        EXPECT_NEAR(colours[0][c], kPureBlue[c], 85) << c;
        EXPECT_NEAR(colours[1][c], kPureWhite[c], 85) << c;
        EXPECT_NEAR(colours[2][c], kPureGreen[c], 85) << c;
        EXPECT_NEAR(colours[3][c], kPureRed[c], 85) << c;
    }
    const std::array inside{Vec2(0.1, 0.9), Vec2(0.2, 0.9), Vec2(0.1, 0.8)};
    for (const Colour& c : picture->colours_of(inside, {})) EXPECT_EQ(c, kPureRed);
    const std::array further{Vec2(3.1, -4.1), Vec2(3.2, -4.1), Vec2(3.1, -4.2)};
    for (const Colour& c : picture->colours_of(further, {})) EXPECT_EQ(c, kPureRed) << "it repeats";
    for (const Colour& c : picture->colours_of(further, {false, false})) EXPECT_EQ(c, kPureWhite) << "its rim goes on";
}

TEST(Pictures, AFaceThatIsCoarseBesideItsPictureHasTheMeanOfWhatItCovers) {
    std::vector<std::uint8_t> chequered;
    for (int i = 0; i < 256 * 256; ++i) chequered.insert(chequered.end(), 3, (i % 2 + i / 256) % 2 == 0 ? 255 : 0);
    const Result<Picture> picture = decoded(test::png_file(256, 256, chequered));
    ASSERT_TRUE(picture);
    const std::array corners{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)};
    for (const Colour& c : picture->colours_of(corners, {})) EXPECT_NEAR(c[0], 128, 2);
}

TEST(Pictures, AJpegIsDecodedAndDamageIsTold) {
    const std::string jpeg = test::jpeg_file(16, 16, std::vector<std::uint8_t>(16 * 16 * 3, 90));
    const Result<Picture> picture = decoded(jpeg);
    ASSERT_TRUE(picture) << picture.error().line();
    EXPECT_NEAR(picture->mean()[1], 90, 2);
    EXPECT_TRUE(decoded("GIF89a").error().line().contains("is neither PNG nor JPEG; save it as PNG or JPEG"));
    EXPECT_FALSE(decoded(jpeg.substr(0, 20)));
    EXPECT_FALSE(decoded(test::png_file(16, 16, test::four_colours()).substr(0, 60)));
    // A header of 100,000 by 100,000 pixels, before any memory is taken for them.
    std::string huge = test::png_file(16, 16, test::four_colours());
    huge.replace(16, 8, std::string("\0\x01\x86\xA0\0\x01\x86\xA0", 8));
    EXPECT_FALSE(decoded(huge));
}

TEST(Pictures, AnObjWearsThePictureOfItsMaterial) {
    const Workplace place;
    place.write("tex.png", test::png_file(16, 16, test::four_colours()));
    for (const char* const statement :
         {"map_Kd tex.png", "map_Kd -s 1 1 1 -blendu on tex.png", "map_Kd C:\\models\\textures\\tex.png"}) {
        const ImportedMesh mesh = square(place, statement);
        ASSERT_EQ(mesh.corner_colours.size(), 2u) << statement;
        EXPECT_GT(mesh.corner_colours[0][0][2], 200) << "blue at the lower left";
        EXPECT_LT(mesh.corner_colours[0][0][1], 100);
        EXPECT_NEAR(mesh.mesh.materials[mesh.mesh.triangle_materials[0]].colour[0], 128, 2)
            << "the mean of the corners";
    }
    const auto files = files_of_mesh(place / "s.obj");
    EXPECT_NE(std::ranges::find(files, place / "tex.png"), files.end()) << "no output may take its place";
}

struct MapStatement {
    const char* statement;
    const char* colours;  // at the corners of the square: each the first letter of blue, white, green, red
};

char name_of_colour(const Colour& c) {
    if (c[0] > 127 && c[1] > 127) return 'w';
    return c[0] > 127 ? 'r' : c[1] > 127 ? 'g' : 'b';
}

std::string corners_of_square(const ImportedMesh& mesh) {
    std::string corners(4, '-');
    for (std::size_t t = 0; t < mesh.corner_colours.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            corners.at(mesh.mesh.triangles[t][k]) = name_of_colour(mesh.corner_colours[t][k]);
    return corners;
}

TEST(Pictures, EveryOptionOfAMapStatementCountsOrIsARemark) {
    const Workplace place;
    place.write("tex.png", test::png_file(16, 16, test::four_colours()));
    for (const auto& [statement, colours] : {MapStatement{"tex.png", "bwgr"},
                                             {"-s 0.4 0.4 1 -o 0.05 0.05 tex.png", "bbbb"},
                                             {"-s 0.4 0.4 1 -o 0.55 0.55 0 tex.png", "gggg"},
                                             {"-o 0 0.5 tex.png", "rgwb"},
                                             {"-o 3 -4 -clamp on tex.png", "wwww"},
                                             {"-CLAMP off -o 3 -4 tex.png", "bwgr"},
                                             {"-mm 0 1 tex.png", "bwgr"},
                                             {"-mm 1 tex.png", "wwww"},
                                             {"-blendu on -blendv on -cc off -t 0 0 0 tex.png", "bwgr"},
                                             {"tex.png -s 0.4 0.4 -o 0.05 0.05", "bbbb"},
                                             {"\"tex.png\"", "bwgr"},
                                             {"TEX.Png", "bwgr"},
                                             {"tex.png # the scan", "bwgr"},
                                             {"-s 0.4 0.4 1 -o 0.05 0.05 \"C:\\scans\\TEX.PNG\" # the scan", "bbbb"}}) {
        const ImportedMesh mesh = square(place, std::string("map_Kd ") + statement);
        EXPECT_EQ(corners_of_square(mesh), colours) << statement;
        EXPECT_TRUE(mesh.report.remarks.empty()) << statement << ": " << mesh.report.remarks[0];
    }
    for (const char* const option : {"-blendu off", "-blendv off", "-boost 2", "-t 1 1 1", "-texres 512", "-bm 0.5",
                                     "-imfchan l", "-type sphere", "-cc on", "-clamp perhaps", "-of 3 on"}) {
        const ImportedMesh mesh = square(place, std::string("map_Kd ") + option + " tex.png");
        EXPECT_EQ(corners_of_square(mesh), "bwgr") << option;
        const std::string word = std::string(option).substr(0, std::string(option).find(' '));
        EXPECT_TRUE(remarks_hold(mesh.report,
                                 "1 options of pictures of material file 'm.mtl' have no effect here, the "
                                 "first ('" +
                                     word))
            << option;
    }
}

// A plate of 8 by 8 squares that wears a picture of 4 by 4 pixels, each quarter of one colour: red, green above; blue,
// yellow below. `further` moves the plate's place in the picture, `vertex` stands behind each vertex.
std::string plate(const Vec2& further, const std::string& vertex) {
    std::string text = "# units mm\nmtllib plate.mtl\n";
    for (int i = 0; i < 81; ++i) {
        text += "v " + std::to_string(5 * (i % 9)) + " " + std::to_string(5 * (i / 9)) + " 0" + vertex + "\n";
        text += "vt " + std::to_string(further.x + i % 9 / 8.0) + " " + std::to_string(further.y + i / 9 / 8.0) + "\n";
    }
    text += "usemtl m\n";
    for (int i = 0; i < 72; ++i) {
        if (i % 9 == 8) continue;
        text += "f";
        for (const int at : {i + 1, i + 2, i + 11, i + 10}) text += " " + std::to_string(at) + "/" + std::to_string(at);
        text += "\n";
    }
    return text;
}

TEST(Pictures, APlateWearsWhatItsStatementSaysEverywhere) {
    const Workplace place;
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 16; ++i) {
        const bool right = i % 4 >= 2, below = i / 4 >= 2;
        pixels.push_back(right == below ? 255 : 0);  // red and yellow
        pixels.push_back(right ? 255 : 0);           // green and yellow
        pixels.push_back(below && !right ? 255 : 0);
    }
    place.write("quad.png", test::png_file(4, 4, pixels));
    const auto name_at = [](const Colour& c) { return c[0] > 127 ? (c[1] > 127 ? 'y' : 'r') : c[1] > 127 ? 'g' : 'b'; };
    struct Case {
        const char *statement, *vertex;
        Vec2 further;
        const char* quarters;  // at the left and right below, the left and right above
    };
    for (const Case& c : {Case{"-s 0.5 0.5 1 quad.png", "", Vec2(0.0), "bbbb"},
                          {"-clamp on quad.png", "", Vec2(0.0, -5.0), "byby"},
                          {"quad.png", " 1 1 1", Vec2(0.0), "byrg"},
                          {"QUAD.PNG", "", Vec2(0.0), "byrg"},
                          {"quad.png # the scan", "", Vec2(0.0), "byrg"}}) {
        place.write("plate.mtl", std::string("newmtl m\nKd 1 1 1\nmap_Kd ") + c.statement + "\n");
        place.write("plate.obj", plate(c.further, c.vertex));
        const auto read = import_mesh(place / "plate.obj");
        ASSERT_TRUE(read) << read.error().line();
        EXPECT_TRUE(read->report.remarks.empty()) << c.statement;
        ASSERT_EQ(read->corner_colours.size(), 128u) << c.statement;
        for (std::size_t t = 0; t < 128; ++t) {
            const std::size_t square = t / 2, quarter = (square % 8 >= 4 ? 1 : 0) + (square / 8 >= 4 ? 2 : 0);
            for (const Colour& corner : read->corner_colours[t]) {
                EXPECT_EQ(name_at(corner), c.quarters[quarter]) << c.statement << " " << t;
                for (const int channel : corner) EXPECT_TRUE(channel == 0 || channel == 255) << "of one pixel alone";
            }
        }
    }
}

TEST(Pictures, ColoursOfVerticesMultiplyWithThem) {
    const Workplace place;
    place.write("tex.png", test::png_file(16, 16, test::four_colours()));
    place.write("m.mtl", "newmtl m\nKd 0.2 0.2 0.2\nmap_Kd tex.png\n");
    const auto worn = [&](const std::string& colour) {
        std::string text = kSquare;
        for (const char* const at : {"v 0 0 0", "v 1 0 0", "v 1 1 0", "v 0 1 0"})
            text.replace(text.find(at), 7, at + (" " + colour));
        place.write("s.obj", text);
        const auto read = import_mesh(place / "s.obj");
        EXPECT_TRUE(read && read->mesh.colours.empty());
        return read ? *read : ImportedMesh{};
    };
    EXPECT_EQ(corners_of_square(worn("1 1 1")), "bwgr");
    EXPECT_EQ(corners_of_square(worn("1 0 0")), "brbr") << "of white red is left, of blue and green nothing";
    const ImportedMesh half = worn("0.5 0.5 0.5"), whole = worn("1 1 1");
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(half.corner_colours[0][0][c], 0.5 * whole.corner_colours[0][0][c], 1.0);
}

TEST(Pictures, WhatCannotBeReadIsARemarkAndTheMaterialKeepsItsColour) {
    const Workplace place;
    std::filesystem::create_directory(place / "m");
    place.write("secret.png", test::png_file(16, 16, test::four_colours()));
    std::filesystem::create_symlink(place / "secret.png", place / "m/link.png");
    place.write("m/m.mtl", "");
    for (const char* const statement : {"map_Kd lost.png", "map_Kd ../secret.png", "map_Kd link.png", "map_Kd m.mtl"}) {
        place.write("m/m.mtl", "newmtl m\nKd 0.5 0.5 0.5\n" + std::string(statement) + "\n");
        place.write("m/s.obj", kSquare);
        const auto read = import_mesh(place / "m/s.obj");
        ASSERT_TRUE(read) << read.error().line();
        EXPECT_TRUE(read->corner_colours.empty()) << statement;
        EXPECT_EQ(read->mesh.materials.at(0).colour, (Colour{128, 128, 128})) << statement;
        EXPECT_TRUE(remarks_hold(read->report, "a picture is not shown")) << statement;
    }
}

TEST(Pictures, AGreyPictureDarkensTheColourOfItsMaterial) {
    EXPECT_EQ(darkened({200, 100, 50}, {255, 255, 255}), (Colour{200, 100, 50}));
    EXPECT_EQ(darkened({200, 100, 50}, {0, 0, 0}), (Colour{0, 0, 0}));
    const Workplace place;
    place.write("tex.png", test::png_file(2, 2, {128, 128, 128, 128}, true));
    const ImportedMesh mesh = square(place, "Kd 1 0.5 0\nmap_Kd tex.png");
    ASSERT_FALSE(mesh.corner_colours.empty());
    EXPECT_NEAR(mesh.corner_colours[0][0][0], 128, 2);
    EXPECT_NEAR(mesh.corner_colours[0][0][1], 64, 2);
    EXPECT_EQ(mesh.corner_colours[0][0][2], 0);
}

// 80,000 readings of a line had 8 GB.
TEST(Pictures, ALineOfHashesHasFewReadings) {
    std::string line;
    for (int i = 0; i < 80'000; ++i) line += "a #";
    EXPECT_LE(names_in(line).size(), 16u);
    EXPECT_LE(picture_use(line).names.size(), 16u);
    EXPECT_EQ(names_in("tex.png # the scan #2").size(), 3u);
}

// Stripes of black and white, each one pixel wide, in both ways but along a picture of one row or column.
Picture striped(std::uint32_t width, std::uint32_t height) {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(std::size_t{3} * width * height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) pixels.insert(pixels.end(), 3, (x + y) % 2 == 0 ? 255 : 0);
    return {width, height, std::move(pixels), true};
}

// What is kept of a picture is what a face smaller than a pixel is sampled from: the pixels themselves where it is not
// too wide, and else their mean.
TEST(Pictures, WhatIsWiderOrHigherThanTheLimitIsKeptAtHalvesOfItsSizeAlone) {
    const auto keeps_its_pixels = [](std::uint32_t width, std::uint32_t height) {
        const Picture picture = striped(width, height);
        const double s = 0.5 / width, t = 0.5 / height;
        const std::array corners{Vec2(s, t), Vec2(s + 1e-9, t), Vec2(s, t + 1e-9)};
        const int found = picture.colours_of(corners, {})[0][0];
        EXPECT_TRUE(found == 0 || found == 255 || std::abs(found - 128) <= 2) << found;
        return found == 0 || found == 255;
    };
    for (const std::uint32_t wide : {1u, 2u, kWidestPicture / 2, kWidestPicture - 1, kWidestPicture}) {
        EXPECT_TRUE(keeps_its_pixels(wide, 1)) << wide;
        EXPECT_TRUE(keeps_its_pixels(1, wide)) << wide;
        EXPECT_TRUE(keeps_its_pixels(wide, 3)) << wide;
    }
    for (const std::uint32_t wide : {kWidestPicture + 2, 2 * kWidestPicture, 4 * kWidestPicture, 8 * kWidestPicture}) {
        EXPECT_FALSE(keeps_its_pixels(wide, 1)) << wide;
        EXPECT_FALSE(keeps_its_pixels(1, wide)) << wide;
        EXPECT_FALSE(keeps_its_pixels(wide, 4)) << wide;
        EXPECT_FALSE(keeps_its_pixels(4, wide)) << wide;
    }
}

// Stripes of four pixels: a picture four times too wide keeps the third level, in which they are one pixel wide, and
// none finer or coarser.
TEST(Pictures, AreHalvedNoOftenerThanTheLimitAsks) {
    for (const std::uint32_t times : {2u, 4u, 8u}) {
        const std::uint32_t width = times * kWidestPicture;
        std::vector<std::uint8_t> pixels;
        for (std::uint32_t x = 0; x < width; ++x) pixels.insert(pixels.end(), 3, x / times % 2 == 0 ? 255 : 0);
        const Picture picture(width, 1, std::move(pixels), true);
        for (std::uint32_t stripe = 0; stripe < kWidestPicture; stripe += 97) {
            const double s = (stripe + 0.5) / kWidestPicture;
            const std::array corners{Vec2(s, 0.5), Vec2(s + 1e-9, 0.5), Vec2(s, 0.5)};
            EXPECT_EQ(int{picture.colours_of(corners, {})[0][0]}, stripe % 2 == 0 ? 255 : 0) << times << " " << stripe;
        }
    }
}

}  // namespace burin::geometry
