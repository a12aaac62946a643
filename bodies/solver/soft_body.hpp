// SPDX-License-Identifier: MIT
// An elastic body of tetrahedra: what of it never changes, its state, its energy and forces.
//
// Material: stable neo-Hookean without the barrier (Smith, de Goes, Kim 2018, eq. 13, with the constant left out),
//   W = mu/2 (tr F'F - 3) - mu (J - 1) + lambda'/2 (J - 1)^2,   F the deformation gradient, J its determinant.
// At rest it has no stress, and for small strains it is Hooke's law with Lame's mu and lambda = lambda' - mu; so
// lambda' = lambda + mu, else Poisson's ratio is wrong. It is defined for inverted elements too, and drives them back.
// Linear elements that must each keep their volume lock: a ball of them is up to a fifth too stiff. So of lambda' only
// kElementShare weighs on each element's J; the rest weighs on the mean J of the elements around each corner, as in
// Bonet and Burton 1998 ("A simple average nodal pressure tetrahedral element", Communications in Numerical Methods in
// Engineering 14). Where all elements are deformed alike nothing changes by that. An element that has lost much of its
// volume is turned back by the rest as well: (1 - kElementShare) lambda'/2 (kSqueezed - J)^2 where J < kSqueezed.
// In each corner alone every J and every mean is affine, so the second derivative with respect to one corner is
// positive definite whatever the deformation: mu |g|^2 of each element, g the gradient of the corner's shape function
// at rest, and c c' of each J or mean, c its derivative.
// A material with a yield stress is plastic as well: its elements' rest shapes follow (plastic_flow.hpp).
// Units: SI; frame: the body's own. Pure; any thread. What is made once allocates, the rest does not.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "bodies/mesh/tetrahedra.hpp"

namespace burin::bodies {

struct SoftMaterial {
    double young_Pa = 100e3;
    double poisson = 0.48;  // below it the volume is not kept
    double density_kg_per_m3 = 1000.0;
    // Of the elements: stress per rate of strain over stress per strain.
    double damping_s = 0.002;
    double yield_Pa = 0.0;    // von Mises' stress beyond which it flows; 0: it is elastic
    double relaxes_s = 0.03;  // while it flows: the stress beyond yield falls to 1/e within this time

    [[nodiscard]] bool is_plastic() const { return yield_Pa > 0.0; }
    [[nodiscard]] double mu_Pa() const { return young_Pa / (2.0 * (1.0 + poisson)); }
    [[nodiscard]] double lambda_Pa() const { return young_Pa * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
};

// Without any of it elements take volume from each other that the mean does not see.
constexpr double kElementShare = 0.25, kSqueezed = 0.3;

// Even permutations that put each corner of an element first.
constexpr std::array<std::array<std::size_t, 4>, 4> kCornerFirst{
    {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};

// One corner of an element, as the element's energy depends on it.
struct SoftIncidence {
    std::array<std::uint32_t, 4> corners{};  // the corner itself first, in the cell's orientation
    std::array<double, 4> gram{};            // g of the corner times g of each, 1/m^2
    double volume_m3 = 0.0;                  // at rest
    std::array<std::uint8_t, 4> ring{};      // where each of the four stands in the ring of the corner
};
// The volume around each corner of a ring, derived with respect to the place of the corner that the ring is around.
constexpr std::size_t kMostInRing = 64;
using RingSlopes = std::array<Vec3, kMostInRing>;  // m^2

// What has flowed of a plastic body (plastic_flow.hpp); empty for an elastic one.
struct SoftFlow {
    std::vector<glm::dmat3> metrics;        // of each element: the inverse of Fp' Fp; its determinant is 1
    std::vector<SoftIncidence> incidences;  // the body's own, with the grams of the rest shapes now
    std::vector<std::uint8_t> stopped;      // 1: the element would go bad if it flowed further, and does not
    std::size_t stopped_count = 0;          // how many of them
    std::size_t flowing_count = 0;          // elements that flowed in the last step
};

struct SoftState {
    std::vector<Vec3> places_m, velocities_m_per_s;
    SoftFlow flow{};
};

class SoftBody {
public:
    using Incidence = SoftIncidence;
    // An element's shape functions at rest, and where it stands among the incidences of its corners.
    struct Element {
        std::array<Vec3, 4> gradients_per_m;
        std::array<std::uint32_t, 4> incidences;
    };

    // Fails on a body without elements, with elements that are flat or inside out, that does not hang together, or with
    // a corner that has more than kMostInRing - 1 neighbours; and on a material that none is.
    [[nodiscard]] static Result<SoftBody> create(Tetrahedra rest, const SoftMaterial& material);

    [[nodiscard]] const Tetrahedra& rest() const { return rest_; }
    [[nodiscard]] const SoftMaterial& material() const { return material_; }
    [[nodiscard]] std::size_t corners() const { return rest_.places_m.size(); }
    [[nodiscard]] double mass_kg(std::uint32_t corner) const { return masses_kg_[corner]; }
    [[nodiscard]] std::span<const Incidence> around(std::uint32_t corner) const {
        return std::span(incidences_).subspan(first_[corner], first_[corner + 1] - first_[corner]);
    }
    // The same, with the rest shapes as they are in this state of the body.
    [[nodiscard]] std::span<const Incidence> around(const SoftState& state, std::uint32_t corner) const {
        const auto& all = state.flow.incidences.empty() ? incidences_ : state.flow.incidences;
        return std::span(all).subspan(first_[corner], first_[corner + 1] - first_[corner]);
    }
    // A corner and those with which it shares an element, itself among them.
    [[nodiscard]] std::span<const std::uint32_t> ring(std::uint32_t corner) const {
        return std::span(rings_).subspan(first_of_ring_[corner], first_of_ring_[corner + 1] - first_of_ring_[corner]);
    }
    // Returns the volume at rest of all elements that have this corner.
    [[nodiscard]] double volume_around_m3(std::uint32_t corner) const { return volumes_around_m3_[corner]; }
    [[nodiscard]] std::span<const Incidence> incidences() const { return incidences_; }
    [[nodiscard]] std::span<const Element> elements() const { return elements_; }
    // Corners of one colour share no element, but volumes around the corners between them.
    [[nodiscard]] std::size_t colours() const { return colours_.size(); }
    [[nodiscard]] std::span<const std::uint32_t> of_colour(std::size_t colour) const { return colours_[colour]; }

    [[nodiscard]] SoftState at_rest() const;

private:
    SoftBody() = default;
    void find_incidences();
    [[nodiscard]] Result<void> find_rings();
    void colour();

    Tetrahedra rest_;
    SoftMaterial material_;
    std::vector<double> masses_kg_;
    std::vector<Incidence> incidences_;
    std::vector<Element> elements_;     // of each cell
    std::vector<std::uint32_t> first_;  // of each corner's incidences
    std::vector<std::uint32_t> rings_, first_of_ring_;
    std::vector<double> volumes_around_m3_;
    std::vector<std::vector<std::uint32_t>> colours_;
};

// The elastic force on a corner, and the derivative of minus that with respect to its place: symmetric, by columns.
struct CornerForce {
    Vec3 force_N{0.0};
    glm::dmat3 stiffness_N_per_m{0.0};
    // The part of both that mu/2 tr F'F gives. It is linear in the places, so the solver derives its damping from it.
    Vec3 of_spread_N{0.0};
    double of_spread_N_per_m = 0.0;
};
[[nodiscard]] Vec3 spread_force_N(const SoftBody& body, const SoftState& state, std::uint32_t corner);
// Sums up the volumes of the elements around each corner, as they are now.
void sum_volumes_around(const SoftBody& body, std::span<const Vec3> places_m, std::vector<double>& volumes_m3);
// Requires those volumes. Leaves in slopes how they change with the corner's place, in the order of its ring.
[[nodiscard]] CornerForce elastic_force(const SoftBody& body, const SoftState& state,
                                        std::span<const double> volumes_around_m3, std::uint32_t corner,
                                        RingSlopes& slopes);
[[nodiscard]] double elastic_energy_J(const SoftBody& body, std::span<const Vec3> places_m);
// Returns the volume now, and the least share of its own that an element has left; below 0 one is inside out.
struct VolumeNow {
    double volume_m3 = 0.0, least_share = 1.0;
};
[[nodiscard]] VolumeNow volume_of(const SoftBody& body, std::span<const Vec3> places_m);

}  // namespace burin::bodies
