// SPDX-License-Identifier: MIT
#include "bodies/solver/soft_body.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/text.hpp"

namespace burin::bodies {
namespace {

using Cell = Tetrahedra::Cell;
constexpr double kLeastQuality = 0.01;

// The gradients of the four shape functions.
std::array<Vec3, 4> gradients_of(const Tetrahedra& body, const Cell& cell) {
    const auto p = [&](std::size_t i) { return body.places_m[cell[i]]; };
    const double six_volumes = 6.0 * volume_m3(p(0), p(1), p(2), p(3));
    const Vec3 g1 = glm::cross(p(2) - p(0), p(3) - p(0)) / six_volumes;
    const Vec3 g2 = glm::cross(p(3) - p(0), p(1) - p(0)) / six_volumes;
    const Vec3 g3 = glm::cross(p(1) - p(0), p(2) - p(0)) / six_volumes;
    return {-(g1 + g2 + g3), g1, g2, g3};
}

bool hangs_together(const Tetrahedra& body) {
    std::vector<std::uint32_t> root(body.places_m.size());
    for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
    const auto find = [&](std::uint32_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const Cell& cell : body.cells)
        for (std::size_t i = 1; i < 4; ++i) root[find(cell[i])] = find(cell[0]);
    for (std::uint32_t i = 0; i < root.size(); ++i)
        if (find(i) != find(0)) return false;
    return true;
}

Result<void> check_rest(const Tetrahedra& body) {
    constexpr const char* kName = "body";
    if (body.cells.empty()) return fail(kName, "has no elements", "give it some");
    for (std::size_t c = 0; c < body.cells.size(); ++c) {
        for (const std::uint32_t corner : body.cells[c])
            if (corner >= body.places_m.size() || !finite(body.places_m[corner]))
                return fail(kName, formatted("element %zu has a corner that is none", c), "number corners from 0");
        const Tetrahedra one{body.places_m, {body.cells[c]}};
        if (const double quality = worst_quality(one); !(quality > kLeastQuality))
            return fail(kName, formatted("element %zu is %s", c, quality < 0.0 ? "inside out" : "flat"),
                        "mesh it anew, with elements alike in size");
    }
    if (!hangs_together(body)) return fail(kName, "is in several pieces", "make each a body of its own");
    return {};
}

Result<void> check_material(const SoftMaterial& m) {
    if (!(m.young_Pa > 0.0) || !std::isfinite(m.young_Pa))
        return fail("stiffness", formatted("is %g Pa", m.young_Pa), "give Young's modulus above 0");
    if (!(m.poisson >= 0.0 && m.poisson <= 0.495))
        return fail("Poisson's ratio", formatted("is %g", m.poisson), "give 0 to 0.495");
    if (!(m.density_kg_per_m3 > 0.0) || !std::isfinite(m.density_kg_per_m3))
        return fail("density", formatted("is %g kg/m3", m.density_kg_per_m3), "give one above 0");
    if (!(m.damping_s >= 0.0 && m.damping_s <= 1.0))
        return fail("damping", formatted("is %g s", m.damping_s), "give 0 to 1 s");
    if (!(m.yield_Pa >= 0.0) || !std::isfinite(m.yield_Pa))
        return fail("yield stress", formatted("is %g Pa", m.yield_Pa), "give one above 0, or 0 for none");
    if (m.is_plastic() && !(m.relaxes_s > 0.0 && m.relaxes_s <= 10.0))
        return fail("relaxation", formatted("is %g s", m.relaxes_s), "give more than 0 and at most 10 s");
    return {};
}

}  // namespace

Result<SoftBody> SoftBody::create(Tetrahedra rest, const SoftMaterial& material) {
    if (const auto sound = check_rest(rest); !sound) return std::unexpected(sound.error());
    if (const auto sound = check_material(material); !sound) return std::unexpected(sound.error());
    SoftBody body;
    body.rest_ = std::move(rest);
    body.material_ = material;
    body.find_incidences();
    body.colour();
    return body;
}

void SoftBody::find_incidences() {
    std::vector<std::vector<Incidence>> around(corners());
    masses_kg_.assign(corners(), 0.0);
    for (const Cell& cell : rest_.cells) {
        const auto g = gradients_of(rest_, cell);
        const auto p = [&](std::size_t i) { return rest_.places_m[cell[i]]; };
        const double volume = bodies::volume_m3(p(0), p(1), p(2), p(3));
        for (std::size_t i = 0; i < 4; ++i) {
            masses_kg_[cell[i]] += 0.25 * material_.density_kg_per_m3 * volume;
            Incidence incidence;
            incidence.volume_m3 = volume;
            for (std::size_t k = 0; k < 4; ++k) {
                incidence.corners[k] = cell[kCornerFirst[i][k]];
                incidence.gram[k] = glm::dot(g[i], g[kCornerFirst[i][k]]);
            }
            around[cell[i]].push_back(incidence);
        }
    }
    first_.push_back(0);
    for (const auto& of_corner : around) {
        incidences_.insert(incidences_.end(), of_corner.begin(), of_corner.end());
        first_.push_back(static_cast<std::uint32_t>(incidences_.size()));
    }
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const Cell& cell : rest_.cells) {
        Element element{gradients_of(rest_, cell), {}};
        for (std::size_t i = 0; i < 4; ++i) element.incidences[i] = next[cell[i]]++;
        elements_.push_back(element);
    }
}

SoftState SoftBody::at_rest() const {
    SoftState state{rest_.places_m, std::vector<Vec3>(corners(), Vec3(0.0)), {}};
    if (!material_.is_plastic()) return state;
    state.flow.metrics.assign(rest_.cells.size(), glm::dmat3(1.0));
    state.flow.incidences = incidences_;
    state.flow.stopped.assign(rest_.cells.size(), 0);
    return state;
}

// Greedy, by the corners' numbers.
void SoftBody::colour() {
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<std::uint32_t> colour_of(corners(), kNone);
    std::vector<bool> taken;
    for (std::uint32_t corner = 0; corner < corners(); ++corner) {
        taken.assign(colours_.size() + 1, false);
        for (const Incidence& incidence : around(corner))
            for (const std::uint32_t other : incidence.corners)
                if (colour_of[other] != kNone) taken[colour_of[other]] = true;
        const auto free = static_cast<std::uint32_t>(std::ranges::find(taken, false) - taken.begin());
        if (free == colours_.size()) colours_.emplace_back();
        colours_[free].push_back(corner);
        colour_of[corner] = free;
    }
}

namespace {

CornerForce force_of(const SoftMaterial& material, std::span<const SoftIncidence> around,
                     std::span<const Vec3> places_m) {
    const double mu = material.mu_Pa(), lambda = material.lambda_Pa() + mu;
    CornerForce sum;
    double of_mu = 0.0;
    for (const SoftIncidence& e : around) {
        const Vec3 &a = places_m[e.corners[0]], &b = places_m[e.corners[1]], &c = places_m[e.corners[2]],
                   &d = places_m[e.corners[3]];
        // J = det(b - a, c - a, d - a) / (6 V), and its derivative with respect to a.
        const double per_volume = 1.0 / (6.0 * e.volume_m3);
        const Vec3 slope = glm::cross(d - b, c - b) * per_volume;
        const double j = glm::dot(slope, a - b);
        const Vec3 spread = e.gram[0] * a + e.gram[1] * b + e.gram[2] * c + e.gram[3] * d;  // F g
        sum.force_N -= e.volume_m3 * (mu * spread + (lambda * (j - 1.0) - mu) * slope);
        of_mu += e.volume_m3 * mu * e.gram[0];
        const Vec3 scaled = e.volume_m3 * lambda * slope;
        sum.stiffness_N_per_m[0] += scaled.x * slope;
        sum.stiffness_N_per_m[1] += scaled.y * slope;
        sum.stiffness_N_per_m[2] += scaled.z * slope;
    }
    for (int axis = 0; axis < 3; ++axis) sum.stiffness_N_per_m[axis][axis] += of_mu;
    return sum;
}

}  // namespace

CornerForce elastic_force(const SoftBody& body, std::span<const Vec3> places_m, std::uint32_t corner) {
    return force_of(body.material(), body.around(corner), places_m);
}

CornerForce elastic_force(const SoftBody& body, const SoftState& state, std::uint32_t corner) {
    return force_of(body.material(), body.around(state, corner), state.places_m);
}

double elastic_energy_J(const SoftBody& body, std::span<const Vec3> places_m) {
    const double mu = body.material().mu_Pa(), lambda = body.material().lambda_Pa() + mu;
    double sum = 0.0;
    for (const Cell& cell : body.rest().cells) {
        const auto g = gradients_of(body.rest(), cell);
        const auto rest = [&](std::size_t i) { return body.rest().places_m[cell[i]]; };
        glm::dmat3 f(0.0);
        for (std::size_t i = 0; i < 4; ++i) f += glm::outerProduct(places_m[cell[i]], g[i]);
        const double j = glm::determinant(f);
        const double trace = glm::dot(f[0], f[0]) + glm::dot(f[1], f[1]) + glm::dot(f[2], f[2]);
        const double density = 0.5 * mu * (trace - 3.0) - mu * (j - 1.0) + 0.5 * lambda * (j - 1.0) * (j - 1.0);
        sum += volume_m3(rest(0), rest(1), rest(2), rest(3)) * density;
    }
    return sum;
}

VolumeNow volume_of(const SoftBody& body, std::span<const Vec3> places_m) {
    VolumeNow now;
    const auto& rest = body.rest().places_m;
    for (const Cell& c : body.rest().cells) {
        const double volume = volume_m3(places_m[c[0]], places_m[c[1]], places_m[c[2]], places_m[c[3]]);
        now.volume_m3 += volume;
        now.least_share = std::min(now.least_share, volume / volume_m3(rest[c[0]], rest[c[1]], rest[c[2]], rest[c[3]]));
    }
    return now;
}

}  // namespace burin::bodies
