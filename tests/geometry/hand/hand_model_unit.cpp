// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "geometry/hand/fingertip_patch.hpp"
#include "geometry/hand/hand_model.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "tests/geometry/hand/hand_samples.hpp"

namespace burin::geometry {
namespace {

// Dual numbers a + b epsilon, and quaternions of them multiplied out by hand: another way to the same motion.
struct Dual {
    double a = 0.0, b = 0.0;
};
Dual operator+(Dual x, Dual y) { return {x.a + y.a, x.b + y.b}; }
Dual operator*(Dual x, Dual y) { return {x.a * y.a, x.a * y.b + x.b * y.a}; }
Dual operator-(Dual x) { return {-x.a, -x.b}; }
using DualFour = std::array<Dual, 4>;  // w, x, y, z

DualFour product(const DualFour& p, const DualFour& q) {
    return {p[0] * q[0] + -(p[1] * q[1]) + -(p[2] * q[2]) + -(p[3] * q[3]),
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] + -(p[3] * q[2]),
            p[0] * q[2] + -(p[1] * q[3]) + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] + -(p[2] * q[1]) + p[3] * q[0]};
}

// The motion from the joint's rest to where it is now: pose * rest^-1, as matrices, and from there as a dual quaternion
// 1/2 t q.
DualFour motion_between(const Pose& rest, const Pose& now) {
    const glm::dmat3 turn = glm::mat3_cast(now.orientation) * glm::transpose(glm::mat3_cast(rest.orientation));
    const Vec3 shift = now.position_m - turn * rest.position_m;
    const Quat q = glm::quat_cast(turn);
    const DualFour real{Dual{q.w, 0}, Dual{q.x, 0}, Dual{q.y, 0}, Dual{q.z, 0}};
    const DualFour moved{Dual{1, 0}, Dual{0, shift.x / 2}, Dual{0, shift.y / 2}, Dual{0, shift.z / 2}};
    return product(moved, real);
}

// Kavan's formula (2008, algorithm 1) component by component.
Vec3 reference_place(const HandModel& hand, const HandSkeleton& skeleton, std::size_t vertex) {
    DualFour sum{};
    DualFour first{};
    for (std::size_t k = 0; k < kInfluences; ++k) {
        const std::size_t joint = hand.bindings[vertex].joints[k];
        const DualFour motion = motion_between(hand.rest[joint], skeleton[joint]);
        if (k == 0) first = motion;
        double same = 0.0;
        for (std::size_t i = 0; i < 4; ++i) same += first[i].a * motion[i].a;
        const double weight = (same < 0.0 ? -1.0 : 1.0) * hand.bindings[vertex].weights[k];
        for (std::size_t i = 0; i < 4; ++i) sum[i] = sum[i] + Dual{weight, 0} * motion[i];
    }
    double length = 0.0;
    for (const Dual& c : sum) length += c.a * c.a;
    length = std::sqrt(length);
    const double w = sum[0].a / length;
    const Vec3 d(sum[1].a / length, sum[2].a / length, sum[3].a / length);
    const double we = sum[0].b / length;
    const Vec3 de(sum[1].b / length, sum[2].b / length, sum[3].b / length);
    const Vec3& v = hand.skin_m[vertex];
    return v + 2.0 * glm::cross(d, glm::cross(d, v) + w * v) + 2.0 * (w * de - we * d + glm::cross(d, de));
}

class BothHands : public testing::TestWithParam<const char*> {
protected:
    BothHands() : hand_(hand_of(GetParam())) {}
    HandModel hand_;
};
INSTANTIATE_TEST_SUITE_P(Hands, BothHands, testing::Values("left", "right"));

TEST_P(BothHands, ComeWithTheProgramAsTheyAreInTheirFile) {
    const HandModel& known = known_hand_model(hand_.is_left);
    EXPECT_EQ(known.skin_m, hand_.skin_m);
    EXPECT_EQ(known.bindings, hand_.bindings);
    EXPECT_EQ(known.triangles, hand_.triangles);
}

TEST_P(BothHands, AreClosedOnceWelded) {
    EXPECT_EQ(hand_.skin_m.size(), 1159u);
    EXPECT_EQ(hand_.triangles.size(), 2314u);
    const MeshHealth health = examine({hand_.skin_m, hand_.triangles, {}, {}, {}});
    EXPECT_TRUE(health.closed);
    EXPECT_TRUE(health.manifold());
    EXPECT_TRUE(health.consistently_oriented);
    EXPECT_FALSE(health.inside_out());
}

TEST_P(BothHands, LieAsTheirFrameSays) {
    EXPECT_EQ(hand_.is_left, std::string(GetParam()) == "left");
    EXPECT_NEAR(hand_.rest[kWrist].position_m.x, 0.0, 1e-9);
    EXPECT_NEAR(hand_.rest[kWrist].position_m.y, -hand_.rest[first_joint(Finger::middle)].position_m.y, 1e-9);
    const double thumb_x = hand_.rest[first_joint(Finger::thumb) + 3].position_m.x;
    EXPECT_GT(hand_.is_left ? thumb_x : -thumb_x, 0.04);
    // A relaxed thumb hangs towards the palm, which is at -Z.
    EXPECT_LT(hand_.rest[first_joint(Finger::thumb) + 3].position_m.z, -0.01);
}

TEST_P(BothHands, AreAtRestAsInTheirFile) {
    const HandSkeleton skeleton = pose_of(hand_, bend_at_rest(hand_), {});
    for (std::size_t i = 0; i < kHandJoints; ++i) {
        EXPECT_LT(glm::length(skeleton[i].position_m - hand_.rest[i].position_m), 1e-12) << kHandJointNames[i];
        EXPECT_NEAR(std::abs(glm::dot(skeleton[i].orientation, hand_.rest[i].orientation)), 1.0, 1e-12);
    }
    const std::vector<Vec3> skin = skinned(hand_, skeleton);
    for (std::size_t i = 0; i < skin.size(); ++i) EXPECT_LT(glm::length(skin[i] - hand_.skin_m[i]), 1e-12);
}

TEST_P(BothHands, FlexTowardsThePalmAndKeepTheirBones) {
    HandBend bend{};
    for (FingerBend& finger : bend) finger = {0.0, 1.2, 1.2, 0.6};
    const HandSkeleton open = pose_of(hand_, {}, {}), fist = pose_of(hand_, bend, {});
    for (const Finger finger : kAllFingers) {
        const std::size_t first = first_joint(finger);
        for (std::size_t i = first; i < first + 3; ++i)
            EXPECT_NEAR(glm::length(fist[i + 1].position_m - fist[i].position_m),
                        glm::length(hand_.rest[i + 1].position_m - hand_.rest[i].position_m), 1e-12);
        if (finger == Finger::thumb) continue;
        EXPECT_LT(fist[first + 3].position_m.z, open[first + 3].position_m.z - 0.02) << kHandJointNames[first];
        EXPECT_LT(fist[first + 3].position_m.y, open[first + 3].position_m.y - 0.04) << kHandJointNames[first];
    }
}

TEST_P(BothHands, SpreadTowardsTheThumb) {
    for (const Finger finger : {Finger::index, Finger::middle, Finger::ring, Finger::little}) {
        HandBend bend{};
        bend[static_cast<std::size_t>(finger)][0] = 0.2;
        const double way = pose_of(hand_, bend, {})[first_joint(finger) + 3].position_m.x -
                           pose_of(hand_, {}, {})[first_joint(finger) + 3].position_m.x;
        EXPECT_GT(hand_.is_left ? way : -way, 0.01);
    }
}

TEST_P(BothHands, KnowTheHandByAFingertip) {
    const HandBend bend = any_bend(7);
    const Pose frame{{0.2, -0.1, 0.4}, glm::normalize(Quat(0.5, 0.2, -0.6, 0.3))};
    for (const Finger finger : kAllFingers) {
        const FingerBend& bent = bend[static_cast<std::size_t>(finger)];
        const Pose tip = hand_from_tip(hand_, finger, bent);
        const Pose back =
            frame_from_hand(hand_, finger, bent, {frame * tip.position_m, frame.orientation * tip.orientation});
        EXPECT_LT(glm::length(back.position_m - frame.position_m), 1e-12);
        EXPECT_NEAR(std::abs(glm::dot(back.orientation, frame.orientation)), 1.0, 1e-12);
        EXPECT_LT(glm::length(pose_of(hand_, bend, {})[first_joint(finger) + 3].position_m - tip.position_m), 1e-12);
    }
}

TEST_P(BothHands, SkinAsTheReferenceInDoubleWithinAMicrometre) {
    double worst_m = 0.0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const HandSkeleton skeleton =
            pose_of(hand_, any_bend(seed), {{0.1, 1.2, -0.3}, glm::normalize(Quat(0.3, seed * 0.1, 0.5, -0.4))});
        const std::vector<Vec3> skin = skinned(hand_, skeleton);
        for (std::size_t i = 0; i < skin.size(); ++i)
            worst_m = std::max(worst_m, glm::length(skin[i] - reference_place(hand_, skeleton, i)));
    }
    EXPECT_LT(worst_m, 1e-6);
}

TEST_P(BothHands, SkinStaysClosedAndAboutAsLargeWhenItIsFiner) {
    const HandModel finer = with_finer_skin(hand_);
    EXPECT_EQ(finer.triangles.size(), 4 * hand_.triangles.size());
    const TriangleMesh mesh{finer.skin_m, finer.triangles, {}, {}, {}};
    EXPECT_TRUE(examine(mesh).closed);
    const auto volume = [](const HandModel& of) {
        double sum = 0.0;
        for (const auto& [a, b, c] : of.triangles)
            sum += glm::dot(of.skin_m[a], glm::cross(of.skin_m[b], of.skin_m[c]));
        return sum / 6.0;
    };
    EXPECT_GT(volume(hand_), 0.0);  // outward
    EXPECT_NEAR(volume(finer) / volume(hand_), 1.0, 0.05);
    for (const SkinBinding& binding : finer.bindings) {
        double sum = 0.0;
        for (const double weight : binding.weights) sum += weight;
        EXPECT_NEAR(sum, 1.0, 1e-12);
    }
}

// Returns how near the skin comes to a joint.
double nearest_to(const std::vector<Vec3>& skin, const Vec3& joint) {
    double nearest_m = 1.0;
    for (const Vec3& place : skin) nearest_m = std::min(nearest_m, glm::length(place - joint));
    return nearest_m;
}

// The skin with linear blending: the mean of where each joint takes a place.
std::vector<Vec3> linear_skin(const HandModel& hand, const HandSkeleton& skeleton) {
    std::vector<Vec3> skin(hand.skin_m.size(), Vec3(0.0));
    for (std::size_t i = 0; i < skin.size(); ++i)
        for (std::size_t k = 0; k < kInfluences; ++k) {
            const std::size_t joint = hand.bindings[i].joints[k];
            const Vec3 own =
                glm::conjugate(hand.rest[joint].orientation) * (hand.skin_m[i] - hand.rest[joint].position_m);
            skin[i] += hand.bindings[i].weights[k] * (skeleton[joint] * own);
        }
    return skin;
}

TEST_P(BothHands, FistKeepsTheThicknessThatLinearBlendingLoses) {
    HandBend bend{};
    for (FingerBend& finger : bend) finger = {0.0, 1.5, 1.5, 1.0};
    const HandSkeleton fist = pose_of(hand_, bend, {});
    const std::vector<Vec3> skin = skinned(hand_, fist), flat = linear_skin(hand_, fist);
    for (const Finger finger : {Finger::index, Finger::middle, Finger::ring}) {
        const std::size_t knuckle = first_joint(finger) + 1;
        const double at_rest_m = nearest_to(hand_.skin_m, hand_.rest[knuckle].position_m);
        EXPECT_GT(nearest_to(skin, fist[knuckle].position_m), 0.8 * at_rest_m) << kHandJointNames[knuckle];
        EXPECT_GT(nearest_to(skin, fist[knuckle].position_m), 1.05 * nearest_to(flat, fist[knuckle].position_m));
    }
}

TEST_P(BothHands, G3FeelByPointsOfTheirSkinWhoseSharesAddUp) {
    for (const Finger finger : kAllFingers)
        for (const std::size_t points : {1u, 5u, 20u, 200u}) {
            const auto patch = fingertip_patch(hand_, finger, {.points = points, .extent_m = 0.004});
            ASSERT_TRUE(patch) << patch.error().line();
            ASSERT_EQ(patch->size(), points);
            double shares = 0.0, area_m2 = 0.0;
            for (const PatchPoint& point : *patch) {
                shares += point.share;
                area_m2 += point.area_m2;
                EXPECT_LT(point.normal_tip.z, -0.3);  // towards the palm
                EXPECT_LT(glm::length(point.place_tip_m - patch->front().place_tip_m), 0.011);
            }
            EXPECT_NEAR(shares, 1.0, 1e-12);
            EXPECT_NEAR(area_m2, 3.14159 * 0.004 * 0.004, 0.35 * 3.14159 * 0.004 * 0.004);
        }
}

TEST_P(BothHands, G3KeepTheirPatchOnTheSkinWhenFingersBend) {
    const auto patch = fingertip_patch(hand_, Finger::index, {});
    ASSERT_TRUE(patch);
    const HandBend bend = any_bend(3);
    const std::vector<Vec3> skin = skinned(hand_, pose_of(hand_, bend, {}));
    const TriangleTree tree(skin, hand_.triangles);
    const Pose tip = hand_from_tip(hand_, Finger::index, bend[1]);
    for (const PatchPoint& point : *patch) {
        EXPECT_LT(tree.nearest(tip * point.place_tip_m, 0).distance_m, 0.0005);
    }
}

TEST(FingertipPatch, G3RefusesNumbersThatMakeNoPatch) {
    const HandModel hand = hand_of("right");
    for (const PatchLayout& layout : {PatchLayout{0, 0.004}, PatchLayout{5, 0.0}, PatchLayout{5, 0.5},
                                      PatchLayout{5, NAN}, PatchLayout{100'000, 0.004}}) {
        const auto patch = fingertip_patch(hand, Finger::index, layout);
        ASSERT_FALSE(patch);
        EXPECT_FALSE(patch.error().remedy.empty());
    }
}

TEST(HandModel, NamesTheJointThatIsMissing) {
    SkinnedMesh mesh = skinned_mesh_of("right");
    mesh.joints[7].name = "elbow";
    const auto hand = hand_model_of(mesh, "hand.glb");
    ASSERT_FALSE(hand);
    EXPECT_NE(hand.error().line().find("index-finger-phalanx-intermediate"), std::string::npos);
}

}  // namespace
}  // namespace burin::geometry
