// SPDX-License-Identifier: MIT
// Tests that an exercise's ball falls on the objects of its world as these are turned, moved and scaled.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/rehab.hpp"
#include "bodies/soft_part.hpp"
#include "scene/scene_object.hpp"
#include "session/objects/world_objects.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::activities {
namespace {

constexpr double kHalfOfBox_m = 0.04;  // of the boxes' meshes
constexpr double kAsideAndUp_m = 0.5;  // where a box stands that is no one's neighbour

std::shared_ptr<const scene::SceneObject> box_at(scene::ObjectId id, const Pose& pose, double scale, bool felt = true) {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    for (int i = 0; i < 8; ++i)
        mesh->positions_m.push_back({(i & 1) != 0 ? kHalfOfBox_m : -kHalfOfBox_m,
                                     (i & 2) != 0 ? 0.5 * kHalfOfBox_m : -0.5 * kHalfOfBox_m,
                                     (i & 4) != 0 ? 1.5 * kHalfOfBox_m : -1.5 * kHalfOfBox_m});
    auto object = std::make_shared<scene::SceneObject>();
    object->id = id;
    object->name = "box " + std::to_string(id);
    object->mesh = mesh;
    object->pose = pose;
    object->scale = scale;
    object->felt = felt;
    return object;
}

// Returns the height of the box's highest corner: of its middle, and of each half axis' share along +Y.
double top_m(const Pose& pose, double scale) {
    const glm::dmat3 turn = glm::mat3_cast(pose.orientation);
    return pose.position_m.y +
           scale * kHalfOfBox_m * (std::abs(turn[0].y) + 0.5 * std::abs(turn[1].y) + 1.5 * std::abs(turn[2].y));
}

// An exercise whose ball may fall, in a world of boxes.
class FallingBall {
public:
    explicit FallingBall(session::WorldObjects world)
        : world_(std::move(world)), exercise_(ball_kind().make(SettingValues(ball_kind().settings))) {
        body_ = dynamic_cast<bodies::SoftPart*>(exercise_.scene_part());
        session::ActivityOrders orders;
        const std::array hands{session::HandView{}};
        exercise_.step({0, hands, {}, &world_}, orders);
        for (const auto& order : orders.on_scene) order();
    }
    // Drops the ball from above a place; returns how high its middle is in the end.
    double rests_at_m(const Vec3& above_m) {
        now_ns_ += 4'000'000;
        body_->frame().fly({above_m, Vec3(0.0), {}}, now_ns_);
        for (int i = 0; i < 3000 && body_->frame().flies(); ++i)
            EXPECT_TRUE(body_->update(now_ns_ += 4'000'000, nullptr));
        return body_->frame().pose().position_m.y;
    }
    [[nodiscard]] double radius_m() const { return body_->setup().half_axes_m.x; }
    [[nodiscard]] scene::ObjectId own() const { return body_->setup().object; }
    static const ExerciseKind& ball_kind() { return *exercise_named("ball"); }

private:
    session::WorldObjects world_;
    Rehab exercise_;
    bodies::SoftPart* body_ = nullptr;
    Nanoseconds now_ns_ = 0;
};

Vec3 aside_m(std::size_t i) { return {1.0 + static_cast<double>(i), 0.0, 0.7 * static_cast<double>(i)}; }

}  // namespace

TEST(FallingBall, LiesOnBoxesAsTheyAreTurnedMovedAndScaledInTheWorld) {
    session::WorldObjects world;
    std::vector<std::pair<Pose, double>> boxes;
    for (std::size_t i = 0; i < kUnevenPoses; ++i) {
        const Pose pose{aside_m(i) + uneven_offset(i), uneven_turn(i)};
        // The second object is the exercise's own ball, which takes part in nothing.
        world.objects.push_back(i == 1 ? box_at(2, Pose{}, 1.0)
                                       : box_at(static_cast<scene::ObjectId>(i + 1), pose, kUnevenScales[i]));
        if (i != 1) boxes.emplace_back(pose, kUnevenScales[i]);
    }
    FallingBall ball(world);
    ASSERT_EQ(ball.own(), 2u);
    for (const auto& [pose, scale] : boxes) {
        const Vec3 above_m(pose.position_m.x, top_m(pose, scale) + 0.1, pose.position_m.z);
        EXPECT_NEAR(ball.rests_at_m(above_m), top_m(pose, scale) + ball.radius_m(), 1e-6) << "scale " << scale;
    }
}

TEST(FallingBall, FallsPastWhatIsNotFeltAndPastItsOwn) {
    session::WorldObjects world;
    const Pose floor{{0.0, -1.0, 0.0}, Quat(1.0, 0.0, 0.0, 0.0)};
    world.objects = {box_at(1, floor, 100.0), box_at(2, {{2.0, kAsideAndUp_m + 2.0, 0.0}, uneven_turn(0)}, 1.7),
                     box_at(3, {{-2.0, kAsideAndUp_m + 2.0, 0.0}, uneven_turn(1)}, 1.7, false),
                     box_at(4, {{0.0, kAsideAndUp_m + 2.0, 2.0}, uneven_turn(2)}, 1.7)};
    FallingBall ball(world);
    const double floor_m = top_m(floor, 100.0), from_m = kAsideAndUp_m + 2.5;
    EXPECT_NEAR(ball.rests_at_m({2.0, from_m, 0.0}), floor_m + ball.radius_m(), 1e-6) << "its own";
    EXPECT_NEAR(ball.rests_at_m({-2.0, from_m, 0.0}), floor_m + ball.radius_m(), 1e-6) << "not felt";
    EXPECT_NEAR(ball.rests_at_m({0.0, from_m, 2.0}), top_m(world.objects[3]->pose, 1.7) + ball.radius_m(), 1e-6);
}

}  // namespace burin::activities
