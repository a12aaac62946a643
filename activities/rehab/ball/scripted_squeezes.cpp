// SPDX-License-Identifier: MIT
#include "activities/rehab/ball/scripted_squeezes.hpp"

#include <algorithm>
#include <random>

#include "activities/rehab/ball/ball.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

// The simulated hand's own: how long it takes from open to where the lowest target is just reached, to as far as it
// closes, and back.
constexpr double kSqueezeReaches_s = 1.38, kSqueezeCloses_s = 2.0, kSqueezeOpens_s = 1.6;
// A hold that is shorter than this is over before a hand that has just reached it has opened.
constexpr double kLeastHold_s = 0.7;
constexpr double kFirstSqueeze_s = 2.85;  // when the script's arm is above the ball

}  // namespace

std::vector<ScriptedSqueeze> drawn_squeezes(const BallSettings& settings, std::uint64_t seed, double first_s) {
    // The generator's own numbers are prescribed by the standard; its distributions are not.
    std::mt19937_64 random(seed);
    const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<ScriptedSqueeze> squeezes;
    double at_s = first_s;
    for (unsigned counted = 0; counted < settings.repetitions;) {
        // Two in a row that are too short would tell nothing more.
        const bool too_short =
            share() < 0.3 && settings.hold_s >= kLeastHold_s && (squeezes.empty() || !squeezes.back().too_short);
        const double held_s = too_short ? 0.3 * settings.hold_s * share() : settings.hold_s + 0.5 + 0.5 * share();
        const double closed_s = (too_short ? kSqueezeReaches_s : kSqueezeCloses_s) + held_s;
        squeezes.push_back({at_s, at_s + closed_s, too_short});
        at_s += closed_s + kSqueezeOpens_s + 0.4 * share();
        counted += too_short ? 0 : 1;
    }
    return squeezes;
}

std::string with_squeezes(std::string_view script, const std::vector<ScriptedSqueeze>& squeezes) {
    std::string text;
    while (!script.empty()) {
        const std::size_t end = std::min(script.find('\n'), script.size() - 1) + 1;
        const std::string_view line = script.substr(0, end);
        if (line.contains(" button ")) break;
        text += line;
        script.remove_prefix(end);
    }
    const auto shown = std::ranges::find(squeezes, false, &ScriptedSqueeze::too_short);
    for (auto squeeze = squeezes.begin(); squeeze != squeezes.end(); ++squeeze) {
        text += formatted("%.3f button press left\n", squeeze->closes_s);
        if (squeeze == shown) text += formatted("%.3f command screenshot squeezed.png\n", squeeze->opens_s - 0.05);
        text += formatted("%.3f button release left\n", squeeze->opens_s);
    }
    const double end_s = squeezes.empty() ? 0.0 : squeezes.back().opens_s + kSqueezeOpens_s;
    return text + formatted("%.3f command quit\n", end_s);
}

std::string scripted_ball(const SettingValues& values, std::uint64_t seed, std::string_view script) {
    return with_squeezes(script, drawn_squeezes(ball_settings(values), seed, kFirstSqueeze_s));
}

}  // namespace burin::activities
