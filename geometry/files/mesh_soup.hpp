// SPDX-License-Identifier: MIT
// What the file readers of mesh_import.cpp share: faces of any number of corners as the file lists them, and the step that
// turns them into a TriangleMesh with its report. Internal to geometry/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "geometry/mesh_import.hpp"

namespace burin {

using Colour = std::array<std::uint8_t, 3>;

inline constexpr Colour kPlainColour{200, 200, 200};  // of what a file leaves uncoloured; equals Material{}.colour

struct MeshSoup {
    std::vector<Vec3> positions_m;
    std::vector<Colour> colours;                // a vertex each, or empty
    std::vector<std::uint32_t> corners;         // of all faces, one after another
    std::vector<std::uint32_t> corner_counts;   // a face each
    std::vector<std::uint32_t> face_materials;  // a face each, into materials, or empty
    std::vector<Material> materials;            // any number
    ImportReport report;                        // what the reader knows; finished() fills in the counts of faces
};

// The material of a colour, made when it is new.
class ColourMaterials {
public:
    explicit ColourMaterials(std::vector<Material>& materials) : materials_(materials) {}
    std::uint32_t index_of(const Colour& colour);

private:
    std::vector<Material>& materials_;
    std::unordered_map<std::uint32_t, std::uint32_t> known_;
};

// "file:line" and "file, byte n".
[[nodiscard]] std::string at_line(const std::string& name, std::uint64_t line);
[[nodiscard]] std::string at_byte(const std::string& name, std::uint64_t byte);

// What is wrong with a coordinate, or nullptr.
[[nodiscard]] const char* coordinate_fault(double value_m);
inline constexpr const char* kCoordinateRemedy = "repair the file, and give coordinates in metres";
inline constexpr const char* kTruncatedRemedy = "the file is cut short or damaged: export or copy it again";

// Splits polygons, reduces the palette and checks that there is a triangle. Every corner must be a valid index.
[[nodiscard]] Result<ImportedMesh> finished(MeshSoup&& soup, const std::string& name);

[[nodiscard]] Result<MeshSoup> read_stl(std::span<const std::byte> bytes, const std::string& name);
[[nodiscard]] Result<MeshSoup> read_obj(std::string_view text, const std::string& name,
                                        const MaterialFileReader& material_files);
[[nodiscard]] Result<MeshSoup> read_ply(std::span<const std::byte> bytes, const std::string& name);
[[nodiscard]] Result<MeshSoup> read_off(std::string_view text, const std::string& name);

[[nodiscard]] inline std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace burin
