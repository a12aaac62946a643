// SPDX-License-Identifier: MIT
#include "activities/rehab/game/game.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "activities/grasp/hand_reading.hpp"
#include "activities/rehab/exercise/person_range.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

// The world's ball and line, as assets/worlds/game.toml has them.
constexpr std::uint32_t kGameObject = 2;
constexpr const char* kLine = "line";
constexpr double kLineThick_m = 0.004;            // on the wall; its middle counts
constexpr double kLineAtWall_m = 0.0005;          // before the wall's face
constexpr double kGameElementsAlongRadius = 3.2;  // as many as the ball that is squeezed has
constexpr double kYoung_Pa = 50e3;                // as a yellow one: it gives when it is caught

// The palm looks at the wall, and a little up: so a ball lies in it and is thrown away from it. Where the grip comes
// to: from above the floor to above the line, from behind where the ball waits to half the way to the wall.
constexpr double kPalmUp_rad = 0.52;
constexpr Vec3 kMiddle_m{0.005, 0.145, 0.025}, kHalf_m{0.15, 0.136, 0.12};

constexpr std::array kSpeeds{"slow", "fast"};  // as GameSpeed has them

}  // namespace

std::span<const SettingKind> Game::setting_kinds() {
    static const std::array kinds{
        SettingKind{.key = "speed", .option = "--speed", .help = "How fast the ball falls", .words = kSpeeds},
        level_setting(static_cast<unsigned>(GameSettings::kLines_m.size()),
                      "Of difficulty: how high the line is on the wall, 1 to 3", "there are levels 1, 2 and 3"),
        SettingKind{.key = "throws",
                    .option = "--throws",
                    .help = "How many throws",
                    .remedy = "ask for 1 to 1000 throws",
                    .usual = 5,
                    .least = 1,
                    .most = 1000,
                    .whole = true},
        time_limit_setting(120.0),
        start_setting(),
        open_setting(),
        closed_setting(),
    };
    return kinds;
}

GameSettings game_settings(const SettingValues& values) {
    return {static_cast<GameSpeed>(values.count("speed")), values.count("level"), values.count("throws"),
            values.number("time_limit_s")};
}

std::unique_ptr<Exercise> Game::make(const SettingValues& values) { return std::make_unique<Game>(values); }

std::optional<Error> Game::conflict(const SettingValues& values) {
    if (auto wrong = too_short_a_way(values)) return wrong;
    if (values.number("start") == kStartsPressed)
        return Error{"is pressed, and nobody presses in the game", "start", "give asked or at_once"};
    // To open a hand and to close it again takes no less: ours, five times a second.
    constexpr double kThrows_s = 0.2;
    const unsigned throws = game_settings(values).throws;
    return too_short_a_limit(values, throws * kThrows_s, formatted("%u throws of %g s", throws, kThrows_s));
}

Game::Game(const SettingValues& values) : values_(values), settings_(game_settings(values)) {}

bodies::SoftPartSetup Game::body() const {
    bodies::SoftPartSetup body;
    body.object = kGameObject;
    body.scene_from_body.position_m = room_.serve_m;
    body.half_axes_m = Vec3(room_.radius_m);
    body.spacing_m = room_.radius_m / kGameElementsAlongRadius;
    body.material.young_Pa = kYoung_Pa;
    return body;
}

std::optional<session::LedHand> Game::led_hand() const {
    return session::LedHand{{kMiddle_m - kHalf_m, kMiddle_m + kHalf_m},
                            glm::angleAxis(kPalmUp_rad, Vec3(1.0, 0.0, 0.0))};
}

void Game::begin(bodies::SoftPart& body, session::ActivityOrders& orders) {
    body_ = &body;
    orders.on_scene.push_back(
        [&body, room = flight_room(room_, settings_)]() mutable { body.fall_among(std::move(room)); });
    orders.edits.push_back({kLine,
                            scene::ObjectProperty::position,
                            {0.0, settings_.line_m() - 0.5 * kLineThick_m, room_.wall_z_m + kLineAtWall_m}});
}

void Game::turn(const ExerciseTurn& turn, session::ActivityOrders& orders) {
    away_ns_ = turn.away_ns;
    GameStep step = step_game(state_, settings_, room_, turn);
    const GameState before = std::exchange(state_, std::move(step.state));
    for (const ExerciseEvent& event : step.events) tell(event, orders);
    move_body(before, orders);
}

void Game::interrupt(Nanoseconds time_ns, session::ActivityOrders& orders) {
    GameStep step = interrupted(state_, time_ns);
    state_ = std::move(step.state);
    for (const ExerciseEvent& event : step.events) tell(event, orders);
    if (state_.phase == GamePhase::resumes && body_ != nullptr)
        orders.on_scene.push_back([body = body_, at = room_.serve_m] { body->frame().put(at); });
}

ExerciseGoal Game::goal() const {
    ExerciseGoal goal;
    goal.progress = formatted("%u of %u", state_.catches + state_.misses, settings_.throws);
    switch (state_.phase) {
        case GamePhase::begins:
        case GamePhase::waits:
        case GamePhase::resumes: goal.next = "Take the ball"; break;
        case GamePhase::held: goal.next = "Throw it at the wall, above the line"; break;
        case GamePhase::flies: goal.next = state_.hit_wall ? "Catch it" : "Watch where it hits"; break;
    }
    if (state_.end != ExerciseEnd::not_yet) goal.next = "Done";
    return goal;
}

std::vector<std::string> Game::help() const {
    return {
        "Throwing and catching trains to open and to close the hand at the right time. The ball waits in the air: "
        "close the hand on it, move it towards the wall, open the hand on the way, and close it again when the "
        "ball comes back.",
        "A throw that hits the wall below the line, a ball that bounces twice off the floor, and one that is caught "
        "before it has been at the wall are misses."};
}

void Game::move_body(const GameState& before, session::ActivityOrders& orders) const {
    if (body_ == nullptr) return;
    bodies::SoftPart* const body = body_;
    const bool waits_anew = state_.phase == GamePhase::waits && before.phase == GamePhase::flies;
    if (state_.phase == GamePhase::held && before.phase != GamePhase::held) {
        std::vector<std::size_t> parts(kFelt);
        std::iota(parts.begin(), parts.end(), std::size_t{0});
        const Vec3 seat_palm_m =
            glm::conjugate(state_.last.palm.orientation) * (state_.last.grip_m - state_.last.palm.position_m);
        orders.on_scene.push_back([body, parts, seat_palm_m] { body->frame().take_hold(parts, seat_palm_m); });
    } else if (state_.phase == GamePhase::flies && before.phase != GamePhase::flies) {
        orders.on_scene.push_back([body, ball = state_.ball, at_ns = state_.last.time_ns + away_ns_] {
            body->frame().fly(ball, at_ns, false);
        });
    } else if (waits_anew) {
        orders.on_scene.push_back([body, at = state_.ball.place_m] { body->frame().put(at); });
    }
}

void Game::tell(const ExerciseEvent& event, session::ActivityOrders& orders) {
    using namespace game_event;
    events_.push_back(event);
    const bool caught = event.what == kCaught, missed = event.what == kMissed;
    if (event.what == kThrown) orders.trials.push_back({event.time_ns, formatted("throw %u", state_.throws)});
    if (caught || missed || event.what == kInterrupted)
        orders.trials.push_back({event.time_ns, "", std::string(event.what)});
    if (caught) orders.messages.push_back(formatted("caught: %u of %u throws", state_.catches, settings_.throws));
    if (event.what == kBelow) orders.messages.push_back("below the line");
    if (missed)
        orders.messages.push_back(state_.phase == GamePhase::held
                                      ? "missed: it has not been at the wall; throw it again"
                                      : "missed; the ball waits at its place");
}

ExerciseCourse Game::course() const {
    return {state_.end,
            state_.begun_ns,
            state_.time_s(),
            score_of(state_, settings_),
            {{"catches", "Catches", state_.catches, settings_.throws},
             {"misses", "Misses", state_.misses, 0},
             {"throws", "Throws", state_.throws, 0}},
            events_};
}

std::string Game::task() const {
    return formatted(
        "Take the ball, throw it at the wall above the line (%.0f cm), and catch it after at most one bounce.",
        100.0 * settings_.line_m());
}

}  // namespace burin::activities
