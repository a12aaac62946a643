// SPDX-License-Identifier: MIT
// The colours that a surface shows, as a file can hold them: of its vertices or of its faces, never of both, since
// programs differ in which of the two they show. Vertices are never split at a border of colours: whoever reads the
// file would find the surface open there. Pure; any thread. Cost: linear.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "geometry/files/colour_scale.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

// The colours of a triangle's corners.
using TriangleColours = std::array<Colour, 3>;

// Of these two one is empty at least.
struct FileColours {
    std::vector<Colour> of_vertices;
    std::vector<Colour> of_faces;
    bool flattened = false;  // a face showed several colours, and vertices can not: it has their mean

    [[nodiscard]] bool none() const { return of_vertices.empty() && of_faces.empty(); }
};

// Returns the colours of `corners`, one for each triangle, where there are as many; else those of the mesh's vertices,
// or else of its materials. They are of vertices where all corners at each vertex agree, else of faces.
[[nodiscard]] FileColours file_colours(const TriangleMesh& mesh, std::span<const TriangleColours> corners = {});

// Leaves a mesh the colours of its faces alone where vertices at one position differ in colour: to be called before
// these become one vertex, of which one would win. Returns whether a face has lost colours, since its corners differ.
bool keep_colours_of_faces_at_seams(TriangleMesh& mesh);

// Says that pictures are flattened to one colour for each triangle: "picture 'skin.png' is flattened ...".
[[nodiscard]] std::string flattened_in_words(const std::vector<std::string>& pictures);

[[nodiscard]] Colour mean_of(std::span<const Colour> colours);

}  // namespace burin::geometry
