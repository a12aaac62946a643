// SPDX-License-Identifier: MIT
// Closed surfaces whose corners were rounded in two ways: joined within what the file's own numbers leave open, and no
// farther.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <random>

#include "base/text.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

using Corner = std::array<double, 3>;

// The corners of a sphere's triangles, radius 47 about (60, 10, -20), each triangle with its own: as programs write
// them that compute a corner anew for each face.
std::vector<Corner> sphere_corners() {
    constexpr int kAround = 24, kRings = 12;
    const auto at = [](int ring, int segment) -> Corner {
        const double up = std::numbers::pi * ring / kRings, around = 2.0 * std::numbers::pi * segment / kAround;
        return {60.0 + 47.0 * std::sin(up) * std::cos(around), 10.0 + 47.0 * std::sin(up) * std::sin(around),
                -20.0 + 47.0 * std::cos(up)};
    };
    std::vector<Corner> corners;
    for (int ring = 0; ring < kRings; ++ring) {
        for (int i = 0; i < kAround; ++i) {
            const Corner a = at(ring, i), b = at(ring, i + 1), c = at(ring + 1, i + 1), d = at(ring + 1, i);
            if (ring > 0) corners.insert(corners.end(), {a, c, b});
            if (ring + 1 < kRings) corners.insert(corners.end(), {a, d, c});
        }
    }
    return corners;
}

using Rounding = std::function<double(double number, int steps)>;  // with its last digit 0 or 1 step off

double in_floats(double x, int steps) {
    auto value = static_cast<float>(x);
    for (; steps != 0; steps += steps > 0 ? -1 : 1) value = std::nextafter(value, steps > 0 ? 1e9f : -1e9f);
    return value;
}
double in_doubles(double x, int steps) { return x + 2e-14 * steps; }
Rounding in_decimals(double last_place) {
    return [last_place](double x, int steps) { return (std::round(x / last_place) + steps) * last_place; };
}

std::vector<Corner> rounded_apart(const Rounding& rounding) {
    std::mt19937 random(7);
    std::vector<Corner> corners = sphere_corners();
    for (Corner& corner : corners) {
        for (double& x : corner) x = rounding(x, static_cast<int>(random() % 2u));
    }
    return corners;
}

std::string text_of(const Corner& corner, const char* format) {
    std::string text;
    for (const double x : corner) text += " " + formatted(format, x);
    return text;
}

std::string as_obj(const std::vector<Corner>& corners, const char* format) {
    std::string text = "# units mm\n";
    for (const Corner& corner : corners) text += "v" + text_of(corner, format) + "\n";
    for (std::size_t i = 1; i < corners.size(); i += 3) text += formatted("f %zu %zu %zu\n", i, i + 1, i + 2);
    return text;
}
std::string as_off(const std::vector<Corner>& corners, const char* format) {
    std::string text = formatted("OFF # units mm\n%zu %zu\n", corners.size(), corners.size() / 3);
    for (const Corner& corner : corners) text += text_of(corner, format) + "\n";
    for (std::size_t i = 0; i < corners.size(); i += 3) text += formatted("3 %zu %zu %zu\n", i, i + 1, i + 2);
    return text;
}
std::string as_ply(const std::vector<Corner>& corners, const char* format) {
    std::string text = formatted(
        "ply\nformat ascii 1.0\ncomment units mm\nelement vertex %zu\nproperty float x\nproperty float y\n"
        "property float z\nelement face %zu\nproperty list uchar int vertex_indices\nend_header\n",
        corners.size(), corners.size() / 3);
    for (const Corner& corner : corners) text += text_of(corner, format) + "\n";
    for (std::size_t i = 0; i < corners.size(); i += 3) text += formatted("3 %zu %zu %zu\n", i, i + 1, i + 2);
    return text;
}
std::string as_ascii_stl(const std::vector<Corner>& corners, const char* format) {
    std::string text = "solid UNITS=mm\n";
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (std::size_t k = 0; k < 3; ++k) text += "vertex" + text_of(corners[i + k], format) + "\n";
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid\n";
}
std::string as_binary_stl(const std::vector<Corner>& corners) {
    std::vector<float> numbers;
    for (const Corner& corner : corners) {
        for (const double x : corner) numbers.push_back(static_cast<float>(x));
    }
    const std::vector<std::byte> bytes = binary_stl(numbers, static_cast<std::uint32_t>(corners.size() / 3));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
template <typename Number>
std::string as_binary_ply(const std::vector<Corner>& corners) {
    const std::string type = sizeof(Number) == 4 ? "float" : "double";
    std::string text = formatted("ply\nformat binary_little_endian 1.0\nelement vertex %zu\n", corners.size());
    for (const char* axis : {"x", "y", "z"}) text += "property " + type + " " + axis + "\n";
    text += formatted("element face %zu\nproperty list uchar int vertex_indices\nend_header\n", corners.size() / 3);
    const auto put = [&](const auto& value) { text.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
    for (const Corner& corner : corners) {
        for (const double x : corner) put(static_cast<Number>(x));
    }
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(corners.size()); i += 3) {
        put(std::uint8_t{3});
        for (const std::int32_t v : {i, i + 1, i + 2}) put(v);
    }
    return text;
}

void expect_closed_within_its_precision(const std::string& text, MeshFormat format, const char* what) {
    auto read = import_text(text, format, LengthUnit::mm);
    ASSERT_TRUE(read) << what << ": " << read.error().line();
    weld_vertices(read->mesh);
    EXPECT_FALSE(examine(read->mesh).closed) << what;
    const double tolerance_m = read->report.weld_tolerance_m;
    EXPECT_LT(tolerance_m, 5e-6) << what << ": 50 ppm of the sphere";
    const JoinReport joined = join_open_edges(read->mesh, tolerance_m);
    EXPECT_GT(joined.vertices_joined, 100u) << what;
    EXPECT_LE(joined.farthest_m, tolerance_m) << what;
    const MeshHealth health = examine(read->mesh);
    EXPECT_TRUE(health.closed && health.manifold() && health.consistently_oriented) << what;
    EXPECT_EQ(health.shells, 1u) << what;
    EXPECT_NEAR(health.signed_volume_m3, 4.18e-4, 0.05e-4) << what;
}

// A cup of 100 mm with walls of 5 mm whose rim is open, about `at` and in metres, its numbers as the format writes them
// out.
std::string cup_obj(const Corner& at, const char* format) {
    constexpr int kAround = 36;
    std::string text, faces;
    const auto ring = [&](double radius, double height) {
        for (int i = 0; i < kAround; ++i) {
            const double around = 2.0 * std::numbers::pi * i / kAround;
            text += "v" +
                    text_of({at[0] + radius * std::cos(around), at[1] + radius * std::sin(around), at[2] + height},
                            format) +
                    "\n";
        }
    };
    ring(0.05, 0.0), ring(0.05, 0.1), ring(0.045, 0.1), ring(0.045, 0.005);
    for (int i = 0; i < kAround; ++i) {
        const int a = i + 1, b = (i + 1) % kAround + 1, inside = 2 * kAround;
        faces += formatted("f %d %d %d %d\n", a, b, b + kAround, a + kAround);
        faces += formatted("f %d %d %d %d\n", a + inside, b + inside, b + inside + kAround, a + inside + kAround);
        if (i > 0 && i + 1 < kAround) {
            faces += formatted("f 1 %d %d\n", b, a);
            faces += formatted("f %d %d %d\n", 3 * kAround + 1, a + 3 * kAround, b + 3 * kAround);
        }
    }
    return text + faces;
}

}  // namespace

TEST(JoinOpenEdges, LeavesTheOpenRimOfACupAsItIsHoweverFarItStandsFromTheOrigin) {
    for (const char* format : {"%.3f", "%.4f", "%.7g", "%.9g", "%.17g"}) {
        for (const Corner& at : {Corner{500, 800, 10}, Corner{0, 0, 0}, Corner{-90, 5, 999.95}}) {
            auto read = import_text(cup_obj(at, format), MeshFormat::obj, LengthUnit::m);
            ASSERT_TRUE(read) << read.error().line();
            weld_vertices(read->mesh);
            EXPECT_LT(read->report.weld_tolerance_m, 2e-3) << format << ": walls are 5 mm";
            EXPECT_EQ(join_open_edges(read->mesh, read->report.weld_tolerance_m).vertices_joined, 0u) << format;
            EXPECT_FALSE(examine(read->mesh).closed) << format;
            EXPECT_EQ(tolerance_that_closes_m(read->mesh), std::nullopt) << format;
        }
    }
}

TEST(JoinOpenEdges, TheToleranceOfAFileIsAPlaceOrTwoOfWhatIsWritten) {
    const auto tolerance = [](const std::string& x) {
        const auto read = import_text("v " + x + " 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n", MeshFormat::obj, LengthUnit::m);
        return read ? read->report.weld_tolerance_m : -1.0;
    };
    EXPECT_NEAR(tolerance("800.000"), 1.75e-3, 1e-9);
    EXPECT_NEAR(tolerance("-999.999"), 1.75e-3, 1e-9);
    EXPECT_NEAR(tolerance("8.00000e+02"), 1.75e-3, 1e-9);
    EXPECT_NEAR(tolerance("1.0000000"), 3.5 * 0x1p-23, 1e-15) << "a float holds no more";
    EXPECT_NEAR(tolerance("800.12345678901"), 512 * 0x1p-43, 1e-17);
    EXPECT_NEAR(tolerance("800"), 512 * 0x1p-43, 1e-17) << "typed, and exact as far as a double is";
}

TEST(JoinOpenEdges, SaysNoToleranceThatPressesWallsTogether) {
    TriangleMesh sheets;  // 1 m wide, 0.5 mm apart
    for (const double z : {0.0, 5e-4}) {
        for (const double y : {0.0, 1.0}) sheets.positions_m.insert(sheets.positions_m.end(), {{0, y, z}, {1, y, z}});
    }
    sheets.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}};
    EXPECT_EQ(tolerance_that_closes_m(sheets), std::nullopt);
}

TEST(JoinOpenEdges, ClosesASphereWhoseCornersWereRoundedInTwoWaysInEveryFormat) {
    const auto floats = rounded_apart(in_floats), doubles = rounded_apart(in_doubles),
               micrometres = rounded_apart(in_decimals(1e-3)), nanometres = rounded_apart(in_decimals(1e-6)),
               six_digits = rounded_apart(in_decimals(1e-4));
    expect_closed_within_its_precision(as_binary_stl(floats), MeshFormat::stl, "binary STL");
    expect_closed_within_its_precision(as_ascii_stl(floats, "%.9g"), MeshFormat::stl, "ASCII STL of floats");
    expect_closed_within_its_precision(as_ascii_stl(six_digits, "%.6e"), MeshFormat::stl, "ASCII STL, %e");
    expect_closed_within_its_precision(as_ascii_stl(micrometres, "%.3f"), MeshFormat::stl, "ASCII STL, 3 decimals");
    expect_closed_within_its_precision(as_obj(doubles, "%.17g"), MeshFormat::obj, "OBJ of doubles");
    expect_closed_within_its_precision(as_obj(nanometres, "%.6f"), MeshFormat::obj, "OBJ, 6 decimals");
    expect_closed_within_its_precision(as_obj(floats, "%.17g"), MeshFormat::obj, "OBJ of floats");
    expect_closed_within_its_precision(as_off(doubles, "%.16g"), MeshFormat::off, "OFF of doubles");
    expect_closed_within_its_precision(as_off(floats, "%.9g"), MeshFormat::off, "OFF of floats");
    expect_closed_within_its_precision(as_ply(six_digits, "%.4f"), MeshFormat::ply, "PLY, 4 decimals");
    expect_closed_within_its_precision(as_binary_ply<float>(floats), MeshFormat::ply, "binary PLY of floats");
    expect_closed_within_its_precision(as_binary_ply<double>(doubles), MeshFormat::ply, "binary PLY of doubles");
}

// The poles of a sphere as sin and cos give them: rings of corners that lie 1e-15 apart.
TEST(JoinOpenEdges, FoldsAPoleOfNearlyEqualCornersToAPoint) {
    constexpr int kAround = 16;
    std::string text, faces;
    for (int ring = 0; ring <= 8; ++ring) {
        const double up = std::numbers::pi * ring / 8;
        for (int i = 0; i < kAround; ++i) {
            const double around = 2.0 * std::numbers::pi * i / kAround;
            text += formatted("v %.17g %.17g %.17g\n", (std::sin(up) + 1e-15) * std::cos(around),
                              (std::sin(up) + 1e-15) * std::sin(around), std::cos(up));
            const int a = ring * kAround + i + 1, b = ring * kAround + (i + 1) % kAround + 1;
            if (ring < 8) faces += formatted("f %d %d %d %d\n", a, a + kAround, b + kAround, b);
        }
    }
    auto read = import_text(text + faces, MeshFormat::obj, LengthUnit::m);
    ASSERT_TRUE(read);
    EXPECT_FALSE(examine(read->mesh).closed);
    const JoinReport joined = join_open_edges(read->mesh, read->report.weld_tolerance_m);
    EXPECT_EQ(joined.vertices_joined, 2u * (kAround - 1));
    EXPECT_EQ(joined.triangles_dropped, 2u * kAround);
    const MeshHealth health = examine(read->mesh);
    EXPECT_TRUE(health.closed && health.manifold()) << "16 triangles meet at each pole";
    EXPECT_EQ(health.degenerate_triangles, 0u);
}

TEST(JoinOpenEdges, LeavesAClosedSurfaceAsItIsHoweverNearItsVerticesLie) {
    TriangleMesh mesh = tetrahedron();
    const auto count = static_cast<std::uint32_t>(mesh.positions_m.size());
    for (std::uint32_t v = 0; v < count; ++v) mesh.positions_m.push_back(mesh.positions_m[v] + 1e-12);
    for (std::size_t t = 0; t < 4; ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        mesh.triangles.push_back({a + count, b + count, c + count});
    }
    const TriangleMesh before = mesh;
    EXPECT_EQ(join_open_edges(mesh, 1e-3).vertices_joined, 0u);
    EXPECT_EQ(mesh.triangles, before.triangles);
}

TEST(JoinOpenEdges, NumbersOfFewDigitsAreTakenAsTheyWereTyped) {
    const auto read = import_text("v 0 0 0\nv 0.02 0 0\nv 0.0201 0.02 0\nf 1 2 3\n", MeshFormat::obj, LengthUnit::m);
    ASSERT_TRUE(read);
    EXPECT_NEAR(read->report.weld_tolerance_m, 512 * 0x1p-58, 1e-19) << "no more than arithmetic in doubles";
}

// Sines and cosines that ought to be 0 are written as 1e-17.
TEST(JoinOpenEdges, CornersThatDifferByLessThanADoubleOfTheLargestAreOneHoweverFewDigitsTheyHave) {
    auto read = import_text(
        "v 0 0 0\nv 0.05 0 0\nv 0 0.04 0\nv 0 0 0.03\nv 1e-17 0 0\nv 0.05 -2e-17 0\n"
        "f 1 3 2\nf 5 6 4\nf 2 3 4\nf 1 4 3\n",
        MeshFormat::obj, LengthUnit::m);
    ASSERT_TRUE(read);
    EXPECT_FALSE(examine(read->mesh).closed);
    EXPECT_EQ(join_open_edges(read->mesh, read->report.weld_tolerance_m).vertices_joined, 2u);
    EXPECT_TRUE(examine(read->mesh).closed);
}

TEST(JoinOpenEdges, SaysWhichToleranceClosesAMeshAndThatNoneClosesAHole) {
    auto cracked = import_text(as_obj(rounded_apart([](double x, int steps) { return x + 0.002 * steps; }), "%.17g"),
                               MeshFormat::obj, LengthUnit::mm);
    ASSERT_TRUE(cracked);
    TriangleMesh& mesh = cracked->mesh;
    weld_vertices(mesh);
    join_open_edges(mesh, cracked->report.weld_tolerance_m);
    EXPECT_FALSE(examine(mesh).closed);
    const auto tolerance_m = tolerance_that_closes_m(mesh);
    ASSERT_TRUE(tolerance_m.has_value());
    EXPECT_NEAR(*tolerance_m, 1e-5, 1e-12) << "corners are up to sqrt(3) * 0.002 mm apart";
    join_open_edges(mesh, *tolerance_m);
    EXPECT_TRUE(examine(mesh).closed);
    TriangleMesh holed = cube();
    holed.triangles.pop_back();
    EXPECT_EQ(tolerance_that_closes_m(holed), std::nullopt);
}

TEST(JoinOpenEdges, KeepsColourAndMaterialOfWhatStays) {
    TriangleMesh mesh;
    mesh.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e-9, 0, 0}, {1, 1, 1}, {1e-9, 0, 1e-9}};
    mesh.colours = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}, {5, 5, 5}, {6, 6, 6}};
    mesh.triangles = {{0, 3, 5}, {0, 1, 2}, {3, 4, 1}};
    mesh.materials = {{"a", {}}, {"b", {}}, {"c", {}}};
    mesh.triangle_materials = {0, 1, 2};
    const JoinReport joined = join_open_edges(mesh, 1e-8);
    EXPECT_EQ(joined.vertices_joined, 2u);
    EXPECT_EQ(joined.triangles_dropped, 1u);
    EXPECT_EQ(mesh.triangle_materials, (std::vector<std::uint8_t>{1, 2}));
    EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 4, 1}}));
    EXPECT_EQ(in_words(joined), "2 corners up to 1.4e-06 mm apart were joined, and 1 triangles without area dropped");
}

}  // namespace burin::geometry::test
