// SPDX-License-Identifier: MIT
// The skin of a hand: how it follows the joints, and how it is made finer.
#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <utility>

#include "geometry/hand/hand_model.hpp"

namespace burin::geometry {
namespace {

// A rigid motion as a dual quaternion: turn + epsilon * shift, with shift = half of the translation times the turn.
struct DualQuat {
    Quat turn, shift;
};

DualQuat dual_of(const Pose& to_from_from) {
    const Vec3& t = to_from_from.position_m;
    return {to_from_from.orientation, Quat(0.0, t.x, t.y, t.z) * to_from_from.orientation * 0.5};
}

// Returns how each joint has moved since the rest.
std::array<DualQuat, kHandJoints> motions_of(const HandModel& hand, const HandSkeleton& skeleton) {
    std::array<DualQuat, kHandJoints> motions{};
    for (std::size_t i = 0; i < kHandJoints; ++i) {
        const Quat turn = glm::normalize(skeleton[i].orientation * glm::conjugate(hand.rest[i].orientation));
        motions[i] = dual_of({skeleton[i].position_m - turn * hand.rest[i].position_m, turn});
    }
    return motions;
}

Vec3 moved(const std::array<DualQuat, kHandJoints>& motions, const SkinBinding& binding, const Vec3& place_m) {
    const Quat& pivot = motions[binding.joints[0]].turn;
    Quat turn(0.0, 0.0, 0.0, 0.0), shift(0.0, 0.0, 0.0, 0.0);
    for (std::size_t k = 0; k < kInfluences; ++k) {
        const DualQuat& motion = motions[binding.joints[k]];
        // q and -q are the same turn; blended, they would cancel.
        const double weight = glm::dot(pivot, motion.turn) < 0.0 ? -binding.weights[k] : binding.weights[k];
        turn = turn + motion.turn * weight;
        shift = shift + motion.shift * weight;
    }
    const double length = glm::length(turn);
    const Quat unit = turn / length;
    const Quat twice = (shift / length) * glm::conjugate(unit) * 2.0;
    return unit * place_m + Vec3(twice.x, twice.y, twice.z);
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// Weights of the joints at a place, while bindings are mixed.
using JointWeights = std::array<double, kHandJoints>;

struct MixedPlace {
    Vec3 place_m{0.0};
    JointWeights weights{};

    void add(const HandModel& hand, std::uint32_t vertex, double share) {
        place_m += share * hand.skin_m[vertex];
        const SkinBinding& binding = hand.bindings[vertex];
        for (std::size_t k = 0; k < kInfluences; ++k) weights[binding.joints[k]] += share * binding.weights[k];
    }
};

SkinBinding greatest_of(const JointWeights& weights) {
    std::array<std::uint16_t, kHandJoints> order{};
    for (std::size_t i = 0; i < kHandJoints; ++i) order[i] = static_cast<std::uint16_t>(i);
    std::ranges::stable_sort(order, [&](std::uint16_t a, std::uint16_t b) { return weights[a] > weights[b]; });
    SkinBinding binding;
    double sum = 0.0;
    for (std::size_t k = 0; k < kInfluences; ++k) {
        binding.joints[k] = order[k];
        binding.weights[k] = weights[order[k]];
        sum += binding.weights[k];
    }
    for (double& weight : binding.weights) weight /= sum;
    return binding;
}

}  // namespace

std::vector<Vec3> skinned(const HandModel& hand, const HandSkeleton& skeleton) {
    const auto motions = motions_of(hand, skeleton);
    std::vector<Vec3> places;
    places.reserve(hand.skin_m.size());
    for (std::size_t i = 0; i < hand.skin_m.size(); ++i)
        places.push_back(moved(motions, hand.bindings[i], hand.skin_m[i]));
    return places;
}

HandModel with_finer_skin(const HandModel& hand) {
    struct Midpoint {
        std::uint32_t vertex = 0;
        std::array<std::uint32_t, 2> opposite{};
        std::size_t sides = 0;
    };
    std::map<Edge, Midpoint> edges;
    for (const auto& t : hand.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            Midpoint& middle = edges[edge_of(t[i], t[(i + 1) % 3])];
            if (middle.sides < 2) middle.opposite[middle.sides] = t[(i + 2) % 3];
            ++middle.sides;
        }
    std::vector<std::vector<std::uint32_t>> around(hand.skin_m.size()), border(hand.skin_m.size());
    for (const auto& [edge, middle] : edges) {
        around[edge.first].push_back(edge.second);
        around[edge.second].push_back(edge.first);
        if (middle.sides == 2) continue;
        border[edge.first].push_back(edge.second);
        border[edge.second].push_back(edge.first);
    }
    HandModel finer = hand;
    finer.skin_m.clear();
    finer.bindings.clear();
    finer.triangles.clear();
    const auto put = [&](const MixedPlace& place) {
        finer.skin_m.push_back(place.place_m);
        finer.bindings.push_back(greatest_of(place.weights));
    };
    for (std::uint32_t v = 0; v < hand.skin_m.size(); ++v) {
        MixedPlace place;
        if (border[v].empty()) {
            const auto n = static_cast<double>(around[v].size());
            const double part = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / n);
            const double each = n > 0.0 ? (0.625 - part * part) / n : 0.0;
            place.add(hand, v, 1.0 - n * each);
            for (const std::uint32_t other : around[v]) place.add(hand, other, each);
        } else {
            // A border is a curve of its own, which nothing beside it draws inwards; where several meet it stays.
            const bool is_curve = border[v].size() == 2;
            place.add(hand, v, is_curve ? 0.75 : 1.0);
            for (std::size_t i = 0; is_curve && i < 2; ++i) place.add(hand, border[v][i], 0.125);
        }
        put(place);
    }
    for (auto& [edge, middle] : edges) {
        middle.vertex = static_cast<std::uint32_t>(finer.skin_m.size());
        const bool inner = middle.sides == 2;  // on a border the middle is the edge's own
        MixedPlace place;
        place.add(hand, edge.first, inner ? 0.375 : 0.5);
        place.add(hand, edge.second, inner ? 0.375 : 0.5);
        for (std::size_t i = 0; inner && i < 2; ++i) place.add(hand, middle.opposite[i], 0.125);
        put(place);
    }
    for (const auto& t : hand.triangles) {
        std::array<std::uint32_t, 3> middle{};
        for (std::size_t i = 0; i < 3; ++i) middle[i] = edges.at(edge_of(t[i], t[(i + 1) % 3])).vertex;
        for (std::size_t i = 0; i < 3; ++i) finer.triangles.push_back({t[i], middle[i], middle[(i + 2) % 3]});
        finer.triangles.push_back({middle[0], middle[1], middle[2]});
    }
    return finer;
}

}  // namespace burin::geometry
