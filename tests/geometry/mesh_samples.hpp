// SPDX-License-Identifier: MIT
// Meshes, files and folders that the tests of geometry/ share.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/files/mesh_import.hpp"

namespace burin::geometry::test {

// The unit cube [0,1]^3, 12 triangles, outward. Volume 1, area 6.
TriangleMesh cube();
// The corner tetrahedron of the unit axes, outward. Volume 1/6.
TriangleMesh tetrahedron();
// A closed torus of rings x sides quads split in two, outward. Volume 2 pi^2 R r^2 in the limit.
TriangleMesh torus(std::size_t rings, std::size_t sides, double radius_m, double tube_m);

[[nodiscard]] std::vector<std::byte> bytes_of(std::string_view text);
[[nodiscard]] std::string text_of_file(const std::filesystem::path& path);

// Imports text as if it were a file named "test.<format>".
Result<geometry::ImportedMesh> import_text(std::string_view text, MeshFormat format,
                                           std::optional<LengthUnit> given_unit = std::nullopt);
// The message of a refusal; an empty string when the text was accepted.
std::string refusal(std::string_view text, MeshFormat format);

// A binary STL of the corners, nine floats a triangle, with the count that the header shall claim.
std::vector<std::byte> binary_stl(std::span<const float> corners, std::uint32_t claimed);

// A fresh folder that vanishes at the end of the scope.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    // Writes a file in the folder and returns its path.
    std::filesystem::path write(const std::string& name, std::string_view text) const;
    [[nodiscard]] std::size_t entries() const;

private:
    std::filesystem::path path_;
};

}  // namespace burin::geometry::test
