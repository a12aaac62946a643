// SPDX-License-Identifier: MIT
// The common part of the file readers of mesh_import.cpp: faces of any number of corners as the file lists them, and
// the step that turns them into a TriangleMesh with its report. Internal to geometry/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "geometry/files/colour_scale.hpp"
#include "geometry/files/coordinate_precision.hpp"
#include "geometry/files/mesh_import.hpp"

namespace burin::geometry {

inline constexpr const char* kCoordinateRemedy = "repair the file or export it again";
inline constexpr const char* kFarRemedy =
    "bring the mesh to its origin with burin convert IN OUT --center, or repair the file";

// A vertex that no mesh can have. Where no face names it, it is left out.
struct FaultyVertex {
    std::uint32_t vertex = 0;
    std::uint64_t place = 0;  // its line, or byte
    const char* fault = "";
    const char* remedy = kCoordinateRemedy;
};

struct MeshSoup {
    std::vector<Vec3> positions;                // numbers of the file, in whichever unit
    std::optional<StatedUnit> stated_unit;      // by a comment or a header of the file
    CoordinatePrecision precision;              // of the positions
    std::string far = {};                       // where one that faces name lies beyond kMaxCoordinate first
    std::vector<Colour> colours;                // one for each vertex, or empty
    std::vector<std::uint32_t> corners;         // corners of all faces, one face after another
    std::vector<std::uint32_t> corner_counts;   // one for each face
    std::vector<std::uint32_t> face_materials;  // one for each face, index into materials; or empty
    std::vector<Colour> corner_colours;         // of pictures, one for each of the corners; or empty
    std::vector<Material> materials;            // any number
    std::vector<FaultyVertex> faulty;           // in the order of positions
    std::vector<FaultyVertex> distant;          // beyond kMaxCoordinate: faulty unless the mesh is moved
    bool has_bytes = false;                     // places are bytes, not lines
    ImportReport report;                        // the reader's part; finished() fills in the counts of faces
};

// Maps colours to materials and makes a new one for each new colour.
class ColourMaterials {
public:
    explicit ColourMaterials(std::vector<Material>& materials) : materials_(materials) {}
    std::uint32_t index_of(const Colour& colour);

private:
    std::vector<Material>& materials_;
    std::unordered_map<std::uint32_t, std::uint32_t> known_;
};

// Return "file:line" and "file, byte n".
[[nodiscard]] std::string at_line(const std::string& name, std::uint64_t line);
[[nodiscard]] std::string at_byte(const std::string& name, std::uint64_t byte);

// Describes the fault of a coordinate, a number of the file; nullptr when there is none.
[[nodiscard]] const char* coordinate_fault(double number);
// Tells whether a coordinate without a fault is too far from the origin for a mesh that stays where it lies.
[[nodiscard]] inline bool is_far(double number) { return number > kMaxCoordinate || number < -kMaxCoordinate; }
inline constexpr const char* kTruncatedRemedy = "the file is cut short or damaged: export or copy it again";

// Adds a vertex, which may be a faulty one.
void add_vertex(MeshSoup& soup, const Vec3& position, std::uint64_t place);

// Leaves out the faulty vertices that no face names, with a remark; one that a face names is an error. Splits polygons,
// reduces the palette, checks that there is a triangle, moves the mesh as asked and brings the numbers to metres. Every
// corner must be a valid index.
[[nodiscard]] Result<ImportedMesh> finished(MeshSoup&& soup, const std::string& name,
                                            std::optional<LengthUnit> given_unit, MeshOrigin origin);

// Tells whether the bytes are exactly as many as a binary STL's count of triangles takes.
[[nodiscard]] bool is_binary_stl(std::span<const std::byte> bytes);
[[nodiscard]] Result<MeshSoup> read_stl(std::span<const std::byte> bytes, const std::string& name);
[[nodiscard]] Result<MeshSoup> read_obj(std::string_view text, const std::string& name,
                                        const MaterialFileReader& material_files,
                                        const MaterialFileReader& pictures = {});
[[nodiscard]] Result<MeshSoup> read_ply(std::span<const std::byte> bytes, const std::string& name,
                                        const MaterialFileReader& pictures = {});
[[nodiscard]] Result<MeshSoup> read_off(std::string_view text, const std::string& name);

[[nodiscard]] inline std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace burin::geometry
