// SPDX-License-Identifier: MIT
#include "geometry/files/surface_colours.hpp"

#include <algorithm>

#include "geometry/files/text_scanner.hpp"
#include "geometry/mesh/vertex_weld.hpp"

namespace burin::geometry {
namespace {

bool is_flat(const TriangleColours& corners) { return corners[0] == corners[1] && corners[1] == corners[2]; }

// Returns a colour for each vertex where all corners at each agree; empty where some do not. A vertex of no triangle
// takes the first corner's, so that the file gains no colour.
std::vector<Colour> agreed_colours(const TriangleMesh& mesh, std::span<const TriangleColours> corners) {
    std::vector<Colour> agreed(mesh.positions_m.size(), corners.front()[0]);
    std::vector<bool> known(mesh.positions_m.size());
    for (std::size_t t = 0; t < corners.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.triangles[t][k];
            if (known[v] && agreed[v] != corners[t][k]) return {};
            known[v] = true;
            agreed[v] = corners[t][k];
        }
    }
    return agreed;
}

std::vector<TriangleColours> colours_of_materials(const TriangleMesh& mesh) {
    std::vector<TriangleColours> corners;
    corners.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::size_t at = t < mesh.triangle_materials.size() ? mesh.triangle_materials[t] : 0;
        const Colour colour = at < mesh.materials.size() ? mesh.materials[at].colour : Material{}.colour;
        corners.push_back({colour, colour, colour});
    }
    return corners;
}

FileColours colours_of_corners(const TriangleMesh& mesh, std::span<const TriangleColours> corners) {
    FileColours colours;
    if (corners.empty()) return colours;
    colours.of_vertices = agreed_colours(mesh, corners);
    if (!colours.of_vertices.empty()) return colours;
    colours.of_faces.reserve(corners.size());
    for (const TriangleColours& corner : corners) {
        colours.of_faces.push_back(mean_of(corner));
        colours.flattened = colours.flattened || !is_flat(corner);
    }
    return colours;
}

}  // namespace

FileColours file_colours(const TriangleMesh& mesh, std::span<const TriangleColours> corners) {
    if (!corners.empty() && corners.size() == mesh.triangles.size()) return colours_of_corners(mesh, corners);
    if (!mesh.colours.empty() && mesh.colours.size() == mesh.positions_m.size()) return {mesh.colours, {}, false};
    if (mesh.materials.empty()) return {};
    return colours_of_corners(mesh, colours_of_materials(mesh));
}

bool keep_colours_of_faces_at_seams(TriangleMesh& mesh) {
    if (mesh.colours.size() != mesh.positions_m.size() || mesh.triangle_materials.size() != mesh.triangles.size())
        return false;
    std::vector<Vec3> places;
    std::vector<Colour> first;
    VertexWeld weld(places);
    bool differ = false;
    for (std::size_t v = 0; v < mesh.positions_m.size() && !differ; ++v) {
        const std::uint32_t place = weld.index_of(mesh.positions_m[v]);
        if (place == first.size()) first.push_back(mesh.colours[v]);
        differ = first[place] != mesh.colours[v];
    }
    if (!differ) return false;
    const bool flattened = std::ranges::any_of(mesh.triangles, [&](const auto& t) {
        return !is_flat({mesh.colours[t[0]], mesh.colours[t[1]], mesh.colours[t[2]]});
    });
    mesh.colours.clear();
    return flattened;
}

std::string flattened_in_words(const std::vector<std::string>& pictures) {
    if (pictures.empty()) return {};
    const std::size_t others = pictures.size() - 1;
    return "picture " + in_quotes(pictures.front()) +
           (others == 0 ? " is" : " and " + std::to_string(others) + (others == 1 ? " other are" : " others are")) +
           " flattened: each triangle has the mean of its corners' colours";
}

Colour mean_of(std::span<const Colour> colours) {
    std::array<std::uint64_t, 3> sum{};
    for (const Colour& colour : colours)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
    const std::uint64_t n = std::max<std::uint64_t>(colours.size(), 1);
    return {static_cast<std::uint8_t>((sum[0] + n / 2) / n), static_cast<std::uint8_t>((sum[1] + n / 2) / n),
            static_cast<std::uint8_t>((sum[2] + n / 2) / n)};
}

}  // namespace burin::geometry
