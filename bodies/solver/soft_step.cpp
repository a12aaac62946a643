// SPDX-License-Identifier: MIT
#include "bodies/solver/soft_step.hpp"

#include <cmath>

#include "bodies/solver/plastic_flow.hpp"

namespace burin::bodies {
namespace {

// A motion of all corners together: the way of the middle, and the turn about it, to first order.
using Motion = std::array<double, 6>;

// The sum of terms 1/2 k (row . motion - way)^2, whose least is looked for.
class RigidStep {
public:
    void add(const Motion& row, double stiffness_N_per_m, double way_m) {
        for (std::size_t i = 0; i < 6; ++i) {
            right_[i] += stiffness_N_per_m * way_m * row[i];
            for (std::size_t j = 0; j <= i; ++j) matrix_[i][j] += stiffness_N_per_m * row[i] * row[j];
        }
    }
    // A spring that draws a place, seen from the middle, by a way in any direction.
    void add(const Vec3& arm_m, double stiffness_N_per_m, const Vec3& way_m) {
        add({1, 0, 0, 0, arm_m.z, -arm_m.y}, stiffness_N_per_m, way_m.x);
        add({0, 1, 0, -arm_m.z, 0, arm_m.x}, stiffness_N_per_m, way_m.y);
        add({0, 0, 1, arm_m.y, -arm_m.x, 0}, stiffness_N_per_m, way_m.z);
    }
    // By Cholesky; no motion where there is no least.
    [[nodiscard]] Motion solved() const {
        std::array<std::array<double, 6>, 6> l{};
        Motion x{};
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = matrix_[i][j];
                for (std::size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
                if (i == j && !(sum > 0.0)) return {};
                l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
            }
        for (std::size_t i = 0; i < 6; ++i) {
            double sum = right_[i];
            for (std::size_t k = 0; k < i; ++k) sum -= l[i][k] * x[k];
            x[i] = sum / l[i][i];
        }
        for (std::size_t i = 6; i-- > 0;) {
            double sum = x[i];
            for (std::size_t k = i + 1; k < 6; ++k) sum -= l[k][i] * x[k];
            x[i] = sum / l[i][i];
        }
        return x;
    }

private:
    std::array<std::array<double, 6>, 6> matrix_{};  // its lower half
    Motion right_{};
};

}  // namespace

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

void SoftSolver::move(const SoftBody& body, SoftState& state, const SoftStepInput& input, std::uint32_t corner) {
    std::vector<Vec3>& places = state.places_m;
    CornerForce sum = elastic_force(body, state, volumes_around_m3_, corner, slopes_m2_);
    const double inertia = body.mass_kg(corner) / (input.dt_s * input.dt_s);
    const double hold = input.holds_N_per_m.empty() ? 0.0 : input.holds_N_per_m[corner];
    const std::span<const Vec3> held_at = input.held_at_m.empty() ? body.rest().places_m : input.held_at_m;
    double diagonal = inertia + hold;
    sum.force_N += inertia * (drawn_to_m_[corner] - places[corner]);
    sum.force_N += hold * (held_at[corner] - places[corner]);
    const double damping = body.material().damping_s / input.dt_s;
    sum.force_N += damping * (sum.of_spread_N - spread_before_N_[corner]);
    diagonal += damping * sum.of_spread_N_per_m;
    for (std::uint32_t i = first_[corner]; i < first_[corner + 1]; ++i) {
        const SoftContact& contact = input.contacts[at_[i].contact];
        const auto [force_N, slope_N_per_m] = contact.law.at(contact.depth_m(places));
        if (force_N <= 0.0) continue;
        const double share = at_[i].share;
        sum.force_N += share * force_N * contact.normal;
        sum.stiffness_N_per_m += share * share * slope_N_per_m * glm::outerProduct(contact.normal, contact.normal);
    }
    for (int axis = 0; axis < 3; ++axis) sum.stiffness_N_per_m[axis][axis] += diagonal;
    const Vec3 way = glm::inverse(sum.stiffness_N_per_m) * sum.force_N;
    places[corner] += way;
    const std::span<const std::uint32_t> ring = body.ring(corner);
    for (std::size_t i = 0; i < ring.size(); ++i) volumes_around_m3_[ring[i]] += glm::dot(slopes_m2_[i], way);
}

void SoftSolver::move_rigidly(const SoftBody& body, SoftState& state, const SoftStepInput& input) const {
    std::vector<Vec3>& places = state.places_m;
    Vec3 middle(0.0);
    double mass_kg = 0.0;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        middle += body.mass_kg(i) * places[i];
        mass_kg += body.mass_kg(i);
    }
    middle /= mass_kg;
    const std::span<const Vec3> held_at = input.held_at_m.empty() ? body.rest().places_m : input.held_at_m;
    RigidStep sum;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        const Vec3 arm = places[i] - middle;
        const double inertia = body.mass_kg(i) / (input.dt_s * input.dt_s);
        sum.add(arm, inertia, drawn_to_m_[i] - places[i]);
        if (!input.holds_N_per_m.empty() && input.holds_N_per_m[i] > 0.0)
            sum.add(arm, input.holds_N_per_m[i], held_at[i] - places[i]);
    }
    for (const SoftContact& contact : input.contacts) {
        const auto [force_N, slope_N_per_m] = contact.law.at(contact.depth_m(places));
        if (!(force_N > 0.0)) continue;
        Vec3 arm(0.0);
        for (std::uint32_t i = 0; i < contact.count; ++i)
            arm += contact.shares[i] * (places[contact.corners[i]] - middle);
        const Vec3 &n = contact.normal, turn = glm::cross(arm, n);
        sum.add({n.x, n.y, n.z, turn.x, turn.y, turn.z}, slope_N_per_m, force_N / slope_N_per_m);
    }
    const Motion motion = sum.solved();
    const Vec3 way(motion[0], motion[1], motion[2]), turn(motion[3], motion[4], motion[5]);
    const double angle = glm::length(turn);
    const Quat turned = angle > 0.0 ? glm::angleAxis(angle, turn / angle) : Quat(1.0, 0.0, 0.0, 0.0);
    for (Vec3& place : places) place = middle + way + turned * (place - middle);
}

void SoftSolver::step(const SoftBody& body, SoftState& state, const SoftStepInput& input) {
    const double dt_s = input.dt_s;
    before_m_ = state.places_m;
    drawn_to_m_.resize(before_m_.size());
    for (std::size_t i = 0; i < before_m_.size(); ++i)
        drawn_to_m_[i] = before_m_[i] + dt_s * state.velocities_m_per_s[i] + dt_s * dt_s * input.acceleration_m_per_s2;
    spread_before_N_.resize(before_m_.size());
    for (std::uint32_t i = 0; i < before_m_.size(); ++i) spread_before_N_[i] = spread_force_N(body, state, i);
    sort_contacts(body, input.contacts);
    state.places_m = drawn_to_m_;  // the first guess
    sum_volumes_around(body, state.places_m, volumes_around_m3_);
    for (unsigned sweep = 0; sweep < input.sweeps; ++sweep) {
        for (std::size_t colour = 0; colour < body.colours(); ++colour)
            for (const std::uint32_t corner : body.of_colour(colour)) move(body, state, input, corner);
        move_rigidly(body, state, input);
    }
    for (std::size_t i = 0; i < before_m_.size(); ++i)
        state.velocities_m_per_s[i] = (state.places_m[i] - before_m_[i]) / dt_s;
    if (body.material().is_plastic()) flow(body, state, dt_s);
}

}  // namespace burin::bodies
