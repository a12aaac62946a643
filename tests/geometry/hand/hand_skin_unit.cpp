// SPDX-License-Identifier: MIT
// A finer skin against Loop's rules, looked up triangle by triangle: within the skin and on its border, which hands of
// other people have at the wrist. And the capsules of the bones against the skin around them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/hand/hand_model.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::geometry {
namespace {

using SkinTriangle = std::array<std::uint32_t, 3>;

// The weights of the joints at a place, and the place.
struct SkinMix {
    Vec3 place_m{0.0};
    std::map<std::uint32_t, double> weights;

    void add(const HandModel& hand, std::uint32_t vertex, double share) {
        place_m += share * hand.skin_m[vertex];
        for (std::size_t k = 0; k < kInfluences; ++k)
            weights[hand.bindings[vertex].joints[k]] += share * hand.bindings[vertex].weights[k];
    }
};

// Loop's rules by looking at every triangle anew (Loop 1987; borders: Hoppe and others, Piecewise Smooth Surface
// Reconstruction, 1994).
class LoopRules {
public:
    explicit LoopRules(const HandModel& hand) : hand_(hand) {}

    // Of the place in the middle of an edge: 3/8 of its ends and 1/8 of what lies opposite, on a border half of its
    // ends.
    [[nodiscard]] SkinMix between(std::uint32_t a, std::uint32_t b) const {
        const std::vector<std::uint32_t> opposite = opposite_of(a, b);
        const bool is_border = opposite.size() == 1;
        SkinMix mix;
        mix.add(hand_, a, is_border ? 0.5 : 0.375);
        mix.add(hand_, b, is_border ? 0.5 : 0.375);
        if (!is_border)
            for (const std::uint32_t other : opposite) mix.add(hand_, other, 0.125);
        return mix;
    }
    // Of a place that was there before: on a border 3/4 of it and 1/8 of its neighbours along the border.
    [[nodiscard]] SkinMix at(std::uint32_t vertex) const {
        std::vector<std::uint32_t> beside, along_border;
        for (const SkinTriangle& t : hand_.triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                if (t[i] != vertex) continue;
                for (const std::uint32_t other : {t[(i + 1) % 3], t[(i + 2) % 3]}) {
                    if (std::ranges::find(beside, other) != beside.end()) continue;
                    beside.push_back(other);
                    if (opposite_of(vertex, other).size() == 1) along_border.push_back(other);
                }
            }
        SkinMix mix;
        if (!along_border.empty() && along_border.size() != 2) {  // borders meet
            mix.add(hand_, vertex, 1.0);
            return mix;
        }
        if (!along_border.empty()) {
            mix.add(hand_, vertex, 0.75);
            for (const std::uint32_t other : along_border) mix.add(hand_, other, 0.125);
            return mix;
        }
        const auto n = static_cast<double>(beside.size());
        const double part = 3.0 / 8.0 + std::cos(2.0 * std::numbers::pi / n) / 4.0;
        const double each = (5.0 / 8.0 - part * part) / n;
        mix.add(hand_, vertex, 1.0 - n * each);
        for (const std::uint32_t other : beside) mix.add(hand_, other, each);
        return mix;
    }

private:
    [[nodiscard]] std::vector<std::uint32_t> opposite_of(std::uint32_t a, std::uint32_t b) const {
        std::vector<std::uint32_t> found;
        for (const SkinTriangle& t : hand_.triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t from = t[i], to = t[(i + 1) % 3];
                if ((from == a && to == b) || (from == b && to == a)) found.push_back(t[(i + 2) % 3]);
            }
        return found;
    }
    const HandModel& hand_;
};

void expect_mix(const HandModel& finer, std::uint32_t vertex, const SkinMix& expected, const std::string& what) {
    EXPECT_LT(glm::length(finer.skin_m[vertex] - expected.place_m), 1e-12) << what;
    // The four greatest weights stay, and add up to 1 again.
    std::vector<double> greatest;
    for (const auto& [joint, weight] : expected.weights) greatest.push_back(weight);
    std::ranges::sort(greatest, std::greater<>());
    greatest.resize(std::min(greatest.size(), kInfluences));
    double sum = 0.0;
    for (const double weight : greatest) sum += weight;
    for (std::size_t k = 0; k < kInfluences; ++k) {
        const double weight = finer.bindings[vertex].weights[k];
        if (!(weight > 0.0)) continue;
        EXPECT_NEAR(weight, expected.weights.at(finer.bindings[vertex].joints[k]) / sum, 1e-12) << what;
    }
}

// The places of the finer skin: the old places first, then those in the middle of edges, found by their triangles; of a
// large skin each so manieth.
void expect_by_the_rules(const HandModel& hand, std::uint32_t each = 1) {
    const HandModel finer = with_finer_skin(hand);
    ASSERT_EQ(finer.triangles.size(), 4 * hand.triangles.size());
    const LoopRules rules(hand);
    for (std::uint32_t v = 0; v < hand.skin_m.size(); v += each)
        expect_mix(finer, v, rules.at(v), "place " + std::to_string(v));
    for (std::size_t i = 0; i < hand.triangles.size(); i += each) {
        const SkinTriangle& t = hand.triangles[i];
        // The triangle in the middle comes last of the four.
        const SkinTriangle& middle = finer.triangles[4 * i + 3];
        for (std::size_t k = 0; k < 3; ++k)
            expect_mix(finer, middle[k], rules.between(t[k], t[(k + 1) % 3]), "edge of triangle " + std::to_string(i));
    }
}

// A piece of a hand that is open at both ends: a tube of uneven rings, each bound to two joints of its own.
HandModel open_tube() {
    constexpr std::uint32_t kRings = 4, kAround = 7;
    HandModel hand;
    for (std::uint32_t ring = 0; ring < kRings; ++ring)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const double angle = 2.0 * std::numbers::pi * (i + 0.2 * ring) / kAround;
            hand.skin_m.push_back({(0.02 + 0.003 * ring) * std::cos(angle), 0.013 * ring, 0.017 * std::sin(angle)});
            SkinBinding binding;
            binding.joints = {static_cast<std::uint16_t>(ring), static_cast<std::uint16_t>(ring + 5), 11, 12};
            binding.weights = {0.55, 0.25, 0.15, 0.05};
            hand.bindings.push_back(binding);
        }
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t a = ring * kAround + i, b = ring * kAround + (i + 1) % kAround;
            hand.triangles.push_back({a, a + kAround, b});
            hand.triangles.push_back({b, a + kAround, b + kAround});
        }
    return hand;
}

// A hand whose skin ends above the wrist.
HandModel cut_at_the_wrist(bool is_left) {
    HandModel hand = known_hand_model(is_left);
    const double cut_y_m = 0.7 * hand.rest[kWrist].position_m.y;
    std::erase_if(hand.triangles, [&](const SkinTriangle& t) {
        return std::ranges::any_of(t, [&](std::uint32_t v) { return hand.skin_m[v].y < cut_y_m; });
    });
    // Places that no triangle has any more go as well.
    std::vector<std::uint32_t> kept(hand.skin_m.size(), 0);
    for (const SkinTriangle& t : hand.triangles)
        for (const std::uint32_t v : t) kept[v] = 1;
    std::vector<Vec3> skin;
    std::vector<SkinBinding> bindings;
    for (std::uint32_t v = 0; v < kept.size(); ++v) {
        if (kept[v] == 0) continue;
        kept[v] = static_cast<std::uint32_t>(skin.size());
        skin.push_back(hand.skin_m[v]);
        bindings.push_back(hand.bindings[v]);
    }
    for (SkinTriangle& t : hand.triangles)
        for (std::uint32_t& v : t) v = kept[v];
    hand.skin_m = std::move(skin);
    hand.bindings = std::move(bindings);
    return hand;
}

}  // namespace

TEST(HandSkin, AFinerSkinFollowsLoopsRulesWithinAndOnItsBorder) {
    {
        SCOPED_TRACE("tube");
        expect_by_the_rules(open_tube());
    }
    for (const bool is_left : {true, false}) {
        SCOPED_TRACE(is_left ? "left" : "right");
        expect_by_the_rules(cut_at_the_wrist(is_left), 7);
    }
}

// However often it is made finer, the end of a tube stays where it is and as wide.
TEST(HandSkin, TheBorderOfAnOpenSkinStaysWhereItIs) {
    HandModel hand = open_tube();
    for (int times = 0; times < 3; ++times) hand = with_finer_skin(hand);
    double least_y = HUGE_VAL, most_y = -HUGE_VAL, widest = 0.0;
    for (const Vec3& p : hand.skin_m) {
        least_y = std::min(least_y, p.y), most_y = std::max(most_y, p.y);
        if (p.y < 1e-9) widest = std::max(widest, p.x);
    }
    EXPECT_NEAR(least_y, 0.0, 1e-12);
    EXPECT_NEAR(most_y, 0.039, 1e-12);
    EXPECT_GT(widest, 0.85 * 0.02);
}

TEST(HandSkin, CapsulesLieBetweenTheJointsOfTheirFingersAndPalmInAnyPose) {
    for (const bool is_left : {true, false}) {
        const HandModel& hand = known_hand_model(is_left);
        HandBend bend{};
        for (std::size_t f = 0; f < kHandFingers; ++f) bend[f] = {0.02 * double(f), 0.3 + 0.1 * double(f), 0.5, 0.2};
        const HandSkeleton skeleton = pose_of(hand, bend, uneven_pose(1));
        const auto capsules = capsules_of(skeleton);
        std::size_t next = 0;
        for (const Finger finger : kAllFingers)
            for (std::size_t i = 0; i < 3; ++i, ++next) {
                const std::size_t joint = first_joint(finger) + i;
                EXPECT_EQ(capsules[next].from_m, skeleton[joint].position_m) << kHandJointNames[joint];
                EXPECT_EQ(capsules[next].to_m, skeleton[joint + 1].position_m) << kHandJointNames[joint];
            }
        for (const Finger finger : kAllFingers) {
            const std::size_t joint = first_joint(finger);
            EXPECT_EQ(capsules[next].from_m, skeleton[joint].position_m) << kHandJointNames[joint];
            EXPECT_EQ(capsules[next].to_m, skeleton[finger == Finger::thumb ? kWrist : joint - 1].position_m);
            EXPECT_GE(capsules[next].radius_m, capsules[3].radius_m) << "the palm is thicker than the index finger";
            ++next;
        }
        EXPECT_EQ(next, kBoneCapsules);
    }
}

namespace {

// The mean distance of the skin from a bone, of all places that move with it more than with any other.
double thickness_m(const HandModel& hand, std::size_t joint) {
    const Vec3 from = hand.rest[joint].position_m, way = hand.rest[joint + 1].position_m - from;
    double sum_m = 0.0, count = 0.0;
    for (std::size_t v = 0; v < hand.skin_m.size(); ++v) {
        const SkinBinding& binding = hand.bindings[v];
        const auto greatest = std::ranges::max_element(binding.weights) - binding.weights.begin();
        if (binding.joints[static_cast<std::size_t>(greatest)] != joint) continue;
        const double share = glm::dot(hand.skin_m[v] - from, way) / glm::dot(way, way);
        if (share < 0.1 || share > 0.9) continue;
        sum_m += glm::length(hand.skin_m[v] - from - share * way);
        count += 1.0;
    }
    return sum_m / count;
}

}  // namespace

TEST(HandSkin, CapsulesAreAsThickAsTheSkinAroundThemAndThinnerTowardsEveryTip) {
    for (const bool is_left : {true, false}) {
        const HandModel& hand = known_hand_model(is_left);
        const auto capsules = capsules_of(hand.rest);
        for (const Finger finger : kAllFingers) {
            const std::size_t first = 3 * static_cast<std::size_t>(finger);
            for (std::size_t i = 0; i < 3; ++i) {
                const double skin_m = thickness_m(hand, first_joint(finger) + i);
                // The thumb's first bone lies in the flesh of the palm.
                if (finger != Finger::thumb || i > 0) {
                    EXPECT_NEAR(capsules[first + i].radius_m, skin_m, 0.2 * skin_m) << first / 3 << " bone " << i;
                }
                if (i == 0) continue;
                EXPECT_LT(capsules[first + i].radius_m, capsules[first + i - 1].radius_m) << first / 3;
            }
        }
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_GT(capsules[i].radius_m, capsules[3 + i].radius_m) << "the thumb is the thickest";
            EXPECT_LT(capsules[12 + i].radius_m, capsules[9 + i].radius_m) << "the little finger is the thinnest";
            EXPECT_LE(capsules[9 + i].radius_m, capsules[6 + i].radius_m);
        }
    }
}

}  // namespace burin::geometry
