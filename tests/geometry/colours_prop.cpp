// SPDX-License-Identifier: MIT
// What a surface shows at any of its points it shows in every file that is written of it: colours of faces, of vertices
// and of corners, through OBJ and PLY, one after another. OpenMesh, which shares no code with ours, sees the same.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <algorithm>

#include "geometry/files/mesh_export.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

using Corners = std::vector<TriangleColours>;

// The colours of all corners, straight from the parts of a mesh: of the vertices, or else of the materials.
Corners shown(const ImportedMesh& read) {
    if (!read.corner_colours.empty()) return read.corner_colours;
    Corners corners;
    for (std::size_t t = 0; t < read.mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = read.mesh.triangles[t];
        if (!read.mesh.colours.empty()) {
            corners.push_back({read.mesh.colours.at(a), read.mesh.colours.at(b), read.mesh.colours.at(c)});
        } else {
            const Colour colour = read.mesh.materials.at(read.mesh.triangle_materials.at(t)).colour;
            corners.push_back({colour, colour, colour});
        }
    }
    return corners;
}

Colour arbitrary_colour() {
    Colour colour{};
    for (auto& channel : colour) channel = *rc::gen::arbitrary<std::uint8_t>();
    return colour;
}

// A closed torus that wears colours of one kind.
ImportedMesh coloured_torus() {
    ImportedMesh made;
    made.mesh = torus(*rc::gen::inRange<std::size_t>(3, 14), *rc::gen::inRange<std::size_t>(3, 14), 1.0, 0.25);
    std::vector<Colour> palette;
    const int colours = *rc::gen::inRange(1, 9);
    for (int i = 0; i < colours; ++i) palette.push_back(arbitrary_colour());
    const auto any = [&] { return palette[*rc::gen::inRange<std::size_t>(0, palette.size())]; };
    switch (*rc::gen::inRange(0, 3)) {
        case 0:
            for (std::size_t v = 0; v < made.mesh.positions_m.size(); ++v) made.mesh.colours.push_back(any());
            break;
        case 1:
            for (const Colour& colour : palette) made.mesh.materials.push_back({"", colour});
            for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t)
                made.mesh.triangle_materials.push_back(
                    *rc::gen::inRange<std::uint8_t>(0, static_cast<std::uint8_t>(palette.size())));
            break;
        default:  // more colours of faces than there can be materials
            for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
                const Colour colour = arbitrary_colour();
                made.corner_colours.push_back({colour, colour, colour});
            }
    }
    return made;
}

ImportedMesh through_file(const ImportedMesh& mesh, MeshFormat format, LengthUnit unit) {
    const auto files = encode_mesh(mesh.mesh, format, "in a folder/test.obj", unit, mesh.corner_colours);
    if (!files) RC_FAIL(files.error().line());
    auto read = import_mesh(files->mesh, format, "test.obj", [&](std::string_view name) -> Result<std::string> {
        RC_ASSERT(name == "test.mtl");
        return files->materials;
    });
    if (!read) RC_FAIL(read.error().line());
    return std::move(*read);
}

std::string numbers_of(const Colour& colour) {
    return " " + std::to_string(colour[0]) + " " + std::to_string(colour[1]) + " " + std::to_string(colour[2]);
}

// Writes the mesh as a text that this program does not write: an ASCII PLY or an OFF.
std::string text_of_colours(const ImportedMesh& mesh, MeshFormat format) {
    const bool is_ply = format == MeshFormat::ply, of_vertices = !mesh.mesh.colours.empty();
    const std::string colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const std::string vertices = std::to_string(mesh.mesh.positions_m.size());
    const std::string faces = std::to_string(mesh.mesh.triangles.size());
    std::string text = is_ply ? "ply\nformat ascii 1.0\nelement vertex " + vertices +
                                    "\nproperty double x\nproperty double y\nproperty double z\n" +
                                    (of_vertices ? colours : "") + "element face " + faces +
                                    "\nproperty list uchar int vertex_indices\n" + (of_vertices ? "" : colours) +
                                    "end_header\n"
                              : std::string(of_vertices ? "C" : "") + "OFF\n" + vertices + " " + faces + " 0\n";
    for (std::size_t v = 0; v < mesh.mesh.positions_m.size(); ++v) {
        for (int k = 0; k < 3; ++k) text += std::to_string(mesh.mesh.positions_m[v][k]) + " ";
        text += (of_vertices ? numbers_of(mesh.mesh.colours[v]) : "") + "\n";
    }
    const Corners corners = shown(mesh);
    for (std::size_t t = 0; t < corners.size(); ++t) {
        text += "3";
        for (const std::uint32_t v : mesh.mesh.triangles[t]) text += " " + std::to_string(v);
        text += (of_vertices ? "" : numbers_of(corners[t][0])) + "\n";
    }
    return text;
}

TEST(Colours, StayAtEveryPointThroughAnyFormatsThatHoldThem) {
    EXPECT_TRUE(rc::check([] {
        ImportedMesh mesh = coloured_torus();
        const Corners before = shown(mesh);
        // An OFF whose colours are all 0 or 1 would be one of the other scale.
        const bool may_be_off = std::ranges::any_of(before, [](const TriangleColours& c) { return c[0][0] > 1; });
        const int first = *rc::gen::inRange(0, may_be_off ? 3 : 2);
        if (first > 0) {
            const MeshFormat format = first == 1 ? MeshFormat::ply : MeshFormat::off;
            auto read = import_text(text_of_colours(mesh, format), format);
            if (!read) RC_FAIL(read.error().line());
            RC_ASSERT(shown(*read) == before);
            mesh = std::move(*read);
        }
        const int steps = *rc::gen::inRange(1, 5);
        for (int i = 0; i < steps; ++i) {
            const MeshFormat format = *rc::gen::element(MeshFormat::obj, MeshFormat::ply);
            mesh = through_file(mesh, format, *rc::gen::element(LengthUnit::m, LengthUnit::mm, LengthUnit::inch));
            RC_ASSERT(shown(mesh) == before);
            RC_ASSERT(examine(mesh.mesh).closed);
        }
    }));
}

struct ColourTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};
using ColouredOpenMesh = OpenMesh::PolyMesh_ArrayKernelT<ColourTraits>;

Colour bytes_of_theirs(const ColouredOpenMesh::Color& colour) {
    return {static_cast<std::uint8_t>(colour[0]), static_cast<std::uint8_t>(colour[1]),
            static_cast<std::uint8_t>(colour[2])};
}

TEST(Colours, AreThoseThatOpenMeshReadsAndItFindsTheSurfaceClosed) {
    omerr().disable();
    const TemporaryFolder folder;
    TriangleMesh mesh = torus(6, 5, 0.1, 0.03);
    mesh.materials = {{"red", {255, 0, 0}}, {"", {0, 0, 255}}, {"sea green", {46, 139, 87}}};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        mesh.triangle_materials.push_back(static_cast<std::uint8_t>(t * 7 % 3));
    for (const char* const name : {"faces.ply", "faces.obj"}) {
        ASSERT_TRUE(export_mesh(mesh, folder.path() / name));
        ColouredOpenMesh theirs;
        theirs.request_face_colors();
        theirs.request_vertex_colors();
        OpenMesh::IO::Options options(OpenMesh::IO::Options::FaceColor | OpenMesh::IO::Options::VertexColor);
        ASSERT_TRUE(OpenMesh::IO::read_mesh(theirs, (folder.path() / name).string(), options)) << name;
        EXPECT_TRUE(options.face_has_color()) << name;
        EXPECT_FALSE(options.vertex_has_color()) << name << ": nobody can show these in their place";
        ASSERT_EQ(theirs.n_faces(), mesh.triangles.size());
        for (const auto f : theirs.faces()) {
            const std::size_t material = mesh.triangle_materials[static_cast<std::size_t>(f.idx())];
            const Colour colour = bytes_of_theirs(theirs.color(f));
            for (std::size_t c = 0; c < 3; ++c)  // it cuts floats off
                EXPECT_NEAR(colour[c], mesh.materials[material].colour[c], 1) << name;
            EXPECT_FALSE(theirs.is_boundary(f)) << name;
        }
    }
}

// Points at which the mean of three corners would be a colour that the surface has nowhere.
TEST(Colours, OfAPictureThatAFileCannotHoldAreTheMeanOfEachFace) {
    TriangleMesh mesh = tetrahedron();
    Corners corners(4, {Colour{255, 0, 0}, Colour{255, 0, 0}, Colour{255, 0, 0}});
    corners[2] = {Colour{0, 0, 0}, Colour{90, 0, 30}, Colour{0, 60, 30}};
    const FileColours colours = file_colours(mesh, corners);
    EXPECT_TRUE(colours.flattened);
    EXPECT_TRUE(colours.of_vertices.empty());
    EXPECT_EQ(colours.of_faces[0], (Colour{255, 0, 0}));
    EXPECT_EQ(colours.of_faces[2], (Colour{30, 20, 20}));
}

TEST(Colours, OfVerticesAtOnePlaceGoToTheFacesBeforeTheyBecomeOne) {
    TriangleMesh mesh;
    mesh.positions_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    mesh.materials = {{"", {255, 0, 0}}, {"", {0, 0, 255}}};
    mesh.triangle_materials = {0, 1};
    const Colour red{255, 0, 0}, blue{0, 0, 255};
    mesh.colours = {red, red, red, red, red, red};
    EXPECT_FALSE(keep_colours_of_faces_at_seams(mesh));
    EXPECT_EQ(mesh.colours.size(), 6u) << "they do not differ";
    mesh.colours = {red, red, red, blue, blue, blue};
    EXPECT_FALSE(keep_colours_of_faces_at_seams(mesh)) << "no face loses a colour";
    EXPECT_TRUE(mesh.colours.empty());
    mesh.colours = {red, red, blue, blue, blue, blue};
    EXPECT_TRUE(keep_colours_of_faces_at_seams(mesh));
}

}  // namespace
}  // namespace burin::geometry::test
