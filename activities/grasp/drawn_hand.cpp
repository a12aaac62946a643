// SPDX-License-Identifier: MIT
#include "activities/grasp/drawn_hand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "picture/frame_setup.hpp"
#include "renderer/frame/redraw.hpp"

namespace burin::activities {
namespace {

using geometry::Finger;
using geometry::kAllFingers;

constexpr Vec3 kSkin{0.86, 0.64, 0.53}, kSleeve{0.21, 0.27, 0.37};  // sRGB

// Returns the joint that a place of the skin follows most.
std::size_t joint_of(const geometry::SkinBinding& binding) {
    const auto most = std::ranges::max_element(binding.weights);
    return binding.joints[static_cast<std::size_t>(most - binding.weights.begin())];
}

// Returns the capsules (geometry::capsules_of) that may keep light off a place that follows this joint: all but those
// that it lies on.
std::uint32_t others_of(std::size_t joint) {
    constexpr std::uint32_t kAll = (1u << geometry::kBoneCapsules) - 1, kPalm = kAll & ~0x7fffu;
    std::uint32_t own = 0;
    bool in_palm = true;
    for (const Finger finger : kAllFingers) {
        const std::size_t first = geometry::first_joint(finger), f = static_cast<std::size_t>(finger);
        if (joint < first || joint > first + 3) continue;
        in_palm = joint == first && finger == Finger::thumb;
        own |= 7u << (3 * f);
        if (joint <= first + (finger == Finger::thumb ? 1u : 0u)) own |= kPalm;
    }
    if (!in_palm) return kAll & ~own;
    for (std::size_t f = 0; f < geometry::kHandFingers; ++f) own |= 1u << (3 * f);
    return kAll & ~(own | kPalm);
}

double smooth_between(double lo, double hi, double x) {
    const double t = std::clamp((x - lo) / (hi - lo), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// The share of the lamp that a capsule hides from a place: hidden_share() of shaders/lighting.glsl at the point of its
// axis that is nearest to the line to the lamp.
double hidden_by(const geometry::BoneCapsule& capsule, const Vec3& place, const Vec3& to_light) {
    const Vec3 to_from = capsule.from_m - place, axis = capsule.to_m - capsule.from_m;
    const double rise = glm::dot(axis, to_light);
    double along = glm::dot(to_from, to_light);
    const Vec3 beside = to_from - along * to_light, flat = axis - rise * to_light;
    const double s = std::clamp(-glm::dot(beside, flat) / std::max(glm::dot(flat, flat), 1e-12), 0.0, 1.0);
    along += s * rise;
    const double r = capsule.radius_m, miss = glm::length(beside + s * flat);
    const double soft = std::max(picture::kLightHalfAngleTangent * std::max(along, 0.0), 0.25 * r);
    const double full = std::min(1.0, r * r / (soft * soft));
    return full * (1.0 - smooth_between(r - soft, r + soft, miss)) * smooth_between(0.0, 0.8 * r, along);
}

// The share of the hemisphere over a place that a capsule covers, cosine-weighted.
double covered_by(const geometry::BoneCapsule& capsule, const Vec3& place, const Vec3& normal) {
    const Vec3 axis = capsule.to_m - capsule.from_m;
    const double t =
        std::clamp(glm::dot(place - capsule.from_m, axis) / std::max(glm::dot(axis, axis), 1e-12), 0.0, 1.0);
    const Vec3 to_axis = capsule.from_m + t * axis - place;
    const double distance_m = std::max(glm::length(to_axis), capsule.radius_m * 1.0001);
    const double sine = capsule.radius_m / distance_m;
    return std::max(glm::dot(normal, to_axis) / distance_m, 0.0) * sine * sine;
}

std::uint32_t colour_code_of(const Vec3& srgb) {
    const auto byte = [](double c) { return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(c, 0.0, 1.0))); };
    return 0xff000000u | byte(srgb.z) << 16 | byte(srgb.y) << 8 | byte(srgb.x);
}

// Blood shows through at fingertips and knuckles; the palm is paler than the back.
std::uint32_t colour_of(const geometry::HandModel& hand, std::size_t vertex) {
    const Vec3& place = hand.skin_m[vertex];
    double red = 0.0;
    for (const Finger finger : kAllFingers) {
        const std::size_t first = geometry::first_joint(finger);
        for (std::size_t i = 0; i < 4; ++i) {
            const double near = glm::length(place - hand.rest[first + i].position_m) / (i == 3 ? 0.011 : 0.012);
            red = std::max(red, (i == 3 ? 0.9 : 0.6) * std::exp(-near * near * 0.8));
        }
    }
    return colour_code_of(Vec3(1.0, 1.0 - 0.13 * red, 1.0 - 0.14 * red));
}

// Returns the bounds of the skin's end at the wrist.
Box end_of(const geometry::HandModel& hand) {
    double last_m = 0.0;
    for (const Vec3& place : hand.skin_m) last_m = std::min(last_m, place.y);
    Box end;
    for (const Vec3& place : hand.skin_m)
        if (place.y < last_m + 0.012) end.include(place);
    return end;
}

constexpr double kSleeve_m = 0.004, kForearm_m = 0.11;  // its thickness beyond the skin; its length

// A sleeve: rings of an ellipse around the forearm, from inside its hem to its closed end.
std::shared_ptr<const picture::DrawnMesh> sleeve_around(const Box& wrist) {
    struct Ring {
        double back_m, wider_m;
    };
    constexpr std::array kRings{Ring{0.004, -0.002},
                                Ring{-0.0085, -0.001},
                                Ring{-0.0105, 0.0005},
                                Ring{-0.011, 0.002},
                                Ring{-0.0105, 0.0035},
                                Ring{-0.0085, 0.0045},
                                Ring{0.006, 0.0045},
                                Ring{0.008, 0.0038},
                                Ring{0.01, 0.0045},
                                Ring{0.05, 0.006},
                                Ring{kForearm_m - 0.006, 0.0085},
                                Ring{kForearm_m - 0.002, 0.007},
                                Ring{kForearm_m, 0.003},
                                Ring{kForearm_m, -1.0}};
    constexpr std::uint32_t kAround = 64;
    std::vector<Vec3> places;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const Vec3 half = 0.5 * wrist.extent(), middle = wrist.center();
    for (const auto& [back_m, wider_m] : kRings)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / kAround;
            const double x = std::max(half.x + wider_m, 0.0), z = std::max(half.z + wider_m, 0.0);
            places.push_back({middle.x + x * std::cos(angle), wrist.lo.y - back_m, middle.z + z * std::sin(angle)});
        }
    for (std::uint32_t ring = 0; ring + 1 < kRings.size(); ++ring)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t a = ring * kAround + i, b = ring * kAround + (i + 1) % kAround;
            triangles.push_back({a, b, a + kAround});
            triangles.push_back({b, b + kAround, a + kAround});
        }
    return picture::smooth_mesh(places, triangles);
}

}  // namespace

DrawnHand::DrawnHand(const geometry::HandModel& hand) : hand_(geometry::with_finer_skin(hand)) {
    const Box wrist = end_of(hand_);
    sleeve_ = sleeve_around(wrist);
    const double radius_m = 0.25 * (wrist.extent().x + wrist.extent().z) + kSleeve_m;
    forearm_ = {hand_.rest[geometry::kWrist].position_m,
                {wrist.center().x, wrist.lo.y - kForearm_m + radius_m, wrist.center().z},
                radius_m};
    colours_.reserve(hand_.skin_m.size());
    others_.reserve(hand_.skin_m.size());
    for (std::size_t i = 0; i < hand_.skin_m.size(); ++i) {
        colours_.push_back(colour_of(hand_, i));
        others_.push_back(others_of(joint_of(hand_.bindings[i])));
    }
}

geometry::VertexLight DrawnHand::light_at(std::size_t vertex, const Vec3& place, const Vec3& normal,
                                          const Capsules& capsules, const Vec3& to_light) const {
    double dark = 0.0, open = 1.0;
    for (std::size_t i = 0; i < capsules.size(); ++i) {
        if ((others_[vertex] >> i & 1u) == 0) continue;
        dark = std::max(dark, hidden_by(capsules[i], place, to_light));
        open *= 1.0 - 0.6 * covered_by(capsules[i], place, normal);
    }
    const auto byte = [](double share) { return static_cast<std::uint8_t>(std::lround(255.0 * share)); };
    return {byte(1.0 - dark), byte(open)};
}

void DrawnHand::add_to(picture::Picture& scene, const geometry::HandBend& bend,
                       const Similarity& world_from_hand) const {
    const geometry::HandSkeleton skeleton = geometry::pose_of(hand_, bend, {});
    const std::vector<Vec3> skin = geometry::skinned(hand_, skeleton);
    const Capsules capsules = geometry::capsules_of(skeleton);
    std::vector<Vec3> normals(skin.size(), Vec3(0.0));
    for (const auto& [a, b, c] : hand_.triangles) {
        const Vec3 area = glm::cross(skin[b] - skin[a], skin[c] - skin[a]);
        for (const std::uint32_t corner : {a, b, c}) normals[corner] += area;
    }
    const Vec3 to_light = glm::conjugate(world_from_hand.orientation) * picture::direction_to_light();
    std::vector<geometry::VertexLight> lights;
    lights.reserve(skin.size());
    for (std::size_t i = 0; i < skin.size(); ++i)
        lights.push_back(light_at(i, skin[i], glm::normalize(normals[i]), capsules, to_light));
    picture::DrawnObject object{picture::smooth_mesh(skin, hand_.triangles, colours_, std::move(lights)),
                                world_from_hand, kSkin};
    object.roughness = 0.55;
    object.gloss = 0.5;
    object.own_capsule = picture::kAllCapsules;
    scene.objects.push_back(std::move(object));
    picture::DrawnObject sleeve{sleeve_, world_from_hand, kSleeve};
    sleeve.roughness = 0.9;
    sleeve.gloss = 0.15;
    sleeve.own_capsule = picture::kAllCapsules;
    scene.objects.push_back(std::move(sleeve));
    const auto cast_by = [&](const geometry::BoneCapsule& bone) {
        scene.capsules.push_back(
            {world_from_hand * bone.from_m, world_from_hand * bone.to_m, world_from_hand.scale * bone.radius_m});
    };
    std::ranges::for_each(capsules, cast_by);
    cast_by(forearm_);
}

}  // namespace burin::activities
