// SPDX-License-Identifier: MIT
#include "bench/stability/stability_figure7.hpp"

#include <algorithm>
#include <cmath>

#include "bench/stability/stability_sim.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "haptics/forces/touch_force.hpp"

namespace burin::bench {
namespace {

constexpr double kRadius_m = 0.05;
const Vec3 kCentre(0.0, -0.05, 0.0);
constexpr devices::HandGrip kGrip{};  // the simulated hand that follows a path

// Returns a point `depth_m` below the ball's surface, rotated from the top by two angles.
Vec3 on_ball(double around_z, double around_x, double depth_m) {
    const Vec3 way(std::sin(around_z), std::cos(around_z) * std::cos(around_x),
                   std::cos(around_z) * std::sin(around_x));
    return kCentre + (kRadius_m - depth_m) * way;
}

// Moves down on the ball, over it and back, and off again, within four seconds.
std::vector<devices::HandPose> script() {
    std::vector<devices::HandPose> poses{{0.0, on_ball(-0.4, 0.0, -0.008)}, {0.3, on_ball(-0.4, 0.0, -0.008)}};
    for (int i = 0; i <= 60; ++i) {
        const double u = i / 60.0;
        const double around_z = -0.4 + 0.8 * std::sin(3.141592653589793 * u);
        poses.push_back({0.5 + 2.8 * u, on_ball(around_z, 0.35 * std::sin(6.283185307179586 * u), 0.006)});
    }
    poses.push_back({3.5, on_ball(-0.4, 0.0, -0.008)});
    return poses;
}
constexpr int kTicks = 3800;

Vec3 force_at(const Vec3& position, const Vec3& velocity, const Figure7& figure) {
    const Vec3 from_centre = position - kCentre;
    const double distance = std::sqrt(glm::dot(from_centre, from_centre));
    if (distance >= kRadius_m) return Vec3(0.0);
    haptics::TouchInput touch;
    touch.hip_object_m = position;
    touch.normal_object = from_centre / distance;
    touch.bearing_object_m = kCentre + kRadius_m * touch.normal_object;
    touch.velocity_device_m_per_s = velocity;
    touch.stiffness_N_per_m = figure.stiffness_N_per_m;
    touch.damping_Ns_per_m = figure.damping_Ns_per_m;
    return touch_force_device(touch);
}

double squared(const Vec3& v) { return glm::dot(v, v); }

// Returns the mean square difference between the commanded force and that of the true motion `late` ticks before.
double difference_at(const std::vector<Vec3>& given, const std::vector<Vec3>& truth, std::size_t late) {
    double sum = 0.0;
    for (std::size_t i = late; i < given.size(); ++i) sum += squared(given[i] - truth[i - late]);
    return sum / static_cast<double>(given.size() - late);
}

void measure(Figure7Run& run, const std::vector<Vec3>& truth, double tick_s) {
    constexpr std::size_t kLongest = 40;
    std::size_t best = 0;
    for (std::size_t late = 1; late < kLongest; ++late) {
        if (difference_at(run.forces_N, truth, late) < difference_at(run.forces_N, truth, best)) best = late;
    }
    double lag = static_cast<double>(best);
    if (best > 0) {  // vertex of the parabola through three points
        const double a = difference_at(run.forces_N, truth, best - 1), b = difference_at(run.forces_N, truth, best),
                     c = difference_at(run.forces_N, truth, best + 1);
        lag += 0.5 * (a - c) / (a - 2.0 * b + c);
    }
    run.lag_ms = 1e3 * tick_s * lag;
    run.noise_rms_N = std::sqrt(difference_at(run.forces_N, truth, best));
    double sum = 0.0, squares = 0.0;
    int n = 0;
    for (std::size_t i = 1; i < truth.size(); ++i) {
        if (squared(truth[i]) == 0.0) continue;
        const double change = squared(run.forces_N[i] - run.forces_N[i - 1]);
        squares += change;
        sum += std::sqrt(change);
        ++n;
    }
    run.change_rms_N = std::sqrt(squares / std::max(1, n));
    run.change_mean_N = sum / std::max(1, n);
}

void simulate(Figure7Run& run, const Figure7& figure) {
    devices::SimulatedOmni omni(*devices::SimulatedHand::create(script(), devices::HandPath::straight, kGrip));
    const double step_m = omni.description().resolution_m;
    haptics::VelocityWindow window;
    haptics::MovingAverage velocity, force;
    std::vector<Vec3> truth;
    for (int tick = 0; tick < kTicks; ++tick) {
        omni.advance(nanoseconds(figure.tick_s));
        const Vec3 position = omni.read().position_device_m;
        window = haptics::with_position(window, position);
        const haptics::VelocityEstimate estimate =
            haptics::estimate_velocity(run.signals, window, velocity, step_m, figure.tick_s);
        velocity = estimate.average;
        force =
            haptics::with_input(force, force_at(position, estimate.velocity_m_per_s, figure), run.signals.force_alpha);
        omni.write({force.value, Vec3(0.0)});
        run.forces_N.push_back(force.value);
        truth.push_back(force_at(omni.true_position_device_m(), omni.true_velocity_device_m_per_s(), figure));
    }
    measure(run, truth, figure.tick_s);
}

double stiffest(const Figure7Run& run, const Figure7& figure) {
    StabilityCase c;
    c.device.delay_s = 0.001;  // as the simulated Omni has
    c.grip = {0.1, 100.0, 3.0};
    c.signals = run.signals;
    c.wall_damping_Ns_per_m = figure.damping_Ns_per_m;
    return scan_stiffness(c, 10.0, 1e5).stable_up_to_N_per_m;
}

}  // namespace

Figure7 run_figure7(bool quick) {
    Figure7 figure;
    haptics::SignalSettings paper;
    paper.velocity = haptics::VelocityMethod::difference;
    haptics::SignalSettings filtered = paper;
    filtered.force_alpha = 0.9;
    figure.runs = {{"(a) no filter", paper, {}},
                   {"(b) force filter, alpha = 0.9", filtered, {}},
                   {"default: adaptive window", haptics::SignalSettings{}, {}}};
    for (Figure7Run& run : figure.runs) {
        simulate(run, figure);
        if (!quick) run.largest_stable_stiffness_N_per_m = stiffest(run, figure);
    }
    return figure;
}

}  // namespace burin::bench
