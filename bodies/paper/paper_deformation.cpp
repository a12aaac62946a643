// SPDX-License-Identifier: MIT
#include "bodies/paper/paper_deformation.hpp"

#include <algorithm>
#include <numeric>

namespace burin::bodies {
namespace {

// How deep a point is below the surface, by the vertex that is nearest; below 0 outside.
double depth_of(const PaperSurface& surface, const Vec3& point_m) {
    const auto nearest = std::ranges::min_element(
        surface.places_m, {}, [&](const Vec3& place) { return glm::dot(place - point_m, place - point_m); });
    const auto index = static_cast<std::size_t>(nearest - surface.places_m.begin());
    return glm::dot(*nearest - point_m, surface.normals[index]);
}

}  // namespace

double closed_share(std::span<const double> angles_rad, double largest_sum_rad) {
    return std::clamp(std::accumulate(angles_rad.begin(), angles_rad.end(), 0.0) / largest_sum_rad, 0.0, 1.0);
}

std::vector<Vec3> between(std::span<const Vec3> open, std::span<const Vec3> closed, double share) {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < open.size(); ++i) all.push_back((1.0 - share) * open[i] + share * closed[i]);
    return all;
}

std::vector<Vec3> normals_between(std::span<const Vec3> open, std::span<const Vec3> closed, double share) {
    std::vector<Vec3> all = between(open, closed, share);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double length = glm::length(all[i]);
        all[i] = length > 0.0 ? all[i] / length : open[i];  // opposite ones, half way
    }
    return all;
}

std::vector<double> dents_m(const PaperSurface& surface, std::span<const Vec3> points_m, double radius_m,
                            PaperForm form) {
    std::vector<double> dents(surface.places_m.size(), 0.0);
    for (const Vec3& point_m : points_m) {
        const double deepest_m = form == PaperForm::corrected ? depth_of(surface, point_m) : radius_m;
        if (!(deepest_m > 0.0)) continue;
        for (std::size_t i = 0; i < dents.size(); ++i) {
            const Vec3 way = surface.places_m[i] - point_m;
            const double near = glm::dot(way, way) / (radius_m * radius_m);
            if (near >= 1.0) continue;
            const double dent = (1.0 - near) * std::max(0.0, glm::dot(way, surface.normals[i]));
            dents[i] = std::max(dents[i], std::min(dent, deepest_m));
        }
    }
    return dents;
}

PaperSurface dented(const PaperSurface& surface, std::span<const double> dents_m, PaperForm form) {
    double pushed_m3 = 0.0, free_m2 = 0.0;
    for (std::size_t i = 0; i < dents_m.size(); ++i) {
        pushed_m3 += dents_m[i] * surface.areas_m2[i];
        if (dents_m[i] <= 0.0) free_m2 += surface.areas_m2[i];
    }
    const double out_m = form == PaperForm::corrected && free_m2 > 0.0 ? pushed_m3 / free_m2 : 0.0;
    PaperSurface moved = surface;
    for (std::size_t i = 0; i < dents_m.size(); ++i)
        moved.places_m[i] += (dents_m[i] > 0.0 ? -dents_m[i] : out_m) * surface.normals[i];
    return moved;
}

PaperSurface PaperPutty::shape(PaperForm form) const {
    return dents_m.empty() ? reference : dented(reference, dents_m, form);
}

PaperPutty step_putty_of_paper(PaperPutty putty, std::span<const Vec3> points_m, double radius_m, PaperForm form) {
    const std::vector<double> now = dents_m(putty.reference, points_m, radius_m, form);
    const bool touches = std::ranges::any_of(now, [](double dent) { return dent > 0.0; });
    if (form == PaperForm::printed) return {dented(putty.reference, now, form), {}};
    if (!touches) return {putty.shape(form), {}};  // the contact is over: what it has left is the reference
    putty.dents_m.resize(now.size(), 0.0);
    for (std::size_t i = 0; i < now.size(); ++i) putty.dents_m[i] = std::max(putty.dents_m[i], now[i]);
    return putty;
}

}  // namespace burin::bodies
