// SPDX-License-Identifier: MIT
// Steps a body that gives: implicit Euler, solved by vertex block descent (Chen, Liu, Yang, Zheng, Chen, Wu 2024,
// "Vertex Block Descent", ACM Transactions on Graphics 43(4)).
//
//   minimise over places x:  sum m/(2 dt^2) |x - x0 - dt v0 - dt^2 a|^2 + W(x) + contacts(x) + holds(x)
// Corner by corner, colour by colour, the sum is minimised in that corner's place alone: 3 x 3, and exactly but for a
// contact that opens or closes, since W is quadratic in one corner (soft_body.hpp). So each sweep lowers it.
// Corners that are moved one by one hardly move the body as a whole, the less the stiffer it is: a push from one side
// would meet far too much inertia. So each sweep ends with a step of all corners together, a rigid motion, which leaves
// W as it is: 6 x 6, by the inertia, contacts and holds alone.
// A contact is a penalty between a point of the embedded surface and a plane: half stiffness times depth squared, or
// what a small dent lacks (dent_law.hpp).
// Damping is viscous, of the part of the stress that goes with mu, over the step. A plastic body flows after it
// (plastic_flow.hpp).
// Units: SI; frame: the body's own. No threads; nothing random. A step allocates where there are more contacts than
// ever before.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bodies/mesh/embedded_surface.hpp"
#include "bodies/solver/dent_law.hpp"
#include "bodies/solver/soft_body.hpp"

namespace burin::bodies {

// A point of the body that must stay beyond a plane: normal . point >= offset. The normal points into the body.
struct SoftContact {
    static constexpr std::size_t kMostCorners = 12;
    std::array<std::uint32_t, kMostCorners> corners{};
    std::array<double, kMostCorners> shares{};
    std::uint32_t count = 0;
    Vec3 normal{0.0};
    double offset_m = 0.0;
    DentLaw law;

    // Adds a share of an anchored point; of at most three.
    void add(const Anchor& anchor, double share);
    [[nodiscard]] double depth_m(std::span<const Vec3> places_m) const;
    [[nodiscard]] double force_N(std::span<const Vec3> places_m) const { return law.at(depth_m(places_m)).force_N; }
};

struct SoftStepInput {
    double dt_s = 0.004;
    unsigned sweeps = 4;
    Vec3 acceleration_m_per_s2{0.0};
    std::span<const SoftContact> contacts{};
    // Springs that draw corners to their places at rest: the stiffness of each corner, N/m; empty: none.
    std::span<const double> holds_N_per_m{};
    // Where they draw them to instead; empty: to their places at rest.
    std::span<const Vec3> held_at_m{};
};

class SoftSolver {
public:
    // Requires a state of the body, a positive step, and contacts whose corners are the body's.
    void step(const SoftBody& body, SoftState& state, const SoftStepInput& input);

private:
    void sort_contacts(const SoftBody& body, std::span<const SoftContact> contacts);
    void move(const SoftBody& body, SoftState& state, const SoftStepInput& input, std::uint32_t corner);
    void move_rigidly(const SoftBody& body, SoftState& state, const SoftStepInput& input) const;

    struct At {
        std::uint32_t contact;
        double share;
    };
    std::vector<Vec3> before_m_, drawn_to_m_, spread_before_N_;
    std::vector<double> volumes_around_m3_;  // of each corner, as the sweep has left them
    RingSlopes slopes_m2_{};
    std::vector<std::uint32_t> first_;  // of each corner's contacts
    std::vector<At> at_;
};

}  // namespace burin::bodies
