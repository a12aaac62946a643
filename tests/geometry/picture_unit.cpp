// SPDX-License-Identifier: MIT
// Pictures as colours of corners: decoded, sampled, worn by an OBJ; what cannot be read is told.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/files/mesh_files.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/obj_pictures.hpp"
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

}  // namespace burin::geometry
