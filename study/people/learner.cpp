// SPDX-License-Identifier: MIT
#include "study/people/learner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/metrics/path.hpp"

namespace burin::study {
namespace {

constexpr double kTick_s = 1.0 / kSimulatedRate_Hz;
constexpr double kRest_s = 0.3;           // in the start cap, before and after going back to it
constexpr double kCalmNearEnds_m = 0.03;  // the wander grows to its full size over this length
constexpr double kStrayFactor = 1.5;      // of the distance at which an attempt is lost
constexpr double kOperatorWaits_s = 1.0;
constexpr std::size_t kWaves = 4;
constexpr std::size_t kMostTicks = 4 * 3600 * 1000;

// The share of the way after a share of the time, with the least jerk (Flash and Hogan, 1985).
double least_jerk(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
}

// One way through the tube: slow waves across it, fixed before it begins.
class HandPath {
public:
    HandPath(const StudyWorld& world, double wander_m, double pace_m_per_s, Random& random) : world_(world) {
        lengths_.push_back(0.0);
        for (std::size_t i = 1; i < world.spine_m.size(); ++i)
            lengths_.push_back(lengths_.back() + glm::distance(world.spine_m[i - 1], world.spine_m[i]));
        const double reach_m = 0.5 * world.cap_depth_m;
        from_m_ = -reach_m;
        to_m_ = lengths_.back() + reach_m;
        duration_s_ = (to_m_ - from_m_) / pace_m_per_s;
        for (std::size_t i = 0; i < kWaves; ++i) {
            const double size = wander_m * random.normal() / std::sqrt(2.0 * kWaves);
            const double size_across = wander_m * random.normal() / std::sqrt(2.0 * kWaves);
            const double phase = 2.0 * std::numbers::pi * random.uniform();
            const double phase_across = 2.0 * std::numbers::pi * random.uniform();
            waves_[i] = {size, phase, size_across, phase_across};
        }
        const Vec3 chord = world.spine_m.back() - world.spine_m.front();
        across_ =
            std::abs(glm::normalize(chord).y) < 0.99 ? glm::normalize(glm::cross(Vec3(0, 1, 0), chord)) : Vec3(1, 0, 0);
    }

    [[nodiscard]] double duration_s() const { return duration_s_; }

    // At a share of the duration; below 0 and above 1 the hand rests at an end.
    [[nodiscard]] Vec3 middle_m(double share) const {
        const double along_m = from_m_ + (to_m_ - from_m_) * least_jerk(share);
        const double to_end_m = std::min(along_m, lengths_.back() - along_m);
        const double window = least_jerk(to_end_m / kCalmNearEnds_m);
        double up_m = 0.0, across_m = 0.0;
        for (std::size_t i = 0; i < kWaves; ++i) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(i + 1) * along_m / lengths_.back();
            up_m += waves_[i].up_m * std::sin(angle + waves_[i].up_phase);
            across_m += waves_[i].across_m * std::sin(angle + waves_[i].across_phase);
        }
        return on_axis(along_m) + window * (up_m * Vec3(0, 1, 0) + across_m * across_);
    }

private:
    struct Wave {
        double up_m = 0.0, up_phase = 0.0, across_m = 0.0, across_phase = 0.0;
    };

    // Goes on straight beyond the ends.
    [[nodiscard]] Vec3 on_axis(double along_m) const {
        const auto after = std::ranges::upper_bound(lengths_, along_m);
        const auto at =
            std::clamp<std::ptrdiff_t>(after - lengths_.begin(), 1, static_cast<std::ptrdiff_t>(lengths_.size()) - 1);
        const auto i = static_cast<std::size_t>(at);
        const double share = (along_m - lengths_[i - 1]) / (lengths_[i] - lengths_[i - 1]);
        return world_.spine_m[i - 1] + share * (world_.spine_m[i] - world_.spine_m[i - 1]);
    }

    const StudyWorld& world_;
    std::vector<double> lengths_;  // along the spine, at each of its points
    double from_m_ = 0.0, to_m_ = 0.0, duration_s_ = 1.0;
    std::array<Wave, kWaves> waves_{};
    Vec3 across_{1.0, 0.0, 0.0};
};

// Feeds ticks to the pure step and keeps what it says.
class StageRun {
public:
    StageRun(const Protocol& protocol, const Stage& stage) : protocol_(protocol), setup_(setup_of(protocol, stage)) {}

    void tick(const Vec3& middle_m, OperatorAct act = OperatorAct::none) {
        const Vec3 up{0.0, protocol_.point_offset_m, 0.0};
        const StageTick tick{static_cast<double>(made_.ticks) * kTick_s, {middle_m + up, middle_m - up}, act, false};
        const StageStep stepped = step(setup_, made_.end, tick);
        for (std::size_t i = 0; i < stepped.event_count; ++i) made_.events.push_back(stepped.events[i]);
        made_.end = stepped.state;
        ++made_.ticks;
        const bool running = made_.end.phase == StagePhase::running;
        if (running && !was_running_) made_.top_m.clear(), made_.bottom_m.clear();
        was_running_ = running;
        if (!running) return;
        made_.top_m.push_back(tick.points_m[0]);
        made_.bottom_m.push_back(tick.points_m[1]);
    }

    [[nodiscard]] bool done() const { return made_.end.phase == StagePhase::done || made_.ticks >= kMostTicks; }
    [[nodiscard]] unsigned attempt() const { return made_.end.attempt; }
    [[nodiscard]] double time_s() const { return static_cast<double>(made_.ticks) * kTick_s; }
    [[nodiscard]] SimulatedStage take() {
        if (made_.end.phase != StagePhase::done) tick({}, OperatorAct::stop);
        if (made_.end.result != StageResult::valid_exit) made_.top_m.clear(), made_.bottom_m.clear();
        return std::move(made_);
    }

private:
    const Protocol& protocol_;
    StageSetup setup_;
    SimulatedStage made_;
    bool was_running_ = false;
};

void go_through(StageRun& run, const HandPath& path, const Protocol& protocol, bool strays) {
    const unsigned attempt = run.attempt();
    const auto rest = static_cast<std::size_t>(kRest_s / kTick_s);
    for (std::size_t i = 0; i < rest && !run.done(); ++i) run.tick(path.middle_m(0.0));
    for (double t = 0.0; t <= path.duration_s() + kRest_s && !run.done(); t += kTick_s) {
        const double share = t / path.duration_s();
        const double off_m = strays ? kStrayFactor * protocol.validity.stray_m * least_jerk(4.0 * (share - 0.4)) : 0.0;
        run.tick(path.middle_m(share) + off_m * Vec3(0, 1, 0));
        if (run.attempt() != attempt) return;
    }
}

}  // namespace

Learner draw_learner(const LearnerPopulation& population, bool first_group, Random& random) {
    Learner learner;
    learner.log_wander = std::log(population.wander_m) + population.wander_spread * random.normal();
    learner.log_pace = std::log(population.pace_m_per_s) + population.pace_spread * random.normal();
    learner.first_group = first_group;
    return learner;
}

SimulatedStage simulate_stage(const Protocol& protocol, const Stage& stage, const Learner& learner,
                              const LearnerPopulation& population, Random& random) {
    StageRun run(protocol, stage);
    const StudyWorld* world = protocol.world(stage.world);
    if (world == nullptr) {
        while (!run.done()) run.tick({}, run.time_s() >= kOperatorWaits_s ? OperatorAct::next : OperatorAct::none);
        return run.take();
    }
    const double shift = stage.outcome && learner.first_group ? -population.effect * population.wander_spread : 0.0;
    const double untrained = std::pow(1.0 - population.learns_per_min, learner.trained_min);
    const double wander_draw = random.normal(), pace_draw = random.normal();
    const double wander_m =
        untrained * std::exp(learner.log_wander + shift + population.wander_trial_spread * wander_draw);
    const double pace = std::exp(learner.log_pace + population.pace_trial_spread * pace_draw);
    while (!run.done()) {
        const HandPath path(*world, wander_m, pace, random);
        const bool strays = random.uniform() < population.stray_chance;
        go_through(run, path, protocol, strays && stage.kind == StageKind::trial);
        // An end by the operator alone comes after one way through.
        if (!stage.ends_after_s && !stage.ends_at_exit && !run.done()) run.tick(path.middle_m(1.0), OperatorAct::next);
    }
    return run.take();
}

Learner after_stage(Learner learner, const Stage& stage) {
    const bool training = stage.kind == StageKind::free_training || stage.kind == StageKind::led_training;
    if (training && stage.ends_after_s) learner.trained_min += *stage.ends_after_s / 60.0;
    return learner;
}

Vec3 within_tube(const StudyWorld& world, const Vec3& point_m) {
    const NearestOnLine nearest = nearest_on(world.spine_m, point_m);
    if (nearest.distance_m <= world.tube_radius_m) return point_m;
    return nearest.place_m + (world.tube_radius_m / nearest.distance_m) * (point_m - nearest.place_m);
}

}  // namespace burin::study
