// SPDX-License-Identifier: MIT
// Every field of a VRML texture by itself and all at once, with numbers of which no two are alike: flags that differ,
// transforms with no symmetry, pictures of one to four components with and without colours of corners.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "geometry/vrml/vrml_textures.hpp"
#include "tests/geometry/picture_samples.hpp"
#include "tests/geometry/vrml/vrml_samples.hpp"

namespace burin::geometry {
namespace {

using PictureFiles = std::map<std::string, std::string>;

// A triangle whose corners have almost the same coordinates in the picture.
std::string small_face(double s, double t) {
    return formatted(
        "geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] } coordIndex [0 1 2] "
        "texCoord TextureCoordinate { point [%.9g %.9g, %.9g %.9g, %.9g %.9g] } }",
        s, t, s + 1e-4, t, s, t + 1e-4);
}

VrmlColour colour_of_face(const std::string& texture, const std::string& face, const PictureFiles& files) {
    const VrmlWorld world = test::vrml_world("Shape { appearance Appearance { " + texture + " } " + face + " }", files);
    if (world.shapes.size() != 1 || world.shapes[0].surface->corner_colours.size() != 1) {
        ADD_FAILURE() << texture << ": no colour";
        return {};
    }
    EXPECT_TRUE(world.remarks.empty()) << texture;
    return world.shapes[0].surface->corner_colours[0][0];
}

// Which quarter of four_colours(): red and green above, blue and white below, each first on the left.
char quarter_of(const VrmlColour& c) {
    if (c[0] > 127 && c[1] > 127) return 'w';
    return c[0] > 127 ? 'r' : c[1] > 127 ? 'g' : 'b';
}

// 64 by 64 pixels: red grows to the right, green upwards, by 4 a pixel; blue is alike everywhere.
std::vector<std::uint8_t> coordinates_as_colours() {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            pixels.push_back(static_cast<std::uint8_t>(4 * x + 2));
            pixels.push_back(static_cast<std::uint8_t>(4 * (63 - y) + 2));
            pixels.push_back(7);
        }
    return pixels;
}

// ISO 14772, 6.48: Tc' = -C x S x R x C x T x Tc, with the matrices written out for homogeneous columns.
struct Transform {
    Vec2 translation{0.0}, center{0.0}, scale{1.0};
    double rotation_rad = 0.0;

    [[nodiscard]] Vec2 of(double s, double t) const {
        using Matrix = std::array<std::array<double, 3>, 3>;
        const auto moved = [](const Vec2& by) { return Matrix{{{1.0, 0.0, by.x}, {0.0, 1.0, by.y}, {0.0, 0.0, 1.0}}}; };
        const double c = std::cos(rotation_rad), d = std::sin(rotation_rad);
        const std::array<Matrix, 5> from_right{
            moved(translation), moved(center), Matrix{{{c, -d, 0.0}, {d, c, 0.0}, {0.0, 0.0, 1.0}}},
            Matrix{{{scale.x, 0.0, 0.0}, {0.0, scale.y, 0.0}, {0.0, 0.0, 1.0}}}, moved(-center)};
        std::array<double, 3> column{s, t, 1.0};
        for (const Matrix& m : from_right) {
            const std::array<double, 3> was = column;
            for (std::size_t i = 0; i < 3; ++i) column[i] = m[i][0] * was[0] + m[i][1] * was[1] + m[i][2] * was[2];
        }
        return {column[0], column[1]};
    }
    [[nodiscard]] std::string text() const {
        return formatted(
            "textureTransform TextureTransform { translation %.9g %.9g center %.9g %.9g scale %.9g %.9g rotation %.9g "
            "}",
            translation.x, translation.y, center.x, center.y, scale.x, scale.y, rotation_rad);
    }
};

}  // namespace

TEST(VrmlTextureFields, RepeatSIsForTheWayToTheRightAndRepeatTForTheWayUp) {
    const PictureFiles files{{"t.png", test::png_file(16, 16, test::four_colours())}};
    struct Case {
        double s, t;
        const char* colours;  // with both flags, without repeatS, without repeatT, without either
    };
    for (const char* const picture :
         {"ImageTexture { url \"t.png\" ", "PixelTexture { image 2 2 3 0x0000FF 0xFFFFFF 0xFF0000 0x00FF00 "})
        for (const Case& at : {Case{1.25, 1.25, "bwrg"}, Case{-0.25, -0.25, "grwb"}, Case{1.25, -0.25, "rgbw"},
                               Case{-2.25, 3.25, "wbgr"}}) {
            const auto face = small_face(at.s, at.t);
            const auto with = [&](const std::string& flags) {
                return quarter_of(colour_of_face("texture " + std::string(picture) + flags + " }", face, files));
            };
            const std::string what = std::string(picture) + std::to_string(at.s) + " " + std::to_string(at.t);
            EXPECT_EQ(with("repeatS TRUE repeatT TRUE"), at.colours[0]) << what;
            EXPECT_EQ(with(""), at.colours[0]) << what << ": both are true where nothing is said";
            EXPECT_EQ(with("repeatS FALSE repeatT TRUE"), at.colours[1]) << what;
            EXPECT_EQ(with("repeatS FALSE"), at.colours[1]) << what;
            EXPECT_EQ(with("repeatS TRUE repeatT FALSE"), at.colours[2]) << what;
            EXPECT_EQ(with("repeatT FALSE"), at.colours[2]) << what;
            EXPECT_EQ(with("repeatS FALSE repeatT FALSE"), at.colours[3]) << what;
        }
}

TEST(VrmlTextureFields, EveryFieldOfATransformActsAsTheStandardsMatrices) {
    const PictureFiles files{{"c.png", test::png_file(64, 64, coordinates_as_colours())}};
    const Vec2 translation(0.13, -0.29), center(0.31, 0.47), scale(1.7, 0.6);
    const double rotation_rad = 0.8;
    for (const Transform& transform :
         {Transform{}, Transform{.translation = translation}, Transform{.center = center}, Transform{.scale = scale},
          Transform{.rotation_rad = rotation_rad}, Transform{.center = center, .scale = scale},
          Transform{.center = center, .rotation_rad = rotation_rad},
          Transform{.scale = scale, .rotation_rad = rotation_rad},
          Transform{.translation = translation, .rotation_rad = rotation_rad},
          Transform{translation, center, scale, rotation_rad}, Transform{translation, center, scale, -1.9}})
        for (const Vec2& at : {Vec2(0.37, 0.11), Vec2(0.83, 0.59)}) {
            const VrmlColour found = colour_of_face("texture ImageTexture { url \"c.png\" } " + transform.text(),
                                                    small_face(at.x, at.y), files);
            const Vec2 expected = transform.of(at.x, at.y);
            for (std::size_t k = 0; k < 2; ++k) {
                const double share = (found[k] - 2.0) / 4.0 / 64.0 + 0.5 / 64.0;  // the middle of the pixel
                const double off = share - expected[static_cast<int>(k)];
                EXPECT_LT(std::abs(off - std::round(off)), 0.6 / 64.0) << (k == 0 ? "s: " : "t: ") << transform.text();
            }
            EXPECT_EQ(found[2], 7);
        }
}

namespace {

// A triangle of three colours, one a corner or one for all.
const std::string kThreePoints =
    "geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] } coordIndex [0 1 2] "
    "texCoord TextureCoordinate { point [0.3 0.3, 0.4 0.3, 0.3 0.4] } ";
constexpr std::array<std::array<double, 3>, 3> kCornerColours{{{0.2, 0.4, 0.9}, {1.0, 0.1, 0.5}, {0.3, 0.8, 0.6}}};

struct PictureKind {
    const char* texture;
    bool is_grey;
    std::array<double, 3> colour;  // of the picture everywhere, 0 to 255
};

}  // namespace

// ISO 14772, tables 4.5 and 4.6: a picture of one component or two is multiplied with the colours of the vertices or
// faces, where there are any, and else with the material's; one of three or four replaces them.
TEST(VrmlTextureFields, PicturesOfOneToFourComponentsMeetColoursOfCornersAsTheStandardSays) {
    const PictureFiles files{{"grey.png", test::png_file(1, 1, {160}, true)},
                             {"colour.png", test::png_file(1, 1, {64, 200, 144})}};
    const std::array<PictureKind, 6> kinds{{{"PixelTexture { image 1 1 1 0xA0 }", true, {160, 160, 160}},
                                            {"PixelTexture { image 1 1 2 0xA037 }", true, {160, 160, 160}},
                                            {"PixelTexture { image 1 1 3 0x40C890 }", false, {64, 200, 144}},
                                            {"PixelTexture { image 1 1 4 0x40C89037 }", false, {64, 200, 144}},
                                            {"ImageTexture { url \"grey.png\" }", true, {160, 160, 160}},
                                            {"ImageTexture { url \"colour.png\" }", false, {64, 200, 144}}}};
    const std::string colour_node = "color Color { color [0.2 0.4 0.9, 1 0.1 0.5, 0.3 0.8 0.6] } ";
    struct Coloured {
        const char* what;
        std::string fields;
        std::array<std::array<double, 3>, 3> own;  // at the three corners
    };
    const std::array<double, 3> diffuse{0.7, 0.35, 0.15};
    const std::array<Coloured, 4> coloured{{{"colours of corners", colour_node, kCornerColours},
                                            {"colours of corners in another order",
                                             colour_node + "colorIndex [2 0 1] ",
                                             {kCornerColours[2], kCornerColours[0], kCornerColours[1]}},
                                            {"one colour for the face",
                                             colour_node + "colorPerVertex FALSE colorIndex [1] ",
                                             {kCornerColours[1], kCornerColours[1], kCornerColours[1]}},
                                            {"no colours", "", {diffuse, diffuse, diffuse}}}};
    for (const PictureKind& kind : kinds)
        for (const Coloured& face : coloured) {
            const VrmlWorld world = test::vrml_world(
                "Shape { appearance Appearance { material Material { diffuseColor 0.7 0.35 0.15 } texture " +
                    std::string(kind.texture) + " } " + kThreePoints + face.fields + "} }",
                files);
            ASSERT_EQ(world.shapes.size(), 1u) << kind.texture;
            const VrmlSurface& surface = *world.shapes[0].surface;
            ASSERT_EQ(surface.corner_colours.size(), 1u) << kind.texture << ", " << face.what;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const Vec3& place = surface.mesh.positions_m[surface.mesh.triangles[0][corner]];
                const std::size_t which = place.x > 0.5 ? 1 : place.y > 0.5 ? 2 : 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const double expected = kind.is_grey ? face.own[which][k] * kind.colour[k] : kind.colour[k];
                    EXPECT_NEAR(surface.corner_colours[0][corner][k], expected, 1.01)
                        << kind.texture << ", " << face.what << ", corner " << which << ", channel " << k;
                }
            }
        }
}

}  // namespace burin::geometry
