// SPDX-License-Identifier: MIT
// Hands for tests: those of assets/hands, and bends drawn from a seed.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "geometry/hand/hand_model.hpp"

namespace burin::geometry {

inline std::string hand_file(const std::string& side) { return "assets/hands/" + side + ".glb"; }

inline SkinnedMesh skinned_mesh_of(const std::string& side) {
    auto mesh = read_skinned_glb(hand_file(side));
    if (!mesh) ADD_FAILURE() << mesh.error().line();
    return mesh ? std::move(*mesh) : SkinnedMesh{};
}

inline HandModel hand_of(const std::string& side) {
    auto hand = read_hand_model(hand_file(side));
    if (!hand) ADD_FAILURE() << hand.error().line();
    return hand ? std::move(*hand) : HandModel{};
}

inline HandBend any_bend(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    HandBend bend{};
    for (const Finger finger : kAllFingers) {
        const BendLimits& limits = limits_of(finger);
        for (std::size_t i = 0; i < kBends; ++i)
            bend[static_cast<std::size_t>(finger)][i] =
                limits.lowest[i] + share(random) * (limits.highest[i] - limits.lowest[i]);
    }
    return bend;
}

}  // namespace burin::geometry
