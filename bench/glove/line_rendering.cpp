// SPDX-License-Identifier: MIT
#include "bench/glove/line_rendering.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>

namespace burin::bench {
namespace {

constexpr double kStep_s = 1e-4, kController_s = 2e-3, kHostTick_s = 1e-3;
constexpr double kMass_kg = 0.1, kHandDamping_Ns_per_m = 3.0, kHand_N_per_m = 100.0;
constexpr double kBitsAByte = 10.0, kSetBytes = 32.0, kCommandBytes = 8.0;

double spring(const LineTask& task, double depth_m, double speed_m_per_s) {
    if (depth_m <= 0.0) return 0.0;
    const double force = task.stiffness_N_per_m * depth_m + task.damping_Ns_per_m * speed_m_per_s;
    return std::clamp(force, 0.0, task.most_force_N);
}

// What is commanded to the piston, from depths that are sampled and sent.
class Renderer {
public:
    explicit Renderer(const LineTask& task) : task_(task) {}

    double command(double time_s, double depth_m) {
        return task_.at == MadeAt::controller ? at_controller(time_s, depth_m) : at_host(time_s, depth_m);
    }

private:
    double at_controller(double time_s, double depth_m) {
        if (time_s < next_s_) return commanded_N_;
        next_s_ += kController_s;
        return commanded_N_ = force_of(depth_m, kController_s);
    }
    double at_host(double time_s, double depth_m) {
        const double set_s = kSetBytes * kBitsAByte / task_.bits_per_s;
        const double answer_s = kCommandBytes * kBitsAByte / task_.bits_per_s;
        if (time_s >= next_s_) {
            sets_.push({next_s_ + set_s, depth_m});
            next_s_ += set_s;
        }
        while (!sets_.empty() && sets_.front().at_s <= time_s) {
            // The host's next tick sees it, and its answer is sent once the one before is out.
            const double tick_s = std::ceil(sets_.front().at_s / kHostTick_s) * kHostTick_s;
            line_free_s_ = std::max(line_free_s_, tick_s) + answer_s;
            commands_.push({line_free_s_, force_of(sets_.front().value, set_s)});
            sets_.pop();
        }
        while (!commands_.empty() && commands_.front().at_s <= time_s) {
            commanded_N_ = commands_.front().value;
            commands_.pop();
        }
        return commanded_N_;
    }
    double force_of(double depth_m, double since_s) {
        const double speed = is_first_ ? 0.0 : (depth_m - last_m_) / since_s;
        is_first_ = false;
        last_m_ = depth_m;
        return spring(task_, depth_m, speed);
    }

    struct Due {
        double at_s, value;
    };
    LineTask task_;
    std::queue<Due> sets_, commands_;
    double next_s_ = 0.0, line_free_s_ = 0.0, commanded_N_ = 0.0, last_m_ = 0.0;
    bool is_first_ = true;
};

// The force that the piston gives, as it follows what is commanded.
class Piston {
public:
    explicit Piston(double cutoff_Hz) : share_(1.0 - std::exp(-2.0 * std::numbers::pi * cutoff_Hz * kStep_s)) {}
    double follow(double commanded_N) { return force_N_ += share_ * (commanded_N - force_N_); }

private:
    double share_, force_N_ = 0.0;
};

// Leads the finger along a path, whatever pushes it, and tells each step's depth and force.
void lead(const LineTask& task, double duration_s, const std::function<double(double)>& depth_at,
          const std::function<void(double, double, double)>& each) {
    Renderer renderer(task);
    Piston piston(task.piston_Hz);
    for (double t = 0.0; t < duration_s; t += kStep_s) {
        const double depth_m = depth_at(t);
        each(t, depth_m, piston.follow(renderer.command(t, depth_m)));
    }
}

double stiffest(LineTask task) {
    const auto rests_at = [&](double stiffness) {
        task.stiffness_N_per_m = stiffness;
        return comes_to_rest(task);
    };
    // The least that does not, on a fine grid: rest is not monotonic where a tap happens to bounce well.
    double rested = 0.0;
    for (double k = 10.0; k < 20'000.0; k *= 1.02) {
        if (!rests_at(k)) break;
        rested = k;
    }
    return rested;
}

}  // namespace

bool comes_to_rest(const LineTask& task) {
    Renderer renderer(task);
    Piston piston(task.piston_Hz);
    constexpr double kWanted_m = 0.02, kTap_m_per_s = 0.1;
    double depth_m = -0.01, speed = kTap_m_per_s, least = HUGE_VAL, most = -HUGE_VAL;
    double wanted_m = depth_m;
    for (double t = 0.0; t < 3.0; t += kStep_s) {
        wanted_m = std::min(kWanted_m, wanted_m + kTap_m_per_s * kStep_s);
        const double wanted_speed = wanted_m < kWanted_m ? kTap_m_per_s : 0.0;
        const double force = piston.follow(renderer.command(t, depth_m));
        const double hand = kHand_N_per_m * (wanted_m - depth_m) + kHandDamping_Ns_per_m * (wanted_speed - speed);
        speed += (hand - force) / kMass_kg * kStep_s;
        depth_m += speed * kStep_s;
        if (t < 2.5) continue;
        least = std::min(least, depth_m);
        most = std::max(most, depth_m);
    }
    return most - least < 1e-4;
}

LineFigures measure_line(MadeAt at, double bits_per_s, double piston_Hz) {
    LineTask task{.at = at, .bits_per_s = bits_per_s, .piston_Hz = piston_Hz};
    LineFigures figures{.at = at, .bits_per_s = bits_per_s};
    figures.sets_per_s = bits_per_s / (kSetBytes * kBitsAByte);
    figures.stiffest_N_per_m = stiffest(task);
    task.stiffness_N_per_m = 200.0;
    constexpr double kSpeed_m_per_s = 0.02;
    double behind = 0.0;
    int counted = 0;
    lead(
        task, 1.5, [](double t) { return kSpeed_m_per_s * (t - 0.1); },
        [&](double t, double depth_m, double force_N) {
            if (t < 1.0) return;  // the ramp has settled
            behind += depth_m / kSpeed_m_per_s - force_N / (task.stiffness_N_per_m * kSpeed_m_per_s);
            ++counted;
        });
    figures.lag_s = behind / counted;
    double squares = 0.0;
    counted = 0;
    constexpr double kSqueeze_m = 0.01;
    lead(
        task, 4.0, [](double t) { return 0.5 * kSqueeze_m * (1.0 - std::cos(2.0 * std::numbers::pi * t)); },
        [&](double t, double depth_m, double force_N) {
            if (t < 1.0) return;
            const double away = force_N - spring(task, depth_m, 0.0);
            squares += away * away;
            ++counted;
        });
    figures.force_error = std::sqrt(squares / counted) / (task.stiffness_N_per_m * kSqueeze_m);
    return figures;
}

std::vector<LineFigures> compare_lines(const std::vector<double>& bits_per_s) {
    std::vector<LineFigures> all{measure_line(MadeAt::controller, bits_per_s.empty() ? 38'400 : bits_per_s.front())};
    for (const double rate : bits_per_s) all.push_back(measure_line(MadeAt::host, rate));
    return all;
}

}  // namespace burin::bench
