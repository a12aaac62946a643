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
    if (const auto found = body.find_rings(); !found) return std::unexpected(found.error());
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

Result<void> SoftBody::find_rings() {
    first_of_ring_.push_back(0);
    std::vector<std::uint32_t> ring;
    for (std::uint32_t corner = 0; corner < corners(); ++corner) {
        ring.clear();
        double volume = 0.0;
        for (Incidence& incidence : std::span(incidences_).subspan(first_[corner], around(corner).size())) {
            volume += incidence.volume_m3;
            for (std::size_t i = 0; i < 4; ++i) {
                const auto at = std::ranges::find(ring, incidence.corners[i]);
                incidence.ring[i] = static_cast<std::uint8_t>(at - ring.begin());
                if (at != ring.end()) continue;
                if (ring.size() == kMostInRing)
                    return fail("body", formatted("corner %u has more than %zu neighbours", corner, kMostInRing - 1),
                                "mesh it anew, with elements alike in size");
                ring.push_back(incidence.corners[i]);
            }
        }
        volumes_around_m3_.push_back(volume);
        rings_.insert(rings_.end(), ring.begin(), ring.end());
        first_of_ring_.push_back(static_cast<std::uint32_t>(rings_.size()));
    }
    return {};
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

void sum_volumes_around(const SoftBody& body, std::span<const Vec3> places_m, std::vector<double>& volumes_m3) {
    volumes_m3.assign(body.corners(), 0.0);
    for (const Cell& cell : body.rest().cells) {
        const double volume = volume_m3(places_m[cell[0]], places_m[cell[1]], places_m[cell[2]], places_m[cell[3]]);
        for (const std::uint32_t corner : cell) volumes_m3[corner] += volume;
    }
}

namespace {

// The sum of V F g over the elements around a corner, and what of it a way of the corner changes.
struct Spread {
    Vec3 of_places_m2{0.0};
    double of_corner_m = 0.0;

    void add(const SoftIncidence& e, std::span<const Vec3> at) {
        const Vec3 spread = e.gram[0] * at[e.corners[0]] + e.gram[1] * at[e.corners[1]] + e.gram[2] * at[e.corners[2]] +
                            e.gram[3] * at[e.corners[3]];
        of_places_m2 += e.volume_m3 * spread;
        of_corner_m += e.volume_m3 * e.gram[0];
    }
};

// A sum of factor v v': symmetric, so that six numbers hold it.
struct Outers {
    Vec3 diagonal{0.0}, beside{0.0};  // xx, yy, zz; yz, zx, xy

    void add(double factor, const Vec3& v) {
        const Vec3 scaled = factor * v;
        diagonal += scaled * v;
        beside += Vec3(scaled.y * v.z, scaled.z * v.x, scaled.x * v.y);
    }
    [[nodiscard]] glm::dmat3 matrix(double on_diagonal) const {
        const Vec3 d = diagonal + on_diagonal;
        return {d.x, beside.z, beside.y, beside.z, d.y, beside.x, beside.y, beside.x, d.z};
    }
};

}  // namespace

CornerForce elastic_force(const SoftBody& body, const SoftState& state, std::span<const double> volumes_around_m3,
                          std::uint32_t corner, RingSlopes& slopes) {
    const double mu = body.material().mu_Pa(), lambda = body.material().lambda_Pa() + mu;
    const double of_element = kElementShare * lambda, of_rest = (1.0 - kElementShare) * lambda;
    const std::span<const std::uint32_t> ring = body.ring(corner);
    std::fill_n(slopes.begin(), ring.size(), Vec3(0.0));
    Vec3 of_volume_N(0.0);
    Outers outers;
    Spread sum;
    for (const SoftIncidence& e : body.around(state, corner)) {
        const Vec3 &a = state.places_m[e.corners[0]], &b = state.places_m[e.corners[1]],
                   &c = state.places_m[e.corners[2]], &d = state.places_m[e.corners[3]];
        sum.add(e, state.places_m);
        // The volume is det(b - a, c - a, d - a) / 6; its derivative with respect to a.
        const Vec3 slope = glm::cross(d - b, c - b) * (1.0 / 6.0);
        const double j = glm::dot(slope, a - b) / e.volume_m3;
        const double squeezed = j < kSqueezed ? of_rest : 0.0;
        of_volume_N -= (of_element * (j - 1.0) + squeezed * (j - kSqueezed) - mu) * slope;
        outers.add((of_element + squeezed) / e.volume_m3, slope);
        for (const std::uint8_t at : e.ring) slopes[at] += slope;
    }
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double rest_m3 = body.volume_around_m3(ring[i]);
        of_volume_N -= 0.25 * of_rest * (volumes_around_m3[ring[i]] / rest_m3 - 1.0) * slopes[i];
        outers.add(0.25 * of_rest / rest_m3, slopes[i]);
    }
    const Vec3 of_spread_N = -mu * sum.of_places_m2;
    return {of_spread_N + of_volume_N, outers.matrix(mu * sum.of_corner_m), of_spread_N, mu * sum.of_corner_m};
}

Vec3 spread_force_N(const SoftBody& body, const SoftState& state, std::uint32_t corner) {
    Spread sum;
    for (const SoftIncidence& e : body.around(state, corner)) sum.add(e, state.places_m);
    return -body.material().mu_Pa() * sum.of_places_m2;
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
        double density =
            0.5 * mu * (trace - 3.0) - mu * (j - 1.0) + 0.5 * kElementShare * lambda * (j - 1.0) * (j - 1.0);
        const double squeezed = std::min(j - kSqueezed, 0.0);
        density += 0.5 * (1.0 - kElementShare) * lambda * squeezed * squeezed;
        sum += volume_m3(rest(0), rest(1), rest(2), rest(3)) * density;
    }
    std::vector<double> volumes_m3;
    sum_volumes_around(body, places_m, volumes_m3);
    for (std::uint32_t corner = 0; corner < body.corners(); ++corner) {
        const double rest_m3 = body.volume_around_m3(corner), too_large = volumes_m3[corner] / rest_m3 - 1.0;
        sum += 0.25 * rest_m3 * 0.5 * (1.0 - kElementShare) * lambda * too_large * too_large;
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
