// SPDX-License-Identifier: MIT
// A hand in scenes of any scale and turn, with objects that are turned and scaled: what it holds, points at and how it
// is drawn is the same as in a scene of its own size.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "haptics/tick_parameters.hpp"
#include "picture/drawn_mesh.hpp"
#include "scene/object_property.hpp"
#include "shaders/shared/frame_uniforms.h"
#include "tests/activities/acted_hand.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::activities {
namespace {

using scene::ObjectProperty;

// An octahedron, all of whose corners are at one distance; or a block.
std::shared_ptr<const geometry::TriangleMesh> corners_of(bool is_round, double half_m, const Vec3& middle_m = {}) {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    for (const double sign : {-half_m, half_m})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 corner(is_round ? 0.0 : 0.6 * sign);
            corner[axis] = sign;
            mesh->positions_m.push_back(middle_m + corner);
        }
    return mesh;
}

// Where the middle of a thing is in its file: nowhere near its origin.
Vec3 middle_in_file_m(std::size_t thing) { return 2.0 * uneven_offset(thing + 2); }

// Things with their middles at uneven places, each of another colour, as they are in a scene.
session::WorldObjects things_in(const Similarity& scene_from_room, std::size_t count) {
    session::WorldObjects world;
    for (std::size_t i = 0; i < count; ++i) {
        scene::SceneObject object;
        object.id = static_cast<scene::ObjectId>(i + 1);
        object.name = "thing " + std::to_string(i);
        const Vec3 apart(0.3 * static_cast<double>(i), 0.0, 0.0);
        object.scale = scene_from_room.scale * kUnevenScales[i];
        object.pose.orientation = scene_from_room.orientation * uneven_turn(i);
        object.pose.position_m = scene_from_room * (apart + uneven_offset(i)) -
                                 object.pose.orientation * (object.scale * middle_in_file_m(i));
        object.mesh = corners_of(i % 2 == 0, 0.02, middle_in_file_m(i));
        for (std::size_t k = 0; k < 3; ++k) object.colour[k] = static_cast<std::uint8_t>(30 + 20 * i + 45 * k);
        world.objects.push_back(std::make_shared<const scene::SceneObject>(object));
    }
    return world;
}

// The colours of all things, as edits have left them.
class Colours {
public:
    explicit Colours(const session::WorldObjects& world) {
        for (const auto& object : world.objects) now_[object->name] = value_of(*object, ObjectProperty::colour);
        first_ = now_;
    }
    void take(const session::ActivityOrders& orders) {
        for (const auto& edit : orders.edits)
            if (edit.property == ObjectProperty::colour) now_[edit.object] = edit.value;
    }
    [[nodiscard]] std::set<std::string> lit_up() const {
        std::set<std::string> names;
        for (const auto& [name, colour] : now_)
            if (colour != first_.at(name)) names.insert(name);
        return names;
    }

private:
    std::map<std::string, scene::PropertyValue> now_, first_;
};

const std::vector<Similarity> kScenes{
    {},
    {uneven_offset(0), uneven_turn(0), 1.7},
    {uneven_offset(1), uneven_turn(1), 10.0},
    {uneven_offset(2), uneven_turn(2), 0.3},
};

HandReading read_of(const ActedHand& acted) {
    std::array<haptics::TickRecord, kFelt> ticks;
    for (std::size_t i = 0; i < kFelt; ++i) ticks[i] = acted.tick(i);
    return reading_of({&ticks[0], &ticks[1], &ticks[2], &ticks[3]});
}

}  // namespace

TEST(PointingHand, LeavesNothingLitUpWhenItsGloveIsLostOrItPointsNoMore) {
    enum class Ends { is_lost, opens, holds, points_elsewhere };
    for (const Similarity& scene : kScenes) {
        const session::WorldObjects world = things_in(scene, 3);
        Grasp activity({});
        ActedHand hand;
        hand.be_in(scene);
        Colours colours(world);
        const auto go_on = [&](int turns) {
            const auto orders = hand.go_on(activity, turns, world);
            colours.take(orders);
            return orders;
        };
        // One activity does it all, thing by thing and twice, so that nothing is kept of the time before.
        for (int times = 0; times < 2; ++times)
            for (std::size_t thing = 0; thing < 3; ++thing)
                for (const Ends ends : {Ends::is_lost, Ends::opens, Ends::holds, Ends::points_elsewhere}) {
                    const std::string name = "thing " + std::to_string(thing);
                    const std::string of = name + ", ends " + std::to_string(static_cast<int>(ends)) + ", scale " +
                                           std::to_string(scene.scale);
                    hand.be_lost(false);
                    hand.touch_nothing();
                    const scene::SceneObject& at = *world.objects[thing];
                    hand.point_at(at.pose * (at.scale * middle_in_file_m(thing)), 0.1, uneven_turn(thing + 1));
                    go_on(150);
                    EXPECT_EQ(colours.lit_up(), std::set{name}) << of;
                    EXPECT_EQ(activity.panel().rows().size(), 1u) << of;
                    if (ends == Ends::is_lost) hand.be_lost(true);
                    if (ends == Ends::opens) hand.bend(devices::GripShape::whole, 0.1);
                    if (ends == Ends::points_elsewhere)
                        hand.point_at(scene * Vec3(0.0, 3.0, 0.0), 0.1, uneven_turn(thing + 1));
                    if (ends == Ends::holds) {
                        hand.bend(devices::GripShape::whole, 0.7);
                        hand.touch(0, 2, {0.0, 0.0, -1.0});
                        hand.touch(1, 2, {0.0, 0.1, 1.0});
                    }
                    go_on(150);
                    EXPECT_EQ(colours.lit_up(), std::set<std::string>{}) << of;
                    EXPECT_EQ(activity.panel().rows().size(), ends == Ends::holds ? 1u : 0u) << of;
                    EXPECT_EQ(activity.gesture().grasps(), ends == Ends::holds) << of;
                    // Lost with something in it, too.
                    hand.be_lost(true);
                    go_on(150);
                    EXPECT_EQ(colours.lit_up(), std::set<std::string>{}) << of;
                    EXPECT_TRUE(activity.panel().rows().empty()) << of;
                }
    }
}

TEST(HandInAScene, OfAnyScaleHoldsAndLetsGoAsInOneOfItsOwnSize) {
    for (const Similarity& scene : kScenes) {
        const session::WorldObjects world = things_in(scene, 3);
        for (scene::ObjectId thing = 1; thing <= 3; ++thing) {
            Grasp activity({});
            ActedHand hand;
            hand.be_in(scene);
            hand.bend(devices::GripShape::whole, 0.7);
            hand.touch(0, thing, {0.0, 0.0, -1.0});
            hand.touch(2, thing, {0.0, 0.1, 1.0});
            hand.touch(3, thing, {0.1, 0.1, 1.0});
            const std::string name = world.find(thing)->name;
            const auto begun = hand.go_on(activity, 50, world);
            ASSERT_EQ(begun.holds.size(), 1u) << name << " at scale " << scene.scale;
            EXPECT_EQ(begun.holds[0], (session::HoldObject{name, {{0, 0}, {0, 2}, {0, 3}}, true}));
            const Pose there{Vec3(0.1, 0.2, 0.3) + uneven_offset(3), glm::normalize(Quat(0.7, -0.6, 0.2, 0.1))};
            hand.move_to(there);
            EXPECT_TRUE(hand.go_on(activity, 50, world).holds.empty());
            EXPECT_LT(
                glm::length(activity.grasps()[0].carried_m - scene.scale * (scene.orientation * uneven_offset(3))),
                1e-9)
                << "as far as the hand has gone, in the scene";
            hand.touch_nothing();
            hand.bend(devices::GripShape::whole, 0.2);
            const auto ended = hand.go_on(activity, 200, world);
            ASSERT_EQ(ended.holds.size(), 1u);
            EXPECT_EQ(ended.holds[0], (session::HoldObject{name, {}, false}));
        }
    }
}

TEST(HandInAScene, OfAnyScaleTakesNothingThatIsTooLargeForIt) {
    for (const Similarity& scene : kScenes)
        for (const double half_m : {0.06, 0.3}) {  // the balls around the block: 0.10 and 0.52 m
            session::WorldObjects world;
            scene::SceneObject object;
            object.id = 1;
            object.name = "block";
            object.pose = {scene.position_m, scene.orientation};
            object.scale = scene.scale;
            object.mesh = corners_of(false, half_m);
            world.objects.push_back(std::make_shared<const scene::SceneObject>(object));
            Grasp activity({});
            ActedHand hand;
            hand.be_in(scene);
            hand.point_at(scene.position_m, 0.5, uneven_turn(1));
            EXPECT_EQ(hand.go_on(activity, 50, world).edits.size(), half_m < 0.1 ? 1u : 0u)
                << half_m << " pointed at, at scale " << scene.scale;
            hand.bend(devices::GripShape::whole, 0.7);
            hand.touch(0, 1, {0.0, 0.0, -1.0});
            hand.touch(1, 1, {0.0, 0.1, 1.0});
            EXPECT_EQ(hand.go_on(activity, 50, world).holds.size(), half_m < 0.1 ? 1u : 0u)
                << half_m << " at scale " << scene.scale;
        }
}

TEST(HandInAScene, OfAnyScaleIsSetFreeWhereItStaysBehindAThing) {
    for (const Similarity& scene : kScenes)
        for (std::size_t finger = 0; finger < kFelt; ++finger)
            for (const double depth_m : {0.015, 0.06}) {
                const session::WorldObjects world = things_in(scene, 1);
                Grasp activity({});
                ActedHand hand;
                hand.be_in(scene);
                hand.bend(devices::GripShape::pinch, 0.2);
                hand.touch(finger, 1, uneven_direction(finger));
                hand.press(depth_m);
                const auto orders = hand.go_on(activity, 400, world);
                EXPECT_EQ(orders.parameters, depth_m > 0.03) << finger << " at scale " << scene.scale;
                for (std::size_t other = 0; other < kFelt; ++other) {
                    haptics::TickParameters parameters;
                    activity.adjust({0, other}, parameters);
                    const bool is_set = depth_m > 0.03 && other == finger;
                    EXPECT_EQ(parameters.placement.number > 0, is_set) << other;
                    if (!is_set) continue;
                    EXPECT_LT(glm::distance(parameters.placement.position_object_m,
                                            hand.tick(other).contact.points[0].hip_object_m),
                              1e-9 * scene.scale);
                }
            }
}

// A fingertip that is 6 mm inside a thing, in the hand's own metres, is drawn so much farther out in every scene.
TEST(HandInAScene, OfAnyScaleIsDrawnWithItsTipsOnTheSurface) {
    constexpr double kInside_m = 0.006;
    for (const Similarity& scene : kScenes)
        for (std::size_t finger = 0; finger < kFelt; ++finger) {
            ActedHand acted;
            acted.be_in(scene);
            acted.move_to(uneven_pose(finger));
            acted.bend(devices::GripShape::whole, 0.7);
            HandReading hand = read_of(acted);
            EXPECT_NEAR(hand.scene_from_hand.scale, scene.scale, 1e-12);
            const auto& chain = devices::usual_hand()[finger];
            const devices::FingertipPlace place = devices::place_of(chain, hand.bend[finger]);
            hand.fingers[finger].object = 1;
            hand.fingers[finger].out_scene_m =
                hand.scene_from_hand.scale * (hand.scene_from_hand.orientation * (-kInside_m * place.flexes_hand));
            const geometry::HandBend drawn = drawn_bend(hand);
            const Vec3 moved_m =
                devices::place_of(chain, drawn[finger]).hand_from_tip.position_m - place.hand_from_tip.position_m;
            EXPECT_NEAR(glm::dot(moved_m, -place.flexes_hand), kInside_m, 1e-4) << finger << " at " << scene.scale;
            EXPECT_EQ(drawn[finger][0], hand.bend[finger][0]) << "it is opened, and not led sideways";
            for (std::size_t other = 0; other < kFelt; ++other)
                if (other != finger) {
                    EXPECT_EQ(drawn[other], hand.bend[other]) << other << " touches nothing";
                }
            EXPECT_EQ(drawn[4], drawn[3]) << "the little finger follows the ring";
        }
}

// ---- Shadows

namespace {

picture::DrawnObject drawn_of(const scene::SceneObject& object) {
    auto mesh = std::make_shared<picture::DrawnMesh>();
    for (const Vec3& p : object.mesh->positions_m) mesh->bounds.include(p);
    return {mesh, Similarity{object.pose.position_m, object.pose.orientation, object.scale}};
}

}  // namespace

TEST(HandInAScene, SparesEachBallTheShadowOfItsOwn) {
    for (const std::size_t unseen : {4u, 0u, 1u, 2u, 3u}) {
        session::WorldObjects world = things_in({}, 4);  // 0 and 2 are balls
        picture::Picture scene;
        scene.world_from_object = {uneven_offset(3), uneven_turn(3), 2.3};
        scene.capsules.push_back({Vec3(1.0), Vec3(2.0), 0.1});  // of something else
        std::vector<std::size_t> seen;
        for (std::size_t i = 0; i < world.objects.size(); ++i) {
            scene::SceneObject object = *world.objects[i];
            object.seen = i != unseen;
            if (object.seen) scene.objects.push_back(drawn_of(object));
            if (object.seen) seen.push_back(i);
            world.objects[i] = std::make_shared<const scene::SceneObject>(object);
        }
        Grasp activity({});
        ActedHand hand;
        hand.bend(devices::GripShape::whole, 0.3);
        hand.go_on(activity, 3, world);
        activity.stage(scene, 0);
        std::set<std::int32_t> taken;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const picture::DrawnObject& object = scene.objects[i];
            if (seen[i] % 2 != 0) {
                EXPECT_EQ(object.own_capsule, picture::kNoCapsule) << "a block has none";
                continue;
            }
            ASSERT_GE(object.own_capsule, 0) << seen[i];
            ASSERT_LT(static_cast<std::size_t>(object.own_capsule), scene.capsules.size());
            EXPECT_TRUE(taken.insert(object.own_capsule).second) << "each has its own";
            const picture::PictureCapsule& own = scene.capsules[static_cast<std::size_t>(object.own_capsule)];
            EXPECT_LT(glm::distance(own.from_world, object.world_from_mesh * object.mesh->bounds.center()), 1e-12)
                << seen[i];
            EXPECT_EQ(own.from_world, own.to_world);
            EXPECT_NEAR(own.radius_m, 0.02 * kUnevenScales[seen[i]], 1e-12);
        }
        EXPECT_EQ(taken.size(), unseen == 0 || unseen == 2 ? 1u : 2u);
    }
}

TEST(HandInAScene, KeepsRoomForTheShadowsOfTheHandAmongManyBalls) {
    session::WorldObjects world;
    picture::Picture scene;
    for (std::size_t i = 0; i < 2 * shared::kMostCapsules; ++i) {
        scene::SceneObject object;
        object.id = static_cast<scene::ObjectId>(i + 1);
        object.name = "ball " + std::to_string(i);
        object.pose.position_m = Vec3(0.3 * static_cast<double>(i), 1.0, 2.0);
        object.mesh = corners_of(true, 0.02);
        scene.objects.push_back(drawn_of(object));
        world.objects.push_back(std::make_shared<const scene::SceneObject>(object));
    }
    Grasp activity({});
    ActedHand hand;
    hand.bend(devices::GripShape::whole, 0.3);
    hand.go_on(activity, 3, world);
    activity.stage(scene, 0);
    EXPECT_LE(scene.capsules.size(), static_cast<std::size_t>(shared::kMostCapsules));
    std::size_t without = 0;
    for (const picture::DrawnObject& object : scene.objects) {
        if (object.own_capsule < 0) {
            ++without;
            continue;
        }
        const auto& own = scene.capsules.at(static_cast<std::size_t>(object.own_capsule));
        EXPECT_EQ(own.from_world, object.world_from_mesh.position_m);
    }
    EXPECT_GT(without, 0u);
}

}  // namespace burin::activities
