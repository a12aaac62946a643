// SPDX-License-Identifier: MIT
// One stage of a study, tick by tick: step() takes the state and a tick and returns the next state and what happened.
// It has no clock, no input and no output, so that a record replayed gives the same events to the bit.
//
// The wand is two points, each taken to move straight and evenly between ticks. A cap is a box behind one end of the
// tube, sensed cap_depth deep away from the tube. It is touched while both points are in it at one instant; times come
// from the segments' crossings of the box's faces, exact between ticks, so that a wand too fast for a tick within the
// box counts. The end is proper where both points came in through the face towards the tube. Any thread; no heap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/space.hpp"
#include "study/protocol/protocol.hpp"

namespace burin::study {

// Right-handed axes; z points away from the tube. The box spans +-half_width in x and y and 0 to depth in z.
struct CapBox {
    Vec3 centre_m{0.0};  // of the face towards the tube
    Vec3 x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};
    double half_width_m = 0.0, depth_m = 0.0;
};

// The share of a segment, 0 to 1, that is within the box, faces included; nothing where none is.
struct Inside {
    double enters = 0.0, leaves = 0.0;
    bool through_face = false;  // it came in through the face towards the tube
};
[[nodiscard]] std::optional<Inside> inside(const CapBox& cap, const Vec3& from_m, const Vec3& to_m);

[[nodiscard]] CapBox start_cap(const StudyWorld& world);
[[nodiscard]] CapBox end_cap(const StudyWorld& world);

// The nearest place of a polyline; along_m is its distance from the first point on the line.
struct NearestOnLine {
    Vec3 place_m{0.0};
    double distance_m = 0.0, along_m = 0.0;
};
[[nodiscard]] NearestOnLine nearest_on(std::span<const Vec3> line_m, const Vec3& point_m);

struct StageSetup {
    StageKind kind = StageKind::page;
    std::optional<double> ends_after_s;
    bool ends_at_exit = false, ends_by_operator = false;
    unsigned attempts = 1;
    ClockStart clock = ClockStart::leave;
    Validity validity;
    CapBox start, end;
    std::span<const Vec3> spine_m;  // of the world; outlives the setup
};
// The protocol must outlive the setup.
[[nodiscard]] StageSetup setup_of(const Protocol& protocol, const Stage& stage);

enum class OperatorAct { none, pause, go_on, stop, next, repeat };
[[nodiscard]] const char* name_of(OperatorAct act);
[[nodiscard]] std::optional<OperatorAct> operator_act(std::string_view name);  // none is no act that has a name

struct StageTick {
    double time_s = 0.0;  // of any clock that only goes forward
    std::array<Vec3, 2> points_m{};
    OperatorAct act = OperatorAct::none;
    bool amplifiers_off = false;
};

enum class StagePhase { begin, waiting, armed, running, paused, done };

// Why an attempt failed or a trial is invalid.
enum class Failure { none, strayed, wrong_exit, went_back, laid_down, amplifiers, gap, paused, repeated };
[[nodiscard]] const char* name_of(Failure failure);
[[nodiscard]] std::optional<Failure> failure_named(std::string_view name);  // none is no failure that has a name
// Returns whether an attempt failed by what the person did, which uses it up; else by the operator or the device.
[[nodiscard]] bool is_of_person(Failure failure);
enum class StageResult { open, time_over, valid_exit, by_operator, no_attempt_left, stopped };
[[nodiscard]] const char* name_of(StageResult result);

enum class StageEventKind { start_touched, clock_started, end_touched, attempt_failed, ended };
struct StageEvent {
    StageEventKind kind = StageEventKind::ended;
    double time_s = 0.0;  // exact, between ticks
    Failure failure = Failure::none;
};

struct StageState {
    StagePhase phase = StagePhase::begin;
    StageResult result = StageResult::open;
    Failure last_failure = Failure::none;
    unsigned attempt = 1;
    std::array<Vec3, 2> points_m{};  // at the tick before
    double time_s = 0.0;             // of the tick before
    double begun_s = 0.0, paused_s = 0.0, pause_begun_s = 0.0;
    double clock_started_s = 0.0, clock_stopped_s = 0.0;
    std::array<bool, 2> in_end_properly{};  // each point came into the end cap through its face and is still there
    bool both_in_start = false;
    bool been_away = false;  // from the start, by return_m along the path
    Vec3 still_at_m{0.0};
    double still_since_s = 0.0;
};

struct StageStep {
    StageState state;
    std::array<StageEvent, 4> events{};
    std::size_t event_count = 0;
};
[[nodiscard]] StageStep step(const StageSetup& setup, const StageState& state, const StageTick& tick);

// Of a trial that ended with valid_exit; from the start cap to the end cap.
[[nodiscard]] double trial_time_s(const StageState& state);

}  // namespace burin::study
