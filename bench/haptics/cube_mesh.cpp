// SPDX-License-Identifier: MIT
#include "bench/haptics/cube_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace burin::bench {

geometry::TriangleMesh mesh_of_cube(int n, const PlaceOnCube& place) {
    geometry::TriangleMesh mesh;
    // Vertices by their position on the cube, counted in squares.
    std::unordered_map<std::uint64_t, std::uint32_t> vertex_of;
    const auto vertex = [&](const std::array<int, 3>& at) {
        const auto side = static_cast<std::uint64_t>(n) + 1;
        const std::uint64_t key =
            (static_cast<std::uint64_t>(at[0]) * side + static_cast<std::uint64_t>(at[1])) * side +
            static_cast<std::uint64_t>(at[2]);
        const auto [known, is_new] = vertex_of.try_emplace(key, static_cast<std::uint32_t>(mesh.positions_m.size()));
        if (is_new) mesh.positions_m.push_back(place(at));
        return known->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int end : {0, n})
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    const auto corner = [&](int u, int v) {
                        std::array<int, 3> at{};
                        at[axis] = end, at[(axis + 1) % 3] = u, at[(axis + 2) % 3] = end > 0 ? v : n - v;
                        return vertex(at);
                    };
                    const std::uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                                        d = corner(i, j + 1);
                    mesh.triangles.push_back({a, b, c});
                    mesh.triangles.push_back({a, c, d});
                }
    return mesh;
}

int squares_for(std::size_t triangles) {
    return std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 12.0))));
}

}  // namespace burin::bench
