// SPDX-License-Identifier: MIT
#include "wall/output_settings.hpp"

#include <cmath>

#include "shaders/shared/output_rules.h"

namespace burin::wall {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

constexpr double kLeastDeterminant = 1e-12;

std::unexpected<Error> singular() {
    return fail("homography", "it squeezes the picture into a line", "give one that can be inverted");
}

bool is_fraction(double x) { return x >= 0.0 && x <= 1.0; }  // false for NaN too

}  // namespace

Result<Homography> homography_onto(const std::array<Vec2, 4>& p) {
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 in = p[i] - p[(i + 3) % 4], out = p[(i + 1) % 4] - p[i];
        // Clockwise on a picture whose v points down; a sine below a thousandth counts as a line.
        if (!(cross(in, out) > 1e-3 * glm::length(in) * glm::length(out))) {
            return fail("homography", "its corners do not make a picture: three are on a line, or they cross over",
                        "give upper left, upper right, lower right, lower left, as seen from the viewer");
        }
    }
    // p holds the output positions of the picture's (0,0), (1,0), (1,1), (0,1).
    const Vec2 sum = p[0] - p[1] + p[2] - p[3], d1 = p[1] - p[2], d2 = p[3] - p[2];
    const double denominator = cross(d1, d2);
    const double g = cross(sum, d2) / denominator, h = cross(d1, sum) / denominator;
    const Vec2 along_u = p[1] - p[0] + g * p[1], along_v = p[3] - p[0] + h * p[3];
    const Homography output_from_picture{Vec3{along_u, g}, Vec3{along_v, h}, Vec3{p[0], 1.0}};
    return glm::inverse(output_from_picture);
}

Result<Homography> homography_from_rows(const std::array<std::array<double, 3>, 3>& rows) {
    Homography output_from_picture;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            output_from_picture[column][row] = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        }
    }
    const double determinant = glm::determinant(output_from_picture);
    if (!(std::abs(determinant) > kLeastDeterminant)) return singular();
    // Chooses the sign for which the picture's middle lies in front of the horizon.
    const Homography inverse = glm::inverse(output_from_picture);
    const Vec3 middle = output_from_picture * Vec3{0.5, 0.5, 1.0};
    return middle.z > 0.0 ? inverse : -1.0 * inverse;
}

Vec2 warped(const Homography& picture_from_output, const Vec2& output_uv) {
    return shared::warped_place(picture_from_output[0], picture_from_output[1], picture_from_output[2], output_uv);
}

double light_share(const EdgeFade& b, const Vec2& uv) {
    return shared::blended_share(uv, b.left, b.right, b.top, b.bottom, b.curve);
}

Result<void> check_output(const OutputSettings& s) {
    const EdgeFade& b = s.blend;
    if (!is_fraction(b.left) || !is_fraction(b.right) || !is_fraction(b.top) || !is_fraction(b.bottom)) {
        return fail("edge blend", "an overlap is not between 0 and 1", "give it as a fraction of the picture's side");
    }
    if (!is_projector_gamma(b.gamma)) {
        return fail("edge blend", "gamma is not between 1 and 4", "measure the projector's, or take 2.2");
    }
    if (!(b.curve >= 1.0 && b.curve <= 8.0)) return fail("edge blend", "curve is not between 1 and 8", "take 2");
    if (s.homography && !(std::abs(glm::determinant(*s.homography)) > kLeastDeterminant)) return singular();
    return {};
}

}  // namespace burin::wall
