// SPDX-License-Identifier: MIT
#include "study/trial/stage_step.hpp"

#include <algorithm>
#include <cmath>

namespace burin::study {
namespace {

// One tick's work on a copy of the state.
class StageStepper {
public:
    StageStepper(const StageSetup& setup, const StageState& state, const StageTick& tick)
        : setup_(setup), tick_(tick), made_{.state = state} {}

    StageStep run() {
        if (s_.phase == StagePhase::done) return made_;
        // Passed over; the next good tick sees a gap.
        if (!std::isfinite(tick_.time_s) || !finite(tick_.points_m[0]) || !finite(tick_.points_m[1])) return made_;
        if (s_.phase == StagePhase::begin) begin();
        const double gap_s = tick_.time_s - s_.time_s;
        if (gap_s < 0.0) return made_;  // a clock that went back; the next tick forward sees a gap
        operator_acts();
        if (s_.phase != StagePhase::done && s_.phase != StagePhase::paused) {
            if (setup_.kind == StageKind::trial) trial(gap_s);
            check_time();
        }
        s_.time_s = tick_.time_s;
        s_.points_m = tick_.points_m;
        return made_;
    }

private:
    void begin() {
        s_.phase = StagePhase::waiting;
        s_.begun_s = s_.time_s = s_.still_since_s = tick_.time_s;
        s_.points_m = tick_.points_m;
        s_.still_at_m = middle();
    }

    [[nodiscard]] Vec3 middle() const { return 0.5 * (tick_.points_m[0] + tick_.points_m[1]); }

    void say(StageEventKind kind, double time_s, Failure failure = Failure::none) {
        if (made_.event_count < made_.events.size()) made_.events[made_.event_count++] = {kind, time_s, failure};
    }

    void end(StageResult result, double time_s) {
        s_.phase = StagePhase::done;
        s_.result = result;
        say(StageEventKind::ended, time_s, s_.last_failure);
    }

    // Only failures of the person use up an attempt.
    void fail_attempt(Failure failure, double time_s) {
        s_.last_failure = failure;
        say(StageEventKind::attempt_failed, time_s, failure);
        s_.phase = StagePhase::waiting;
        s_.both_in_start = s_.been_away = false;
        s_.in_end_properly = {};
        const bool of_person = is_of_person(failure);
        if (of_person && s_.attempt >= setup_.attempts) return end(StageResult::no_attempt_left, time_s);
        if (of_person) ++s_.attempt;
    }

    void operator_acts() {
        const double now_s = tick_.time_s;
        switch (tick_.act) {
            case OperatorAct::none: break;
            case OperatorAct::pause:
                if (s_.phase == StagePhase::paused) break;
                if (s_.phase == StagePhase::running) fail_attempt(Failure::paused, now_s);
                s_.phase = StagePhase::paused;
                s_.pause_begun_s = now_s;
                break;
            case OperatorAct::go_on:
                if (s_.phase != StagePhase::paused) break;
                s_.phase = StagePhase::waiting;
                s_.paused_s += now_s - s_.pause_begun_s;
                s_.both_in_start = false;
                s_.still_since_s = now_s;
                break;
            case OperatorAct::stop: end(StageResult::stopped, now_s); break;
            case OperatorAct::next:
                if (setup_.ends_by_operator) end(StageResult::by_operator, now_s);
                break;
            case OperatorAct::repeat:
                if (setup_.kind == StageKind::trial && s_.phase != StagePhase::paused)
                    fail_attempt(Failure::repeated, now_s);
                break;
        }
    }

    void check_time() {
        if (s_.phase == StagePhase::done || !setup_.ends_after_s) return;
        const double over_s = s_.begun_s + s_.paused_s + *setup_.ends_after_s;
        if (tick_.time_s >= over_s) end(StageResult::time_over, over_s);
    }

    void trial(double gap_s) {
        if (s_.phase == StagePhase::running) {
            if (gap_s > setup_.validity.longest_gap_s) return fail_attempt(Failure::gap, tick_.time_s);
            if (tick_.amplifiers_off) return fail_attempt(Failure::amplifiers, tick_.time_s);
        }
        if (gap_s <= setup_.validity.longest_gap_s) {
            start(gap_s);
            if (s_.phase == StagePhase::running) reach_end(gap_s);
        }
        if (s_.phase == StagePhase::running) watch();
    }

    // The share of the tick in which both points are in the cap.
    [[nodiscard]] std::optional<Inside> both(const CapBox& cap) const {
        const auto a = inside(cap, s_.points_m[0], tick_.points_m[0]);
        const auto b = inside(cap, s_.points_m[1], tick_.points_m[1]);
        if (!a || !b || std::max(a->enters, b->enters) > std::min(a->leaves, b->leaves)) return std::nullopt;
        return Inside{std::max(a->enters, b->enters), std::min(a->leaves, b->leaves), false};
    }

    void start(double gap_s) {
        const auto touched = both(setup_.start);
        const double before_s = s_.time_s;
        if (s_.phase == StagePhase::running) {
            if (touched && s_.been_away) fail_attempt(Failure::went_back, before_s + touched->enters * gap_s);
            return;
        }
        if (touched && s_.phase == StagePhase::waiting) {
            s_.phase = StagePhase::armed;
            const double at_s = before_s + touched->enters * gap_s;
            say(StageEventKind::start_touched, at_s);
            if (setup_.clock == ClockStart::touch) s_.clock_started_s = at_s;
        }
        if (s_.phase != StagePhase::armed) return;
        // Both are out on the tube's side: the later of them has crossed the face, perhaps within this tick. One that
        // goes out of another face disarms.
        const double a = outward(setup_.start, tick_.points_m[0]), b = outward(setup_.start, tick_.points_m[1]);
        if (a < 0.0 && b < 0.0) {
            const double leaves = std::max(crossing(setup_.start, 0), crossing(setup_.start, 1));
            run_clock(before_s + leaves * gap_s);
        } else if (!touched && (a > 0.0 && b > 0.0)) {
            s_.phase = StagePhase::waiting;
        }
    }

    void run_clock(double left_s) {
        s_.phase = StagePhase::running;
        if (setup_.clock == ClockStart::leave) s_.clock_started_s = left_s;
        s_.been_away = false;
        s_.in_end_properly = {};
        s_.still_since_s = tick_.time_s;
        s_.still_at_m = middle();
        say(StageEventKind::clock_started, s_.clock_started_s);
    }

    [[nodiscard]] static double outward(const CapBox& cap, const Vec3& point_m) {
        return glm::dot(point_m - cap.centre_m, cap.z);
    }

    // Where in the tick a point crosses the plane of the face; 0 where it was across before.
    [[nodiscard]] double crossing(const CapBox& cap, std::size_t point) const {
        const double from = outward(cap, s_.points_m[point]), to = outward(cap, tick_.points_m[point]);
        return from >= 0.0 && to < 0.0 ? from / (from - to) : 0.0;
    }

    void reach_end(double gap_s) {
        std::array<bool, 2> proper{};
        for (std::size_t p = 0; p < 2; ++p) {
            const auto in = inside(setup_.end, s_.points_m[p], tick_.points_m[p]);
            if (!in) continue;
            const bool was_in = in->enters == 0.0 && !in->through_face;
            proper[p] = in->through_face || (was_in && s_.in_end_properly[p]);
        }
        s_.in_end_properly = proper;
        const auto touched = both(setup_.end);
        if (!touched) return;
        const double at_s = s_.time_s + touched->enters * gap_s;
        if (!proper[0] || !proper[1]) return fail_attempt(Failure::wrong_exit, at_s);
        s_.clock_stopped_s = at_s;
        say(StageEventKind::end_touched, at_s);
        if (setup_.ends_at_exit) return end(StageResult::valid_exit, at_s);
        s_.phase = StagePhase::waiting;
    }

    void watch() {
        const NearestOnLine nearest = nearest_on(setup_.spine_m, middle());
        if (nearest.along_m >= setup_.validity.return_m) s_.been_away = true;
        if (nearest.distance_m > setup_.validity.stray_m) return fail_attempt(Failure::strayed, tick_.time_s);
        if (glm::distance(middle(), s_.still_at_m) > setup_.validity.still_m) {
            s_.still_at_m = middle();
            s_.still_since_s = tick_.time_s;
        } else if (tick_.time_s - s_.still_since_s >= setup_.validity.still_s) {
            fail_attempt(Failure::laid_down, tick_.time_s);
        }
    }

    const StageSetup& setup_;
    const StageTick& tick_;
    StageStep made_;
    StageState& s_ = made_.state;
};

}  // namespace

const char* name_of(OperatorAct act) {
    switch (act) {
        case OperatorAct::none: return "none";
        case OperatorAct::pause: return "pause";
        case OperatorAct::go_on: return "go on";
        case OperatorAct::stop: return "stop";
        case OperatorAct::next: return "next";
        case OperatorAct::repeat: return "repeat";
    }
    return "unknown";
}

std::optional<OperatorAct> operator_act(std::string_view name) {
    for (const OperatorAct act :
         {OperatorAct::pause, OperatorAct::go_on, OperatorAct::stop, OperatorAct::next, OperatorAct::repeat}) {
        if (name == name_of(act)) return act;
    }
    return std::nullopt;
}

const char* name_of(Failure failure) {
    switch (failure) {
        case Failure::none: return "none";
        case Failure::strayed: return "strayed";
        case Failure::wrong_exit: return "wrong exit";
        case Failure::went_back: return "went back";
        case Failure::laid_down: return "laid down";
        case Failure::amplifiers: return "amplifiers off";
        case Failure::gap: return "gap in the data";
        case Failure::paused: return "paused";
        case Failure::repeated: return "repeated";
    }
    return "unknown";
}

std::optional<Failure> failure_named(std::string_view name) {
    for (const Failure failure : {Failure::strayed, Failure::wrong_exit, Failure::went_back, Failure::laid_down,
                                  Failure::amplifiers, Failure::gap, Failure::paused, Failure::repeated}) {
        if (name == name_of(failure)) return failure;
    }
    return std::nullopt;
}

bool is_of_person(Failure failure) {
    return failure == Failure::strayed || failure == Failure::wrong_exit || failure == Failure::went_back ||
           failure == Failure::laid_down;
}

const char* name_of(StageResult result) {
    switch (result) {
        case StageResult::open: return "open";
        case StageResult::time_over: return "time over";
        case StageResult::valid_exit: return "valid exit";
        case StageResult::by_operator: return "by operator";
        case StageResult::no_attempt_left: return "no attempt left";
        case StageResult::stopped: return "stopped";
    }
    return "unknown";
}

StageSetup setup_of(const Protocol& protocol, const Stage& stage) {
    StageSetup setup{.kind = stage.kind,
                     .ends_after_s = stage.ends_after_s,
                     .ends_at_exit = stage.ends_at_exit,
                     .ends_by_operator = stage.ends_by_operator,
                     .attempts = stage.attempts,
                     .clock = protocol.clock,
                     .validity = protocol.validity,
                     .start = {},
                     .end = {},
                     .spine_m = {}};
    if (const StudyWorld* world = protocol.world(stage.world)) {
        setup.start = start_cap(*world);
        setup.end = end_cap(*world);
        setup.spine_m = world->spine_m;
    }
    return setup;
}

StageStep step(const StageSetup& setup, const StageState& state, const StageTick& tick) {
    return StageStepper(setup, state, tick).run();
}

double trial_time_s(const StageState& state) { return state.clock_stopped_s - state.clock_started_s; }

}  // namespace burin::study
