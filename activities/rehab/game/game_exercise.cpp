// SPDX-License-Identifier: MIT
#include "activities/rehab/game/game_exercise.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace burin::activities {
namespace {

using State = GameState;

constexpr std::uint32_t kWall = 1;  // among the obstacles of flight_room()

// When, within a turn that begins at `from`, the hand is closed as a catch asks for; from 0 to 1, empty where last < 0.
struct Span {
    double first = 0.0, last = 1.0;
};
Span closed_span(double from, double to) {
    const double change = to - from;
    if (change == 0.0) return from >= State::kClosed && from <= State::kFist ? Span{} : Span{0.0, -1.0};
    double a = (State::kClosed - from) / change, b = (State::kFist - from) / change;
    if (b < a) std::swap(a, b);
    const Span span{std::max(a, 0.0), std::min(b, 1.0)};
    return span.first <= span.last ? span : Span{0.0, -1.0};
}

// The arcs from a time on, as a flight of their own.
std::vector<bodies::Arc> from_on(const std::vector<bodies::Arc>& arcs, double first_s, double last_s) {
    std::vector<bodies::Arc> cut;
    for (bodies::Arc arc : arcs) {
        const double begin_s = std::max(arc.begin_s, first_s), end_s = std::min(arc.begin_s + arc.length_s, last_s);
        if (end_s < begin_s) continue;
        const double skipped_s = begin_s - arc.begin_s;
        arc.place_m = arc.place_at(begin_s);
        arc.velocity_m_per_s += skipped_s * arc.acceleration_m_per_s2;
        arc.begin_s = begin_s - first_s;
        arc.length_s = end_s - begin_s;
        cut.push_back(arc);
    }
    return cut;
}

// When within the turn the ball comes into the closed hand, in seconds since the turn before.
std::optional<double> caught_s(const std::vector<bodies::Arc>& arcs, const GameTurn& before, const GameTurn& turn) {
    const double turn_s = seconds(turn.time_ns - before.time_ns);
    const Span closed = closed_span(before.closure, turn.closure);
    if (closed.last < 0.0 || !(turn_s > 0.0)) return std::nullopt;
    const Vec3 velocity = (turn.grip_m - before.grip_m) / turn_s;
    const double first_s = closed.first * turn_s;
    const auto met = bodies::first_within(from_on(arcs, first_s, closed.last * turn_s),
                                          before.grip_m + first_s * velocity, velocity, State::kReach_m);
    return met ? std::optional(first_s + *met) : std::nullopt;
}

// Tells what happens, and keeps the ball and the counts by it.
class TurnOfGame {
public:
    TurnOfGame(const State& state, const GameSettings& settings, const GameRoom& room, const ExerciseTurn& turn)
        : settings_(settings), room_(room), turn_(game_turn(turn)), lies_m_(turn.lies_in_palm_m), step_{state, {}} {
        const FingerForces& forces_N = turn.fingers.forces_N;
        force_N_ = std::accumulate(forces_N.begin(), forces_N.end(), 0.0);
    }

    GameStep go_on() {
        if (state().end != ExerciseEnd::not_yet) return step_;
        if (state().phase == GamePhase::begins) begin();
        if (state().phase == GamePhase::resumes) {
            state().last = turn_;  // the hand has moved meanwhile, and met nothing on its way
            serve();
        }
        if (state().phase == GamePhase::waits) wait();
        if (state().phase == GamePhase::held)
            hold();
        else if (state().phase == GamePhase::flies)
            fly();
        state().last = turn_;
        end_where_due();
        return step_;
    }

private:
    State& state() { return step_.state; }
    void tell(std::string_view what, Nanoseconds time_ns) { step_.events.push_back({what, time_ns, force_N_}); }
    void serve() {
        state().phase = GamePhase::waits;
        state().ball = {room_.serve_m, Vec3(0.0), {}};
    }
    void begin() {
        state().begun_ns = turn_.time_ns;
        state().last = turn_;
        serve();
        tell(game_event::kBegun, turn_.time_ns);
    }
    void take(std::string_view what, Nanoseconds time_ns) {
        state().phase = GamePhase::held;
        state().recent.clear();
        const Pose palm = palm_at(time_ns);
        state().in_palm_m = glm::conjugate(palm.orientation) * (state().ball.place_m - palm.position_m);
        tell(what, time_ns);
    }
    // The palm moves evenly within a turn, and turns at its beginning.
    [[nodiscard]] Pose palm_at(Nanoseconds time_ns) const {
        const GameTurn& last = step_.state.last;
        const double turn_s = seconds(turn_.time_ns - last.time_ns);
        const double share = turn_s > 0.0 ? seconds(time_ns - last.time_ns) / turn_s : 1.0;
        return {last.palm.position_m + share * (turn_.palm.position_m - last.palm.position_m), turn_.palm.orientation};
    }
    [[nodiscard]] Vec3 held_at(const GameTurn& turn) const {
        return turn.palm.position_m + turn.palm.orientation * step_.state.in_palm_m;
    }
    void wait() {
        const double turn_s = seconds(turn_.time_ns - state().last.time_ns);
        const std::vector still{bodies::Arc{0.0, turn_s, state().ball.place_m, Vec3(0.0), Vec3(0.0)}};
        if (caught_s(still, state().last, turn_)) take(game_event::kTaken, turn_.time_ns);
    }
    // The ball goes with the palm; an opened hand throws it with the velocity that it has there.
    void hold() {
        auto& recent = state().recent;
        if (lies_m_) state().in_palm_m = *lies_m_;
        state().ball = {held_at(turn_), Vec3(0.0), {}};
        recent.push_back(turn_);
        const auto is_old = [&](const GameTurn& t) { return turn_.time_ns - t.time_ns > State::kThrow_ns; };
        recent.erase(recent.begin(), std::ranges::find_if_not(recent, is_old));
        if (turn_.closure >= State::kOpen) return;
        const double over_s = seconds(turn_.time_ns - recent.front().time_ns);
        if (over_s > 0.0) state().ball.velocity_m_per_s = (held_at(turn_) - held_at(recent.front())) / over_s;
        state().phase = GamePhase::flies;
        state().has_left = state().hit_wall = false;
        state().bounces = 0;
        ++state().throws;
        tell(game_event::kThrown, turn_.time_ns);
    }
    void miss(Nanoseconds time_ns) {
        ++state().misses;
        tell(game_event::kMissed, time_ns);
        serve();
    }
    // Returns whether the throw has ended with the bounce.
    bool bounce(const bodies::Bounce& bounce) {
        const Nanoseconds at_ns = state().last.time_ns + static_cast<Nanoseconds>(std::llround(1e9 * bounce.at_s));
        state().ball.place_m = bounce.place_m;
        if (bounce.obstacle == kWall) {
            const bool above = bounce.place_m.y > settings_.line_m();
            const bool first = !state().hit_wall;
            if (first) tell(above ? game_event::kHit : game_event::kBelow, at_ns);
            state().hit_wall = true;
            if (first && !above) miss(at_ns);
            return first && !above;
        }
        ++state().bounces;
        tell(game_event::kBounced, at_ns);
        if (state().bounces < 2) return false;
        miss(at_ns);
        return true;
    }
    void fly() {
        const double turn_s = seconds(turn_.time_ns - state().last.time_ns);
        const bodies::Flight flight = bodies::flight_of(state().ball, flight_room(room_, settings_), turn_s);
        const std::optional<double> caught =
            state().has_left ? caught_s(flight.arcs, state().last, turn_) : std::nullopt;
        for (const bodies::Bounce& of : flight.bounces)
            if ((!caught || of.at_s <= *caught) && bounce(of)) return;
        if (caught) {
            const Nanoseconds at_ns = state().last.time_ns + static_cast<Nanoseconds>(std::llround(1e9 * *caught));
            for (const bodies::Arc& arc : flight.arcs)
                if (arc.begin_s <= *caught) state().ball.place_m = arc.place_at(*caught);
            ++(state().hit_wall ? state().catches : state().misses);
            return take(state().hit_wall ? game_event::kCaught : game_event::kMissed, at_ns);
        }
        state().ball = flight.ball;
        state().has_left = state().has_left || !flight.bounces.empty() ||
                           glm::length(state().ball.place_m - turn_.grip_m) > State::kReach_m;
        if (flight.ball.rests() || flight.ball.place_m.z > kAway_m) miss(turn_.time_ns);
    }
    void end_where_due() {
        const bool done = state().catches + state().misses >= settings_.throws;
        if (!done && state().time_s() < settings_.time_limit_s) return;
        state().end = done ? ExerciseEnd::done : ExerciseEnd::time_over;
        tell(done ? game_event::kDone : game_event::kTimeOver, turn_.time_ns);
    }

    static constexpr double kAway_m = 1.0;  // nobody reaches a ball that has come so far back

    const GameSettings& settings_;
    const GameRoom& room_;
    const GameTurn turn_;
    const std::optional<Vec3> lies_m_;
    double force_N_ = 0.0;
    GameStep step_;
};

}  // namespace

GameTurn game_turn(const ExerciseTurn& turn) {
    const Similarity& hand = turn.scene_from_hand;
    return {turn.time_ns, {hand.position_m, hand.orientation}, hand * kGrip_hand_m, turn.closure};
}

bodies::FlightRoom flight_room(const GameRoom& room, const GameSettings& settings) {
    bodies::FlightRoom flight;
    flight.gravity_m_per_s2 *= settings.weight();
    flight.radius_m = room.radius_m;
    flight.restitution = room.restitution;
    flight.tangential_kept = room.tangential_kept;
    flight.obstacles = {bodies::HalfSpace{}, bodies::HalfSpace{{0.0, 0.0, 1.0}, room.wall_z_m}};
    return flight;
}

GameStep step_game(GameState state, const GameSettings& settings, const GameRoom& room, const ExerciseTurn& turn) {
    return TurnOfGame(state, settings, room, turn).go_on();
}

GameStep interrupted(GameState state, Nanoseconds time_ns) {
    GameStep step{std::move(state), {}};
    GameState& next = step.state;
    if (next.phase == GamePhase::begins || next.end != ExerciseEnd::not_yet) return step;
    if (next.phase == GamePhase::flies) {
        --next.throws;
        step.events.push_back({game_event::kInterrupted, time_ns, 0.0});
    }
    next.phase = GamePhase::resumes;
    next.recent.clear();
    return step;
}

double score_of(const GameState& state, const GameSettings& settings) {
    return 100.0 * std::clamp(static_cast<double>(state.catches) / settings.throws, 0.0, 1.0);
}

}  // namespace burin::activities
