// SPDX-License-Identifier: MIT
// Writes a triangle mesh as STL (binary), PLY (binary, little endian) or OBJ, chosen by the extension.
//
// What each format keeps: STL the shape in float; PLY the shape in float, and colours of vertices or of faces; OBJ the
// shape in double, and colours of vertices as v x y z r g b or of faces as materials (usemtl), whose Kd stand in a file
// beside it, NAME.mtl. Which of the two says surface_colours.hpp; a mesh without colours has neither.
// Numbers are in the unit asked for, which the file states in a comment that import_mesh reads: "UNITS=mm" in the
// header of an STL, "units mm" in PLY and OBJ. In OBJ metres are kept to the last bit, and so are numbers that were
// read from a file in the same unit; others to within two units in the last place.
// Scaling and rounding can change a mesh: vertices fall together, triangles turn over and pass through each other. So a
// mesh is made of the numbers that the file will hold, is checked and repaired as such, and is then written as it is.
// The frame is the object frame. The same mesh gives the same bytes. The file appears whole or not at all, see
// write_file_atomically. Failure: an Error with the path and the remedy; an existing file is then unchanged. Cost: the
// file in memory once. Any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/surface_colours.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

// A mesh whose positions are the numbers of a file: in its unit, and floats where the format has floats.
struct FileNumbers {
    TriangleMesh mesh;
    bool is_rounded = false;       // a number is not the mesh's own
    std::size_t without_area = 0;  // triangles with corners that differed and became equal by rounding
    std::size_t steps_apart = 0;   // single steps of a float by which vertices were moved apart again
};
// Returns the mesh as the format holds it. Positions that differ stay different (distinct_positions.hpp), equal ones
// stay equal. Requires finite coordinates, in float too for STL and PLY.
[[nodiscard]] FileNumbers numbers_of_file(const TriangleMesh& mesh_m, MeshFormat format, LengthUnit unit);

// Files in memory.
struct MeshFiles {
    std::vector<std::byte> mesh;
    std::string materials;  // of the file beside an OBJ whose faces have colours; empty: there is none
};

// Returns the file beside an OBJ that has its materials: NAME.mtl.
[[nodiscard]] std::filesystem::path material_file_of(const std::filesystem::path& obj);

// Writes a mesh of numbers of the file, in the unit that the file states, and of an OBJ first its materials. `corners`
// are the colours where there are as many as triangles. Refuses as export_mesh does.
[[nodiscard]] Result<void> export_numbers(const TriangleMesh& numbers, const std::filesystem::path& path,
                                          LengthUnit unit, std::span<const TriangleColours> corners = {});

// Writes the numbers of a mesh in metres to a file. Refuses meshes without triangles, indices out of range, coordinates
// that are not finite (in float, for STL and PLY), and OFF.
[[nodiscard]] Result<void> export_mesh(const TriangleMesh& mesh, const std::filesystem::path& path,
                                       LengthUnit unit = LengthUnit::m);

// Encodes the files in memory; `name` stands for the mesh's in messages, and names its materials.
[[nodiscard]] Result<MeshFiles> encode_mesh(const TriangleMesh& mesh, MeshFormat format, const std::string& name,
                                            LengthUnit unit = LengthUnit::m,
                                            std::span<const TriangleColours> corners = {});

}  // namespace burin::geometry
