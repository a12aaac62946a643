// SPDX-License-Identifier: MIT
// What a touched mesh stores of one triangle, for the normals at its corners and for its patch. Computed once for an
// edit, then read from all three corners. Metres, any frame.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/mesh/triangle.hpp"

namespace burin::geometry {

// Facets count in a normal as Max, "Weights for computing vertex normals from facet normals" (Journal of Graphics Tools
// 4(2), 1999) weights them: by the cross product of the two edges at the vertex over the product of their squared
// lengths, which is exact for vertices on a sphere however they are meshed. The cross product is the same at all three
// corners, so 1 / (ab^2 ca^2) at corner a is bc^2 / (ab^2 bc^2 ca^2): no angle, no root, and one division for all
// three.
struct alignas(64) TouchFacet {
    Vec3 cross{0.0};      // product of two edges: along the normal, of length twice the area
    double cross2 = 0.0;  // its squared length
    std::array<double, 3>
        weight{};             // weight of cross in the normal of each corner, m^-4; 0 where the angle is below 1e-6
    std::uint32_t slot = 0;   // the triangle's slot in the owner's numbering
    float edge_sum_m = 0.0f;  // 0 if it is_degenerate

    TouchFacet() = default;
    TouchFacet(const Triangle& t, std::uint32_t slot_there) noexcept {
        const Vec3 ab = t.b - t.a, bc = t.c - t.b, ca = t.a - t.c;
        const double ab2 = glm::dot(ab, ab), bc2 = glm::dot(bc, bc), ca2 = glm::dot(ca, ca);
        cross = glm::cross(ca, ab);
        cross2 = glm::dot(cross, cross);
        slot = slot_there;
        if (!is_degenerate(t)) edge_sum_m = static_cast<float>(std::sqrt(ab2) + std::sqrt(bc2) + std::sqrt(ca2));
        // Compares with the squared sine of an angle of 1e-6, below which the facet's direction is noise.
        const double shared = 1.0 / (ab2 * bc2 * ca2), area2 = 1e12 * cross2;
        weight = {area2 > ca2 * ab2 ? bc2 * shared : 0.0, area2 > ab2 * bc2 ? ca2 * shared : 0.0,
                  area2 > bc2 * ca2 ? ab2 * shared : 0.0};
    }
};
static_assert(sizeof(TouchFacet) == 64, "one cache line each: an edit goes through thousands, six times");

}  // namespace burin::geometry
