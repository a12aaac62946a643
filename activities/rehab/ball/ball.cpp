// SPDX-License-Identifier: MIT
#include "activities/rehab/ball/ball.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"

namespace burin::activities {
namespace {

// The world's ball, as assets/worlds/hand.toml has it: its number, its place and its size.
constexpr std::uint32_t kBallObject = 2;
constexpr Vec3 kPlace_m{0.02, 0.0825, 0.0};
constexpr double kRadius_m = 0.035;
constexpr double kBallElementsAlongRadius = 3.2;  // 1,632 elements: the scene's thread has more to do than them

constexpr std::array kColours{"yellow", "red", "green", "blue"};  // as BallColour has them

constexpr double kPressedOpen_s = 0.5;  // with the target's force by a hand that does not grasp: this is told

}  // namespace

std::span<const SettingKind> Ball::setting_kinds() {
    static const std::array kinds{
        SettingKind{.key = "colour",
                    .option = "--colour",
                    .help = "How stiff the ball is, from soft to hard",
                    .usual = 1,
                    .words = kColours},
        level_setting(3, "Of difficulty: with how much force to squeeze, 1 to 3", "there are levels 1, 2 and 3"),
        SettingKind{.key = "repetitions",
                    .option = "--repetitions",
                    .help = "How many squeezes",
                    .remedy = "ask for 1 to 1000 squeezes",
                    .usual = 5,
                    .least = 1,
                    .most = 1000,
                    .whole = true},
        SettingKind{.key = "hold_s",
                    .option = "--hold",
                    .help = "How long each is held, in seconds",
                    .remedy = "ask for 0 to 60 seconds",
                    .usual = 1.0,
                    .most = 60.0},
        time_limit_setting(60.0),
        SettingKind{.key = "share",
                    .option = "--share",
                    .help = "Of the force, that each finger gives at least; 0: all together, whoever gives it",
                    .remedy = "ask for 0, all together, to 0.25, of each finger a quarter",
                    .usual = 0.1,
                    .most = 0.25,
                    .before = 0.0},
        start_setting(),
        most_force_setting(),
        open_setting(),
        closed_setting(),
        success_setting(),
        begin_force_setting(),
    };
    return kinds;
}

BallSettings ball_settings(const SettingValues& values) {
    BallSettings settings{static_cast<BallColour>(values.count("colour")),
                          values.count("level"),
                          values.count("repetitions"),
                          values.number("hold_s"),
                          values.number("time_limit_s"),
                          values.number("share"),
                          values.number("most_N")};
    if (values.number("success") > 0.0) settings.adapts = staircase_of(values, settings.target_N(), settings.most_N);
    return settings;
}

std::unique_ptr<Exercise> Ball::make(const SettingValues& values) { return std::make_unique<Ball>(values); }

std::optional<Error> Ball::conflict(const SettingValues& values) {
    if (auto wrong = too_short_a_way(values)) return wrong;
    if (auto wrong = no_staircase(values)) return wrong;
    if (auto wrong = too_low_a_target(BallSettings::kOfMost[values.count("level") - 1], values.number("most_N")))
        return wrong;
    const BallSettings settings = ball_settings(values);
    const unsigned rests = settings.repetitions - 1;
    return too_short_a_limit(values, settings.repetitions * settings.hold_s + rests * BallState::kRelaxes_s,
                             formatted("%u squeezes of %g s and %u rests of %g s", settings.repetitions,
                                       settings.hold_s, rests, BallState::kRelaxes_s));
}

Ball::Ball(const SettingValues& values) : values_(values), settings_(ball_settings(values)) {}

bodies::SoftPartSetup Ball::body() const {
    bodies::SoftPartSetup body;
    body.object = kBallObject;
    body.scene_from_body.position_m = kPlace_m;
    body.half_axes_m = Vec3(kRadius_m);
    body.spacing_m = kRadius_m / kBallElementsAlongRadius;
    body.material.young_Pa = kind_of(settings_.colour).young_Pa;
    return body;
}

void Ball::turn(const ExerciseTurn& turn, session::ActivityOrders& orders) {
    BallStep step = step_ball(state_, settings_, turn);
    state_ = step.state;
    for (const ExerciseEvent& event : step.events) tell(event, orders);
    follow_pressed_open(turn, orders);
}

void Ball::interrupt(Nanoseconds time_ns, session::ActivityOrders& orders) {
    BallStep step = interrupted(state_, time_ns);
    state_ = step.state;
    pressed_open_s_ = 0.0;
    for (const ExerciseEvent& event : step.events) tell(event, orders);
}

ExerciseGoal Ball::goal() const {
    ExerciseGoal goal{target_N(), state_.smooth_N, settings_.share * target_N(), settings_.hold_s, 0.0, {}, {}};
    goal.progress = formatted("%u of %u", state_.repetitions, settings_.repetitions);
    switch (state_.phase) {
        case BallPhase::begins:
        case BallPhase::waits: goal.next = state_.grasped ? "Squeeze the ball" : "Grasp the ball"; break;
        case BallPhase::holds:
            goal.held_s = std::min(seconds(state_.last_ns - state_.held_since_ns), settings_.hold_s);
            goal.next = "Hold it so";
            break;
        case BallPhase::relaxes: goal.next = "Relax"; break;
        case BallPhase::ended: goal.next = "Done: let go of the ball"; break;
    }
    if (state_.phase == BallPhase::relaxes) goal.held_s = goal.hold_s;
    return goal;
}

// A hand that is not closed by the range that is set does not grasp, and its force does not count.
void Ball::follow_pressed_open(const ExerciseTurn& turn, session::ActivityOrders& orders) {
    const bool presses = !turn.grasped && state_.phase == BallPhase::waits && state_.smooth_N >= target_N();
    const double before_s = pressed_open_s_;
    pressed_open_s_ = presses ? before_s + turn.fingers.dt_s : 0.0;
    if (before_s >= kPressedOpen_s || pressed_open_s_ < kPressedOpen_s) return;
    ++pressed_open_;
    orders.messages.push_back(
        formatted("%.1f N do not count: the hand does not grasp the ball; it is closed by %.2f of "
                  "the way from open %g to closed %g",
                  state_.smooth_N, turn.closure, values_.number("open"), values_.number("closed")));
}

void Ball::tell(const ExerciseEvent& event, session::ActivityOrders& orders) {
    events_.push_back(event);
    const unsigned number = state_.repetitions;
    const bool counted = event.what == ball_event::kCounted, too_short = event.what == ball_event::kTooShort;
    const bool broken = event.what == ball_event::kInterrupted;
    if (event.what == ball_event::kReached)
        orders.trials.push_back({event.time_ns, formatted("squeeze %u", number + state_.too_short + 1)});
    if (counted || too_short || broken) orders.trials.push_back({event.time_ns, "", std::string(event.what)});
    const std::string adapted = settings_.adapts ? formatted("; the next with %.2f N", target_N()) : "";
    if (counted)
        orders.messages.push_back(formatted("squeeze %u of %u counted", number, settings_.repetitions) + adapted);
    if (event.what == ball_event::kTooWeak) orders.messages.push_back("too weak" + adapted);
    if (event.what == ball_event::kUneven) {
        const std::size_t finger = state_.weakest_finger();
        orders.messages.push_back(formatted("the %s presses with %.2f N, and %.2f N is asked of each finger",
                                            kFingerNames[finger], state_.smooth_each_N[finger],
                                            settings_.share * target_N()));
    }
    if (too_short) orders.messages.push_back("held too short; squeeze again" + adapted);
}

ExerciseCourse Ball::course() const {
    std::vector<std::string> notes;
    if (pressed_open_ > 0)
        notes.push_back(
            formatted("the force was reached %s and did not count, since the hand did not grasp the "
                      "ball: it was not closed as open %g and closed %g have it, or not around the ball",
                      pressed_open_ == 1 ? "once" : formatted("%u times", pressed_open_).c_str(),
                      values_.number("open"), values_.number("closed")));
    ExerciseCourse course{state_.end,
                          state_.begun_ns,
                          state_.time_s(),
                          score_of(state_, settings_),
                          {{"repetitions", "Squeezes", state_.repetitions, settings_.repetitions},
                           {"held_too_short", "Held too short", state_.too_short, 0},
                           {"grasps", "Grasps", state_.grasps, 0}},
                          events_,
                          std::move(notes)};
    if (settings_.adapts) course.counts.push_back({"too_weak", "Too weak", state_.too_weak, 0});
    return course;
}

Json Ball::findings() const {
    if (!settings_.adapts) return {};
    return {{"first_target_N", settings_.adapts->target_N}, {"next_target_N", target_N()}};
}

std::vector<std::string> Ball::help() const {
    std::vector<std::string> help{
        "The ball trains the strength of the grip and how long it is kept up: squeeze it until the forces reach their "
        "marks, hold it so until the ring is full, and relax.",
        formatted(
            "A squeeze that sinks below %.0f %% of a mark before the ring is full is held too short, and the ring "
            "begins anew. The next one counts after the force has been at half of the target or less for %.2f s, "
            "or the ball was let go of.",
            100.0 * BallState::kKept, BallState::kRelaxes_s)};
    if (settings_.share > 0.0)
        help.push_back(formatted("Each finger gives %.0f %% of the force or more: the others cannot do it for one.",
                                 100.0 * settings_.share));
    if (settings_.adapts)
        help.push_back(
            "The force that is asked for rises after each squeeze that counts, and falls after one that is "
            "held too short or too weak. One that a break has interrupted changes nothing.");
    return help;
}

std::string Ball::task() const {
    const std::string of_each =
        settings_.share > 0.0 ? formatted(", %.1f N or more in each,", settings_.share * target_N()) : "";
    return formatted("Squeeze the ball with %.3g N in all fingers together%s for %.1f s, then relax.", target_N(),
                     of_each.c_str(), settings_.hold_s);
}

}  // namespace burin::activities
