// SPDX-License-Identifier: MIT
#include "activities/rehab/putty/scripted_kneads.hpp"

#include <random>

#include "activities/rehab/ball/scripted_squeezes.hpp"
#include "activities/rehab/putty/putty.hpp"

namespace burin::activities {
namespace {

// The simulated hand's own: how long it takes until it has closed as far as it does, how soon it opens again without
// having touched, and how long it takes to open.
constexpr double kKneadCloses_s = 2.2, kKneadMisses_s = 0.3, kKneadOpens_s = 1.6;
constexpr double kFirstKnead_s = 2.85;  // when the script's arm is above the putty
// What the script does from this line on brings thumb and index to where they meet at the ball.
constexpr std::string_view kForPinch = "# for the pinch";

}  // namespace

std::vector<ScriptedKnead> drawn_kneads(const PuttySettings& settings, std::uint64_t seed, double first_s) {
    // The generator's own numbers are prescribed by the standard; its distributions are not.
    std::mt19937_64 random(seed);
    const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<ScriptedKnead> kneads;
    double at_s = first_s;
    for (unsigned touches = 0; touches < settings.kneads;) {
        const bool misses = share() < 0.25 && (kneads.empty() || !kneads.back().misses);
        const double closed_s = misses ? kKneadMisses_s : kKneadCloses_s + 0.6 * share();
        kneads.push_back({at_s, at_s + closed_s, misses});
        at_s += closed_s + kKneadOpens_s + 0.4 * share();
        touches += misses ? 0 : 1;
    }
    return kneads;
}

std::string scripted_putty(const SettingValues& values, std::uint64_t seed, std::string_view script) {
    const PuttySettings settings = putty_settings(values);
    std::vector<ScriptedSqueeze> squeezes;
    for (const ScriptedKnead& knead : drawn_kneads(settings, seed, kFirstKnead_s))
        squeezes.push_back({knead.closes_s, knead.opens_s, knead.misses});
    return with_squeezes(settings.is_pinch() ? script : script.substr(0, script.find(kForPinch)), squeezes);
}

}  // namespace burin::activities
