// SPDX-License-Identifier: MIT
#include "geometry/hand/fingertip_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

namespace burin::geometry {
namespace {

struct SkinTriangle {
    std::array<Vec3, 3> corners{};  // in the fingertip's frame
};

// Returns the triangles of the skin that follow the last bone, and those between it and the one before.
std::vector<SkinTriangle> skin_of_tip(const HandModel& hand, Finger finger) {
    const std::size_t first = first_joint(finger), last = first + 2, tip = first + 3;
    const Pose place = hand_from_tip(hand, finger, hand.finger(finger).rest);
    const Quat back = glm::conjugate(place.orientation);
    const auto follows = [&](std::uint32_t vertex) {
        double weight = 0.0;
        const SkinBinding& binding = hand.bindings[vertex];
        for (std::size_t k = 0; k < kInfluences; ++k)
            if (binding.joints[k] == last || binding.joints[k] == tip) weight += binding.weights[k];
        return weight > 0.5;
    };
    std::vector<SkinTriangle> found;
    for (const auto& t : hand.triangles) {
        if (!std::ranges::any_of(t, follows)) continue;
        SkinTriangle triangle;
        for (std::size_t i = 0; i < 3; ++i) triangle.corners[i] = back * (hand.skin_m[t[i]] - place.position_m);
        found.push_back(triangle);
    }
    return found;
}

Vec3 center_of_gravity(const std::vector<SkinTriangle>& skin) {
    Vec3 sum(0.0);
    double area = 0.0;
    for (const SkinTriangle& t : skin) {
        const double own = glm::length(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
        sum += own * (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0;
        area += own;
    }
    return sum / area;
}

struct SkinHit {
    Vec3 place{0.0}, normal{0.0};
};

// Returns where a ray leaves the skin: its farthest crossing.
std::optional<SkinHit> left_by(const std::vector<SkinTriangle>& skin, const Vec3& from, const Vec3& along) {
    std::optional<SkinHit> hit;
    double farthest = 0.0;
    for (const auto& [corners] : skin) {
        const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
        const Vec3 across = glm::cross(u, v);
        const double slope = glm::dot(across, along);
        if (!(std::abs(slope) > std::numeric_limits<double>::min())) continue;
        const double t = glm::dot(across, corners[0] - from) / slope;
        const Vec3 at = from + t * along - corners[0];
        const double square = glm::dot(across, across);
        const double a = glm::dot(glm::cross(at, v), across) / square, b = glm::dot(glm::cross(u, at), across) / square;
        if (a < 0.0 || b < 0.0 || a + b > 1.0 || t <= farthest) continue;
        farthest = t;
        hit = SkinHit{from + t * along, glm::normalize(across)};
    }
    return hit;
}

// Where a point lies on the cylinder: along the bone, and across it.
std::vector<Vec2> layout_of(const PatchLayout& layout) {
    const double e = layout.extent_m;
    if (layout.points == 5) return {{0.0, 0.0}, {e, 0.0}, {-e, 0.0}, {0.0, e}, {0.0, -e}};
    std::vector<Vec2> places;
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (std::size_t i = 0; i < layout.points; ++i) {
        // Spirals have one point for the same area everywhere; a single point is the middle.
        const double n = static_cast<double>(i);
        const double r = layout.points == 1 ? 0.0 : e * std::sqrt((n + 0.5) / static_cast<double>(layout.points));
        places.push_back({r * std::cos(golden * n), r * std::sin(golden * n)});
    }
    return places;
}

}  // namespace

Result<std::vector<PatchPoint>> fingertip_patch(const HandModel& hand, Finger finger, const PatchLayout& layout) {
    const std::string where = std::string(kHandJointNames[first_joint(finger) + 3]);
    if (layout.points < 1 || layout.points > kMostPatchPoints)
        return fail(where, "is to feel with " + std::to_string(layout.points) + " points", "ask for 1 to 4096");
    if (!(layout.extent_m > 0.0 && layout.extent_m <= 0.01))
        return fail(where, "its patch is to reach further than a fingertip does", "give it 0 to 10 mm");
    const std::vector<SkinTriangle> skin = skin_of_tip(hand, finger);
    if (skin.empty()) return fail(where, "no skin follows it", "name a hand whose skin follows its fingertips");
    // The axis goes through the centre of gravity, along the bone; -Z is towards the palm.
    const Vec3 center = center_of_gravity(skin), palmar{0.0, 0.0, -1.0};
    const auto middle = left_by(skin, center, palmar);
    if (!middle) return fail(where, "its skin is open towards the palm", "name a hand whose skin is closed");
    const double radius_m = glm::length(middle->place - center);
    std::vector<PatchPoint> patch;
    const double own_m2 = std::numbers::pi * layout.extent_m * layout.extent_m / static_cast<double>(layout.points);
    for (const Vec2& at : layout_of(layout)) {
        const Vec3 from = center + Vec3(0.0, at.x, 0.0);
        const double angle = at.y / radius_m;
        const Vec3 along{std::sin(angle), 0.0, -std::cos(angle)};
        const auto hit = left_by(skin, from, along);
        if (!hit) return fail(where, "its patch reaches beyond its skin", "give it less extent");
        // An area on the cylinder is larger on the skin by how much farther out that is, and by its slope.
        const double out = glm::length(hit->place - from) / radius_m,
                     slope = std::max(glm::dot(hit->normal, along), 0.1);
        patch.push_back({hit->place, hit->normal, own_m2 * out / slope, 0.0});
    }
    double sum_m2 = 0.0;
    for (const PatchPoint& point : patch) sum_m2 += point.area_m2;
    for (PatchPoint& point : patch) point.share = point.area_m2 / sum_m2;
    return patch;
}

std::vector<double> stiffness_shares(const std::vector<PatchPoint>& patch, double depth_m) {
    double flat_m = 0.0;  // force over stiffness
    for (const PatchPoint& point : patch)
        flat_m += point.share * std::max(0.0, depth_m + patch.front().place_tip_m.z - point.place_tip_m.z);
    std::vector<double> shares;
    shares.reserve(patch.size());
    for (const PatchPoint& point : patch) shares.push_back(point.share * depth_m / flat_m);
    return shares;
}

}  // namespace burin::geometry
