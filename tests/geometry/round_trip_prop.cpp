// SPDX-License-Identifier: MIT
// What is written comes back, in every format; and OpenMesh, which shares no code with ours, reads the same.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <cmath>

#include "geometry/files/mesh_export.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

// Any triangles over any vertices: holes, fans, repeats and all. Coordinates of every magnitude that a float holds.
TriangleMesh arbitrary_mesh(bool with_materials) {
    TriangleMesh mesh;
    const auto coordinate = rc::gen::map(rc::gen::pair(rc::gen::inRange(-1000000, 1000001), rc::gen::inRange(-30, 3)),
                                         [](std::pair<int, int> v) { return v.first * std::pow(10.0, v.second); });
    const auto vertices = *rc::gen::resize(40, rc::gen::nonEmpty(rc::gen::container<std::vector<std::array<double, 3>>>(
                                                   rc::gen::container<std::array<double, 3>>(coordinate))));
    for (const auto& v : vertices) mesh.positions_m.emplace_back(v[0], v[1], v[2]);
    const auto index = rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(vertices.size()));
    mesh.triangles = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::array<std::uint32_t, 3>>>(
        rc::gen::container<std::array<std::uint32_t, 3>>(index)));
    if (with_materials) {
        mesh.materials = {{"", {255, 0, 7}}, {"", {1, 2, 3}}, {"", {0, 0, 0}}};
        mesh.triangle_materials =
            *rc::gen::container<std::vector<std::uint8_t>>(mesh.triangles.size(), rc::gen::inRange<std::uint8_t>(0, 3));
    }
    return mesh;
}

TriangleMesh written_and_read(const TriangleMesh& mesh, MeshFormat format) {
    const auto files = encode_mesh(mesh, format, "test");
    if (!files) RC_FAIL(files.error().line());
    auto result = import_mesh(files->mesh, format, "test",
                              [&](std::string_view) -> Result<std::string> { return files->materials; });
    if (!result) RC_FAIL(result.error().line());
    RC_ASSERT(result->report.remarks.empty());
    RC_ASSERT(result->report.faces_in_file == mesh.triangles.size());
    return std::move(result->mesh);
}

Vec3 rounded(const Vec3& p) { return Vec3(Vec3f(p)); }

TEST(RoundTrip, ThroughObjKeepsEveryBitAndEveryTriangle) {
    EXPECT_TRUE(rc::check([] {
        const TriangleMesh mesh = arbitrary_mesh(false);
        const TriangleMesh back = written_and_read(mesh, MeshFormat::obj);
        RC_ASSERT(back.positions_m == mesh.positions_m);
        RC_ASSERT(back.triangles == mesh.triangles);
        RC_ASSERT(back.colours.empty());
    }));
}

TEST(RoundTrip, ThroughPlyKeepsFloatsTrianglesAndMaterials) {
    EXPECT_TRUE(rc::check([] {
        const TriangleMesh mesh = arbitrary_mesh(true);
        const TriangleMesh back = written_and_read(mesh, MeshFormat::ply);
        RC_ASSERT(back.triangles == mesh.triangles);
        for (std::size_t v = 0; v < mesh.positions_m.size(); ++v)
            RC_ASSERT((back.positions_m[v] == rounded(mesh.positions_m[v])));
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            RC_ASSERT(back.materials[back.triangle_materials[t]].colour ==
                      mesh.materials[mesh.triangle_materials[t]].colour);
        }
    }));
}

TEST(RoundTrip, ThroughStlKeepsTheFloatsOfEveryCorner) {
    EXPECT_TRUE(rc::check([] {
        const TriangleMesh mesh = arbitrary_mesh(false);
        const TriangleMesh back = written_and_read(mesh, MeshFormat::stl);
        RC_ASSERT(back.triangles.size() == mesh.triangles.size());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                RC_ASSERT((back.positions_m[back.triangles[t][k]] == rounded(mesh.positions_m[mesh.triangles[t][k]])));
            }
        }
    }));
}

TEST(RoundTrip, OfVertexColoursIsExactInObjAndPly) {
    EXPECT_TRUE(rc::check([] {
        TriangleMesh mesh = torus(4, 4, 1.0, 0.25);
        mesh.colours.resize(16);
        for (auto& colour : mesh.colours) {
            for (auto& channel : colour) channel = *rc::gen::arbitrary<std::uint8_t>();
        }
        RC_ASSERT((written_and_read(mesh, MeshFormat::obj).colours == mesh.colours));
        RC_ASSERT((written_and_read(mesh, MeshFormat::ply).colours == mesh.colours));
    }));
}

TEST(RoundTrip, WritesTheSameBytesForTheSameMesh) {
    EXPECT_TRUE(rc::check([] {
        const TriangleMesh mesh = arbitrary_mesh(true);
        for (const MeshFormat format : {MeshFormat::stl, MeshFormat::ply, MeshFormat::obj}) {
            const auto first = encode_mesh(mesh, format, "a"), second = encode_mesh(TriangleMesh(mesh), format, "a");
            RC_ASSERT(first && second && first->mesh == second->mesh && first->materials == second->materials);
        }
    }));
}

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};
using OpenMeshMesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

TEST(RoundTrip, ReadsAsOpenMeshDoesOnSoundMeshes) {
    omerr().disable();
    const TemporaryFolder folder;
    TriangleMesh mesh = torus(20, 12, 0.1, 0.03);
    mesh.colours.assign(mesh.positions_m.size(), {10, 200, 30});
    for (const char* name : {"torus.stl", "torus.ply", "torus.obj"}) {
        const auto path = folder.path() / name;
        ASSERT_TRUE(export_mesh(mesh, path));
        const auto ours = import_mesh(path);
        ASSERT_TRUE(ours) << ours.error().line();
        OpenMeshMesh theirs;
        theirs.request_vertex_colors();
        OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexColor);
        ASSERT_TRUE(OpenMesh::IO::read_mesh(theirs, path.string(), options)) << name;
        ASSERT_EQ(theirs.n_vertices(), ours->mesh.positions_m.size());
        ASSERT_EQ(theirs.n_faces(), ours->mesh.triangles.size());
        for (const auto v : theirs.vertices()) {
            const auto& p = theirs.point(v);
            const Vec3& q = ours->mesh.positions_m[static_cast<std::size_t>(v.idx())];
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(p[static_cast<std::size_t>(k)], q[k], 1e-8);  // it reads floats: 0.13 * 2^-24
        }
        for (const auto f : theirs.faces()) {
            std::size_t k = 0;
            for (const auto v : theirs.fv_range(f)) {
                EXPECT_EQ(static_cast<std::uint32_t>(v.idx()),
                          ours->mesh.triangles[static_cast<std::size_t>(f.idx())][k++]);
            }
            EXPECT_FALSE(theirs.is_boundary(f));
        }
    }
}

TEST(MeshExport, RefusesWhatAFormatCannotHoldAndTouchesNothing) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.stl", "precious");
    TriangleMesh broken = tetrahedron();
    broken.positions_m[1].x = 1e39;  // beyond a float
    EXPECT_FALSE(export_mesh(broken, path));
    EXPECT_TRUE(encode_mesh(broken, MeshFormat::obj, "a.obj"));
    broken.positions_m[1].x = std::nan("");
    EXPECT_FALSE(encode_mesh(broken, MeshFormat::obj, "a.obj"));
    broken = tetrahedron();
    broken.triangles[0][0] = 4;
    EXPECT_FALSE(export_mesh(broken, path));
    EXPECT_FALSE(export_mesh({}, path));
    EXPECT_FALSE(export_mesh(tetrahedron(), folder.path() / "a.off"));
    EXPECT_FALSE(export_mesh(tetrahedron(), folder.path() / "a"));
    EXPECT_EQ(text_of_file(path), "precious");
    EXPECT_EQ(folder.entries(), 1u);
}

}  // namespace
}  // namespace burin::geometry::test
