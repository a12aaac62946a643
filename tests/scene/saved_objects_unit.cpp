// SPDX-License-Identifier: MIT
// Objects of a world as pages of a document: what is opened is what was saved, and what is damaged takes nothing else
// along.
#include "scene/saved_objects.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "scene/world_file.hpp"
#include "tests/scene/scene_samples.hpp"

namespace burin::scene {
namespace {

// Two objects of one mesh, one of another with colours of its own, and one on a path.
std::vector<SceneObject> four_objects() {
    const auto cube = test::shared_mesh(geometry::test::cube(0.05));
    const auto ball = test::shared_mesh(geometry::test::ball(8, 0.03));
    std::vector<SceneObject> objects{
        test::object_at(1, cube, {0.1, 0.0, 0.3}), test::object_at(2, cube, {0.2, 0.0, 0.1}),
        test::object_at(3, ball, {-0.1, 1.0 / 3.0, 0.0}), test::object_at(4, ball, {0.0, 0.0, 0.0})};
    objects[0].pose.orientation = glm::angleAxis(0.3, glm::normalize(Vec3(1.0, 2.0, 3.0)));
    objects[0].scale = 1.7;
    objects[0].pivot_m = {0.01, 0.02, 0.03};
    objects[0].colour = {10, 20, 255};
    objects[0].opacity = 0.25;
    objects[0].material = {123.456, 0.125, 0.5, 0.25, 0.0625};
    objects[1].seen = false;
    objects[1].felt = false;
    objects[1].both_sides = true;
    CornerColours colours(ball->triangles.size());
    for (std::size_t i = 0; i < colours.size(); ++i)
        colours[i] = {Colour{static_cast<std::uint8_t>(i), 1, 2}, Colour{3, 4, 5}, Colour{6, 7, 8}};
    take_colours(objects[2], std::move(colours));
    PathMotion path = test::up_and_down(0.1);
    path.about_m = {0.0, 0.01, 0.0};
    objects[3].motion = path;
    return objects;
}

Pages saved(const std::vector<SceneObject>& objects) {
    std::vector<const geometry::TriangleMesh*> meshes;
    for (const SceneObject& object : objects) meshes.push_back(object.mesh.get());
    const std::vector<std::size_t> numbers = mesh_numbers(meshes);
    Pages pages{.part = std::string(kObjectsPart)};
    for (std::size_t i = 0; i < objects.size(); ++i)
        save_object(objects[i], objects[i].corner_colours.get(), numbers[i], object_bytes(objects[i], numbers[i]),
                    pages);
    return pages;
}

std::vector<std::shared_ptr<const CornerColours>> colours_of_all(const std::vector<SceneObject>& objects) {
    std::vector<std::shared_ptr<const CornerColours>> colours;
    for (const SceneObject& object : objects) colours.push_back(object.corner_colours);
    return colours;
}

void expect_same(const SceneObject& a, const SceneObject& b) {
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.mesh->positions_m, b.mesh->positions_m);
    EXPECT_EQ(a.mesh->triangles, b.mesh->triangles);
    EXPECT_EQ(a.pose, b.pose);
    EXPECT_EQ(a.scale, b.scale);
    EXPECT_EQ(a.pivot_m, b.pivot_m);
    EXPECT_EQ(a.seen, b.seen);
    EXPECT_EQ(a.felt, b.felt);
    EXPECT_EQ(a.colour, b.colour);
    EXPECT_EQ(a.opacity, b.opacity);
    EXPECT_EQ(a.material, b.material);
    EXPECT_EQ(a.both_sides, b.both_sides);
    EXPECT_EQ(a.motion, b.motion);
    ASSERT_EQ(a.corner_colours == nullptr, b.corner_colours == nullptr);
    EXPECT_TRUE(a.corner_colours == nullptr || *a.corner_colours == *b.corner_colours);
}

}  // namespace

TEST(SavedObjects, AreOpenedAsTheyWereSavedToTheBit) {
    const std::vector<SceneObject> objects = four_objects();
    const auto loaded = load_objects(saved(objects), "w.burin");
    ASSERT_TRUE(loaded) << loaded.error().line();
    EXPECT_EQ(loaded->lost, "");
    ASSERT_EQ(loaded->objects.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) expect_same(loaded->objects[i], objects[i]);
    EXPECT_EQ(loaded->objects[0].mesh, loaded->objects[1].mesh) << "a mesh that objects share is there once";
}

TEST(SavedObjects, OfAMeshThatIsLostKeepTheirNumbersAndLeaveTheOthersWhole) {
    const std::vector<SceneObject> objects = four_objects();
    Pages pages = saved(objects);
    pages.damaged.push_back({"mesh", 0});
    pages.pages.erase({"mesh", 0});
    const auto loaded = load_objects(pages, "w.burin");
    ASSERT_TRUE(loaded) << loaded.error().line();
    EXPECT_EQ(loaded->lost, "2 objects cannot be read, and nothing is seen or felt of it");
    ASSERT_EQ(loaded->objects.size(), 4u);
    EXPECT_FALSE(loaded->objects[0].seen || loaded->objects[0].felt);
    expect_same(loaded->objects[2], objects[2]);
}

TEST(SavedObjects, WhoseColoursAreLostAreCountedAndWhole) {
    std::vector<SceneObject> objects = four_objects();
    for (SceneObject& object : objects) {
        CornerColours colours(object.mesh->triangles.size());
        for (std::size_t i = 0; i < colours.size(); ++i)
            colours[i].fill({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(20 * object.id), 5});
        take_colours(object, std::move(colours));
    }
    const Pages sound = saved(objects);
    Pages pages = sound;
    for (std::int64_t lost = 1; lost <= 3; ++lost) {
        std::erase_if(pages.pages, [&](const auto& page) {
            return page.first.kind == "colours" && page.first.number / 4096 == lost + 1;
        });
        const auto loaded = load_objects(pages, "w.burin");
        ASSERT_TRUE(loaded) << loaded.error().line();
        EXPECT_EQ(loaded->lost,
                  std::to_string(lost) + (lost == 1 ? " object" : " objects") + " lost the colours of its file");
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const bool is_bare = i >= 1 && i <= static_cast<std::size_t>(lost);
            EXPECT_EQ(loaded->objects[i].corner_colours == nullptr, is_bare) << i;
            EXPECT_EQ(loaded->objects[i].seen, objects[i].seen) << i;
        }
    }
}

TEST(SavedObjects, OfADamagedLastPageAreStillCounted) {
    Pages pages = saved(four_objects());
    pages.pages.erase({"object", 4});
    pages.damaged.push_back({"object", 4});
    const auto loaded = load_objects(pages, "w.burin");
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->objects.size(), 4u);
    EXPECT_TRUE(loaded->lost.starts_with("1 object cannot be read"));
}

TEST(SavedObjects, WithWhatNoObjectCanHaveAreLostAndNothingCrashes) {
    const std::vector<SceneObject> objects = four_objects();
    const Pages sound = saved(objects);
    const std::string text(reinterpret_cast<const char*>(sound.find({"object", 1})->data()),
                           sound.find({"object", 1})->size());
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        EXPECT_NE(changed.find(from), std::string::npos) << from;
        changed.replace(changed.find(from), from.size(), to);
        Pages pages = sound;
        const auto bytes = std::as_bytes(std::span(changed));
        pages.pages[{"object", 1}] = {bytes.begin(), bytes.end()};
        return load_objects(pages, "w.burin");
    };
    for (const auto& [from, to] : {std::pair{"\"scale\": 1.7", "\"scale\": -1"},
                                   {"\"scale\": 1.7", "\"scale\": \"x\""},
                                   {"\"mesh\": 0", "\"mesh\": 7"},
                                   {"\"mesh\": 0", "\"mesh\": -1"},
                                   {"\"mesh\": 0", "\"mesh\": 1e300"},
                                   {"\"object 1\"", "\"object 2\""},
                                   {"123.456", "1e999"},
                                   {"0.03\n", "1e300\n"},
                                   {"255\n", "256\n"},
                                   {"\"pivot_m\"", "\"pivot\""},
                                   {"{", ""}}) {
        const auto loaded = with(from, to);
        ASSERT_TRUE(loaded) << to;
        EXPECT_TRUE(loaded->lost.starts_with("1 object cannot be read")) << to << ": " << loaded->lost;
    }
    Pages claims = sound;  // more vertices than there are bytes
    const std::uint64_t many = std::uint64_t{1} << 61;
    std::memcpy(claims.pages[{"mesh", 0}].data(), &many, sizeof many);
    const auto loaded = load_objects(claims, "w.burin");
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(loaded->lost.starts_with("2 objects cannot be read")) << loaded->lost;
    EXPECT_FALSE(load_objects(Pages{.part = "objects"}, "w.burin"));
}

TEST(SavedObjects, FollowAChangeOfAJournalOrRefuseItWhole) {
    const std::vector<SceneObject> objects = four_objects();
    std::vector<SceneObject> now = objects, changed = objects;
    changed[2].scale = 2.0;
    changed[0].pose.position_m = {9.0, 8.0, 7.0};
    Pages change{.part = std::string(kObjectsPart), .whole = false};
    change.pages[change_of(3)] = object_bytes(changed[2], 1);
    change.pages[change_of(1)] = object_bytes(changed[0], 0);
    const std::vector<std::shared_ptr<const CornerColours>> colours = colours_of_all(objects);
    ASSERT_TRUE(apply_change(now, colours, change, "j.burin"));
    for (std::size_t i = 0; i < 4; ++i) expect_same(now[i], changed[i]);
    change.pages[change_of(5)] = object_bytes(objects[1], 0);
    change.pages[change_of(1)] = object_bytes(objects[0], 0);
    EXPECT_FALSE(apply_change(now, colours, change, "j.burin")) << "there is no object 5";
    expect_same(now[0], changed[0]);
}

TEST(SavedObjects, ThatAreLostStayLostWhateverAChangeSays) {
    const std::vector<SceneObject> objects = four_objects();
    Pages pages = saved(objects);
    pages.pages.erase({"object", 1});
    auto loaded = load_objects(pages, "w.burin");
    ASSERT_TRUE(loaded);
    Pages change{.part = std::string(kObjectsPart), .whole = false};
    change.pages[change_of(1)] = object_bytes(objects[0], 0);
    ASSERT_TRUE(apply_change(loaded->objects, loaded->colours, change, "j.burin"));
    EXPECT_FALSE(loaded->objects[0].felt) << "an empty mesh cannot be felt, and the session would not open";
}

TEST(SavedObjects, GivenOneColourGetTheColoursOfTheirFileBackByAChange) {
    std::vector<SceneObject> objects = four_objects();
    const SceneObject coloured = objects[2];
    objects[2].corner_colours = nullptr;
    Pages pages{.part = std::string(kObjectsPart)};
    for (std::size_t i = 0; i < 4; ++i)
        save_object(objects[i], i == 2 ? coloured.corner_colours.get() : nullptr, i < 2 ? 0 : 1,
                    object_bytes(objects[i], i < 2 ? 0 : 1), pages);
    auto loaded = load_objects(pages, "w.burin");
    ASSERT_TRUE(loaded && loaded->lost.empty() && loaded->objects[2].corner_colours == nullptr);
    Pages change{.part = std::string(kObjectsPart), .whole = false};
    change.pages[change_of(3)] = object_bytes(coloured, 1);
    ASSERT_TRUE(apply_change(loaded->objects, loaded->colours, change, "j.burin"));
    expect_same(loaded->objects[2], coloured);
}

TEST(SavedObjects, OfAMeshLargerThanAPageMayBeComeBackWhole) {
    geometry::TriangleMesh mesh;
    const std::size_t vertices = kMostPieceBytes / sizeof(Vec3) + 1000;
    for (std::size_t i = 0; i < vertices; ++i)
        mesh.positions_m.push_back(Vec3(1e-6 * static_cast<double>(i), 0.0, 0.0));
    mesh.triangles = {{0, 1, static_cast<std::uint32_t>(vertices - 1)}};
    std::vector<SceneObject> objects{test::object_at(1, test::shared_mesh(mesh), Vec3(0.0))};
    const Pages pages = saved(objects);
    EXPECT_EQ(pages.pages.size(), 3u);
    const auto loaded = load_objects(pages, "w.burin");
    ASSERT_TRUE(loaded);
    expect_same(loaded->objects[0], objects[0]);
}

}  // namespace burin::scene
