// SPDX-License-Identifier: MIT
// A body that turns moves a point of its surface by its own velocity and by w x r, r from the body's origin. Bodies,
// turns and places are uneven, both senses are tried, and no body lies at the object's origin.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "haptics/contact/moving_bodies.hpp"
#include "tests/haptics/bodies.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::haptics {
namespace {

constexpr double kTurnTick_s = 1e-3;

// Returns w x r, component by component.
Vec3 turning_velocity(const Vec3& w, const Vec3& r) {
    return {w.y * r.z - w.z * r.y, w.z * r.x - w.x * r.z, w.x * r.y - w.y * r.x};
}

void expect_vector(const Vec3& found, const Vec3& expected, double within, const std::string& what) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], within) << what << ", axis " << k;
}

// Three bodies that turn, with meshes that rest before, between and behind them.
struct ThreeTurning {
    static constexpr std::array<std::size_t, 3> kMeshes{1, 3, 4};
    std::array<geometry::MeshMotion, 3> motions;
    geometry::LocalSurface surface;

    explicit ThreeTurning(double sense) {
        const test::Snapshot plate = test::plate(0.01, 0.002, 1);
        surface = test::around(std::vector<geometry::TouchedMesh>(6, {plate, 0}));
        for (std::size_t i = 0; i < 3; ++i) {
            geometry::MeshMotion& motion = motions[i];
            motion.body = 40 - i;  // names in another order than the bodies
            motion.object_from_mesh = uneven_pose(i);
            motion.velocity_object_m_per_s = kUnevenScales[i] * uneven_offset(i + 2);
            motion.angular_velocity_object_rad_per_s = sense * (2.0 + static_cast<double>(i)) * uneven_direction(i + 1);
            motion.time_ns = 1'000'000'000 + static_cast<Nanoseconds>(i) * 3'000'000;
            surface.meshes[kMeshes[i]].motion = motion;
        }
    }
    // The first triangle of a mesh.
    [[nodiscard]] std::uint32_t triangle_of(std::size_t mesh) const {
        std::uint32_t first = 0;
        for (std::size_t i = 0; i < mesh; ++i) first += surface.meshes[i].snapshot->triangles();
        return first;
    }
};

}  // namespace

TEST(TurningBodies, EveryPointOfEveryBodyHasTheVelocityOfItsTurning) {
    for (const double sense : {1.0, -1.0}) {
        const ThreeTurning three(sense);
        const Nanoseconds now_ns = 1'012'000'000;
        BodiesState state;
        for (const Nanoseconds at_ns : {now_ns - 1'000'000, now_ns}) {
            const MovingBodies bodies(state, three.surface, at_ns, 0.5);
            for (std::size_t i = 0; i < 3; ++i) {
                const geometry::MeshMotion& motion = three.motions[i];
                const Vec3 middle = motion.object_from_mesh.position_m +
                                    seconds(at_ns - motion.time_ns) * motion.velocity_object_m_per_s;
                for (std::size_t k = 0; k < kUnevenPoses; ++k) {
                    const Vec3 place = middle + kUnevenScales[k] * uneven_offset(k);
                    const Vec3 expected = motion.velocity_object_m_per_s +
                                          turning_velocity(motion.angular_velocity_object_rad_per_s, place - middle);
                    const std::string what = "body " + std::to_string(i) + ", place " + std::to_string(k);
                    expect_vector(bodies.velocity(three.triangle_of(ThreeTurning::kMeshes[i]), place), expected, 1e-12,
                                  what + " by its triangle");
                    // By its name it is known from its second tick on.
                    expect_vector(bodies.velocity_of_body(motion.body, place), at_ns == now_ns ? expected : Vec3(0.0),
                                  1e-12, what + " by its name");
                }
            }
            for (const std::size_t resting : {0u, 2u, 5u})
                EXPECT_EQ(bodies.velocity(three.triangle_of(resting), uneven_offset(1)), Vec3(0.0)) << resting;
            EXPECT_EQ(bodies.velocity_of_body(99, uneven_offset(1)), Vec3(0.0)) << "there is no such body";
        }
    }
}

// A point that is fixed to a turning body goes where its velocity takes it: the pose that is followed and the velocity
// that is told agree.
TEST(TurningBodies, CarryAPointAsFastAsTheyTellThatItMoves) {
    for (const double sense : {1.0, -1.0}) {
        const ThreeTurning three(sense);
        constexpr Nanoseconds kNow_ns = 1'012'000'000, kStep_ns = 10'000;
        BodiesState state;
        {
            const MovingBodies first(state, three.surface, kNow_ns - kStep_ns, 0.5);
        }
        const MovingBodies bodies(state, three.surface, kNow_ns, 0.5);
        for (std::uint32_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < kUnevenPoses; ++k) {
                const Vec3 before = three.motions[i].object_from_mesh.position_m + uneven_offset(k);
                const Vec3 now = bodies.carried(i, before);
                const Vec3 told = bodies.velocity(three.triangle_of(ThreeTurning::kMeshes[i]), now);
                // Within half of the acceleration over the step: 0.5 w^2 r T.
                expect_vector((now - before) / seconds(kStep_ns), told, 1e-5, "body " + std::to_string(i));
                EXPECT_LT(glm::length(bodies.unexplained(i, now)), 1e-15);
            }
    }
}

TEST(TurningBodies, ThatAreNotPublishedAnyMoreStandAndMoveNoPoint) {
    const ThreeTurning three(1.0);
    BodiesState state;
    for (const Nanoseconds now_ns : {1'099'000'000, 1'100'000'000}) {
        const MovingBodies bodies(state, three.surface, now_ns, 0.05);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(bodies.velocity(three.triangle_of(ThreeTurning::kMeshes[i]), uneven_offset(3)), Vec3(0.0)) << i;
    }
}

namespace {

// A plate in an uneven pose under a hand at rest, through an uneven mapping at scale 1.7. The hand is off the plate's
// middle, pressed in by some depth along the plate's normal.
struct HandOnPlate {
    Pose object_from_plate = uneven_pose(0);
    Similarity object_from_device{uneven_offset(2), uneven_turn(3), kUnevenScales[0]};
    Vec3 place_plate_m{0.031, 0.0, -0.019};
    double ball_m = 0.004, depth_device_m = 0.002, stiffness_N_per_m = 600.0, damping_Ns_per_m = 4.0;
    double friction = 0.0;

    [[nodiscard]] Vec3 normal() const { return object_from_plate.orientation * Vec3(0.0, 1.0, 0.0); }
    // Where the hand is held, in the object frame.
    [[nodiscard]] Vec3 hip() const {
        const double height_m = ball_m - depth_device_m * object_from_device.scale;
        return object_from_plate * (place_plate_m + Vec3(0.0, height_m, 0.0));
    }
    [[nodiscard]] Vec3 at_device(const Vec3& of_object) const {
        return glm::conjugate(object_from_device.orientation) * of_object;
    }
    // `motion`: of the plate, whose pose at time 0 is object_from_plate.
    [[nodiscard]] test::Bodies bodies(const test::Motion& motion) const {
        test::Bodies made;
        made.parameters.passivity.control = false;
        made.parameters.probe = ball_probe(ball_m);
        made.parameters.workspace.object_from_device = object_from_device;
        made.parameters.materials[0].stiffness_N_per_m = stiffness_N_per_m;
        made.parameters.materials[0].damping_Ns_per_m = damping_Ns_per_m;
        made.parameters.materials[0].static_friction = made.parameters.materials[0].dynamic_friction = friction;
        made.publish_every = 1;
        made.surface = test::around({{test::plate(0.2, 0.01), 0}});
        made.motions = {motion};
        return made;
    }
    [[nodiscard]] Vec3 hand_device() const {
        return at_device(hip() - object_from_device.position_m) / object_from_device.scale;
    }
};

}  // namespace

// The plate rocks about a slanted axis, so that its surface comes and goes under the hand by w x r alone.
TEST(TurningBodies, APlateThatRocksUnderAHandOffItsMiddleIsFeltAsSpringAndDamperByItsTurning) {
    const HandOnPlate set;
    double fastest_N = 0.0;
    for (const std::size_t axis : {0u, 1u, 3u})
        for (const double sense : {1.0, -1.0}) {
            const Vec3 about = uneven_direction(axis);
            constexpr double kSwing_rad = 0.02, kRate_per_s = 31.0;
            const auto motion = [&](double time_s) {
                geometry::MeshMotion of;
                of.body = 5;
                of.object_from_mesh = set.object_from_plate;
                of.object_from_mesh.orientation =
                    glm::angleAxis(sense * kSwing_rad * std::sin(kRate_per_s * time_s), about) *
                    set.object_from_plate.orientation;
                of.angular_velocity_object_rad_per_s =
                    sense * kSwing_rad * kRate_per_s * std::cos(kRate_per_s * time_s) * about;
                return of;
            };
            test::Bodies bodies = set.bodies(motion);
            for (int i = 0; i < 700; ++i) {
                const geometry::MeshMotion now = motion(bodies.time_s());
                const TickRecord record = bodies.tick(set.hand_device());
                ASSERT_TRUE(record.in_contact()) << i;
                if (i < 400) continue;  // the ramp of the first contact
                const Vec3 normal = now.object_from_mesh.orientation * Vec3(0.0, 1.0, 0.0);
                const Vec3 from_middle = set.hip() - now.object_from_mesh.position_m;
                const double depth_m = set.ball_m - glm::dot(from_middle, normal), scale = set.object_from_device.scale;
                const Vec3 proxy = from_middle + depth_m * normal;
                const Vec3 moves = turning_velocity(now.angular_velocity_object_rad_per_s, proxy);
                expect_vector(record.contact.surface_velocity_device_m_per_s, set.at_device(moves) / scale, 1e-5,
                              "velocity told");
                const double damper_N = set.damping_Ns_per_m * glm::dot(moves, normal) / scale;
                const double expected_N = set.stiffness_N_per_m * depth_m / scale + damper_N;
                fastest_N = std::max(fastest_N, std::abs(damper_N));
                ASSERT_NEAR(glm::dot(record.gate.given.force_device_N, set.at_device(normal)), expected_N, 0.005)
                    << "tick " << i << ", axis " << axis << ", sense " << sense;
            }
        }
    EXPECT_GT(fastest_N, 0.02) << "the turning is felt";
}

// A turntable drags a hand that holds still by the friction cone, the way its surface goes there.
TEST(TurningBodies, ATurntableDragsAHandOffItsMiddleTheWayItsSurfaceGoesThere) {
    HandOnPlate set;
    set.friction = 0.4;
    for (const Vec3& place : {Vec3(0.031, 0.0, -0.019), Vec3(-0.023, 0.0, 0.041)})
        for (const double rate_rad_per_s : {-4.0, 1.5, 4.0}) {
            set.place_plate_m = place;
            const Vec3 turning = rate_rad_per_s * set.normal();
            test::Bodies bodies = set.bodies([&](double time_s) {
                geometry::MeshMotion of;
                of.body = 5;
                of.object_from_mesh = geometry::moved_on(set.object_from_plate, Vec3(0.0), turning, time_s);
                of.angular_velocity_object_rad_per_s = turning;
                return of;
            });
            TickRecord record;
            for (int i = 0; i < 900; ++i) record = bodies.tick(set.hand_device());
            ASSERT_TRUE(record.in_contact());
            const Vec3 moves = turning_velocity(turning, set.hip() - set.object_from_plate.position_m);
            const Vec3 normal = set.at_device(set.normal()), way = set.at_device(glm::normalize(moves));
            const Vec3 force = record.gate.given.force_device_N;
            const double pressed_N = glm::dot(force, normal);
            EXPECT_NEAR(pressed_N, set.stiffness_N_per_m * set.depth_device_m, 0.02);
            EXPECT_NEAR(glm::dot(force, way), set.friction * pressed_N, 0.05 * pressed_N) << rate_rad_per_s;
            EXPECT_NEAR(glm::dot(force, glm::cross(normal, way)), 0.0, 0.08 * pressed_N) << rate_rad_per_s;
            EXPECT_NEAR(glm::dot(record.contact.surface_velocity_device_m_per_s, way),
                        glm::length(moves) / set.object_from_device.scale,
                        0.15 * glm::length(moves) / set.object_from_device.scale);
        }
}

}  // namespace burin::haptics
