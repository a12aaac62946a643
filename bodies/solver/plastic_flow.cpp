// SPDX-License-Identifier: MIT
#include "bodies/solver/plastic_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin::bodies {
namespace {

constexpr int kNewtonSteps = 8;  // each doubles the digits once near; from a yield of a few per cent, four do

double squared(const glm::dmat3& m) { return glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]); }
double trace(const glm::dmat3& m) { return m[0][0] + m[1][1] + m[2][2]; }

glm::dmat3 deformation_of(const SoftBody& body, std::span<const Vec3> places_m, std::size_t cell) {
    const auto& corners = body.rest().cells[cell];
    const auto& g = body.elements()[cell].gradients_per_m;
    const Vec3& origin = places_m[corners[0]];
    glm::dmat3 f(0.0);
    for (std::size_t i = 1; i < 4; ++i) f += glm::outerProduct(places_m[corners[i]] - origin, g[i]);
    return f;
}

// b = F M F', and what of it shears.
struct Strain {
    glm::dmat3 f, deviator;
    double mean = 0.0, mises_Pa = 0.0;
};
Strain strain_of(const SoftBody& body, const SoftState& state, std::size_t cell) {
    Strain strain;
    strain.f = deformation_of(body, state.places_m, cell);
    strain.deviator = strain.f * state.flow.metrics[cell] * glm::transpose(strain.f);
    strain.mean = trace(strain.deviator) / 3.0;
    for (int i = 0; i < 3; ++i) strain.deviator[i][i] -= strain.mean;
    strain.mises_Pa = body.material().mu_Pa() * std::sqrt(1.5 * squared(strain.deviator));
    return strain;
}

// The largest root p of det(s D + p I) = det, D without trace, by Newton from the right, where it falls steadily.
double mean_of(const glm::dmat3& d, double s, double from, double det) {
    const double half = 0.5 * s * s * squared(d), cube = s * s * s * glm::determinant(d);
    double p = from;
    for (int i = 0; i < kNewtonSteps; ++i) p -= (p * (p * p - half) + cube - det) / (3.0 * p * p - half);
    return p;
}

// The quality of a rest shape: the element's at rest, its edges as the metric's inverse has them.
double quality_of(const SoftBody& body, const glm::dmat3& metric, std::size_t cell) {
    const auto& corners = body.rest().cells[cell];
    const auto& rest = body.rest().places_m;
    const glm::dmat3 lengths = glm::inverse(metric);
    double sum_m2 = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Vec3 edge = rest[corners[i]] - rest[corners[j]];
            sum_m2 += glm::dot(edge, lengths * edge);
        }
    const double edge_m = std::sqrt(sum_m2 / 6.0);
    return 6.0 * std::numbers::sqrt2 * body.incidences()[body.elements()[cell].incidences[0]].volume_m3 /
           (edge_m * edge_m * edge_m);
}

void take_metric(const SoftBody& body, SoftFlow& flow, std::size_t cell, const glm::dmat3& metric) {
    flow.metrics[cell] = metric;
    const SoftBody::Element& element = body.elements()[cell];
    const auto& g = element.gradients_per_m;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 mapped = metric * g[i];
        SoftIncidence& incidence = flow.incidences[element.incidences[i]];
        for (std::size_t k = 0; k < 4; ++k) incidence.gram[k] = glm::dot(mapped, g[kCornerFirst[i][k]]);
    }
}

// The rotation of a map's polar decomposition, by Newton (Higham 1986); none where the map is flat or inside out.
glm::dmat3 rotation_of(const glm::dmat3& map) {
    const double det = glm::determinant(map), size = std::sqrt(squared(map) / 3.0);
    if (!(det > 1e-6 * size * size * size)) return glm::dmat3(1.0);
    glm::dmat3 rotation = map / std::cbrt(det);
    for (int i = 0; i < 12; ++i) rotation = 0.5 * (rotation + glm::transpose(glm::inverse(rotation)));
    return rotation;
}

}  // namespace

void flow(const SoftBody& body, SoftState& state, double dt_s) {
    const double yield_Pa = body.material().yield_Pa, kept = std::exp(-dt_s / body.material().relaxes_s);
    SoftFlow& flow = state.flow;
    flow.flowing_count = 0;
    for (std::size_t cell = 0; cell < flow.metrics.size(); ++cell) {
        const Strain strain = strain_of(body, state, cell);
        if (!(strain.mises_Pa > yield_Pa)) continue;  // one that is stopped stays so until it flows
        const double j = glm::determinant(strain.f);
        if (!(j > kLeastPlasticVolume)) continue;
        const double s = (yield_Pa + (strain.mises_Pa - yield_Pa) * kept) / strain.mises_Pa;
        const double p = mean_of(strain.deviator, s, strain.mean, j * j);
        const glm::dmat3 back = glm::inverse(strain.f);
        const glm::dmat3 &old = flow.metrics[cell], rigid = back * glm::transpose(back);
        glm::dmat3 metric = s * old + (p - s * strain.mean) * rigid;
        metric *= 1.0 / std::cbrt(glm::determinant(metric));  // what rounding has changed
        const double quality = quality_of(body, metric, cell);
        const bool stops = !(quality >= kLeastPlasticQuality) && !(quality > quality_of(body, old, cell));
        flow.stopped_count += stops ? 1u : 0u;
        flow.stopped_count -= flow.stopped[cell];
        flow.stopped[cell] = stops ? 1 : 0;
        if (stops) continue;
        ++flow.flowing_count;
        take_metric(body, flow, cell, metric);
    }
}

// An element that has never flowed has the body's own grams, as at the beginning.
void take_rest_shapes(const SoftBody& body, SoftState& state, std::span<const glm::dmat3> metrics) {
    state.flow = body.at_rest().flow;
    for (std::size_t cell = 0; cell < metrics.size(); ++cell)
        if (metrics[cell] != glm::dmat3(1.0)) take_metric(body, state.flow, cell, metrics[cell]);
}

void follow_shape(const SoftBody& body, const SoftState& state, std::span<const double> holds_N_per_m,
                  std::span<Vec3> held_at_m) {
    const std::span<const Vec3> rest = body.rest().places_m;
    Vec3 middle(0.0), rest_middle(0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        sum += holds_N_per_m[i];
        middle += holds_N_per_m[i] * state.places_m[i];
        rest_middle += holds_N_per_m[i] * rest[i];
    }
    if (!(sum > 0.0)) return;
    middle /= sum;
    rest_middle /= sum;
    glm::dmat3 spread(0.0);
    for (std::size_t i = 0; i < rest.size(); ++i)
        spread += holds_N_per_m[i] * glm::outerProduct(state.places_m[i] - middle, rest[i] - rest_middle);
    const glm::dmat3 back = glm::transpose(rotation_of(spread));
    for (std::size_t i = 0; i < rest.size(); ++i) held_at_m[i] = rest_middle + back * (state.places_m[i] - middle);
}

std::vector<double> stresses_of(const SoftBody& body, const SoftState& state) {
    std::vector<double> stresses;
    stresses.reserve(state.flow.metrics.size());
    for (std::size_t cell = 0; cell < state.flow.metrics.size(); ++cell)
        stresses.push_back(strain_of(body, state, cell).mises_Pa);
    return stresses;
}

double worst_rest_quality(const SoftBody& body, const SoftState& state) {
    double worst = 1.0;
    for (std::size_t cell = 0; cell < state.flow.metrics.size(); ++cell)
        worst = std::min(worst, quality_of(body, state.flow.metrics[cell], cell));
    return worst;
}

}  // namespace burin::bodies
