// SPDX-License-Identifier: MIT
#include "haptics/forces/guidance.hpp"

#include <algorithm>
#include <cmath>

namespace burin::haptics {
namespace {

constexpr double kFullUpTo = 0.75;   // of the reach
constexpr double kKeepsFor = 0.1;    // of the reach; how much nearer another stretch must be to take over
constexpr double kLeadsUpTo = 0.25;  // of the reach; the lead speed falls to zero at twice that

// A point of the curve with its arc length and its distance from the tool.
struct Foot {
    Vec3 at{0.0};
    Vec3 tangent{0.0};  // unit; zero on a stretch of no length
    double along_m = 0.0;
    double distance_m = HUGE_VAL;
};

class Polyline {
public:
    Polyline(const GuidanceCurve& curve, const Vec3& hip) : curve_(curve), hip_(hip) {}

    // The nearest point of the whole curve, and the one reached from `along_m` without going away from the tool.
    struct Feet {
        Foot nearest, kept;
    };
    [[nodiscard]] Feet feet(double along_m) const {
        Feet feet;
        double begin_m = 0.0;
        // The segment that contains along_m, and the arc length at its beginning.
        std::uint32_t home = 0;
        double home_m = 0.0;
        for (std::uint32_t i = 0; i < segments(); ++i) {
            const Foot foot = foot_on(i, begin_m);
            if (foot.distance_m < feet.nearest.distance_m) feet.nearest = foot;
            if (along_m >= begin_m) home = i, home_m = begin_m;
            begin_m += glm::length(point(i + 1) - point(i));
        }
        feet.kept = walk(walk(foot_on(home, home_m), home, home_m, true), home, home_m, false);
        return feet;
    }

    // The point at an arc length, clamped to the curve.
    [[nodiscard]] Foot at(double along_m) const {
        double begin_m = 0.0;
        for (std::uint32_t i = 0; i < segments(); ++i) {
            const Vec3 edge = point(i + 1) - point(i);
            const double l = glm::length(edge);
            if (along_m <= begin_m + l || i + 1 == segments()) {
                const double t = l > 0.0 ? std::clamp((along_m - begin_m) / l, 0.0, 1.0) : 0.0;
                return foot_at(i, begin_m, t);
            }
            begin_m += l;
        }
        return {};
    }

private:
    [[nodiscard]] std::uint32_t segments() const { return curve_.count - 1; }
    [[nodiscard]] Vec3 point(std::uint32_t i) const { return Vec3(curve_.points_object_m[i]); }

    [[nodiscard]] Foot foot_at(std::uint32_t i, double begin_m, double t) const {
        const Vec3 edge = point(i + 1) - point(i);
        const double l = glm::length(edge);
        Foot foot;
        foot.at = point(i) + t * edge;
        if (l > 0.0) foot.tangent = edge / l;
        foot.along_m = begin_m + t * l;
        foot.distance_m = glm::length(foot.at - hip_);
        return foot;
    }
    [[nodiscard]] Foot foot_on(std::uint32_t i, double begin_m) const {
        const Vec3 edge = point(i + 1) - point(i);
        const double l2 = glm::dot(edge, edge);
        const double t = l2 > 0.0 ? std::clamp(glm::dot(hip_ - point(i), edge) / l2, 0.0, 1.0) : 0.0;
        return foot_at(i, begin_m, t);
    }
    // Moves from segment to segment as long as the next one is no farther.
    [[nodiscard]] Foot walk(Foot foot, std::uint32_t i, double begin_m, bool forwards) const {
        while (forwards ? i + 1 < segments() : i > 0) {
            if (forwards) begin_m += glm::length(point(i + 1) - point(i));
            i += forwards ? 1u : -1u;
            if (!forwards) begin_m -= glm::length(point(i + 1) - point(i));
            const Foot next = foot_on(i, begin_m);
            if (!(next.distance_m <= foot.distance_m)) break;
            foot = next;
        }
        return foot;
    }

    const GuidanceCurve& curve_;
    Vec3 hip_;
};

// The attracting point: on the stretch held last, unless another is clearly nearer.
Foot free_foot(const Polyline& curve, const GuidanceState& state, const GuidanceSettings& settings) {
    const Polyline::Feet feet = curve.feet(state.along_m);
    const bool keeps = state.held && feet.kept.distance_m <= feet.nearest.distance_m + kKeepsFor * settings.reach_m;
    return keeps ? feet.kept : feet.nearest;
}

// The leading point advances along the curve, and waits for a hand that lags.
Foot leading_foot(const Polyline& curve, const GuidanceState& state, const GuidanceSettings& settings, double dt_s) {
    if (!state.held) return free_foot(curve, state, settings);
    const Foot before = curve.at(state.along_m);
    const double pace = std::clamp(2.0 - before.distance_m / (kLeadsUpTo * settings.reach_m), 0.0, 1.0);
    return curve.at(std::max(0.0, before.along_m + pace * settings.lead_speed_m_per_s * dt_s));
}

double fade(double distance_m, double reach_m) {
    return std::clamp((1.0 - distance_m / reach_m) / (1.0 - kFullUpTo), 0.0, 1.0);
}

Vec3 at_most(const Vec3& v, double most) {
    const double l = glm::length(v);
    return l > most ? v * (most / l) : v;
}

// The middle of the points, and of their offsets.
struct Middle {
    Vec3 hip_object_m{0.0}, offset_device_m{0.0};
};

Middle middle_of(std::span<const GuidedPoint> points) {
    if (points.size() == 1) return {points[0].hip_object_m, points[0].offset_device_m};
    Middle middle;
    for (const GuidedPoint& p : points) {
        middle.hip_object_m += p.hip_object_m;
        middle.offset_device_m += p.offset_device_m;
    }
    const double count = static_cast<double>(points.size());
    return {middle.hip_object_m / count, middle.offset_device_m / count};
}

// What acts on every point alike.
struct Pull {
    Foot foot;
    Middle middle;
    double faded = 0.0, stiffness_N_per_m = 0.0, damping_Ns_per_m = 0.0, max_N = 0.0;  // of one point
    bool turns = false;
    Vec3 tangent_device{0.0};
    Quat device_from_object{1.0, 0.0, 0.0, 0.0};
};

Vec3 force_on(const GuidedPoint& point, const Pull& pull, const GuidanceInput& in, const GuidanceSettings& settings) {
    Vec3 way_object_m = pull.foot.at - pull.middle.hip_object_m;
    if (pull.turns) {
        const Vec3 place =
            in.scale * (settings.orientation_object * (point.offset_device_m - pull.middle.offset_device_m));
        way_object_m = pull.foot.at + place - point.hip_object_m;
    }
    const double sign = settings.repels ? -1.0 : 1.0;
    const Vec3 spring_N =
        at_most((sign * pull.stiffness_N_per_m / in.scale) * (pull.device_from_object * way_object_m), pull.max_N);
    Vec3 v = in.velocity_device_m_per_s;
    if (in.points.size() > 1) v += glm::cross(in.angular_velocity_device_rad_per_s, point.arm_device_m);
    const Vec3 across = v - glm::dot(v, pull.tangent_device) * pull.tangent_device;
    return at_most(pull.faded * (spring_N - pull.damping_Ns_per_m * across), pull.max_N);
}

}  // namespace

GuidanceStep guide(const GuidanceState& state, const GuidanceInput& in, const GuidanceCurve& curve,
                   const GuidanceSettings& settings) noexcept {
    if (curve.count < 2 || curve.count > kMostCurvePoints || !(settings.stiffness_N_per_m > 0.0)) return {};
    if (in.points.empty()) return {};
    const Middle middle = middle_of(in.points);
    const Polyline line(curve, middle.hip_object_m);
    const bool leads = settings.lead_speed_m_per_s != 0.0 && !settings.repels;
    const Foot foot = leads ? leading_foot(line, state, settings, in.dt_s) : free_foot(line, state, settings);
    if (!(foot.distance_m < settings.reach_m)) return {};  // also rejects NaN
    GuidanceStep step;
    step.next = {foot.along_m, true};
    step.distance_m = foot.distance_m;
    const double count = static_cast<double>(in.points.size());
    Pull pull{foot,
              middle,
              fade(foot.distance_m, settings.reach_m),
              settings.stiffness_N_per_m / count,
              settings.damping_Ns_per_m / count,
              settings.max_force_N / count};
    pull.turns = settings.holds_orientation && !settings.repels;
    pull.device_from_object = glm::conjugate(in.object_from_device_orientation);
    pull.tangent_device = pull.device_from_object * foot.tangent;
    for (const GuidedPoint& point : in.points) {
        const Vec3 force_N = force_on(point, pull, in, settings);
        step.force_device_N += force_N;
        // A free tool is not turned by what draws its middle.
        if (pull.turns) step.torque_device_Nm += glm::cross(point.arm_device_m, force_N);
    }
    return step;
}

}  // namespace burin::haptics
