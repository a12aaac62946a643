// SPDX-License-Identifier: MIT
// mesh_audit sees every kind of defect that a test may rely on it to see, and judges sound files of each format the
// same. It is run as the program it is; the meshes are made here, with known counts.
#include <gtest/gtest.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/places.hpp"

namespace {

namespace fs = std::filesystem;

struct Shape {
    std::vector<std::array<double, 3>> points;
    std::vector<std::vector<unsigned>> faces;
};

Shape unit_cube(double x = 0, double y = 0, double z = 0) {
    Shape cube;
    for (unsigned i = 0; i < 8; ++i) {
        cube.points.push_back({x + (i & 1), y + ((i >> 1) & 1), z + ((i >> 2) & 1)});
    }
    cube.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return cube;
}

Shape both(Shape a, const Shape& b) {
    const auto shift = static_cast<unsigned>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (std::vector<unsigned> face : b.faces) {
        for (unsigned& corner : face) corner += shift;
        a.faces.push_back(face);
    }
    return a;
}

// m quads around, n along: a torus of genus 1.
Shape torus(unsigned m, unsigned n) {
    Shape shape;
    for (unsigned i = 0; i < m; ++i) {
        for (unsigned j = 0; j < n; ++j) {
            const double u = 2 * M_PI * i / m, v = 2 * M_PI * j / n;
            shape.points.push_back({(2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v)});
            const unsigned a = i * n + j, b = (i + 1) % m * n + j, c = (i + 1) % m * n + (j + 1) % n,
                           d = i * n + (j + 1) % n;
            shape.faces.push_back({a, b, c});
            shape.faces.push_back({a, c, d});
        }
    }
    return shape;
}

std::string obj(const Shape& shape) {
    std::string text = "# made by a test\n";
    for (const auto& p : shape.points) {
        text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    }
    for (const auto& face : shape.faces) {
        text += "f";
        for (const unsigned corner : face) text += " " + std::to_string(corner + 1) + "/1/1";
        text += "\n";
    }
    return text;
}

std::string off(const Shape& shape) {
    std::string text =
        "OFF\n# counts\n" + std::to_string(shape.points.size()) + " " + std::to_string(shape.faces.size()) + " 0\n";
    for (const auto& p : shape.points) {
        text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    }
    for (const auto& face : shape.faces) {
        text += std::to_string(face.size());
        for (const unsigned corner : face) text += " " + std::to_string(corner);
        text += "\n";
    }
    return text;
}

template <typename T>
std::string bytes(T value, bool big_endian = false) {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    return big_endian ? std::string(text.rbegin(), text.rend()) : text;
}

std::string ascii_stl(const Shape& shape) {
    std::string text = "solid test\n";
    for (const auto& face : shape.faces) {
        text += " facet normal 0 0 0\n  outer loop\n";
        for (const unsigned corner : face) {
            const auto& p = shape.points[corner];
            text +=
                "   vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
        }
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid test\n";
}

// Begins with "solid", as some programs write it.
std::string binary_stl(const Shape& shape) {
    std::string text = "solid but binary";
    text.resize(80, ' ');
    text += bytes(static_cast<std::uint32_t>(shape.faces.size()));
    for (const auto& face : shape.faces) {
        text.append(12, '\0');
        for (const unsigned corner : face) {
            for (const double value : shape.points[corner]) text += bytes(static_cast<float>(value));
        }
        text.append(2, '\0');
    }
    return text;
}

template <typename Real>
std::string binary_ply(const Shape& shape, bool big_endian) {
    std::string text =
        std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\ncomment test\n";
    text += "element vertex " + std::to_string(shape.points.size()) + "\n";
    for (const char* axis : {"x", "y", "z"}) {
        text += std::string("property ") + (sizeof(Real) == 4 ? "float " : "double ") + axis + "\n";
    }
    text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    text +=
        "element face " + std::to_string(shape.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& p : shape.points) {
        for (const double value : p) text += bytes(static_cast<Real>(value), big_endian);
        text += "\x10\x20\x30";
    }
    for (const auto& face : shape.faces) {
        text += static_cast<char>(face.size());
        for (const unsigned corner : face) text += bytes(static_cast<std::int32_t>(corner), big_endian);
    }
    return text;
}

std::string ascii_ply(const Shape& shape) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(shape.points.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                       std::to_string(shape.faces.size()) + "\nproperty list uchar uint vertex_index\nend_header\n";
    for (const auto& p : shape.points) {
        text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    }
    const std::string faces = off(shape);
    std::size_t at = faces.size();
    for (std::size_t i = 0; i <= shape.faces.size(); ++i) at = faces.rfind('\n', at - 1);
    return text + faces.substr(at + 1);
}

class MeshAudit : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "burin-audit-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    struct Run {
        int status = -1;
        std::string output;  // of both streams
    };

    static Run run(const std::string& command) {
        Run result;
        FILE* pipe = popen((command + " 2>&1 </dev/null").c_str(), "r");
        if (pipe == nullptr) return result;
        std::array<char, 4096> part{};
        while (fgets(part.data(), part.size(), pipe) != nullptr) result.output += part.data();
        const int status = pclose(pipe);
        result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return result;
    }

    [[nodiscard]] std::string written(const std::string& name, const std::string& content) const {
        const std::string path = (folder_ / name).string();
        std::ofstream(path, std::ios::binary) << content;
        return path;
    }

    [[nodiscard]] Run audit(const std::string& name, const std::string& content) const {
        return run(std::string("'") + burin::kMeshAudit + "' --json '" + written(name, content) + "'");
    }

    // Each named figure has the given value, and the exit status is as said.
    void expect(const std::string& name, const std::string& content, int status,
                const std::map<std::string, double>& figures) const {
        const Run result = audit(name, content);
        EXPECT_EQ(result.status, status) << result.output;
        const auto json = nlohmann::json::parse(result.output, nullptr, false);
        ASSERT_FALSE(json.is_discarded()) << result.output;
        for (const auto& [figure, value] : figures) {
            ASSERT_TRUE(json.contains(figure) && json[figure].is_number()) << figure << " in " << result.output;
            EXPECT_NEAR(json[figure].get<double>(), value, 1e-6 * std::abs(value)) << figure << " of " << name;
        }
    }

    fs::path folder_;
};

TEST_F(MeshAudit, JudgesTheSameCubeAlikeInEveryFormat) {
    const Shape cube = unit_cube(3, -2, 5);
    const std::map<std::string, double> sound = {{"vertices", 8},
                                                 {"unused_vertices", 0},
                                                 {"triangles", 12},
                                                 {"edges", 18},
                                                 {"open_edges", 0},
                                                 {"nonmanifold_edges", 0},
                                                 {"misoriented_edges", 0},
                                                 {"nonmanifold_vertices", 0},
                                                 {"repeated_corners", 0},
                                                 {"components", 1},
                                                 {"euler_characteristic", 2},
                                                 {"genus", 0},
                                                 {"volume", 1},
                                                 {"area", 6},
                                                 {"zero_area_triangles", 0}};
    expect("cube.obj", obj(cube), 0, sound);
    expect("cube.off", off(cube), 0, sound);
    expect("cube.STL", ascii_stl(cube), 0, sound);
    expect("binary.stl", binary_stl(cube), 0, sound);
    expect("cube.ply", ascii_ply(cube), 0, sound);
    expect("little.ply", binary_ply<float>(cube, false), 0, sound);
    expect("double.ply", binary_ply<double>(cube, false), 0, sound);
    expect("big.ply", binary_ply<float>(cube, true), 0, sound);
}

TEST_F(MeshAudit, SplitsPolygonsAndUnderstandsRelativeIndices) {
    Shape cube = unit_cube();
    cube.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    expect("quads.obj", obj(cube), 0, {{"triangles", 12}, {"volume", 1}});
    expect("quads.ply", binary_ply<float>(cube, false), 0, {{"triangles", 12}, {"volume", 1}});
    expect("relative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -2 -4 -1\n", 0,
           {{"volume", 1.0 / 6}});
}

TEST_F(MeshAudit, FindsTheGenusAndTheComponents) {
    expect("torus.obj", obj(torus(40, 20)), 0, {{"genus", 1}, {"euler_characteristic", 0}, {"components", 1}});
    expect("two.obj", obj(both(unit_cube(), torus(40, 20))), 0, {{"genus", 1}, {"components", 2}});
}

TEST_F(MeshAudit, MeasuresATorusCloseToItsClosedForm) {
    const Run result = audit("torus.stl", binary_stl(torus(400, 200)));
    const auto json = nlohmann::json::parse(result.output, nullptr, false);
    ASSERT_FALSE(json.is_discarded()) << result.output;
    // V = 2 pi^2 R r^2, A = 4 pi^2 R r; 400 by 200 flat pieces fall short of either by about (pi / 200)^2.
    EXPECT_NEAR(json["volume"].get<double>(), 2 * M_PI * M_PI * 2, 39.5 * 4e-4);
    EXPECT_NEAR(json["area"].get<double>(), 4 * M_PI * M_PI * 2, 79 * 4e-4);
}

TEST_F(MeshAudit, SeesTheBoundingBox) {
    const auto json = nlohmann::json::parse(audit("cube.obj", obj(unit_cube(3, -2, 5))).output, nullptr, false);
    ASSERT_FALSE(json.is_discarded());
    EXPECT_EQ(json["box_lo"], nlohmann::json({3.0, -2.0, 5.0}));
    EXPECT_EQ(json["box_hi"], nlohmann::json({4.0, -1.0, 6.0}));
}

TEST_F(MeshAudit, SeesAHole) {
    Shape cube = unit_cube();
    cube.faces.pop_back();
    expect("hole.obj", obj(cube), 1, {{"open_edges", 3}, {"nonmanifold_edges", 0}, {"misoriented_edges", 0}});
}

TEST_F(MeshAudit, SeesACrackOfOneBitInAnStl) {
    Shape cube = unit_cube();
    cube.points.push_back(cube.points[7]);
    cube.points.back()[0] = std::nextafterf(1.0f, 2.0f);
    for (unsigned& corner : cube.faces.back()) corner = corner == 7 ? 8 : corner;
    expect("crack.stl", binary_stl(cube), 1, {{"vertices", 9}, {"open_edges", 4}});
}

TEST_F(MeshAudit, SeesATriangleTurnedRound) {
    Shape cube = unit_cube();
    std::swap(cube.faces[4][0], cube.faces[4][1]);
    expect("turned.obj", obj(cube), 1, {{"misoriented_edges", 3}, {"open_edges", 0}, {"nonmanifold_edges", 0}});
}

TEST_F(MeshAudit, SeesAnInsideOutMeshByItsVolume) {
    Shape cube = unit_cube();
    for (auto& face : cube.faces) std::swap(face[0], face[1]);
    expect("inside_out.obj", obj(cube), 0, {{"misoriented_edges", 0}, {"volume", -1}});
}

TEST_F(MeshAudit, SeesAnEdgeWithFourTriangles) {
    // Two cubes side by side along a diagonal share one edge when their corners are welded.
    expect("edge.stl", binary_stl(both(unit_cube(), unit_cube(1, 1, 0))), 1,
           {{"nonmanifold_edges", 1}, {"nonmanifold_vertices", 2}, {"open_edges", 0}});
}

TEST_F(MeshAudit, SeesATriangleThatIsThereTwice) {
    Shape cube = unit_cube();
    cube.faces.push_back(cube.faces.front());
    expect("twice.obj", obj(cube), 1, {{"nonmanifold_edges", 3}});
}

TEST_F(MeshAudit, SeesTwoSolidsThatTouchAtAVertex) {
    expect("vertex.stl", binary_stl(both(unit_cube(), unit_cube(1, 1, 1))), 0,
           {{"nonmanifold_vertices", 1}, {"nonmanifold_edges", 0}, {"components", 2}});
}

TEST_F(MeshAudit, SeesDegenerateTriangles) {
    Shape cube = unit_cube();
    cube.faces.push_back({0, 0, 1});
    expect("repeated.obj", obj(cube), 0, {{"repeated_corners", 1}, {"open_edges", 0}, {"euler_characteristic", 2}});
    Shape flat = unit_cube();
    // Splitting an edge at its middle and closing the gap with a triangle on a line keeps the mesh closed.
    flat.points.push_back({0.5, 0, 0});
    flat.faces[1] = {0, 3, 8};
    flat.faces.push_back({8, 3, 1});
    flat.faces.push_back({0, 8, 1});
    expect("flat.obj", obj(flat), 0, {{"zero_area_triangles", 1}, {"open_edges", 0}, {"volume", 1}});
}

TEST_F(MeshAudit, SeesCoordinatesThatAreNoNumbers) {
    Shape cube = unit_cube();
    cube.points[7][1] = std::nan("");
    expect("nan.ply", binary_ply<float>(cube, false), 1, {{"nonfinite_vertices", 1}, {"open_edges", 0}});
}

TEST_F(MeshAudit, SeesUnusedVertices) {
    Shape cube = unit_cube();
    cube.points.push_back({9, 9, 9});
    expect("unused.obj", obj(cube), 0, {{"vertices", 8}, {"unused_vertices", 1}, {"euler_characteristic", 2}});
}

TEST_F(MeshAudit, RefusesWhatItCannotReadWithStatusTwoAndOneLine) {
    const Shape cube = unit_cube();
    std::string claims_more = binary_stl(cube);
    claims_more[83] = '\x7f';
    std::string huge_ply = ascii_ply(cube);
    huge_ply.replace(huge_ply.find("vertex 8"), 8, "vertex 4000000000000000");
    const std::map<std::string, std::string> bad = {
        {"empty.stl", ""},
        {"short.stl", binary_stl(cube).substr(0, 300)},
        {"claims.stl", claims_more},
        {"huge.ply", huge_ply},
        {"none.obj", "v 0 0 0\n"},
        {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"},
        {"number.obj", "v 0 zero 0\n"},
        {"truncated.ply", binary_ply<float>(cube, false).substr(0, 300)},
        {"header.ply", "ply\nformat ascii 1.0\n"},
        {"huge.off", "OFF\n4000000000 4000000000 0\n0 0 0\n"},
        {"loop.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nendloop\n"},
        {"mesh.xyz", "0 0 0\n"},
    };
    for (const auto& [name, content] : bad) {
        const Run result = audit(name, content);
        EXPECT_EQ(result.status, 2) << name << ": " << result.output;
        EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
        EXPECT_TRUE(result.output.contains(name)) << result.output;
    }
    EXPECT_EQ(run(std::string("'") + burin::kMeshAudit + "' '" + folder_.string() + "'").status, 2);
    EXPECT_EQ(run(std::string("'") + burin::kMeshAudit + "'").status, 2);
}

// The number behind a label in admesh's report, e.g. "Number of parts : 2"; -1 when it is not there.
double admesh_figure(const std::string& report, const std::string& label) {
    const std::size_t at = report.find(label);
    const std::size_t colon = at == std::string::npos ? at : report.find(':', at);
    return colon == std::string::npos ? -1 : std::strtod(report.c_str() + colon + 1, nullptr);
}

TEST_F(MeshAudit, AgreesWithAdmesh) {
    if (run("command -v admesh").status != 0)
        GTEST_SKIP() << "admesh is not installed (scripts/setup --dev installs it)";
    Shape open = torus(40, 20);
    open.faces.pop_back();
    const std::map<std::string, Shape> shapes = {
        {"torus.stl", torus(40, 20)}, {"open.stl", open}, {"two.stl", both(unit_cube(), unit_cube(3, 0, 0))}};
    for (const auto& [name, shape] : shapes) {
        const auto json = nlohmann::json::parse(audit(name, binary_stl(shape)).output, nullptr, false);
        ASSERT_FALSE(json.is_discarded());
        // Exact matching only, nothing repaired; it counts parts and volume by the directions and values of normals.
        const std::string report =
            run("admesh --exact --normal-directions --normal-values '" + (folder_ / name).string() + "'").output;
        EXPECT_EQ(admesh_figure(report, "Number of facets"), json["triangles"].get<double>()) << report;
        EXPECT_EQ(admesh_figure(report, "Number of parts"), json["components"].get<double>()) << report;
        if (json["open_edges"] == 0) {  // an open mesh has no volume, and the two define theirs differently
            EXPECT_NEAR(admesh_figure(report, "Volume"), json["volume"].get<double>(), 1e-4) << report;  // floats
        }
        EXPECT_EQ(admesh_figure(report, "Facets with 1 disconnected edge") +
                      2 * admesh_figure(report, "Facets with 2 disconnected edges") +
                      3 * admesh_figure(report, "Facets with 3 disconnected edges"),
                  json["open_edges"].get<double>())
            << report;
    }
}

}  // namespace
