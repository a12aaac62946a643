// SPDX-License-Identifier: MIT
// Writes a triangle mesh as STL (binary), PLY (binary, little endian) or OBJ, chosen by the extension.
//
// What each format keeps: STL the shape in float; PLY the shape in float, a colour for each vertex and, where triangles
// have materials, for each face; OBJ the shape in double and vertex colours as v x y z r g b. A vertex's colour is
// mesh.colours where given, else that of the material of its first triangle.
// Numbers are in the unit asked for, which the file states in a comment that import_mesh reads: "UNITS=mm" in the
// header of an STL, "units mm" in PLY and OBJ. In OBJ metres are kept to the last bit, and so are numbers that were
// read from a file in the same unit; others to within two units in the last place.
// The frame is the object frame. The same mesh gives the same bytes. The file appears whole or not at all, see
// write_file_atomically. Failure: an Error with the path and the remedy; an existing file is then unchanged. Cost: the
// file in memory once. Any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "base/error.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

// Writes the mesh to a file. Refuses meshes without triangles, indices out of range, coordinates that are not finite
// (in float, for STL and PLY), and OFF.
[[nodiscard]] Result<void> export_mesh(const TriangleMesh& mesh, const std::filesystem::path& path,
                                       LengthUnit unit = LengthUnit::m);

// Encodes the file in memory; `name` stands for it in messages.
[[nodiscard]] Result<std::vector<std::byte>> encode_mesh(const TriangleMesh& mesh, MeshFormat format,
                                                         const std::string& name, LengthUnit unit = LengthUnit::m);

}  // namespace burin::geometry
