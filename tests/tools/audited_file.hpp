// SPDX-License-Identifier: MIT
// A mesh file as mesh_audit sees it: points and triangles, nothing repaired. Standard library only, and nothing of
// Burin's, so that a mistake there cannot hide itself here.
//
// Formats: STL (binary and ASCII), PLY (ASCII, binary little and big endian; any scalar types), OBJ, OFF.
// Faces with more than three corners are split as a fan from their first corner. STL corners are welded where all three
// coordinates have the same bits; the other formats keep the indices of the file.
// Units: whatever the file holds. Memory: proportional to the file, never to a count that the file claims. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mesh_audit {

struct Point {
    double x = 0, y = 0, z = 0;
};

using Triangle = std::array<std::uint32_t, 3>;  // indices into points, in the order of the file

struct Mesh {
    std::string format;  // "binary STL", "ASCII PLY", ...
    std::vector<Point> points;
    std::vector<Triangle> triangles;
};

struct Failure {
    std::string message;  // one line without the file's name; empty means success
};

struct Reading {
    Mesh mesh;
    Failure failure;
};

[[nodiscard]] Reading read_mesh(const std::string& path);

// The parsers behind it, each for the whole content of a file.
[[nodiscard]] Reading read_binary_stl(std::string_view content);
[[nodiscard]] Reading read_ply(std::string_view content);
[[nodiscard]] Reading read_ascii_stl(std::string_view content);
[[nodiscard]] Reading read_obj(std::string_view content);
[[nodiscard]] Reading read_off(std::string_view content);

// Appends the fan of one face; false when an index is outside the points.
[[nodiscard]] bool append_face(Mesh& mesh, const std::vector<std::uint64_t>& corners);

// Replaces a triangle soup (three points each) by indexed triangles; points are one where their bits are.
void weld_by_bits(Mesh& mesh);

}  // namespace mesh_audit
