// SPDX-License-Identifier: MIT
#include "bench/haptics/touch_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "base/try.hpp"
#include "bench/measure/bumpy_sphere.hpp"
#include "bench/measure/rough_surfaces.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "sculpt/stroke_reader.hpp"
#include "toolbox/feel_options.hpp"

namespace burin::bench {
namespace {

constexpr double kExtent_m = 0.1, kLargestBall_m = 0.02;

// Returns a point on a sphere of the bumpy sphere's radius, whose top is the origin.
haptics::ProbePoint on_sphere(double x, double z) {
    const double radius = BumpySphere{}.radius_m;
    return {{x, std::sqrt(radius * radius - x * x - z * z) - radius, z}, 0.0};
}

// Returns a wand's two ends, nearer together than the real one's, so that both are on the surface.
haptics::Probe two_points() {
    haptics::Probe probe;
    probe.count = 2;
    probe.points[0] = on_sphere(0.02, 0.0);
    probe.points[1] = on_sphere(-0.02, 0.0);
    return probe;
}

// Returns four fingers, each a point and its four neighbours, 2 mm apart.
haptics::Probe four_fingers() {
    haptics::Probe probe;
    probe.count = 0;
    for (const double x : {-0.012, 0.012})
        for (const double z : {-0.012, 0.012})
            for (const auto& [dx, dz] : {std::pair{0.0, 0.0}, {0.002, 0.0}, {-0.002, 0.0}, {0.0, 0.002}, {0.0, -0.002}})
                probe.points[probe.count++] = on_sphere(x + dx, z + dz);
    return probe;
}

TouchScene of_file(const std::filesystem::path& path) {
    return {path.stem().string(), false, [path]() -> Result<geometry::TriangleMesh> {
                auto read = geometry::import_mesh(path, LengthUnit::m);  // whatever its unit: it is scaled
                if (!read) return std::unexpected(read.error());
                return scaled_to(std::move(read->mesh), kExtent_m);
            }};
}

bool is_mesh(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
    return extension == ".obj" || extension == ".ply" || extension == ".stl" || extension == ".off";
}

Result<void> add_models(TouchScenes& all, const std::string& folder) {
    std::error_code error;
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (is_mesh(at->path())) files.push_back(at->path());
    if (error) return fail("--models " + folder, "cannot be read: " + error.message(), "name a folder of meshes");
    if (files.empty()) return fail("--models " + folder, "holds no mesh", "put STL, OBJ, PLY or OFF files into it");
    std::ranges::sort(files);
    for (const auto& file : files) all.scenes.push_back(of_file(file));
    return {};
}

constexpr std::size_t kMostJudged = 200;  // ticks without contact in a run; a judgement looks at every triangle
constexpr double kInside_m = 2e-5;        // deep enough that rounding does not decide

// Returns how often the mesh winds around the point: 1 inside a closed one, 0 outside (Jacobson et al. 2013), with the
// solid angles of Van Oosterom and Strackee 1983.
double winding_number(const geometry::TriangleMesh& mesh, const Vec3& p) {
    double sum = 0.0;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 a = mesh.positions_m[i] - p, b = mesh.positions_m[j] - p, c = mesh.positions_m[k] - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (2.0 * std::numbers::pi);
}

}  // namespace

geometry::TriangleMesh scaled_to(geometry::TriangleMesh mesh, double extent_m) {
    Box box;
    for (const Vec3& p : mesh.positions_m) box.include(p);
    const Vec3 extent = box.empty() ? Vec3(0.0) : box.extent();
    const double largest = std::max({extent.x, extent.y, extent.z});
    if (!(largest > 0.0)) return mesh;
    for (Vec3& p : mesh.positions_m) p = (extent_m / largest) * (p - box.center());
    return mesh;
}

Result<TouchScenes> touch_scenes(const TouchSceneOptions& options) {
    TouchScenes all;
    const auto add = [&](const char* name, bool smooth, std::function<geometry::TriangleMesh()> make) {
        all.scenes.push_back(
            {name, smooth, [make = std::move(make)]() -> Result<geometry::TriangleMesh> { return make(); }});
    };
    for (const std::size_t size : options.spheres)
        add("sphere", true, [size] { return mesh_of(BumpySphere{}, squares_for(size)); });
    add("rough_ball", false, [n = options.rough_triangles] { return rough_ball(n); });
    add("rough_plate", false, [n = options.rough_triangles] { return rough_plate(n); });
    add("file", false, [] { return file_plate(); });
    add("machined", false, [n = options.sides] { return machined_part(n); });
    add("needles", false, [n = options.needles] { return needle_comb(n); });
    if (std::error_code ignored; std::filesystem::exists(options.workpiece, ignored))
        all.scenes.push_back(of_file(options.workpiece));
    else
        all.notes.push_back(options.workpiece + " is not here: run in the repository's folder to touch it");
    if (options.models.empty()) {
        all.notes.emplace_back("no scanned or machined models were touched: name a folder of them with --models");
        return all;
    }
    BURIN_TRY_DO(add_models(all, options.models));
    return all;
}

Result<std::unique_ptr<const TouchedScene>> touched(const TouchScene& scene) {
    BURIN_TRY(mesh, scene.make());
    BURIN_TRY(touch, geometry::TouchMesh::create(mesh));
    BURIN_TRY(walk, SurfaceWalk::create(mesh, 1));
    const geometry::MeshHealth health = geometry::examine(mesh);
    geometry::TriangleMesh kept = std::move(mesh);
    // The tree refers to arrays that moving the mesh leaves in place.
    geometry::TriangleTree tree(kept.positions_m, kept.triangles);
    return std::make_unique<const TouchedScene>(TouchedScene{scene.name, scene.smooth, std::move(kept),
                                                             touch.snapshot(), std::move(walk), std::move(tree),
                                                             !health.closed || !health.consistently_oriented});
}

std::uint64_t contacts_lost(const TouchedScene& scene, const std::vector<Vec3>& hands_m, double radius_m) {
    if (hands_m.empty()) return 0;
    const std::size_t stride = (hands_m.size() + kMostJudged - 1) / kMostJudged;
    std::uint64_t judged = 0, lost = 0;
    for (std::size_t i = 0; i < hands_m.size(); i += stride) {
        ++judged;
        const double distance_m = scene.tree.nearest(hands_m[i], 0).distance_m;
        const bool meets = distance_m < 0.95 * radius_m;  // a ball in a session is a little smaller than its tool
        if (meets || (!scene.both_sides && distance_m > kInside_m && winding_number(scene.mesh, hands_m[i]) > 0.5))
            ++lost;
    }
    return lost * hands_m.size() / judged;
}

void fill(geometry::LocalSurface& draft, const TouchedScene& scene, std::uint64_t sequence, Nanoseconds now_ns) {
    draft.sequence = sequence;
    draft.made_ns = now_ns;
    draft.radius_m = 1e3;
    draft.meshes.assign(1, {scene.snapshot, 0, scene.both_sides});
}

std::vector<NamedProbe> probes_on(double mean_edge_m) {
    std::vector<NamedProbe> probes{{"point", {}, 0.0},
                                   {"ball_2_mm", haptics::ball_probe(0.002), 0.002},
                                   {"ball_5_mm", haptics::ball_probe(0.005), 0.005}};
    for (const double edges : {1.0, 3.5, 7.0, 14.0}) {
        const double radius_m = edges * mean_edge_m;
        if (radius_m > kLargestBall_m) continue;
        std::array<char, 32> name{};
        std::snprintf(name.data(), name.size(), "ball_%g_edges", edges);
        probes.push_back({name.data(), haptics::ball_probe(radius_m), radius_m});
    }
    probes.push_back({"two_points", two_points(), 0.0});
    probes.push_back({"20_points", four_fingers(), 0.0});
    return probes;
}

haptics::TickParameters session_parameters(const haptics::Probe& probe, bool friction) {
    haptics::TickParameters parameters;
    parameters.sequence = 1;
    parameters.probe = probe;
    parameters.action = toolbox::action_of(compute::Operation::cut);
    haptics::TouchMaterial material = toolbox::touch_material({});
    if (!friction) material.static_friction = material.dynamic_friction = 0.0;
    parameters.materials.fill(material);
    return parameters;
}

}  // namespace burin::bench
