// SPDX-License-Identifier: MIT
// LDR-FLIP against its authors' own program, and its colour spaces against their published definitions.
#include "bench/measure/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace burin::bench {
namespace {

using Colour = std::array<std::uint8_t, 3>;
using Painter = std::function<Colour(unsigned, unsigned)>;

constexpr ImageSize kSize{96, 64};

Image painted(const Painter& colour_at, ImageSize size = kSize) {
    Image image{size, {}};
    for (unsigned y = 0; y < size.height; ++y)
        for (unsigned x = 0; x < size.width; ++x) {
            const Colour c = colour_at(x, y);
            image.rgba.insert(image.rgba.end(), {c[0], c[1], c[2], std::uint8_t{255}});
        }
    return image;
}

Image plain(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    return painted([=](unsigned, unsigned) { return Colour{r, g, b}; });
}

// Patterns in whole numbers, so that the authors' program could be given the same bytes.
Colour rings(unsigned x, unsigned y) {
    const unsigned d = (x - 48) * (x - 48) + (y - 32) * (y - 32);
    return {static_cast<std::uint8_t>(d / 7), static_cast<std::uint8_t>(d / 11 + x),
            static_cast<std::uint8_t>(255 - d / 5 - y)};
}
Colour rings_moved(unsigned x, unsigned y) { return rings(x + 1, y); }
Colour checks(unsigned x, unsigned y) {
    const std::uint8_t v = ((x / 4 + y / 4) & 1) != 0 ? 200 : 60;
    return {v, v, v};
}
Colour checks_tinted(unsigned x, unsigned y) {
    Colour c = checks(x, y);
    c[2] = static_cast<std::uint8_t>(c[2] + 30);
    return c;
}
Colour grey(unsigned, unsigned) { return {128, 128, 128}; }
Colour one_point(unsigned x, unsigned y) { return x == 48 && y == 32 ? Colour{255, 255, 255} : grey(x, y); }
Colour black(unsigned, unsigned) { return {0, 0, 0}; }
Colour half_white(unsigned x, unsigned) { return x < 48 ? Colour{0, 0, 0} : Colour{255, 255, 255}; }

}  // namespace

// The values are those that the authors' program of version 1.6.0.1 (NVlabs/flip, FLIP.h, processor path) gives
// for these very bytes. It works in float with rounded matrices, hence the tolerance.
TEST(Flip, AgreesWithItsAuthorsProgram) {
    struct Known {
        const char* name;
        Painter reference, test;
        double pixels_per_degree, mean, largest;
    };
    const std::array known{
        Known{"rings", rings, rings_moved, 67.0, 0.228602, 0.964347},
        Known{"rings", rings, rings_moved, 30.0, 0.255501, 0.984821},
        Known{"tint", checks, checks_tinted, 67.0, 0.305414, 0.359145},
        Known{"tint", checks, checks_tinted, 30.0, 0.324091, 0.373335},
        Known{"point", grey, one_point, 67.0, 0.000700, 0.378817},
        Known{"point", grey, one_point, 30.0, 0.000409, 0.820975},
        Known{"step", black, half_white, 67.0, 0.513340, 0.993944},
        Known{"step", black, half_white, 30.0, 0.495677, 0.994549},
    };
    for (const Known& k : known) {
        const auto map = flip(painted(k.reference), painted(k.test), k.pixels_per_degree);
        ASSERT_TRUE(map.has_value()) << map.error().line();
        EXPECT_NEAR(map->mean, k.mean, 2e-4) << k.name << " at " << k.pixels_per_degree;
        EXPECT_NEAR(map->largest, k.largest, 2e-3) << k.name << " at " << k.pixels_per_degree;
    }
}

TEST(Flip, IsZeroForEqualPictures) {
    for (const Painter& painter : {Painter(rings), Painter(checks), Painter(half_white)}) {
        const auto map = flip(painted(painter), painted(painter));
        ASSERT_TRUE(map.has_value());
        EXPECT_EQ(map->largest, 0.0);
        EXPECT_EQ(map->mean, 0.0);
    }
}

// Without edges only colour counts. From the paper's constants: black and white are 100 apart in lightness; 100^0.7 =
// 25.119. The largest, green to blue, from their CIELab values under D65 (87.73, -86.18, 83.18) and (32.30, 79.19,
// -107.86) with Hunt's effect: 55.43 + |(-75.61 - 25.58, 72.98 + 34.84)| = 203.30, to the 0.7: 41.26.
TEST(Flip, OfBlackAndWhiteIsWhatTheFormulasSay) {
    const double largest = std::pow(203.30, 0.7), bend = 0.4 * largest;
    const double expected = 0.95 + (std::pow(100.0, 0.7) - bend) / (largest - bend) * 0.05;
    const auto map = flip(plain(0, 0, 0), plain(255, 255, 255));
    ASSERT_TRUE(map.has_value());
    EXPECT_NEAR(map->mean, expected, 2e-4);
    EXPECT_NEAR(map->largest, map->mean, 1e-6);
    EXPECT_NEAR(flip(plain(0, 255, 0), plain(0, 0, 255))->mean, 1.0,
                1e-6);  // the largest difference of colour there is
}

TEST(Flip, IsTheSameTheOtherWayRound) {
    const Image a = painted(rings), b = painted(rings_moved), c = painted(checks);
    EXPECT_NEAR(flip(a, b)->mean, flip(b, a)->mean, 1e-7);
    EXPECT_NEAR(flip(a, c)->mean, flip(c, a)->mean, 1e-7);
}

TEST(Flip, GrowsWithTheDifference) {
    const Image base = plain(100, 100, 100);
    double before = 0.0;
    for (const int more : {1, 2, 4, 8, 16, 32, 64, 128}) {
        const auto v = static_cast<std::uint8_t>(100 + more);
        const double now = flip(base, plain(v, v, v))->mean;
        EXPECT_GT(now, before) << more;
        before = now;
    }
}

TEST(Flip, SeesFinePatternsLessFromFarAway) {
    const auto fine = [](unsigned x, unsigned y) {
        const std::uint8_t v = ((x + y) & 1) != 0 ? 138 : 118;
        return Colour{v, v, v};
    };
    const Image flat = painted(grey), pattern = painted(fine);
    EXPECT_GT(flip(flat, pattern, 10.0)->mean, 2.0 * flip(flat, pattern, 67.0)->mean);
}

TEST(Flip, MarksOnlyWhatIsNearTheDifference) {
    const auto map = flip(painted(grey), painted(one_point));
    ASSERT_TRUE(map.has_value());
    EXPECT_GT(map->error[32 * 96 + 48], 0.3f);
    for (unsigned x = 0; x < 96; ++x) {  // the filters reach 10 pixels at 67 pixels per degree
        if (x >= 37 && x <= 59) continue;
        EXPECT_LT(map->error[32 * 96 + x], 1e-4f) << x;
    }
}

// sRGB: IEC 61966-2-1. Its matrix to XYZ is printed with four digits; CIELab values of the primaries and greys under
// D65 are tabulated with two.
TEST(Flip, ConvertsColoursAsTheirStandardsSay) {
    EXPECT_EQ(linear_of_srgb8(0), 0.0);
    EXPECT_NEAR(linear_of_srgb8(255), 1.0, 1e-12);
    EXPECT_NEAR(linear_of_srgb8(10), 10.0 / 255.0 / 12.92, 1e-12);
    EXPECT_NEAR(linear_of_srgb8(188), 0.5028865, 1e-6);  // ((188/255 + 0.055) / 1.055)^2.4
    const std::array<std::array<double, 3>, 3> printed{
        {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
    for (int column = 0; column < 3; ++column) {
        Vec3 unit(0.0);
        unit[column] = 1.0;
        for (int row = 0; row < 3; ++row)
            EXPECT_NEAR(xyz_of_linear(unit)[row],
                        printed[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)], 6e-5);
    }
    struct Known {
        Vec3 linear, lab;
    };
    const double mid = std::pow((0.5 + 0.055) / 1.055, 2.4);
    for (const Known& k : {Known{{0, 0, 0}, {0, 0, 0}}, Known{{1, 1, 1}, {100, 0, 0}},
                           Known{{1, 0, 0}, {53.24, 80.09, 67.20}}, Known{{0, 1, 0}, {87.73, -86.18, 83.18}},
                           Known{{0, 0, 1}, {32.30, 79.19, -107.86}}, Known{{mid, mid, mid}, {53.39, 0, 0}},
                           // Below (6/29)^3 lightness is (29/3)^3 Y.
                           Known{{0.004, 0.004, 0.004}, {0.004 * 24389.0 / 27.0, 0, 0}}}) {
        const Vec3 lab = lab_of_linear(k.linear);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(lab[i], k.lab[i], 0.02) << k.lab.x << " part " << i;
    }
}

TEST(Flip, RefusesPicturesThatCannotBeCompared) {
    const Image a = plain(0, 0, 0);
    const Image small = painted(grey, {8, 8});
    EXPECT_NE(flip(a, small).error().line().find("96 x 64 and 8 x 8"), std::string::npos);
    EXPECT_NE(flip({}, a).error().line().find("no pixels"), std::string::npos);
    EXPECT_NE(flip(a, a, 0.0).error().line().find("pixels per degree"), std::string::npos);
    EXPECT_FALSE(flip(a, a, std::nan("")).has_value());
}

}  // namespace burin::bench
