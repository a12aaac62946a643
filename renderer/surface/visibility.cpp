// SPDX-License-Identifier: MIT
#include "renderer/surface/visibility.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "wall/projection.hpp"

namespace burin::renderer {
namespace {

constexpr double kPad_px = 1.0;
// Share of the screen's distance: a box nearer than this to the plane of an eye counts as bent without further tests.
constexpr double kNearest = 0.02;
// Of the band in which parallax fades, for what is computed in single precision on the device.
constexpr double kRounding = 1e-4;

Vec3 position_of(const shared::SurfaceVertex& v) { return {v.x, v.y, v.z}; }

// Returns whether the segment from the eye to p meets the box, by the slabs of the three axes.
bool meets(const Vec3& eye, const Vec3& p, const Box& box) {
    double enters = 0.0, leaves = 1.0;
    for (int i = 0; i < 3; ++i) {
        const double step = p[i] - eye[i];
        if (step == 0.0) {
            if (eye[i] < box.lo[i] || eye[i] > box.hi[i]) return false;
            continue;
        }
        const double a = (box.lo[i] - eye[i]) / step, b = (box.hi[i] - eye[i]) / step;
        enters = std::max(enters, std::min(a, b));
        leaves = std::min(leaves, std::max(a, b));
    }
    return enters <= leaves;
}

// Returns the plane through the eye and an edge of the screen, given by two points a and b, with `inner` on its inside.
glm::dvec4 plane_through(const Vec3& eye, const Vec3& a, const Vec3& b, const Vec3& inner) {
    Vec3 n = glm::normalize(glm::cross(a - eye, b - eye));
    if (glm::dot(n, inner - eye) < 0.0) n = -n;
    return {n, -glm::dot(n, eye)};
}

bool outside(const glm::dvec4& plane, const Box& box) {
    Vec3 farthest_inside;
    for (int i = 0; i < 3; ++i) farthest_inside[i] = plane[i] > 0.0 ? box.hi[i] : box.lo[i];
    return glm::dot(Vec3(plane), farthest_inside) + plane.w < 0.0;
}

Vec3 box_corner(const Box& box, int corner) {
    return {(corner & 1) != 0 ? box.hi.x : box.lo.x, (corner & 2) != 0 ? box.hi.y : box.lo.y,
            (corner & 4) != 0 ? box.hi.z : box.lo.z};
}

FadedEdges faded_edges(const picture::Picture& picture, const EyeFrustum& middle) {
    const wall::Eyes eyes = wall::eyes_of(picture.viewer);
    const Vec3 middle_world = middle_of(eyes);
    const Mat4 world_from_patch =
        matrix(picture.world_from_object) * glm::translate(Mat4(1.0), picture.lattice_origin_object);
    FadedEdges fade{middle, {}, {}, wall::distance_in_front(picture.screen, middle_world), picture.edge_fade_band};
    const std::array from{eyes.left_world, eyes.right_world, middle_world};
    // The near and far planes do not matter.
    for (std::size_t i = 0; i < 3; ++i) {
        const Mat4& clip = fade.clip_from_patch[i] =
            off_axis_projection(picture.screen, from[i], 0.01, 100.0) * world_from_patch;
        for (const auto& [row, of] : {std::pair{0, 0}, {1, 1}, {2, 3}})
            fade.rows[i][row] = {clip[0][of], clip[1][of], clip[2][of], clip[3][of]};
    }
    return fade;
}

}  // namespace

PatchShape shape_of(std::span<const shared::SurfaceVertex> vertices, std::span<const std::uint32_t> indices) {
    PatchShape shape;
    for (const shared::SurfaceVertex& v : vertices) shape.bounds.include(position_of(v));
    shape.center = shape.bounds.center();
    shape.radius_m = 0.5 * glm::length(shape.bounds.extent());
    Vec3 sum(0.0);
    double edges_squared = 0.0;
    const auto normal_of = [&](std::size_t i) {
        const Vec3 a = position_of(vertices[indices[i]]), b = position_of(vertices[indices[i + 1]]),
                   c = position_of(vertices[indices[i + 2]]);
        edges_squared += glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(a - c, a - c);
        return glm::cross(b - a, c - a);
    };
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) sum += normal_of(i);
    if (!indices.empty()) shape.edge_m = std::sqrt(edges_squared / static_cast<double>(indices.size()));
    const double length = glm::length(sum);
    if (!(length > 0.0)) return shape;
    shape.cone_axis = sum / length;
    double least_cosine = 1.0;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Vec3 n = normal_of(i);
        const double area = glm::length(n);
        if (area > 0.0) least_cosine = std::min(least_cosine, glm::dot(n, shape.cone_axis) / area);
    }
    constexpr double kSpare = 1e-4;  // for the rounding of narrow triangles' normals
    least_cosine -= kSpare;
    if (least_cosine > 0.0) shape.cone_sine = std::sqrt(1.0 - least_cosine * least_cosine);
    return shape;
}

EyePair eye_frusta(const picture::Picture& picture, ImageSize size, const PixelRect& part) {
    const wall::Screen& s = picture.screen;
    const Vec3 across = s.lower_right_world - s.lower_left_world, upright = s.upper_left_world - s.lower_left_world;
    const auto at = [&](double x_px, double y_px) {
        return s.lower_left_world + across * (x_px / size.width) + upright * (1.0 - y_px / size.height);
    };
    const double x0 = part.x - kPad_px, x1 = part.x + (part.width + kPad_px);
    const double y0 = part.y - kPad_px, y1 = part.y + (part.height + kPad_px);
    const Similarity object_from_world = inverse(picture.world_from_object);
    const auto local = [&](const Vec3& p) { return object_from_world * p - picture.lattice_origin_object; };
    const Vec3 lower_left = local(at(x0, y1)), lower_right = local(at(x1, y1)), upper_left = local(at(x0, y0)),
               upper_right = local(at(x1, y0));
    const auto frustum = [&](const Vec3& eye_world) {
        const Vec3 eye = local(eye_world);
        return EyeFrustum{eye,
                          {plane_through(eye, lower_left, upper_left, lower_right),
                           plane_through(eye, lower_right, upper_right, lower_left),
                           plane_through(eye, lower_left, lower_right, upper_left),
                           plane_through(eye, upper_left, upper_right, lower_left)}};
    };
    const wall::Eyes world = wall::eyes_of(picture.viewer);
    EyePair pair{{frustum(world.left_world), frustum(world.right_world)}};
    if (picture.edge_fade > 0.0) pair.fade = faded_edges(picture, frustum(middle_of(world)));
    return pair;
}

namespace {

struct Range {
    double lo = 0.0, hi = 0.0;
};

// Returns the range of a linear function over a box, by the box's centre and half extent.
Range range_of(const glm::dvec4& row, const Vec3& center, const Vec3& half) {
    const double middle = glm::dot(Vec3(row), center) + row.w, reach = glm::dot(glm::abs(Vec3(row)), half);
    return {middle - reach, middle + reach};
}

// Returns whether the box is certain not to be bent, by bounds of each coordinate apart: a fifth of the work of
// projecting its corners, and the answer for nearly all boxes.
bool surely_straight(const FadedEdges& fade, const Box& box) {
    const Vec3 center = box.center(), half = 0.5 * box.extent();
    double w_lo = HUGE_VAL;
    std::array<std::array<Range, 3>, 3> clip;  // of each of the three: x, y and w
    for (std::size_t i = 0; i < 3; ++i) {
        for (int row = 0; row < 3; ++row) clip[i][row] = range_of(fade.rows[i][row], center, half);
        w_lo = std::min(w_lo, clip[i][2].lo);
    }
    if (fade.middle_to_screen_m - clip[2][2].lo <= 0.0) return true;
    if (w_lo < kNearest * fade.middle_to_screen_m) return false;
    for (int axis = 0; axis < 2; ++axis) {
        std::array<Range, 3> seen;
        for (std::size_t i = 0; i < 3; ++i) {
            const Range& at = clip[i][axis];
            const Range& w = clip[i][2];
            seen[i] = {at.lo / (at.lo < 0.0 ? w.lo : w.hi), at.hi / (at.hi < 0.0 ? w.hi : w.lo)};
        }
        const double lo = seen[2].lo, hi = seen[2].hi;
        double half_parallax = 0.0;
        for (std::size_t i = 0; i < 2; ++i) half_parallax = std::max({half_parallax, seen[i].hi - lo, hi - seen[i].lo});
        const double band = std::max(fade.band, 1.125 * half_parallax) + kRounding;
        if (std::max(hi, -lo) > 1.0 - band) return false;
    }
    return true;
}

}  // namespace

bool bent(const EyePair& eyes, const Box& box) {
    if (!eyes.fade) return false;
    const FadedEdges& fade = *eyes.fade;
    if (surely_straight(fade, box)) return false;
    std::array<Box, 3> seen;  // as seen by each of the three, on the screen; without depth
    double farthest_m = 0.0, nearest_m = HUGE_VAL;
    for (int corner = 0; corner < 8; ++corner) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec4 clip = fade.clip_from_patch[i] * glm::dvec4(box_corner(box, corner), 1.0);
            nearest_m = std::min(nearest_m, clip.w);
            if (i == 2) farthest_m = std::max(farthest_m, fade.middle_to_screen_m - clip.w);
            seen[i].include({clip.x / clip.w, clip.y / clip.w, 0.0});
        }
    }
    if (farthest_m <= 0.0) return false;                              // at or behind the screen
    if (nearest_m < kNearest * fade.middle_to_screen_m) return true;  // cannot be projected
    for (int axis = 0; axis < 2; ++axis) {
        const double lo = seen[2].lo[axis], hi = seen[2].hi[axis];
        double half_parallax = 0.0;
        for (std::size_t i = 0; i < 2; ++i)
            half_parallax = std::max({half_parallax, seen[i].hi[axis] - lo, hi - seen[i].lo[axis]});
        const double band = std::max(fade.band, 1.125 * half_parallax) + kRounding;
        if (std::max(hi, -lo) > 1.0 - band) return true;
    }
    return false;
}

bool beside(const EyeFrustum& eye, const Box& box) {
    return std::ranges::any_of(eye.planes, [&](const glm::dvec4& plane) { return outside(plane, box); });
}

bool beside(const EyeFrustum& eye, const EyeFrustum& middle, const Box& box) {
    for (std::size_t i = 0; i < eye.planes.size(); ++i)
        if (outside(eye.planes[i], box) && outside(middle.planes[i], box)) return true;
    return false;
}

bool turned_away(const EyeFrustum& eye, const PatchShape& patch) {
    if (patch.cone_sine > 1.0) return false;
    const Vec3 to = patch.center - eye.eye;
    return glm::dot(to, patch.cone_axis) > patch.cone_sine * glm::length(to) + patch.radius_m;
}

bool behind(const Vec3& eye, const Box& box, const Box& occluder) {
    for (int corner = 0; corner < 8; ++corner) {
        if (!meets(eye, box_corner(box, corner), occluder)) return false;
    }
    return true;
}

Hidden hidden(const EyePair& eyes, const PatchShape& patch, std::span<const Box> occluders) {
    return hidden(eyes, patch, occluders, bent(eyes, patch.bounds));
}

Hidden hidden(const EyePair& eyes, const PatchShape& patch, std::span<const Box> occluders, bool is_bent) {
    if (is_bent) {
        const bool none_sees = std::ranges::all_of(
            eyes.eyes, [&](const EyeFrustum& eye) { return beside(eye, eyes.fade->middle, patch.bounds); });
        return none_sees ? Hidden::beside : Hidden::no;
    }
    Hidden reason = Hidden::no;
    for (const EyeFrustum& eye : eyes.eyes) {
        if (beside(eye, patch.bounds)) {
            reason = Hidden::beside;
        } else if (turned_away(eye, patch)) {
            reason = Hidden::turned_away;
        } else if (std::ranges::any_of(occluders,
                                       [&](const Box& solid) { return behind(eye.eye, patch.bounds, solid); })) {
            reason = Hidden::behind;
        } else {
            return Hidden::no;
        }
    }
    return reason;
}

}  // namespace burin::renderer
