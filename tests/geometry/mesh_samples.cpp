// SPDX-License-Identifier: MIT
#include "tests/geometry/mesh_samples.hpp"

#include <stdlib.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>

namespace burin::geometry::test {

TriangleMesh cube() {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions_m.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

TriangleMesh tetrahedron() {
    TriangleMesh mesh;
    mesh.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

TriangleMesh torus(std::size_t rings, std::size_t sides, double radius_m, double tube_m) {
    TriangleMesh mesh;
    for (std::size_t i = 0; i < rings; ++i) {
        for (std::size_t j = 0; j < sides; ++j) {
            const double u = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(rings);
            const double v = 2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(sides);
            const double r = radius_m + tube_m * std::cos(v);
            mesh.positions_m.emplace_back(r * std::cos(u), r * std::sin(u), tube_m * std::sin(v));
        }
    }
    const auto at = [&](std::size_t i, std::size_t j) {
        return static_cast<std::uint32_t>(i % rings * sides + j % sides);
    };
    for (std::size_t i = 0; i < rings; ++i) {
        for (std::size_t j = 0; j < sides; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

std::vector<std::byte> bytes_of(std::string_view text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

std::string text_of_file(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

Result<geometry::ImportedMesh> import_text(std::string_view text, MeshFormat format,
                                           std::optional<LengthUnit> given_unit) {
    static constexpr const char* kNames[] = {"test.stl", "test.obj", "test.ply", "test.off"};
    return geometry::import_mesh(bytes_of(text), format, kNames[static_cast<std::size_t>(format)], {}, given_unit);
}

std::string refusal(std::string_view text, MeshFormat format) {
    const auto result = import_text(text, format);
    return result ? std::string() : result.error().line();
}

std::vector<std::byte> binary_stl(std::span<const float> corners, std::uint32_t claimed) {
    const std::size_t triangles = corners.size() / 9;
    std::vector<std::byte> bytes(84 + 50 * triangles);
    std::memcpy(bytes.data() + 80, &claimed, 4);
    for (std::size_t t = 0; t < triangles; ++t) std::memcpy(bytes.data() + 84 + 50 * t + 12, &corners[9 * t], 36);
    return bytes;
}

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "burin-test-XXXXXX").string();
    if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
}

std::size_t TemporaryFolder::entries() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(path_)) ++count;
    return count;
}

}  // namespace burin::geometry::test
