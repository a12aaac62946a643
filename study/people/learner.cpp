// SPDX-License-Identifier: MIT
#include "study/people/learner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "study/metrics/path.hpp"

namespace burin::study {
namespace {

constexpr double kRest_s = 0.3;           // at an end, before going on
constexpr double kReturn_m_per_s = 0.25;  // the mean speed of going straight back to the start
constexpr double kLean_rad = 0.08, kLean_s = 3.1;
constexpr double kCalmNearEnds_m = 0.03;  // the wander grows to its full size over this length
constexpr double kStrayFactor = 1.5;      // of the distance at which an attempt is lost
constexpr std::size_t kWaves = 4;

// The share of the way after a share of the time, with the least jerk (Flash and Hogan, 1985).
double least_jerk(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
}

}  // namespace

// One way through the tube: slow waves across it, fixed before it begins.
class LearnerHand::Path {
public:
    Path(const StudyWorld& world, double wander_m, double pace_m_per_s, Random& random) : world_(world) {
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
    // Up or down: away from where the path bulges, since a device reaches little farther than the path.
    [[nodiscard]] Vec3 strays_m() const {
        const double ends_m = 0.5 * (world_.spine_m.front().y + world_.spine_m.back().y);
        return {0.0, on_axis(0.5 * lengths_.back()).y > ends_m ? -1.0 : 1.0, 0.0};
    }

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

LearnerHand::LearnerHand(const Protocol& protocol, const Stage& stage, const StudyWorld& world, const Learner& learner,
                         const LearnerPopulation& population, bool is_led, Random& random)
    : protocol_(protocol),
      stage_(stage),
      world_(world),
      random_(random),
      stray_chance_(stage.kind == StageKind::trial ? population.stray_chance : 0.0),
      is_led_(is_led) {
    const double shift = stage.outcome && learner.first_group ? -population.effect * population.wander_spread : 0.0;
    const double untrained = std::pow(1.0 - population.learns_per_min, learner.trained_min);
    const double wander_draw = random.normal(), pace_draw = random.normal();
    wander_m_ = untrained * std::exp(learner.log_wander + shift + population.wander_trial_spread * wander_draw);
    pace_m_per_s_ = std::exp(learner.log_pace + population.pace_trial_spread * pace_draw);
    lean_phase_ = 2.0 * std::numbers::pi * random.uniform();
    draw_path();
    from_m_ = now_m_ = path_->middle_m(0.0);
}

LearnerHand::~LearnerHand() = default;

void LearnerHand::draw_path() {
    path_ = std::make_unique<Path>(world_, wander_m_, pace_m_per_s_, random_);
    strays_ = random_.uniform() < stray_chance_;
}

void LearnerHand::begin(Doing doing, double time_s) {
    doing_ = doing;
    since_s_ = time_s;
    from_m_ = now_m_;
}

Vec3 LearnerHand::place(double time_s) const {
    const double t = time_s - since_s_;
    if (doing_ == Doing::rests) return from_m_;
    if (doing_ == Doing::returns) {
        const Vec3 to_m = path_->middle_m(0.0);
        const double duration_s = std::max(0.5, glm::distance(from_m_, to_m) / kReturn_m_per_s);
        return from_m_ + least_jerk(t / duration_s) * (to_m - from_m_);
    }
    const double share = t / path_->duration_s();
    const double off_m = strays_ ? kStrayFactor * protocol_.validity.stray_m * least_jerk(4.0 * (share - 0.4)) : 0.0;
    return path_->middle_m(backwards_ ? 1.0 - share : share) + off_m * path_->strays_m();
}

bool LearnerHand::lasts(double time_s) const {
    const double t = time_s - since_s_;
    switch (doing_) {
        case Doing::rests: return t < kRest_s;
        case Doing::returns: return t < std::max(0.5, glm::distance(from_m_, path_->middle_m(0.0)) / kReturn_m_per_s);
        case Doing::goes: return t < path_->duration_s();
    }
    return false;
}

HandWish LearnerHand::next(const StageState& state, double time_s) {
    HandWish wish;
    const bool by_operator_alone = !stage_.ends_after_s && !stage_.ends_at_exit;
    const bool goes = stage_.kind == StageKind::trial || (stage_.kind == StageKind::free_training && !is_led_);
    if (!goes) {
        wish.gives_way = is_led_;
        if (by_operator_alone && time_s >= kOperatorWaits_s) wish.act = OperatorAct::next;
    } else if (state.attempt != attempt_) {
        attempt_ = state.attempt;
        draw_path();
        begin(Doing::returns, time_s);
    } else if (!lasts(time_s)) {
        now_m_ = place(time_s);
        const bool went = doing_ == Doing::goes;
        if (doing_ == Doing::returns) {
            begin(Doing::rests, time_s);
        } else if (doing_ == Doing::rests) {
            begin(Doing::goes, time_s);
        } else if (stage_.kind == StageKind::free_training) {
            backwards_ = !backwards_;
            draw_path();
            begin(Doing::rests, time_s);
        } else if (state.phase == StagePhase::waiting) {
            draw_path();  // the clock did not run: once more
            begin(Doing::returns, time_s);
        }
        // An end by the operator alone comes after one way through.
        if (went && by_operator_alone) wish.act = OperatorAct::next;
    }
    wish.middle_m = now_m_ = place(time_s);
    const double lean = kLean_rad * std::sin(2.0 * std::numbers::pi * time_s / kLean_s + lean_phase_);
    if (!wish.gives_way) wish.orientation = {std::cos(0.5 * lean), 0.0, 0.0, std::sin(0.5 * lean)};
    return wish;
}

Learner draw_learner(const LearnerPopulation& population, bool first_group, Random& random) {
    Learner learner;
    learner.log_wander = std::log(population.wander_m) + population.wander_spread * random.normal();
    learner.log_pace = std::log(population.pace_m_per_s) + population.pace_spread * random.normal();
    learner.first_group = first_group;
    return learner;
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
