// SPDX-License-Identifier: MIT
#include "bodies/solver/plates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin::bodies {
namespace {

struct Plates {
    std::vector<SoftContact> contacts;  // of the lower plate first
    std::size_t lower = 0;

    void close_to(double half_gap_m) {
        for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].offset_m = -half_gap_m;
    }
    [[nodiscard]] double force_N(std::span<const Vec3> places_m) const {
        double sum = 0.0;
        for (const SoftContact& contact : contacts) sum += contact.force_N(places_m);
        return 0.5 * sum;
    }
};

// Points that lie in the half of the body that the plate comes from.
Plates plates_on(const SoftBody& body, const EmbeddedSurface& surface, double half_height_m, double softness) {
    Plates plates;
    const double pressure_per_m = body.material().young_Pa / (softness * half_height_m);
    for (const double side : {-1.0, 1.0})
        for (std::size_t i = 0; i < surface.points.size(); ++i) {
            if (side * place_of(surface.points[i], body.rest().places_m).y < 0.2 * half_height_m) continue;
            SoftContact contact;
            contact.add(surface.points[i], 1.0);
            contact.normal = {0.0, -side, 0.0};
            contact.law.stiffest_N_per_m = pressure_per_m * surface.areas_m2[i];
            plates.contacts.push_back(contact);
        }
    return plates;
}

// The elements' forces, along y, on the corners that started above the middle: what the upper plate has to bear.
double elastic_above_N(const SoftBody& body, const SoftState& state, double above_m) {
    std::vector<double> volumes_m3;
    sum_volumes_around(body, state.places_m, volumes_m3);
    RingSlopes slopes;
    double sum = 0.0;
    for (std::uint32_t corner = 0; corner < body.corners(); ++corner)
        if (body.rest().places_m[corner].y > above_m)
            sum += elastic_force(body, state, volumes_m3, corner, slopes).force_N.y;
    return sum;
}

}  // namespace

PlateFigures press_between_plates(const SoftBody& body, const EmbeddedSurface& surface, const PlatePress& press) {
    double half_height_m = 0.0;
    for (const Anchor& point : surface.points)
        half_height_m = std::max(half_height_m, place_of(point, body.rest().places_m).y);
    Plates plates = plates_on(body, surface, half_height_m, press.softness);
    SoftState state = body.at_rest();
    SoftSolver solver;
    PlateFigures figures;
    const double closes_s = press.closed_m / press.closes_m_per_s, all_s = closes_s + press.settles_s;
    double before_N = 0.0;
    for (double t = press.dt_s; t <= all_s; t += press.dt_s) {
        plates.close_to(half_height_m - press.closed_m * std::min(t / closes_s, 1.0));
        solver.step(body, state, {press.dt_s, press.sweeps, Vec3(0.0), plates.contacts, {}, {}});
        ++figures.steps;
        if (t <= all_s - 0.1 * press.settles_s) before_N = plates.force_N(state.places_m);
    }
    const VolumeNow volume = volume_of(body, state.places_m);
    figures.force_N = plates.force_N(state.places_m);
    figures.elastic_N = elastic_above_N(body, state, 0.0);
    figures.volume_share = volume.volume_m3 / volume_m3(body.rest());
    figures.least_share = volume.least_share;
    figures.drift = std::abs(figures.force_N / before_N - 1.0);
    return figures;
}

double hertz_N(double radius_m, double young_Pa, double poisson, double closed_m) {
    return 4.0 / 3.0 * young_Pa / (1.0 - poisson * poisson) * std::sqrt(radius_m) * closed_m * std::sqrt(closed_m);
}

// closed = 3 (1 - nu^2) F / (4 E a) - f(a) F / (pi E), f(a) = 2 (1 + nu) R^2 / (a^2 + 4 R^2)^(3/2)
// + (1 - nu^2) / (a^2 + 4 R^2)^(1/2), with the contact's radius a by Hertz: a^3 = 3 (1 - nu^2) R F / (4 E).
double tatara_N(double radius_m, double young_Pa, double poisson, double closed_m) {
    const double e = 1.0 - poisson * poisson, r2 = radius_m * radius_m;
    const auto force_of = [&](double a) { return 4.0 * young_Pa * a * a * a / (3.0 * e * radius_m); };
    const auto closed_by = [&](double a) {
        const double s = a * a + 4.0 * r2, force = force_of(a);
        const double f = 2.0 * (1.0 + poisson) * r2 / (s * std::sqrt(s)) + e / std::sqrt(s);
        return a * a / radius_m - f * force / (std::numbers::pi * young_Pa);
    };
    // It rises with a up to a squeeze of more than half the radius.
    double low = 0.0, high = 1.2 * radius_m;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (closed_by(middle) < closed_m ? low : high) = middle;
    }
    return force_of(0.5 * (low + high));
}

}  // namespace burin::bodies
