// SPDX-License-Identifier: MIT
// What the haptic thread finds in the surfaces of a scene.
#include <gtest/gtest.h>

#include "geometry/contact/gridded_triangles.hpp"
#include "tests/scene/scene_samples.hpp"

namespace burin::scene {
namespace {

// Adds what it is told to.
class ToldPart final : public ScenePart {
public:
    Result<void> update(Nanoseconds, const PartSeen*) override { return {}; }
    const PartSeen& seen() const override { return seen_; }
    Result<void> add_near(const ProbeBall&, geometry::LocalSurface& draft) override {
        was_empty = was_empty && draft.meshes.empty() && draft.tiles.places.empty() && draft.tiles.triangles == 0 &&
                    !draft.loose && draft.sequence == 0;
        if (fails) return fail("part", "cannot go on");
        draft.meshes = meshes;
        draft.loose = loose;
        draft.tiles = tiles;
        draft.radius_m = std::min(draft.radius_m, knows_m);
        return {};
    }
    Nanoseconds period_ns() const override { return 10'000'000; }
    void finish() override {}

    std::vector<geometry::TouchedMesh> meshes;
    std::shared_ptr<const geometry::GriddedTriangles> loose;
    geometry::TileBlock tiles;
    double knows_m = 1.0;
    bool fails = false, was_empty = true;

private:
    PartSeen seen_;
};

std::shared_ptr<const geometry::TouchSnapshot> cube_snapshot() {
    return geometry::TouchMesh::create(geometry::test::cube(0.01))->snapshot();
}

geometry::TouchedMesh cube_at(const std::shared_ptr<const geometry::TouchSnapshot>& snapshot, const Vec3& at_m,
                              std::uint64_t body = 0) {
    geometry::TouchedMesh mesh{snapshot};
    mesh.motion.body = body;
    mesh.motion.object_from_mesh.position_m = at_m;
    return mesh;
}

struct Published {
    TouchPublisher::Slot slot;
    TouchPublisher publisher{std::vector<TouchPublisher::Slot*>{&slot}};
    ToldPart part;

    const geometry::LocalSurface& publish(double radius_m = 1.0, Nanoseconds now_ns = 1) {
        ScenePart* const parts[] = {&part};
        (void)publisher.publish({0, Vec3(0.0), radius_m}, parts, now_ns);
        return slot.newest();
    }
};

TEST(TouchPublisher, ADraftKeepsNothingOfThreePublicationsAgo) {
    Published scene;
    auto snapshot = cube_snapshot();
    auto loose = std::make_shared<geometry::GriddedTriangles>();
    auto tile = std::make_shared<geometry::SurfaceTile>();
    scene.part.meshes = {cube_at(snapshot, Vec3(0.0))};
    scene.part.loose = loose;
    scene.part.tiles.places.push_back({tile, 0});
    scene.part.tiles.triangles = 3;
    (void)scene.publish();
    scene.part.meshes.clear();
    scene.part.loose.reset();
    scene.part.tiles = {};
    for (int i = 0; i < 4; ++i) EXPECT_EQ(scene.publish().meshes.size(), 0u) << i;
    EXPECT_TRUE(scene.part.was_empty) << "no part finds what another publication has left";
    EXPECT_EQ(snapshot.use_count(), 1) << "what nobody publishes any more is let go";
    EXPECT_EQ(loose.use_count(), 1);
    EXPECT_EQ(tile.use_count(), 1);
}

TEST(TouchPublisher, StampsSequenceTimeAndTheBall) {
    Published scene;
    EXPECT_EQ(scene.publish(0.5, 70).sequence, 1u);
    const geometry::LocalSurface& second = scene.publish(0.25, 80);
    EXPECT_EQ(second.sequence, 2u);
    EXPECT_EQ(second.made_ns, 80);
    EXPECT_EQ(second.radius_m, 0.25);
    scene.part.knows_m = 0.1;
    EXPECT_EQ(scene.publish(0.25, 90).radius_m, 0.1) << "a part may know less";
    EXPECT_EQ(scene.publisher.published(0), 3u);
    scene.part.fails = true;
    ScenePart* const parts[] = {&scene.part};
    EXPECT_FALSE(scene.publisher.publish({0, Vec3(0.0), 1.0}, parts, 100).has_value());
    EXPECT_EQ(scene.slot.newest().sequence, 3u) << "nothing is published where a part fails";
}

TEST(TouchPublisher, PutsWhatMovesFirstAndTheNearerBeforeTheFarther) {
    Published scene;
    const auto snapshot = cube_snapshot();
    scene.part.meshes = {cube_at(snapshot, {0.2, 0.0, 0.0}), cube_at(snapshot, {0.1, 0.0, 0.0}),
                         cube_at(snapshot, {0.4, 0.0, 0.0}, 7), cube_at(snapshot, {0.3, 0.0, 0.0}, 9)};
    std::vector<double> at_m;
    for (const geometry::TouchedMesh& mesh : scene.publish().meshes)
        at_m.push_back(mesh.motion.object_from_mesh.position_m.x);
    EXPECT_EQ(at_m, (std::vector<double>{0.3, 0.4, 0.1, 0.2}));
}

TEST(TouchPublisher, LeavesOutTheFarthestOfTooManyAndEndsTheBallBeforeThem) {
    const auto snapshot = cube_snapshot();
    constexpr std::uint32_t kFollowed = geometry::PosedSurface::kMostFollowed;
    Published moving;
    for (std::uint64_t i = 0; i < kFollowed + 5; ++i)
        moving.part.meshes.push_back(cube_at(snapshot, {0.02 * static_cast<double>(i + 1), 0.0, 0.0}, 100 - i));
    const geometry::LocalSurface& some = moving.publish(10.0);
    ASSERT_EQ(some.meshes.size(), kFollowed);
    EXPECT_NEAR(some.radius_m, 0.02 * (kFollowed + 1) - 0.01, 1e-6) << "up to the first that is left out";
    Published resting;
    for (std::uint32_t i = 0; i < TouchPublisher::kMaxMeshes + 1; ++i)
        resting.part.meshes.push_back(cube_at(snapshot, {0.02 * (i + 1), 0.0, 0.0}));
    EXPECT_EQ(resting.publish(10.0).meshes.size(), TouchPublisher::kMaxMeshes);
    EXPECT_LT(resting.slot.newest().radius_m, 0.02 * (TouchPublisher::kMaxMeshes + 1));
}

TEST(TouchPublisher, LeavesOutWhatCannotBeTouched) {
    Published scene;
    const auto snapshot = cube_snapshot();
    geometry::TouchedMesh torn = cube_at(snapshot, Vec3(0.0), 3);
    torn.motion.velocity_object_m_per_s.x = NAN;
    scene.part.meshes = {torn, cube_at(snapshot, {NAN, 0.0, 0.0}), geometry::TouchedMesh{}};
    EXPECT_EQ(scene.publish().meshes.size(), 0u);
    EXPECT_EQ(scene.slot.newest().radius_m, 1.0);
}

TEST(TouchPublisher, AMaterialThatATickDoesNotKnowIsRefusedWithTheObjectsNumberAndNotFeltAsAnother) {
    Published scene;
    geometry::TouchedMesh cube = cube_at(cube_snapshot(), Vec3(0.0));
    cube.object = 7;
    cube.material = haptics::kMostMaterials - 1;
    scene.part.meshes = {cube};
    EXPECT_EQ(scene.publish().meshes.size(), 1u) << "the last that there is";
    scene.part.meshes[0].material = haptics::kMostMaterials;
    ScenePart* const parts[] = {&scene.part};
    const Result<void> refused = scene.publisher.publish({0, Vec3(0.0), 1.0}, parts, 2);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().where, "object 7");
    EXPECT_TRUE(refused.error().what.contains("material 16")) << refused.error().line();
    EXPECT_FALSE(refused.error().remedy.empty());
    EXPECT_EQ(scene.slot.newest().sequence, 1u) << "nothing is published";
}

TEST(TouchPublisher, WhatMovesIsAsNearAsItsVelocityTakesIt) {
    const auto snapshot = cube_snapshot();
    geometry::TouchedMesh mesh = cube_at(snapshot, {0.11, 0.0, 0.0}, 1);
    EXPECT_NEAR(distance_ahead_m(mesh, Vec3(0.0)), 0.1, 1e-6);
    mesh.motion.velocity_object_m_per_s.x = -1.0;
    EXPECT_NEAR(distance_ahead_m(mesh, Vec3(0.0)), 0.1 - kAhead_s, 1e-6);
    mesh.motion.angular_velocity_object_rad_per_s.y = 1.0;
    EXPECT_LT(distance_ahead_m(mesh, Vec3(0.0)), 0.1 - kAhead_s);
    mesh.motion.body = 0;
    EXPECT_NEAR(distance_ahead_m(mesh, Vec3(0.0)), 0.1, 1e-6) << "what rests has no velocity";
}

}  // namespace
}  // namespace burin::scene
