// SPDX-License-Identifier: MIT
#include "activities/rehab/game/scripted_throws.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "activities/rehab/game/game.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

constexpr double kThrow_m_per_s = 0.55;                    // a little less than the fastest that a desk leads a hand
constexpr double kBegins_z_m = 0.12, kLeaves_z_m = -0.08;  // where it begins to move, and where the ball leaves it
constexpr double kEnds_z_m = -0.13;
// The simulated hand's own: how long it takes until it has opened so far that it throws, from a ball that it holds; how
// long from open until it has taken one, and until it holds it as firmly as it does.
constexpr double kThrowOpens_s = 0.375, kThrowTakes_s = 0.9, kThrowHolds_s = 1.4;
constexpr double kFree_s = 0.15;  // by which it is closed before the ball comes
constexpr double kShown_s = 0.5;  // from the throw until a picture shows the ball, which comes from the wall
// From the front the hand hides the ball: so the eyes go to the right first, by the key for that. They come no nearer
// to the screen, and the mouse leads the hand as far as before.
constexpr double kAsideFrom_s = 0.12, kAside_s = 2.0;
// Closing again takes this much longer than the hand has gone on opening since the throw.
constexpr double kClosesAgain_s = 0.21;

// In a window of the usual size the desk leads the hand by kPixel_m a pixel, less kPixelLess of a metre for each metre
// by which its z is above kThumbAhead_m, and by kWheelStep_m a step of the wheel (session/state/session_state.cpp,
// session/live/opened_room.cpp).
constexpr double kPixel_m = 0.0011377, kPixelLess = 0.00159, kThumbAhead_m = 0.0287, kWheelStep_m = 0.01;
constexpr double kRest_y_m = 0.2209, kRest_z_m = 0.131;  // where the grip is at first
constexpr double kStep_s = 1.0 / 30.0;

// Leads the hand from place to place.
class Leading {
public:
    Leading(std::string text, double from_s) : text_(std::move(text)), at_s_(from_s) { mouse(); }

    void go(double y_m, double z_m, double for_s, bool evenly = false) {
        const double from_y_m = y_m_, from_z_m = z_m_, begun_s = at_s_;
        const int steps = std::max(1, static_cast<int>(std::lround(for_s / kStep_s)));
        for (int i = 1; i <= steps; ++i) {
            const double part = static_cast<double>(i) / steps;
            const double share = evenly ? part : part * part * (3.0 - 2.0 * part);
            at_s_ = begun_s + for_s * part;
            const double up_m = from_y_m + share * (y_m - from_y_m) - y_m_;
            const double away_m = z_m_ - from_z_m - share * (z_m - from_z_m);
            mouse_px_ -= up_m / (kPixel_m - kPixelLess * (z_m_ - kThumbAhead_m));
            y_m_ += up_m;
            if (up_m != 0.0) mouse();
            z_m_ -= away_m;
            if (away_m != 0.0) text_ += formatted("%.4f scroll 0 %.6g\n", at_s_, away_m / kWheelStep_m);
        }
    }
    void rest(double for_s) { at_s_ += for_s; }
    void press(double at_s) { later(at_s, "button press left"); }
    void release(double at_s) { later(at_s, "button release left"); }
    // A line of a time that may be within the next way: lines are put in order at the end.
    void later(double at_s, const std::string& line) { later_.push_back(formatted("%.4f ", at_s) + line + "\n"); }
    [[nodiscard]] double now_s() const { return at_s_; }
    [[nodiscard]] std::string text() const;

private:
    void mouse() { text_ += formatted("%.4f mouse 640 %.4f\n", at_s_, mouse_px_); }

    std::string text_;
    std::vector<std::string> later_;
    double at_s_, mouse_px_ = 360.0, y_m_ = kRest_y_m, z_m_ = kRest_z_m;
};

double time_of(std::string_view line) {
    return std::strtod(std::string(line.substr(0, line.find(' '))).c_str(), nullptr);
}

std::string Leading::text() const {
    std::vector<std::string> lines;
    for (std::string_view rest = text_; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
        lines.emplace_back(rest.substr(0, end));
        rest.remove_prefix(end);
    }
    const auto is_event = [](const std::string& line) { return !line.empty() && line[0] >= '0' && line[0] <= '9'; };
    const auto first_event = std::ranges::find_if(lines, is_event) - lines.begin();  // an insertion may move all
    lines.insert(lines.end(), later_.begin(), later_.end());
    std::stable_sort(lines.begin() + first_event, lines.end(),
                     [](const std::string& a, const std::string& b) { return time_of(a) < time_of(b); });
    std::string all;
    for (const std::string& line : lines) all += line;
    return all;
}

// The ball's way from a throw on, for so long.
bodies::Flight way_of(const ScriptedThrow& thrown, const GameSettings& settings, const GameRoom& room, double for_s) {
    return bodies::flight_of({thrown.from_m, thrown.velocity_m_per_s, {}}, flight_room(room, settings), for_s);
}

// Where the hand best waits: a slow ball before it comes to the floor, a fast one when it rises behind it.
void await(ScriptedThrow& thrown, const GameSettings& settings, const GameRoom& room) {
    constexpr double kAboveFloor_m = 0.09;
    const bodies::Flight flight = way_of(thrown, settings, room, 10.0);
    const double hits_s = flight.bounces[0].at_s, lands_s = flight.bounces[1].at_s;
    double at_s = lands_s + 0.3;
    if (settings.speed == GameSpeed::slow)
        for (at_s = hits_s + 0.6 * (lands_s - hits_s);
             at_s > hits_s && way_of(thrown, settings, room, at_s).ball.place_m.y < kAboveFloor_m;)
            at_s -= 0.01;
    thrown.returns_s = at_s;
    thrown.waits_m = way_of(thrown, settings, room, at_s).ball.place_m;
}

}  // namespace

std::vector<ScriptedThrow> drawn_throws(const GameSettings& settings, const GameRoom& room, std::uint64_t seed) {
    // The generator's own numbers are prescribed by the standard; its distributions are not.
    std::mt19937_64 random(seed);
    const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const double flies_s = (kLeaves_z_m - room.wall_z_m - room.radius_m) / kThrow_m_per_s;
    const double falls_m = 0.5 * 9.81 * settings.weight() * flies_s * flies_s;
    std::vector<ScriptedThrow> throws;
    for (unsigned i = 0; i < settings.throws; ++i) {
        const double kind = share(), off_m = 0.035 + 0.015 * share();
        const bool low = kind >= 0.6 && kind < 0.75;
        ScriptedThrow thrown;
        const double hits_y_m = settings.line_m() + (low ? -off_m : off_m);
        thrown.from_m = {0.0, hits_y_m + falls_m, kLeaves_z_m};
        thrown.velocity_m_per_s = {0.0, 0.0, -kThrow_m_per_s};
        await(thrown, settings, room);
        if (kind >= 0.75) thrown.caught = kind < 0.88 ? ScriptedCatch::elsewhere : ScriptedCatch::with_open_hand;
        if (thrown.caught == ScriptedCatch::elsewhere) thrown.waits_m = {0.0, thrown.from_m.y, 0.11};
        throws.push_back(thrown);
    }
    return throws;
}

std::string with_throws(std::string_view script, const std::vector<ScriptedThrow>& throws, const GameSettings& settings,
                        const GameRoom& room) {
    const std::size_t mouse = script.find(" mouse "), line = script.rfind('\n', mouse);
    std::string head(script.substr(0, mouse == std::string_view::npos ? script.size() : line + 1));
    Leading hand(std::move(head), 0.6);
    hand.later(kAsideFrom_s, "key press d");
    hand.later(kAsideFrom_s + kAside_s, "key release d");
    bool holds = false;
    for (const ScriptedThrow& thrown : throws) {
        if (hand.now_s() > settings.time_limit_s + 1.0) break;
        if (!holds) {
            hand.go(room.serve_m.y, kRest_z_m, 0.7);
            hand.go(room.serve_m.y, room.serve_m.z, 0.5);
            hand.press(hand.now_s());
            hand.rest(kThrowHolds_s);
        }
        hand.go(thrown.from_m.y, room.serve_m.z, 0.6);
        hand.go(thrown.from_m.y, kBegins_z_m, 0.4);
        hand.rest(0.2);
        const double leaves_s = hand.now_s() + (kBegins_z_m - kLeaves_z_m) / kThrow_m_per_s;
        hand.release(leaves_s - kThrowOpens_s);
        if (&thrown == &throws.front()) hand.later(leaves_s + kShown_s, "command screenshot thrown.png");
        hand.go(thrown.from_m.y, kEnds_z_m, (kBegins_z_m - kEnds_z_m) / kThrow_m_per_s, true);
        hand.go(thrown.waits_m.y, thrown.waits_m.z,
                std::max(0.4, thrown.returns_s - kFree_s - (hand.now_s() - leaves_s)));
        const bodies::Flight flight = way_of(thrown, settings, room, 20.0);
        const bool above = flight.bounces[0].place_m.y > settings.line_m();
        if (thrown.caught != ScriptedCatch::with_open_hand)
            hand.press(leaves_s + std::max(0.05, 0.5 * (thrown.returns_s - kFree_s - kClosesAgain_s)));
        holds = above && thrown.caught == ScriptedCatch::there;
        hand.rest(std::max(0.0, leaves_s + thrown.returns_s + kThrowHolds_s - hand.now_s()));
        if (holds) continue;
        const double missed_s = above ? flight.bounces[2].at_s : flight.bounces[0].at_s;
        hand.release(hand.now_s());
        hand.rest(std::max(1.2, leaves_s + missed_s + 0.2 - hand.now_s()));
    }
    hand.later(hand.now_s() + 0.5, "command quit");
    return hand.text();
}

std::string scripted_game(const SettingValues& values, std::uint64_t seed, std::string_view script) {
    const GameSettings settings = game_settings(values);
    const GameRoom room;
    return with_throws(script, drawn_throws(settings, room, seed), settings, room);
}

}  // namespace burin::activities
