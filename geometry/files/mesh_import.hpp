// SPDX-License-Identifier: MIT
// Reads a triangle mesh from STL (ASCII, binary), OBJ (with MTL), PLY (ASCII, binary of both byte orders) or OFF
// (ASCII).
//
// Guarantee: every face of the file is in the mesh, as it stands in the file, or counted in the report. Nothing is
// merged, dropped, repaired or flipped here; that is for mesh_health.hpp and mesh_repair.hpp, on request. There are two
// exceptions: STL has no shared vertices, so equal positions become one vertex (bit for bit; -0 equals 0); and a vertex
// that no mesh can have is left out, with a remark, where no face names it.
//
// Units and frame: the mesh is in metres, as doubles, in the object frame. Which unit the file's numbers are in says
// mesh_unit.hpp; the report says which it was and why. Every coordinate is finite and at most kMaxCoordinate.
// Faces wind counter-clockwise seen from outside where the file keeps to that.
// Failure: an Error with the file, the line (text) or byte (binary), and the remedy. Memory is bounded by a small
// multiple of the file's size: a count in a header is compared with the bytes that follow before anything is allocated.
// Cost: linear in the file; a binary STL of a million triangles takes a fraction of a second. Any thread; no locale.
//
// Why our own readers and not OpenMesh's: handed a BaseImporter that takes faces raw, OpenMesh 9 still
//   OBJ: skips a vertex that it cannot parse (so that all later indices name other vertices), drops faces with a
//        repeated index, rounds positions to float, passes indices out of range;
//   OFF: repeats the last face when the file is cut short, reads "nan" as 0, passes uninitialised vertex handles for a
//        face that claims many corners;
//   PLY: believes the header's and each face's counts, passes empty faces when the text is malformed, rounds to float;
//   STL: drops triangles with two equal corners, reads "nan" as 0;
// and none of them can say in which line. The tests use OpenMesh as the independent reader instead.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "geometry/files/mesh_unit.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

inline constexpr double kMaxCoordinate = 1e9;  // keeps areas and volumes far from overflow
// That of a mesh that is brought to its middle; there a double still has an eighth.
inline constexpr double kFarthestCoordinate = 1e15;
// A material is one byte; two values stay free for the solid's own use.
inline constexpr std::size_t kMaxMaterials = 254;

enum class MeshFormat : std::uint8_t { stl, obj, ply, off };

// What the reader did: it does nothing that is not reported here.
struct ImportReport {
    std::string format;                    // e.g. "PLY, binary little endian"
    std::uint64_t faces_in_file = 0;       // = triangles_in_file + polygons_in_file + faces_without_area
    std::uint64_t triangles_in_file = 0;   // taken unchanged
    std::uint64_t polygons_in_file = 0;    // of n > 3 corners, split into n - 2 triangles each (polygon.hpp):
    std::uint64_t polygons_fanned = 0;     //   convex ones, as a fan from their first corner
    std::uint64_t polygons_swept = 0;      //   other simple ones: their triangles cover them once
    std::uint64_t polygons_touching = 0;   //   that touch themselves: likewise
    std::uint64_t polygons_crossing = 0;   //   that cross themselves or have no area: triangles may overlap
    std::uint64_t faces_without_area = 0;  // of fewer than 3 corners: not in the mesh
    std::uint64_t vertices_in_file = 0;
    std::uint64_t vertices_merged = 0;   // STL corners that met at an equal position
    std::uint64_t materials_merged = 0;  // number of materials removed by merging down to kMaxMaterials
    std::vector<std::string> remarks;    // one line each, for the user: what was ignored or assumed
    std::vector<std::string> pictures;   // that faces wear: by these a face may have several colours
    // Distance up to which corners at open edges are one corner that was rounded in two ways (join_open_edges). It
    // follows from how many digits the file's numbers have; 0 where there are too few to tell.
    double weld_tolerance_m = 0.0;
    FileUnit unit;     // of the file's numbers
    Vec3 size_m{0.0};  // of the box around all triangles; describe_size() says both in a line
};

// Where the mesh's frame has its origin: where the file's has it, or in the middle of the box around all triangles. The
// latter moves the file's own numbers, before they are metres, and takes those of up to kFarthestCoordinate.
enum class MeshOrigin : std::uint8_t { of_file, middle };

struct ImportedMesh {
    TriangleMesh mesh;
    ImportReport report;
    // The colours of each triangle's corners, where the file names pictures, of which the triangle's material has the
    // mean, or has more colours of faces than there can be materials. Empty: those of the mesh are all that it has.
    std::vector<std::array<std::array<std::uint8_t, 3>, 3>> corner_colours = {};
};

// Reads the file, whose format follows from the extension (any case). Reads an OBJ's MTL files from the OBJ's folder; a
// missing one is a remark; so is a picture that a material (map_Kd) or a PLY (comment TextureFile) names, which must
// lie in the mesh's folder or below it. Names may differ from the files' in capitals.
// The unit is found out where none is given.
[[nodiscard]] Result<ImportedMesh> import_mesh(const std::filesystem::path& path,
                                               std::optional<LengthUnit> given_unit = std::nullopt,
                                               MeshOrigin origin = MeshOrigin::of_file);

// Returns the text of a material file named by an OBJ, or the bytes of a picture named by that or by a PLY.
using MaterialFileReader = std::function<Result<std::string>(std::string_view name)>;

// Reads a mesh from memory; `name` stands for the file in messages. Without readers, OBJ materials are plain grey,
// and pictures are left out.
[[nodiscard]] Result<ImportedMesh> import_mesh(std::span<const std::byte> bytes, MeshFormat format,
                                               const std::string& name, const MaterialFileReader& material_files = {},
                                               std::optional<LengthUnit> given_unit = std::nullopt,
                                               const MaterialFileReader& pictures = {},
                                               MeshOrigin origin = MeshOrigin::of_file);

// Returns the format that an extension stands for (".stl", any case), if any.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path);

}  // namespace burin::geometry
