// SPDX-License-Identifier: MIT
#include "bodies/solver/soft_step.hpp"

#include <cmath>

namespace burin::bodies {

void SoftContact::add(const Anchor& anchor, double share) {
    for (std::size_t i = 0; i < 4; ++i) {
        std::uint32_t at = 0;
        while (at < count && corners[at] != anchor.corners[i]) ++at;
        if (at == count) {
            if (count == kMostCorners) return;
            corners[count++] = anchor.corners[i];
        }
        shares[at] += share * anchor.shares[i];
    }
}

double SoftContact::depth_m(std::span<const Vec3> places_m) const {
    double along = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) along += shares[i] * glm::dot(normal, places_m[corners[i]]);
    return offset_m - along;
}

void SoftSolver::sort_contacts(const SoftBody& body, std::span<const SoftContact> contacts) {
    first_.assign(body.corners() + 1, 0);
    for (const SoftContact& contact : contacts)
        for (std::uint32_t i = 0; i < contact.count; ++i) ++first_[contact.corners[i] + 1];
    for (std::size_t corner = 0; corner < body.corners(); ++corner) first_[corner + 1] += first_[corner];
    at_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t c = 0; c < contacts.size(); ++c)
        for (std::uint32_t i = 0; i < contacts[c].count; ++i)
            at_[next[contacts[c].corners[i]]++] = {c, contacts[c].shares[i]};
}

Vec3 SoftSolver::moved(const SoftBody& body, const SoftState& state, const SoftStepInput& input,
                       std::uint32_t corner) const {
    const std::vector<Vec3>& places = state.places_m;
    CornerForce sum = elastic_force(body, places, corner);
    const double inertia = body.mass_kg(corner) / (input.dt_s * input.dt_s);
    const double hold = input.holds_N_per_m.empty() ? 0.0 : input.holds_N_per_m[corner];
    double diagonal = inertia + hold;
    sum.force_N += inertia * (drawn_to_m_[corner] - places[corner]);
    sum.force_N += hold * (body.rest().places_m[corner] - places[corner]);
    if (const double viscous = body.material().damping_s / input.dt_s * body.material().mu_Pa(); viscous > 0.0)
        for (const SoftBody::Incidence& e : body.around(corner)) {
            Vec3 spread(0.0);
            for (std::size_t i = 0; i < 4; ++i) spread += e.gram[i] * (places[e.corners[i]] - before_m_[e.corners[i]]);
            sum.force_N -= e.volume_m3 * viscous * spread;
            diagonal += e.volume_m3 * viscous * e.gram[0];
        }
    for (std::uint32_t i = first_[corner]; i < first_[corner + 1]; ++i) {
        const SoftContact& contact = input.contacts[at_[i].contact];
        const double force_N = contact.force_N(places);
        if (force_N <= 0.0) continue;
        const double share = at_[i].share;
        sum.force_N += share * force_N * contact.normal;
        sum.stiffness_N_per_m +=
            share * share * contact.stiffness_N_per_m * glm::outerProduct(contact.normal, contact.normal);
    }
    for (int axis = 0; axis < 3; ++axis) sum.stiffness_N_per_m[axis][axis] += diagonal;
    return places[corner] + glm::inverse(sum.stiffness_N_per_m) * sum.force_N;
}

void SoftSolver::step(const SoftBody& body, SoftState& state, const SoftStepInput& input) {
    const double dt_s = input.dt_s;
    before_m_ = state.places_m;
    drawn_to_m_.resize(before_m_.size());
    for (std::size_t i = 0; i < before_m_.size(); ++i)
        drawn_to_m_[i] = before_m_[i] + dt_s * state.velocities_m_per_s[i] + dt_s * dt_s * input.acceleration_m_per_s2;
    sort_contacts(body, input.contacts);
    state.places_m = drawn_to_m_;  // the first guess
    for (unsigned sweep = 0; sweep < input.sweeps; ++sweep)
        for (std::size_t colour = 0; colour < body.colours(); ++colour)
            for (const std::uint32_t corner : body.of_colour(colour))
                state.places_m[corner] = moved(body, state, input, corner);
    for (std::size_t i = 0; i < before_m_.size(); ++i)
        state.velocities_m_per_s[i] = (state.places_m[i] - before_m_[i]) / dt_s;
}

}  // namespace burin::bodies
