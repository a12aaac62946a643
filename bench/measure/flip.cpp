// SPDX-License-Identifier: MIT
// Section and equation numbers refer to the paper named in flip.hpp.
#include "bench/measure/flip.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace burin::bench {
namespace {

constexpr double kPi = std::numbers::pi;

// ---- Colour

// Columns: XYZ of a unit of linear red, green and blue; from
// the primaries and D65 of IEC 61966-2-1 without its rounding.
const glm::dmat3 kXyzFromLinear = [] {
    const auto xyz_of = [](double x, double y) { return Vec3(x / y, 1.0, (1.0 - x - y) / y); };
    const glm::dmat3 primaries(xyz_of(0.64, 0.33), xyz_of(0.30, 0.60), xyz_of(0.15, 0.06));
    const Vec3 share = glm::inverse(primaries) * xyz_of(0.3127, 0.3290);
    return glm::dmat3(primaries[0] * share.x, primaries[1] * share.y, primaries[2] * share.z);
}();
const glm::dmat3 kLinearFromXyz = glm::inverse(kXyzFromLinear);
const Vec3 kWhite = kXyzFromLinear * Vec3(1.0);

// Y Cx Cz, linear opponent colours: section 3.1.1.
Vec3 opponent_of_linear(const Vec3& rgb) {
    const Vec3 relative = xyz_of_linear(rgb) / kWhite;
    return {116.0 * relative.y - 16.0, 500.0 * (relative.x - relative.y), 200.0 * (relative.y - relative.z)};
}

Vec3 linear_of_opponent(const Vec3& opponent) {
    const double y = (opponent.x + 16.0) / 116.0;
    return kLinearFromXyz * (kWhite * Vec3(opponent.y / 500.0 + y, y, y - opponent.z / 200.0));
}

// Colours look less colourful when dark: the Hunt effect, section 3.1.2.
Vec3 hunt(const Vec3& lab) { return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z}; }

// City-block in lightness, Euclidean in chroma: HyAB, section 3.1.2 (Abasi et al. 2020).
double hyab(const Vec3& a, const Vec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

constexpr double kColourExponent = 0.7;        // q_c
constexpr double kBend = 0.4, kAtBend = 0.95;  // p_c and p_t: the bend beyond which large errors are compressed
constexpr double kFeatureExponent = 0.5;       // q_f
constexpr double kFeatureDegrees = 0.082;      // w: the width of the edges to detect
constexpr double kDeviations = 3.0;            // radius of a kernel

double largest_colour_error() {
    const double apart = hyab(hunt(lab_of_linear({0, 1, 0})), hunt(lab_of_linear({0, 0, 1})));
    return std::pow(apart, kColourExponent);
}

// Equation 5: linear up to kBend of the largest error; larger errors share the rest up to 1.
double redistributed(double error, double largest) {
    const double bend = kBend * largest;
    return error < bend ? kAtBend / bend * error : kAtBend + (error - bend) / (largest - bend) * (1.0 - kAtBend);
}

// ---- Filters

using Plane = std::vector<float>;
using Kernel = std::vector<float>;  // of odd length

struct Planes {
    Plane y, cx, cz;
};

template <typename Function>
Kernel kernel_of(int radius, Function value) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(static_cast<float>(value(static_cast<double>(i))));
    return kernel;
}

// Scales positive weights to the sum 1 and negative ones to -1: the response to a step of full height is 1.
Kernel balanced(Kernel kernel) {
    float up = 0.0f, down = 0.0f;
    for (const float w : kernel) (w > 0.0f ? up : down) += std::abs(w);
    for (float& w : kernel) w /= w > 0.0f ? up : (down > 0.0f ? down : 1.0f);
    return kernel;
}

// Adds weight * row to out; called once for each tap of a kernel, as compilers vectorise this loop.
void add_scaled(std::span<float> out, const float* row, float weight) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += weight * row[i];
}

// Filters along rows; a picture continues beyond its edges with its outermost pixels.
Plane filtered_along_rows(const Plane& in, ImageSize size, const Kernel& kernel) {
    const std::size_t w = size.width, radius = kernel.size() / 2;
    Plane out(in.size(), 0.0f), padded(w + 2 * radius);
    for (std::size_t y = 0; y < size.height; ++y) {
        const float* row = in.data() + y * w;
        std::fill_n(padded.begin(), radius, row[0]);
        std::copy_n(row, w, padded.begin() + static_cast<std::ptrdiff_t>(radius));
        std::fill_n(padded.begin() + static_cast<std::ptrdiff_t>(radius + w), radius, row[w - 1]);
        for (std::size_t t = 0; t < kernel.size(); ++t)
            add_scaled(std::span(out).subspan(y * w, w), padded.data() + t, kernel[t]);
    }
    return out;
}

Plane filtered_along_columns(const Plane& in, ImageSize size, const Kernel& kernel) {
    const std::size_t w = size.width;
    const auto radius = static_cast<std::ptrdiff_t>(kernel.size() / 2);
    const auto last = static_cast<std::ptrdiff_t>(size.height) - 1;
    Plane out(in.size(), 0.0f);
    for (std::ptrdiff_t y = 0; y <= last; ++y)
        for (std::ptrdiff_t t = 0; t < static_cast<std::ptrdiff_t>(kernel.size()); ++t) {
            const auto from = static_cast<std::size_t>(std::clamp(y + t - radius, std::ptrdiff_t{0}, last));
            add_scaled(std::span(out).subspan(static_cast<std::size_t>(y) * w, w), in.data() + from * w,
                       kernel[static_cast<std::size_t>(t)]);
        }
    return out;
}

Plane filtered(const Plane& in, ImageSize size, const Kernel& along_rows, const Kernel& along_columns) {
    return filtered_along_columns(filtered_along_rows(in, size, along_rows), size, along_columns);
}

// ---- Contrast sensitivity of the eye (section 3.1.1, table 1): a
// sum of Gaussians in degrees, a sqrt(pi / b) exp(-pi^2 d^2 / b).

struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kLightness{1.0, 0.0047, 0.0, 1e-5};
constexpr Sensitivity kRedGreen{1.0, 0.0053, 0.0, 1e-5};
constexpr Sensitivity kBlueYellow{34.1, 0.04, 13.5, 0.025};

Plane seen(const Plane& in, ImageSize size, const Sensitivity& s, double ppd) {
    // All three channels use the radius of the widest: 3 standard deviations of b = 0.04.
    const int radius = static_cast<int>(std::ceil(kDeviations * std::sqrt(0.04 / (2.0 * kPi * kPi)) * ppd));
    Plane out(in.size(), 0.0f);
    double total = 0.0;
    for (const auto& [a, b] : {std::pair(s.a1, s.b1), std::pair(s.a2, s.b2)}) {
        if (a == 0.0) continue;
        Kernel kernel = kernel_of(radius, [&](double i) { return std::exp(-kPi * kPi * (i / ppd) * (i / ppd) / b); });
        double sum = 0.0;
        for (const float w : kernel) sum += w;
        // Weight of the two-dimensional kernel, which is the product of two one-dimensional ones.
        const double weight = a * std::sqrt(kPi / b);
        total += weight * sum * sum;
        add_scaled(out, filtered(in, size, kernel, kernel).data(), static_cast<float>(weight));
    }
    for (float& value : out) value /= static_cast<float>(total);
    return out;
}

Planes opponent_planes(const Image& image) {
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < 256; ++i) linear[i] = linear_of_srgb8(static_cast<std::uint8_t>(i));
    const std::size_t pixels = std::size_t{image.size.width} * image.size.height;
    Planes planes{Plane(pixels), Plane(pixels), Plane(pixels)};
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint8_t* p = image.rgba.data() + 4 * i;
        const Vec3 opponent = opponent_of_linear({linear[p[0]], linear[p[1]], linear[p[2]]});
        planes.y[i] = static_cast<float>(opponent.x);
        planes.cx[i] = static_cast<float>(opponent.y);
        planes.cz[i] = static_cast<float>(opponent.z);
    }
    return planes;
}

// Returns the perceived colour of each pixel, as CIELab with the Hunt effect.
std::vector<Vec3f> seen_colours(const Planes& in, ImageSize size, double ppd) {
    const Plane y = seen(in.y, size, kLightness, ppd), cx = seen(in.cx, size, kRedGreen, ppd),
                cz = seen(in.cz, size, kBlueYellow, ppd);
    std::vector<Vec3f> colours(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
        const Vec3 rgb = glm::clamp(linear_of_opponent({y[i], cx[i], cz[i]}), 0.0, 1.0);
        colours[i] = Vec3f(hunt(lab_of_linear(rgb)));
    }
    return colours;
}

// ---- Edges and points (section 3.2): first and second derivatives of a Gaussian, on lightness from 0 to 1.

struct Features {
    Plane edge, point;  // magnitude of the response in x and y
};

Plane lengths(const Plane& x, const Plane& y) {
    Plane out(x.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::hypot(x[i], y[i]);
    return out;
}

Features features_of(Plane lightness, ImageSize size, double ppd) {
    for (float& value : lightness) value = (value + 16.0f) / 116.0f;
    const double sigma = 0.5 * kFeatureDegrees * ppd;
    const int radius = static_cast<int>(std::ceil(kDeviations * sigma));
    const auto gauss = [&](double i) { return std::exp(-i * i / (2.0 * sigma * sigma)); };
    const Kernel smooth = balanced(kernel_of(radius, gauss));
    const Kernel first = balanced(kernel_of(radius, [&](double i) { return -i * gauss(i); }));
    const Kernel second =
        balanced(kernel_of(radius, [&](double i) { return (i * i / (sigma * sigma) - 1.0) * gauss(i); }));
    return {lengths(filtered(lightness, size, first, smooth), filtered(lightness, size, smooth, first)),
            lengths(filtered(lightness, size, second, smooth), filtered(lightness, size, smooth, second))};
}

Result<void> check(const Image& reference, const Image& test, double ppd) {
    const auto text = [](ImageSize size) { return std::to_string(size.width) + " x " + std::to_string(size.height); };
    for (const Image* image : {&reference, &test}) {
        const std::size_t bytes = std::size_t{4} * image->size.width * image->size.height;
        if (bytes == 0 || image->rgba.size() != bytes) {
            return fail("picture", "has no pixels, or not as many as its size says",
                        "compare pictures that were drawn");
        }
    }
    if (reference.size.width != test.size.width || reference.size.height != test.size.height) {
        return fail("pictures", "differ in size: " + text(reference.size) + " and " + text(test.size),
                    "draw both at the same size");
    }
    if (!(ppd >= 1.0 && ppd <= 1000.0)) {
        return fail("pixels per degree", std::to_string(ppd) + " is not possible", "choose 1 to 1000; 67 is usual");
    }
    return {};
}

}  // namespace

double linear_of_srgb8(std::uint8_t value) {
    const double c = value / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
}

Vec3 xyz_of_linear(const Vec3& rgb) { return kXyzFromLinear * rgb; }

Vec3 lab_of_linear(const Vec3& rgb) {
    constexpr double kKnee = 6.0 / 29.0;  // CIE 15: where the cube root turns into a straight line
    const auto f = [](double t) {
        return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3.0 * kKnee * kKnee) + 4.0 / 29.0;
    };
    const Vec3 relative = xyz_of_linear(rgb) / kWhite;
    const double x = f(relative.x), y = f(relative.y), z = f(relative.z);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Result<FlipMap> flip(const Image& reference, const Image& test, double pixels_per_degree) {
    BURIN_TRY_DO(check(reference, test, pixels_per_degree));
    const ImageSize size = reference.size;
    const Planes a = opponent_planes(reference), b = opponent_planes(test);
    const std::vector<Vec3f> colour_a = seen_colours(a, size, pixels_per_degree),
                             colour_b = seen_colours(b, size, pixels_per_degree);
    const Features in_a = features_of(a.y, size, pixels_per_degree), in_b = features_of(b.y, size, pixels_per_degree);
    const double largest = largest_colour_error();

    FlipMap map{size, std::vector<float>(colour_a.size()), 0.0, 0.0};
    for (std::size_t i = 0; i < map.error.size(); ++i) {
        const double apart = hyab(Vec3(colour_a[i]), Vec3(colour_b[i]));
        const double colour = redistributed(std::pow(apart, kColourExponent), largest);
        const double feature = std::max(std::abs(in_a.edge[i] - in_b.edge[i]), std::abs(in_a.point[i] - in_b.point[i]));
        // Each of the two responses is at most 1: divided by sqrt 2 their
        // magnitude is at most 1 (equation 8). Equation 9 combines it with colour.
        const double sharp = std::clamp(std::pow(feature / std::numbers::sqrt2, kFeatureExponent), 0.0, 1.0);
        const double error = colour > 0.0 ? std::clamp(std::pow(colour, 1.0 - sharp), 0.0, 1.0) : 0.0;
        map.error[i] = static_cast<float>(error);
        map.mean += error;
        map.largest = std::max(map.largest, error);
    }
    map.mean /= static_cast<double>(map.error.size());
    return map;
}

}  // namespace burin::bench
