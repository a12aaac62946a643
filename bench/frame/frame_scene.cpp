// SPDX-License-Identifier: MIT
#include "bench/frame/frame_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "bench/measure/bumpy_sphere.hpp"

namespace burin::bench {
namespace {

constexpr BumpySphere kSurface{.radius_m = 1.0, .bumps = 0.02, .waves = 12.0};
constexpr double kHeightDegrees = 37.0;
constexpr double kPathHalf_m = 0.05;
constexpr double kDentRadius_m = 0.06, kDentDepth_m = 0.004, kDentPath_m = 0.1;

wall::Screen screen_around(const Vec3& head, double aspect) {
    const double half_height = head.z * std::tan(0.5 * kHeightDegrees * std::numbers::pi / 180.0);
    const double half_width = aspect * half_height;
    return {{-half_width, -half_height, 0.0}, {half_width, -half_height, 0.0}, {-half_width, half_height, 0.0}};
}

FrameMesh mesh_with_normals(std::size_t triangles) {
    const geometry::TriangleMesh mesh = mesh_of(kSurface, squares_for(triangles));
    FrameMesh made;
    made.vertices.reserve(mesh.positions_m.size());
    for (const Vec3& p : mesh.positions_m)
        made.vertices.push_back({Vec3f(p), Vec3f(glm::normalize(kSurface.gradient(p)))});
    made.indices.reserve(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles)
        made.indices.insert(made.indices.end(), triangle.begin(), triangle.end());
    return made;
}

// Returns the side of cubes that hold about so many triangles of the sphere each, if a flat square crosses each cube.
double cube_side_m(std::size_t triangles, std::size_t triangles_a_patch) {
    return std::sqrt(4.0 * std::numbers::pi * static_cast<double>(triangles_a_patch) / static_cast<double>(triangles));
}

using Cube = std::tuple<int, int, int>;

std::map<Cube, std::vector<std::uint32_t>> indices_by_cube(const FrameMesh& whole, double side_m) {
    std::map<Cube, std::vector<std::uint32_t>> cubes;
    for (std::size_t t = 0; t < whole.indices.size(); t += 3) {
        Vec3 middle(0.0);
        for (std::size_t k = 0; k < 3; ++k) middle += Vec3(whole.vertices[whole.indices[t + k]].position_world_m) / 3.0;
        const Vec3 at = glm::floor(middle / side_m);
        auto& indices = cubes[{static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)}];
        indices.insert(indices.end(), whole.indices.begin() + static_cast<std::ptrdiff_t>(t),
                       whole.indices.begin() + static_cast<std::ptrdiff_t>(t + 3));
    }
    return cubes;
}

void add_patch(FrameScene& scene, const std::vector<std::uint32_t>& whole_indices,
               std::vector<std::uint32_t>& place_of) {
    constexpr auto kNone = static_cast<std::uint32_t>(-1);
    FrameMesh patch;
    std::vector<std::uint32_t> members;
    for (const std::uint32_t index : whole_indices) {
        if (place_of[index] == kNone) {
            place_of[index] = static_cast<std::uint32_t>(members.size());
            members.push_back(index);
            patch.vertices.push_back(scene.whole.vertices[index]);
        }
        patch.indices.push_back(place_of[index]);
    }
    for (const std::uint32_t index : members) place_of[index] = kNone;
    scene.patches.push_back(std::move(patch));
    scene.whole_vertices.push_back(std::move(members));
}

wall::Viewer viewer_at(const FrameScene& scene, const Vec3& head_world) {
    return {{head_world, Quat{1.0, 0.0, 0.0, 0.0}}, scene.interpupillary_m};
}

Vec3 dent_middle(unsigned frame) {
    const double turn = 2.0 * std::numbers::pi * frame / kFramesAround;
    const Vec3 direction = glm::normalize(Vec3(kDentPath_m * std::cos(turn), kDentPath_m * std::sin(turn), 1.0));
    return kSurface.radius_at_m(direction) * direction;
}

// Pushes the vertex in by g = depth (1 - r^2 / R^2)^2 along the
// normal n; the normal becomes n plus g's gradient along the surface.
FrameVertex dented(const FrameVertex& vertex, const Vec3& middle) {
    const Vec3 n(vertex.normal_world), from_middle = Vec3(vertex.position_world_m) - middle;
    const double rest = 1.0 - glm::dot(from_middle, from_middle) / (kDentRadius_m * kDentRadius_m);
    if (rest <= 0.0) return vertex;
    const Vec3 gradient = kDentDepth_m * 2.0 * rest * (-2.0 / (kDentRadius_m * kDentRadius_m)) * from_middle;
    const Vec3 along = gradient - glm::dot(gradient, n) * n;
    return {vertex.position_world_m - Vec3f(kDentDepth_m * rest * rest * n), Vec3f(glm::normalize(n + along))};
}

bool touches(const FrameMesh& patch, const Vec3& middle) {
    return std::ranges::any_of(patch.vertices, [&](const FrameVertex& v) {
        return glm::distance(Vec3(v.position_world_m), middle) < kDentRadius_m;
    });
}

}  // namespace

FrameScene make_frame_scene(std::size_t triangles, std::size_t triangles_a_patch) {
    FrameScene scene;
    scene.screen = screen_around(scene.head_middle_world, static_cast<double>(scene.size.width) / scene.size.height);
    scene.look.to_light_world = glm::normalize(scene.look.to_light_world);
    scene.whole = mesh_with_normals(triangles);
    std::vector<std::uint32_t> place_of(scene.whole.vertices.size(), static_cast<std::uint32_t>(-1));
    for (const auto& [cube, indices] : indices_by_cube(scene.whole, cube_side_m(scene.triangles(), triangles_a_patch)))
        add_patch(scene, indices, place_of);
    return scene;
}

wall::Viewer moving_viewer(const FrameScene& scene, unsigned frame) {
    const double turn = 2.0 * std::numbers::pi * (frame % kFramesAround) / kFramesAround;
    return viewer_at(
        scene, scene.head_middle_world + Vec3(kPathHalf_m * std::sin(turn), kPathHalf_m * std::sin(2.0 * turn), 0.0));
}

wall::Viewer still_viewer(const FrameScene& scene) { return viewer_at(scene, scene.head_middle_world); }

std::vector<PatchChange> wandering_dent(const FrameScene& scene, unsigned frame) {
    const Vec3 middle = dent_middle(frame), before = dent_middle(frame + kFramesAround - 1);
    std::vector<PatchChange> changes;
    for (std::uint32_t i = 0; i < scene.patches.size(); ++i) {
        const FrameMesh& patch = scene.patches[i];
        if (!touches(patch, middle) && !touches(patch, before)) continue;
        PatchChange change{i, {}};
        change.vertices.reserve(patch.vertices.size());
        for (const FrameVertex& vertex : patch.vertices) change.vertices.push_back(dented(vertex, middle));
        changes.push_back(std::move(change));
    }
    return changes;
}

double expected_coverage(const FrameScene& scene, const Vec3& eye_world) {
    const wall::Screen& s = scene.screen;
    std::size_t covered = 0;
    for (std::uint32_t y = 0; y < scene.size.height; ++y)
        for (std::uint32_t x = 0; x < scene.size.width; ++x) {
            const Vec3 pixel = s.lower_left_world +
                               (s.lower_right_world - s.lower_left_world) * ((x + 0.5) / scene.size.width) +
                               (s.upper_left_world - s.lower_left_world) * ((y + 0.5) / scene.size.height);
            const Vec3 along = glm::normalize(pixel - eye_world);
            // Compares the line's distance from the sphere's centre, the origin, with the radius.
            if (glm::length(eye_world - glm::dot(eye_world, along) * along) < kSurface.radius_m) ++covered;
        }
    return static_cast<double>(covered) / (static_cast<double>(scene.size.width) * scene.size.height);
}

double coverage(const FrameLook& look, const Image& image) {
    const Vec3 background = 255.0 * look.background;
    std::size_t covered = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const Vec3 away = glm::abs(Vec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]) - background);
        if (std::max({away.x, away.y, away.z}) > 6.0) ++covered;  // smaller differences are dither or rounding
    }
    return image.rgba.empty() ? 0.0 : 4.0 * static_cast<double>(covered) / static_cast<double>(image.rgba.size());
}

}  // namespace burin::bench
