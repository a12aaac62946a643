// SPDX-License-Identifier: MIT
// Queries among objects against looking at each, and paths against their keys.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "base/file_io.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "scene/world_file.hpp"
#include "tests/scene/scene_samples.hpp"

namespace burin::scene {
namespace {

using geometry::test::random_vector;

Pose any_pose(std::mt19937& random, double half_m) {
    const Vec3 at = random_vector(random, half_m), q = random_vector(random, 1.0);
    return {at, glm::normalize(Quat(0.3, q.x, q.y, q.z))};
}

RC_GTEST_PROP(ObjectTree, FindsWhatLookingAtEachBoxFinds, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const std::size_t count = random() % 200;
    std::vector<ObjectTree::Item> items;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 at = random_vector(random, 1.0), half = glm::abs(random_vector(random, 0.1));
        items.push_back({{at - half, at + half}, i});
        if (random() % 8 == 0) items.back().box = items.front().box;  // some in one place
    }
    const ObjectTree tree(items);
    for (int query = 0; query < 10; ++query) {
        const Vec3 center = random_vector(random, 1.2);
        const double radius_m = std::abs(random_vector(random, 0.5).x);
        std::multiset<std::uint32_t> found, expected;
        tree.for_each_near(center, radius_m, [&](std::uint32_t i) { found.insert(i); });
        for (const ObjectTree::Item& item : items)
            if (distance2_m2(item.box, center) <= radius_m * radius_m) expected.insert(item.index);
        RC_ASSERT(found == expected);
    }
}

// The least distance of a point from an object's triangles where they are in the scene.
double distance_m(const SceneObject& object, const Vec3& point) {
    double least = HUGE_VAL;
    for (const auto& t : object.mesh->triangles) {
        const auto at = [&](std::size_t k) { return object.pose * (object.scale * object.mesh->positions_m[t[k]]); };
        least = std::min(least, glm::length(point - geometry::nearest_point({at(0), at(1), at(2)}, point)));
    }
    return least;
}

RC_GTEST_PROP(MeshPart, OffersEveryObjectWhoseTrianglesAreNear, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const auto ball = test::shared_mesh(geometry::test::ball(2, 0.05, random_vector(random, 0.2)));
    const auto cube = test::shared_mesh(geometry::test::cube(0.05));
    std::vector<SceneObject> objects;
    for (ObjectId id = 1; id <= 60; ++id) {
        objects.push_back(test::object_at(id, random() % 2 == 0 ? ball : cube, Vec3(0.0)));
        objects.back().pose = any_pose(random, 0.5);
        const std::array scales{0.5, 1.0, 2.0};
        objects.back().scale = scales[random() % scales.size()];
        objects.back().felt = random() % 8 != 0;
    }
    MaterialTable materials;
    auto part = MeshPart::create(objects, materials);
    RC_ASSERT(part.has_value());
    for (int query = 0; query < 5; ++query) {
        // An edit now and then.
        const ObjectId edited_id = 1 + random() % 60;
        const Pose to = any_pose(random, 0.5);
        RC_ASSERT((*part)->edit(edited_id, SetPose{to}).has_value());
        objects[edited_id - 1].pose = to;
        const Vec3 center = random_vector(random, 0.6);
        const double radius_m = std::abs(random_vector(random, 0.2).x);
        geometry::LocalSurface draft;
        RC_ASSERT((*part)->add_near({0, center, radius_m}, draft).has_value());
        for (const SceneObject& object : objects) {
            const bool is_there = std::ranges::any_of(draft.meshes, [&](const geometry::TouchedMesh& mesh) {
                return mesh.motion.object_from_mesh.position_m == object.pose.position_m;
            });
            if (!object.felt) RC_ASSERT(!is_there);
            if (object.felt && distance_m(object, center) <= radius_m - 1e-6) RC_ASSERT(is_there);
        }
    }
}

// Cuts, doubles and overwrites parts of a text.
std::string damaged(std::string text, std::mt19937& random) {
    const std::string_view pieces[] = {"[",    "]",   "[[object]]", "=",          "\"",   "{",        "}",
                                       "nan",  "\n",  "-1e400",     "'''",        ",",    "0x",       "path",
                                       "\xff", "0.5", "object",     "1979-05-27", "true", "material", "99"};
    const auto times = 1 + random() % 4;
    for (std::uint32_t i = 0; i < times && !text.empty(); ++i) {
        const std::size_t at = random() % text.size(), from = random() % text.size(), length = random() % 40;
        switch (random() % 3) {
            case 0: text.erase(at, length); break;
            case 1: text.insert(at, text.substr(from, length)); break;
            default: text.insert(at, pieces[from % std::size(pieces)]);
        }
    }
    return text;
}

RC_GTEST_PROP(WorldFile, ADamagedFileIsAWorldOrAListOfProblemsWithPlaces, (std::uint32_t seed)) {
    static const std::string garden = *read_text_file("assets/worlds/garden.toml");
    std::mt19937 random(seed);
    const auto cube = [](const std::string&, std::optional<LengthUnit>) -> Result<geometry::ImportedMesh> {
        return geometry::ImportedMesh{geometry::test::cube(0.01), {}};
    };
    const WorldOrProblems world = parse_world(damaged(garden, random), "w.toml", cube);
    if (!world) {
        RC_ASSERT(!world.error().empty());
        for (const Error& error : world.error()) {
            RC_ASSERT(error.where.starts_with("w.toml:"));
            RC_ASSERT(!error.what.empty());
            RC_ASSERT(!error.remedy.empty());
        }
        return;
    }
    // A world without a problem can be touched.
    MaterialTable materials(1);
    const auto part = MeshPart::create(world->objects, materials);
    RC_ASSERT(part.has_value());
}

RC_GTEST_PROP(PathMotion, PassesItsKeysWithoutAStepInPlaceOrVelocity, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    PathMotion path;
    double time_s = 0.0;
    const std::size_t count = 3 + random() % 6;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 at = random_vector(random, 0.1),
                   axis = glm::normalize(random_vector(random, 1.0) + Vec3(0.0, 2.0, 0.0));
        const double turn_rad = random_vector(random, 0.9).x;
        path.keys.push_back({time_s, {at, glm::angleAxis(turn_rad, axis)}});
        if (random() % 2 == 0) path.keys.back().pose.orientation = -path.keys.back().pose.orientation;
        time_s += 0.3 + std::abs(random_vector(random, 1.0).x);
    }
    path.repeats = random() % 2 == 0;
    if (path.repeats) path.keys.push_back({time_s, path.keys.front().pose});
    RC_ASSERT(problems(path).empty());
    const double step_s = 1e-5;
    for (const PathKey& key : path.keys) {
        const Pose at = pose_on(path, key.time_s);
        RC_ASSERT(glm::length(at.position_m - key.pose.position_m) < 1e-9);
        RC_ASSERT(std::abs(glm::dot(at.orientation, key.pose.orientation)) > 1.0 - 1e-9);
        if (key.time_s == 0.0) continue;
        const Pose before = pose_on(path, key.time_s - step_s), after = pose_on(path, key.time_s + step_s);
        const Velocities in = velocities_between(before, at, step_s), out = velocities_between(at, after, step_s);
        // Accelerations are below 10 m/s^2 and 100 rad/s^2.
        RC_ASSERT(glm::length(in.linear_m_per_s - out.linear_m_per_s) < 1e-3);
        RC_ASSERT(glm::length(in.angular_rad_per_s - out.angular_rad_per_s) < 1e-2);
    }
}

}  // namespace
}  // namespace burin::scene
