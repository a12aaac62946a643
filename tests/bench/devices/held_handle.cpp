// SPDX-License-Identifier: MIT
#include "tests/bench/devices/held_handle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin::bench {
namespace {

// The same everywhere, which std::uniform_real_distribution is not.
double between(std::mt19937_64& random, double least, double most) {
    return least + (most - least) * (static_cast<double>(random() >> 11) * 0x1.0p-53);
}

double between_by_octaves(std::mt19937_64& random, double least, double most) {
    return least * std::exp(between(random, 0.0, std::log(most / least)));
}

}  // namespace

UnsteadyHand UnsteadyHand::drawn(std::mt19937_64& random, double sway_m) {
    UnsteadyHand hand;
    for (auto& waves : hand.waves) {
        double sum = 0.0;
        for (Wave& wave : waves) {
            wave.amplitude_m = between(random, 0.0, 1.0);
            wave.radians_per_s = 2.0 * std::numbers::pi * between_by_octaves(random, 0.3, 8.0);
            wave.phase = between(random, 0.0, 2.0 * std::numbers::pi);
            sum += &wave == &waves.back() ? 0.0 : wave.amplitude_m;
        }
        for (Wave& wave : waves) wave.amplitude_m *= sway_m / sum;
        waves.back().amplitude_m = between(random, 0.0, 0.0001);  // the tremor
        waves.back().radians_per_s = 2.0 * std::numbers::pi * between(random, 8.0, 12.0);
    }
    for (int axis = 0; axis < 3; ++axis) hand.drift_m_per_s[axis] = between(random, -0.005, 0.005);
    const double softest = between_by_octaves(random, 100.0, 700.0);
    const Vec3 stiffnesses = softest * Vec3(1.0, between(random, 1.0, 3.0), between(random, 1.0, 3.0));
    const Quat turn = glm::normalize(Quat(between(random, -1.0, 1.0), between(random, -1.0, 1.0),
                                          between(random, -1.0, 1.0), between(random, -1.0, 1.0)));
    glm::dmat3 along(0.0);
    for (int axis = 0; axis < 3; ++axis) along[axis][axis] = stiffnesses[axis];
    hand.stiffness_N_per_m = glm::mat3_cast(turn) * along * glm::mat3_cast(glm::conjugate(turn));
    hand.mass_kg = between(random, 0.08, 0.25);
    hand.damping_Ns_per_m = between(random, 3.0, 12.0);
    hand.pushes_back = random() % 3 == 0 ? between(random, 0.0, 1.2) : 0.0;
    hand.reaction_s = between(random, 0.12, 0.22);
    return hand;
}

void UnsteadyHand::reach(std::mt19937_64& random, double most_m) {
    for (double begin_s = 1.0; begin_s < 40.0; begin_s += between(random, 0.5, 3.5)) {
        Reach& one = reaches.emplace_back(begin_s);
        for (int axis = 0; axis < 3; ++axis) one.by_m[axis] = between(random, -most_m, most_m);
    }
}

HeldHandle::HeldHandle(const UnsteadyHand& hand, const glm::dmat3& motors, Clock& clock)
    : hand_(hand), motors_(motors), clock_(clock), time_ns_(clock.now_ns()) {
    description_.name = "a handle in a hand that does not keep still";
    description_.workspace_m = Vec3(0.2);
    description_.resolution_m = 0.00005;
    description_.max_force_N = 3.3;
    description_.friction_N = kFriction_N;
    description_.has_buttons = false;
    place_m_ = target_at(seconds(time_ns_)).place_m;
}

HeldHandle::Target HeldHandle::target_at(double time_s) const {
    Target target{hand_.drift_m_per_s * time_s, hand_.drift_m_per_s};
    for (int axis = 0; axis < 3; ++axis)
        for (const UnsteadyHand::Wave& wave : hand_.waves[static_cast<std::size_t>(axis)]) {
            const double at = wave.radians_per_s * time_s + wave.phase;
            target.place_m[axis] += wave.amplitude_m * std::sin(at);
            target.velocity_m_per_s[axis] += wave.amplitude_m * wave.radians_per_s * std::cos(at);
        }
    constexpr double kReach_s = 0.4;
    for (const UnsteadyHand::Reach& reach : hand_.reaches) {
        const double u = std::clamp((time_s - reach.begin_s) / kReach_s, 0.0, 1.0);
        target.place_m += u * u * u * (10.0 + u * (6.0 * u - 15.0)) * reach.by_m;
        target.velocity_m_per_s += 30.0 * u * u * (1.0 - u) * (1.0 - u) / kReach_s * reach.by_m;
    }
    return target;
}

void HeldHandle::step(const Target& target) {
    constexpr double kStep_s = 0.0002;
    const auto written_N = [&](std::size_t ago) {
        return ago < writes_ ? written_N_[(writes_ - ago) % written_N_.size()] : Vec3(0.0);
    };
    const auto reaction = static_cast<std::size_t>(1000.0 * hand_.reaction_s);
    const Vec3 pull_N = motors_ * (written_N(1) - hand_.pushes_back * written_N(reaction)) +
                        hand_.stiffness_N_per_m * (target.place_m - place_m_) +
                        hand_.damping_Ns_per_m * (target.velocity_m_per_s - velocity_m_per_s_);
    const double mass_kg = hand_.mass_kg + 0.045;
    Vec3 velocity = velocity_m_per_s_ + kStep_s / mass_kg * pull_N;
    const double brake = kStep_s * kFriction_N / mass_kg, speed = glm::length(velocity);
    velocity_m_per_s_ = speed <= brake ? Vec3(0.0) : velocity * (1.0 - brake / speed);
    place_m_ += kStep_s * velocity_m_per_s_;
}

devices::DeviceSample HeldHandle::read() noexcept {
    const Target target = target_at(seconds(clock_.now_ns()));
    for (; time_ns_ < clock_.now_ns(); time_ns_ += 200'000) step(target);
    devices::DeviceSample sample;
    sample.time_ns = clock_.now_ns();
    sample.position_device_m = description_.resolution_m * glm::round(place_m_ / description_.resolution_m);
    return sample;
}

void HeldHandle::write(const devices::DeviceWrench& wrench) noexcept {
    written_N_[++writes_ % written_N_.size()] = wrench.force_device_N;
}

}  // namespace burin::bench
