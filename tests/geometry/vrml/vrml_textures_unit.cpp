// SPDX-License-Identifier: MIT
// Textures of VRML as colours of corners.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/vrml/vrml_textures.hpp"
#include "tests/geometry/picture_samples.hpp"
#include "tests/geometry/vrml/vrml_samples.hpp"

namespace burin::geometry {
namespace {

using Files = std::map<std::string, std::string>;

const std::string kWorn = "appearance Appearance { material Material { diffuseColor 0.2 0.4 0.6 } texture ";
const std::string kQuad =
    "geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] } coordIndex [0 1 2 3] "
    "texCoord TextureCoordinate { point [0 0, 1 0, 1 1, 0 1] } ";

// Returns the colour at the corner that lies there.
VrmlColour colour_at(const VrmlShape& shape, const Vec3& place) {
    const VrmlSurface& surface = *shape.surface;
    for (std::size_t i = 0; i < surface.corner_colours.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            if (surface.mesh.positions_m[surface.mesh.triangles[i][c]] == place) return surface.corner_colours[i][c];
    ADD_FAILURE() << "no colour there";
    return {};
}

// Which of the four quarters of four_colours() a colour is most like: 'r', 'g', 'b' or 'w'.
char like(const VrmlColour& c) {
    if (c[0] > 127 && c[1] > 127 && c[2] > 127) return 'w';
    return c[0] > c[1] && c[0] > c[2] ? 'r' : c[1] > c[2] ? 'g' : 'b';
}

std::string corners_of(const VrmlShape& shape) {
    std::string all;
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) all += like(colour_at(shape, p));
    return all;
}

}  // namespace

TEST(VrmlTextures, AFaceSetWearsItsPictureByItsCoordinates) {
    const Files files{{"t.png", test::png_file(16, 16, test::four_colours())}};
    const auto corners = [&](const std::string& texture, const std::string& more = "") {
        const VrmlWorld world = test::vrml_world("Shape { " + kWorn + texture + " } " + kQuad + more + " } }", files);
        return world.shapes.empty() ? "" : corners_of(world.shapes[0]);
    };
    EXPECT_EQ(corners("ImageTexture { url \"t.png\" }"), "bwgr");
    EXPECT_EQ(corners("ImageTexture { url [\"lost.png\" \"t.png\"] }"), "bwgr") << "the first that can be read";
    EXPECT_EQ(corners("ImageTexture { url \"t.png\" }", "texCoordIndex [1 2 3 0]"), "wgrb");
    EXPECT_EQ(corners("ImageTexture { url \"t.png\" } textureTransform TextureTransform { translation 0.5 0 }"),
              "wbrg");
    EXPECT_EQ(corners("PixelTexture { image 2 2 3 0x0000FF 0xFFFFFF 0xFF0000 0x00FF00 }"), "bwgr");
}

TEST(VrmlTextures, SolidsAndSetsWithoutCoordinatesWearItAsTheStandardSays) {
    const Files files{{"t.png", test::png_file(16, 16, test::four_colours())}};
    const std::string texture = kWorn + "ImageTexture { url \"t.png\" } } ";
    const VrmlWorld box = test::vrml_world("Shape { " + texture + "geometry Box { } }", files);
    ASSERT_EQ(box.shapes.size(), 1u);
    const VrmlSurface& sides = *box.shapes[0].surface;
    for (std::size_t i = 0; i < sides.mesh.triangles.size(); ++i) {
        const auto& t = sides.mesh.triangles[i];
        const auto at = [&](std::size_t c) { return sides.mesh.positions_m[t[c]]; };
        const Vec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec3 p = at(c);
            const double right = normal.z != 0.0   ? p.x * glm::sign(normal.z)
                                 : normal.x != 0.0 ? -p.z * glm::sign(normal.x)
                                                   : p.x;
            const double up = normal.y != 0.0 ? -p.z * glm::sign(normal.y) : p.y;
            const char expected = up > 0.0 ? (right > 0.0 ? 'g' : 'r') : (right > 0.0 ? 'w' : 'b');
            EXPECT_EQ(like(sides.corner_colours[i][c]), expected) << i << " " << c;
        }
    }
    for (const char* const solid : {"Sphere { }", "Cylinder { }", "Cone { }", "Extrusion { }"}) {
        const VrmlWorld world = test::vrml_world("Shape { " + texture + "geometry " + solid + " }", files);
        ASSERT_EQ(world.shapes.size(), 1u) << solid;
        EXPECT_EQ(world.shapes[0].surface->corner_colours.size(), world.shapes[0].surface->mesh.triangles.size());
    }
    const VrmlWorld ball = test::vrml_world("Shape { " + texture + "geometry Sphere { } }", files);
    const VrmlSurface& round = *ball.shapes[0].surface;
    for (std::size_t i = 0; i < round.mesh.triangles.size(); ++i) {
        Vec3 middle(0.0);
        for (const std::uint32_t v : round.mesh.triangles[i]) middle += round.mesh.positions_m[v] / 3.0;
        if (std::abs(middle.x) < 0.2 || std::abs(middle.y) < 0.2) continue;  // where two colours meet
        // From the back counter-clockwise, seen from above: the left half of the picture lies on -X.
        const char expected = middle.y > 0.0 ? (middle.x < 0.0 ? 'r' : 'g') : (middle.x < 0.0 ? 'b' : 'w');
        EXPECT_EQ(like(round.corner_colours[i][0]), expected) << i;
    }
}

TEST(VrmlTextures, WhatCannotBeReadIsOneRemarkThatNamesItAndTheMaterialsColourStands) {
    for (const char* const url : {"lost.png", "../t.png", "http://x.org/t.png", "t.wrl"}) {
        const VrmlWorld world =
            test::vrml_world("DEF A Shape { " + kWorn + "ImageTexture { url \"" + url + "\" } } " + kQuad +
                                 " } }\nShape { " + kWorn + "ImageTexture { } } " + kQuad + " } }",
                             {{"t.wrl", "#VRML V2.0 utf8"}});
        ASSERT_EQ(world.shapes.size(), 2u);
        EXPECT_TRUE(world.shapes[0].surface->corner_colours.empty());
        EXPECT_EQ(world.shapes[0].colour, (VrmlColour{51, 102, 153}));
        ASSERT_EQ(world.remarks.size(), 1u) << url;
        EXPECT_TRUE(world.remarks[0].line().contains("colour of its material stands")) << world.remarks[0].line();
        EXPECT_TRUE(world.remarks[0].where.contains("test.wrl:2:")) << world.remarks[0].where;
    }
}

TEST(VrmlTextures, AGreyPictureDarkensAndWhatGlowsIsSeenInThatColour) {
    const Files files{{"g.png", test::png_file(2, 2, {128, 128, 128, 128}, true)}};
    const VrmlWorld grey =
        test::vrml_world("Shape { " + kWorn + "ImageTexture { url \"g.png\" } } " + kQuad + " } }", files);
    const VrmlColour c = colour_at(grey.shapes[0], Vec3(0.0));
    EXPECT_NEAR(c[0], 26, 1);
    EXPECT_NEAR(c[2], 77, 1);
    const VrmlWorld glowing = test::vrml_world(
        "Shape { appearance Appearance { material Material { diffuseColor 0 0 0 emissiveColor 1 0.2 0 } } " + kQuad +
        " } }");
    EXPECT_EQ(glowing.shapes[0].colour, (VrmlColour{255, 51, 0}));
}

// ISO 14772, 5.5: with four components red stands in the highest byte and alpha in the lowest, which fills all 32 bits.
TEST(VrmlTextures, APixelTextureMayHaveAnAlphaWrittenWithASignOrWithout) {
    for (const char* const image : {"1 2 4 0xFF0000FF 0xFF0000FF", "1 2 4 4278190335 -16776961", "1 1 4 0xFF0000FF",
                                    "1 1 3 0xFF0000", "1 1 4 0xFF000000"}) {
        const VrmlWorld world =
            test::vrml_world("DEF Plate Shape { appearance Appearance { texture PixelTexture { image " +
                             std::string(image) + " } } geometry Box { size 0.1 0.1 0.1 } }");
        ASSERT_EQ(world.shapes.size(), 1u) << image;
        EXPECT_TRUE(world.remarks.empty()) << image;
        for (const auto& corner : world.shapes[0].surface->corner_colours)
            EXPECT_EQ(corner[0], (VrmlColour{255, 0, 0})) << image;
        EXPECT_FALSE(world.shapes[0].surface->corner_colours.empty()) << image;
    }
}

TEST(VrmlTextures, WhatIsNoNumberInATextureLosesNoShape) {
    const VrmlWorld world = test::vrml_world(
        "Shape { " + kWorn +
        "PixelTexture { image 1 1 3 0xFF0000 } textureTransform TextureTransform { scale nan 1 } } "
        "geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0] } coordIndex [0 1 2] "
        "texCoord TextureCoordinate { point [nan 0, 1e30 0, 1 1] } } }");
    ASSERT_EQ(world.shapes.size(), 1u);
    EXPECT_EQ(colour_at(world.shapes[0], Vec3(0.0)), (VrmlColour{255, 0, 0}));
}

TEST(VrmlTextures, AnUnsoundPixelTextureIsARemark) {
    for (const char* const image :
         {"2 2 3 0 0 0", "2 2 9 0 0 0 0", "1 1 3 0.5", "1 1 3 nan", "1 1 4 4294967296", "1e9 1e9 1 0"}) {
        const VrmlWorld world =
            test::vrml_world("Shape { " + kWorn + "PixelTexture { image " + image + " } } " + kQuad + " } }");
        EXPECT_EQ(world.remarks.size(), 1u) << image;
    }
    EXPECT_TRUE(
        test::vrml_world("Shape { " + kWorn + "PixelTexture { image 0 0 0 } } " + kQuad + " } }").remarks.empty());
}

TEST(VrmlTextures, TheFilesOfPicturesAreKnownSoThatNoOutputOverwritesThem) {
    const auto file = read_vrml(test::kVrmlHead +
                                    "PROTO P [ field MFString f \"a.png\" ] { Shape { appearance Appearance { "
                                    "texture ImageTexture { url IS f } } geometry Box { } } }\n"
                                    "P { f \"b.png\" } Shape { appearance Appearance { texture ImageTexture { "
                                    "url \"sub/c.jpg\" } } geometry Box { } }",
                                "test.wrl");
    ASSERT_TRUE(file);
    const std::vector<std::string> names = vrml_picture_names(*file);
    for (const char* const name : {"a.png", "b.png", "sub/c.jpg"})
        EXPECT_NE(std::ranges::find(names, name), names.end()) << name;
}

}  // namespace burin::geometry
