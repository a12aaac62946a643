// SPDX-License-Identifier: MIT
// Grooves that a steered hand carves into a block through the haptic loop, in simulated time: a path is sampled, its
// targets are delivered, and grooves are compared ray by ray.
// Frames: the block's top is z = 0 in the object frame; device and object differ by a translation alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "devices/haptic/simulated_omni.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "sculpt/carved_scene.hpp"
#include "sculpt/load_workpiece.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/felt_tool.hpp"

namespace burin::sculpt {

constexpr double kGrooveBall_m = 0.003, kGrooveCell_m = 0.0005;
const Vec3 kGrooveBlock_m(0.15, 0.116, 0.012);

// A target, and when the hand is told of it.
struct Delivered {
    devices::SteeredTarget target;
    Nanoseconds arrival_ns = 0;
};

// Where the hand is steered, in the device frame, from rest to rest; the button is down from press_s on.
struct GroovePath {
    std::function<Vec3(double)> at;
    double press_s = 0.2, begin_s = 0.4, end_s = 0.0;  // the motion

    [[nodiscard]] devices::SteeredTarget target(double time_s) const {
        return {nanoseconds(time_s), at(std::clamp(time_s, begin_s, end_s)), Quat{1, 0, 0, 0},
                time_s >= press_s ? 1u : 0u};
    }
    [[nodiscard]] double over_s() const { return end_s + 0.9; }
};

// The hand goes straight down into the block in the first 0.2 s of the motion, and straight up in the last: corners, at
// times that are multiples of 0.2 s, as all corners are.
constexpr double kGrooveDown_s = 0.2, kGrooveUp_m = 0.002, kGrooveDepth_m = 0.004;

inline GroovePath groove_path(double duration_s, const std::function<Vec2(double)>& across) {
    GroovePath path;
    path.end_s = path.begin_s + duration_s + 2.0 * kGrooveDown_s;
    path.at = [=, begin = path.begin_s, end = path.end_s](double t) {
        const double down = std::clamp((t - begin) / kGrooveDown_s, 0.0, 1.0);
        const double up = std::clamp((end - t) / kGrooveDown_s, 0.0, 1.0);
        return Vec3(across(std::clamp(t - begin - kGrooveDown_s, 0.0, duration_s)),
                    kGrooveUp_m - (kGrooveUp_m + kGrooveDepth_m) * std::min(down, up));
    };
    return path;
}

inline GroovePath line_path(double speed_m_per_s, double duration_s) {
    const Vec2 way = speed_m_per_s * duration_s * Vec2(0.98, 0.199);
    return groove_path(duration_s, [=](double t) { return (t / duration_s - 0.5) * way; });
}

inline GroovePath circle_path(double speed_m_per_s, double radius_m, double duration_s) {
    return groove_path(duration_s, [=](double t) {
        const double angle = t * speed_m_per_s / radius_m;
        return radius_m * Vec2(std::cos(angle), std::sin(angle));
    });
}

// Legs of 0.4 s with sharp turns between them.
inline GroovePath corner_path(double speed_m_per_s) {
    constexpr double kLeg_s = 0.4;
    std::vector<Vec2> corners{{-0.06, -0.01}};
    double direction = 0.0;
    for (const double turn : {0.0, 1.2, -1.8, -1.8, -0.9}) {
        direction += turn;
        corners.push_back(corners.back() + kLeg_s * speed_m_per_s * Vec2(std::cos(direction), std::sin(direction)));
    }
    return groove_path(5.0 * kLeg_s, [=](double t) {
        const auto leg = std::min<std::size_t>(static_cast<std::size_t>(t / kLeg_s), 4);
        return corners[leg] + (t / kLeg_s - static_cast<double>(leg)) * (corners[leg + 1] - corners[leg]);
    });
}

// ---- Sampling

struct Sampling {
    double rate_Hz = 240.0;
    double frames_Hz = 0.0;  // targets come in bursts, one a frame; 0: as soon as they are made
    double jitter = 0.0;     // of the times at which the path is sampled, in intervals
    double lateness = 0.0;   // up to so many intervals on the way
    unsigned seed = 1;
    double phase = 0.0;          // of the first target, in intervals
    bool keeps_corners = false;  // there is a target at each multiple of 0.2 s in spite of jitter
};

inline std::vector<Delivered> deliver(const GroovePath& path, const Sampling& sampling) {
    std::mt19937 random(sampling.seed);
    std::uniform_real_distribution<double> jitter(-sampling.jitter, sampling.jitter), late(0.0, sampling.lateness);
    std::vector<Delivered> targets;
    Nanoseconds last_ns = 0;
    for (int i = 0;; ++i) {
        const double even_s = i / sampling.rate_Hz;
        const bool is_corner = sampling.keeps_corners && std::abs(5.0 * even_s - std::round(5.0 * even_s)) < 1e-9;
        const double t = std::max(even_s + (sampling.phase + jitter(random) * !is_corner) / sampling.rate_Hz, 0.0);
        if (t > path.over_s()) return targets;
        double arrival_s = t + late(random) / sampling.rate_Hz;
        if (sampling.frames_Hz > 0.0) arrival_s = std::ceil(arrival_s * sampling.frames_Hz - 1e-9) / sampling.frames_Hz;
        last_ns = std::max(last_ns, nanoseconds(arrival_s));
        targets.push_back({path.target(t), last_ns});
    }
}

// ---- Carving

// Height of the block's top on each ray along z, in metres below it.
struct Groove {
    int nodes_x = 0, nodes_y = 0;
    Vec3 origin_object{0.0};
    std::vector<double> height_m;

    [[nodiscard]] double at(int x, int y) const {
        return height_m[static_cast<std::size_t>(y) * static_cast<std::size_t>(nodes_x) + static_cast<std::size_t>(x)];
    }
};

inline Groove groove_of(const compute::Solid& solid) {
    Groove groove;
    const compute::Lattice& lattice = solid.lattice;
    groove.nodes_x = lattice.cells[0] + 1;
    groove.nodes_y = lattice.cells[1] + 1;
    groove.origin_object = lattice.origin_object;
    for (int y = 0; y < groove.nodes_y; ++y) {
        for (int x = 0; x < groove.nodes_x; ++x) {
            const auto ends = solid.sets[2].ends(x, y);
            groove.height_m.push_back(
                ends.empty() ? NAN : shared::depth_of(ends.back()) * lattice.unit_m() + lattice.origin_object.z);
        }
    }
    return groove;
}

inline Vec3 block_from_device() {
    return {0.5 * kGrooveBlock_m.x, 0.5 * kGrooveBlock_m.y, kGrooveBlock_m.z + kGrooveBall_m};
}

// Carves with a hand that holds an Omni. before_tick: tells the hand what it is to know by then.
inline Groove carve_groove(devices::AnyHand hand, double duration_s,
                           const std::function<void(Nanoseconds)>& before_tick) {
    WorkerPool pool(1);
    workpiece::WorkpieceOptions block{"block:" + std::to_string(kGrooveBlock_m.x) + "," +
                                          std::to_string(kGrooveBlock_m.y) + "," + std::to_string(kGrooveBlock_m.z),
                                      static_cast<int>(std::lround(kGrooveBlock_m.x / kGrooveCell_m)), false};
    Sculpture carving(compute::make_cpu_engine(std::move(load_workpiece(block, pool)->solid), pool), pool);
    // Without a yield, below which a material would hide what the hand does.
    const toolbox::Feel feel = *toolbox::parse_feel({.yield_kPa = 0.0});
    const toolbox::Tool tool{compute::BallTool{kGrooveBall_m}};
    haptics::HapticChannels channels;
    haptics::TickParameters& parameters = channels.parameters.draft();
    parameters.sequence = 1;
    parameters.workspace.object_from_device.position_m = block_from_device();
    toolbox::FeltTool felt = toolbox::felt_tool(tool.shape);
    parameters.probe = felt.probe;
    parameters.shape = felt.shape;
    parameters.tool = felt.surface;
    parameters.materials.fill(feel.material);
    parameters.action = toolbox::action_of(tool.operation);
    channels.parameters.publish();
    SimulatedClock clock;
    devices::SimulatedOmni omni(std::move(hand), {}, &clock);
    haptics::HapticLoop loop(omni, clock, channels);
    CarvedScene service(carving, channels, tool, feel.material.hardness_Ns_per_m3, 0.012 + 2.0 * kGrooveCell_m, {});
    service.start_at(block_from_device() + omni.true_position_device_m());
    static_cast<void>(service.update(0));
    haptics::TickRecord record;
    for (Nanoseconds tick = 1; tick * 1'000'000 <= nanoseconds(duration_s); ++tick) {
        before_tick(clock.now_ns());
        clock.sleep_until(tick * 1'000'000);
        loop.step();
        if (tick % 10 == 0) static_cast<void>(service.update(clock.now_ns()));
        while (channels.records.pop(record)) {
        }
    }
    return groove_of(carving.engine().solid());
}

inline Groove carve_steered(const GroovePath& path, const std::vector<Delivered>& targets) {
    devices::HandSteering steering;
    devices::HandTarget start;
    start.position_device_m = path.target(0.0).position_device_m;
    std::size_t next = 0;
    return carve_groove(*devices::SteeredHand::create(&steering, start), path.over_s(), [&](Nanoseconds now_ns) {
        for (; next < targets.size() && targets[next].arrival_ns <= now_ns; ++next) steering.push(targets[next].target);
    });
}

// ---- Comparing

struct GrooveDifference {
    double most_cells = 0.0, p99_cells = 0.0;
    double at_s = 0.0;  // when the path was there
    double deepest_cells = 0.0;
    std::size_t rays = 0;
};

// Compares two grooves along the path between two times: the distance of their surfaces along the normal, about.
inline GrooveDifference difference(const Groove& one, const Groove& other, const GroovePath& path, double from_s,
                                   double to_s) {
    struct Place {
        double time_s, away_m;
    };
    // For each ray the place that is nearest, and how near.
    std::vector<Place> nearest(one.height_m.size(), {NAN, 0.003});
    const auto ray = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(one.nodes_x) + static_cast<std::size_t>(x);
    };
    for (double t = path.begin_s; t <= path.end_s; t += 0.004) {
        const Vec3 at = (path.at(t) + block_from_device() - one.origin_object) / kGrooveCell_m;
        constexpr double kNear_cells = 0.003 / kGrooveCell_m;
        const int from_x = std::max(0, static_cast<int>(at.x - kNear_cells)),
                  from_y = std::max(0, static_cast<int>(at.y - kNear_cells));
        for (int y = from_y; y <= at.y + kNear_cells && y < one.nodes_y; ++y)
            for (int x = from_x; x <= at.x + kNear_cells && x < one.nodes_x; ++x) {
                const double away_m = kGrooveCell_m * std::hypot(at.x - x, at.y - y);
                if (away_m < nearest[ray(x, y)].away_m) nearest[ray(x, y)] = {t, away_m};
            }
    }
    GrooveDifference worst;
    std::vector<double> all;
    for (int y = 1; y + 1 < one.nodes_y; ++y) {
        for (int x = 1; x + 1 < one.nodes_x; ++x) {
            const double time_s = nearest[ray(x, y)].time_s;
            if (!(time_s >= from_s && time_s <= to_s)) continue;  // none is near where it is not a number
            double slope = 0.0;                                   // the steepest beside, since a groove has edges
            for (const Groove* g : {&one, &other}) {
                for (int side = -1; side <= 1; side += 2) {
                    const double dx = (g->at(x + side, y) - g->at(x, y)) / kGrooveCell_m,
                                 dy = (g->at(x, y + side) - g->at(x, y)) / kGrooveCell_m;
                    slope = std::max(slope, std::hypot(dx, dy));
                }
            }
            const double apart =
                std::abs(one.at(x, y) - other.at(x, y)) / std::sqrt(1.0 + slope * slope) / kGrooveCell_m;
            worst.deepest_cells = std::max(worst.deepest_cells, (kGrooveBlock_m.z - one.at(x, y)) / kGrooveCell_m);
            all.push_back(apart);
            if (apart > worst.most_cells) {
                worst.most_cells = apart;
                worst.at_s = time_s;
            }
        }
    }
    worst.rays = all.size();
    if (all.empty()) return worst;
    const auto p99 = all.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(all.size() - 1));
    std::ranges::nth_element(all, p99);
    worst.p99_cells = *p99;
    return worst;
}

}  // namespace burin::sculpt
