// SPDX-License-Identifier: MIT
#include "activities/rehab/assess/assess.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace burin::activities {
namespace {

// Where the mouse leads the hand: above a table, over nothing that a closing finger reaches.
constexpr Vec3 kAssessMiddle_m{0.0, 0.055, 0.0}, kAssessHalf_m{0.1, 0.02, 0.08};
// Fingers up and away from the person, who sees the back of the hand and how each finger bends.
constexpr double kAssessTilt_rad = -0.6;

Json json_of_measure(const std::optional<double>& measure) { return measure ? Json(*measure) : Json(); }

}  // namespace

std::span<const SettingKind> Assess::setting_kinds() {
    static const std::array kinds{
        SettingKind{.key = "bound_N",
                    .option = "--bound",
                    .help = "Up to which force a piston holds against a finger that presses",
                    .remedy = "give 1 to 10 N",
                    .usual = 8.0,
                    .least = 1.0,
                    .most = 10.0},
        start_setting(),
    };
    return kinds;
}

std::unique_ptr<Exercise> Assess::make(const SettingValues& values) { return std::make_unique<Assess>(values); }

std::optional<Error> Assess::conflict(const SettingValues& values) {
    if (values.number("start") != kStartsPressed) return std::nullopt;
    return Error{"is pressed, and nothing is there to press on before the assessment", "start",
                 "say asked, to begin with Start, or at_once"};
}

Assess::Assess(const SettingValues& values) : values_(values) {}

std::optional<session::LedHand> Assess::led_hand() const {
    return session::LedHand{{kAssessMiddle_m - kAssessHalf_m, kAssessMiddle_m + kAssessHalf_m},
                            glm::angleAxis(kAssessTilt_rad, Vec3(1.0, 0.0, 0.0))};
}

void Assess::turn(const ExerciseTurn& turn, session::ActivityOrders& orders) {
    const AssessStep step = step_assessment(state_, turn);
    const bool was_pressing = pressed_from_m_.has_value();
    const std::size_t part_before = state_.part;
    const bool had_begun = state_.begun;
    state_ = step.state;
    events_.insert(events_.end(), step.events.begin(), step.events.end());
    const bool presses = state_.measures && assess_parts()[state_.part].task == AssessTask::press;
    if (presses && !was_pressing) pressed_from_m_ = turn.tips_object_m;
    if (!presses) pressed_from_m_.reset();
    orders.parameters = orders.parameters || presses != was_pressing;
    if (state_.end == ExerciseEnd::not_yet && (!had_begun || state_.part != part_before))
        orders.messages.push_back(instruction_of(assess_parts()[state_.part]));
    for (const ExerciseEvent& event : step.events) {
        if (event.what.ends_with(" begins"))
            orders.trials.push_back({event.time_ns, std::string(event.what.substr(0, event.what.size() - 7))});
        else if (event.what != "begun")
            orders.trials.push_back({event.time_ns, "", "measured"});
    }
}

void Assess::interrupt(Nanoseconds time_ns, session::ActivityOrders& orders) {
    const AssessStep step = interrupted(state_, time_ns);
    state_ = step.state;
    pressed_from_m_.reset();
    for (const ExerciseEvent& event : step.events) {
        events_.push_back(event);
        orders.trials.push_back({event.time_ns, "", std::string(event.what)});
    }
}

ExerciseGoal Assess::goal() const {
    ExerciseGoal goal;
    goal.progress = formatted("%zu of %zu", std::min(state_.part + 1, kAssessParts), kAssessParts);
    goal.next = task();
    if (!state_.measures) return goal;
    const AssessPart& part = assess_parts()[state_.part];
    goal.hold_s = part.lasts_s;
    goal.held_s = std::clamp(state_.course_s() - assess_begins_s(state_.part), 0.0, part.lasts_s);
    return goal;
}

std::vector<std::string> Assess::help() const {
    return {
        "The assessment measures what the hand can do: how far and how fast it opens and closes, with how much force "
        "each finger presses, and how well each moves alone. The other exercises are fitted to it.",
        formatted("Each of its %zu parts has a time, which the ring shows, and %.0f s before it to read what comes. "
                  "A break puts back the part that is under way: it is measured anew.",
                  kAssessParts, kReads_s)};
}

void Assess::adjust(std::size_t finger, haptics::TickParameters& parameters) const {
    if (!pressed_from_m_ || finger >= pressed_from_m_->size()) return;
    parameters.guidance = {};
    parameters.guidance.stiffness_N_per_m = kSpring_N_per_m;
    parameters.guidance.damping_Ns_per_m = kDamping_Ns_per_m;
    parameters.guidance.max_force_N = values_.number("bound_N");
    parameters.guidance.reach_m = kReach_m;
    parameters.curve = {};
    parameters.curve.count = 2;  // of no length: a point
    parameters.curve.points_object_m[0] = parameters.curve.points_object_m[1] = Vec3f((*pressed_from_m_)[finger]);
}

ExerciseCourse Assess::course() const {
    const Assessed found = assessed(state_);
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < found.fingers.size(); ++i) {
        const bool was_asked = state_.part > 5 + i;
        if (was_asked && !found.fingers[i].fractionation)
            notes.push_back(
                formatted("the %s moved by less than %g rad when it was to move alone: its fractionation "
                          "is not known",
                          kFingerNames[i], AssessState::kMoved_rad));
        const std::optional<double>& strength_N = found.fingers[i].strength_N;
        if (strength_N && *strength_N >= 0.98 * values_.number("bound_N"))
            notes.push_back(
                formatted("the %s pressed with the %g N that a piston holds against at most: it may be "
                          "stronger",
                          kFingerNames[i], values_.number("bound_N")));
    }
    if (state_.together.was_held && !found.together_N)
        notes.push_back("no piston gave a force while the fingers pressed: strength is not known; is the force on?");
    const unsigned parts = found.measured_parts();
    return {state_.end,
            state_.begun_ns,
            state_.time_s(),
            100.0 * parts / kAssessParts,
            {{"parts", "Parts", static_cast<unsigned>(state_.part), static_cast<unsigned>(kAssessParts)},
             {"measured", "Measured", parts, 0}},
            events_,
            std::move(notes)};
}

std::string Assess::task() const {
    if (state_.part == kAssessParts) return "Done.";
    const AssessPart& part = assess_parts()[state_.part];
    const double in_s = assess_begins_s(state_.part) - state_.course_s();
    if (!state_.measures) return formatted("In %.0f s: ", std::max(in_s, 0.0)) + instruction_of(part);
    const std::string now =
        part.task == AssessTask::press ? "Press with all fingers as hard as you can." : instruction_of(part);
    return formatted("Now, for %.0f s: ", std::max(in_s + part.lasts_s, 0.0)) + now;
}

Json Assess::findings() const {
    const Assessed found = assessed(state_);
    Json fingers = Json::array();
    for (std::size_t i = 0; i < found.fingers.size(); ++i) {
        const AssessedFinger& finger = found.fingers[i];
        Json ranges = Json::array();
        for (const auto& range_rad : finger.range_rad) ranges.push_back(json_of_measure(range_rad));
        fingers.push_back({{"finger", kFingerNames[i]},
                           {"range_of_motion_rad", std::move(ranges)},
                           {"open", json_of_measure(finger.open)},
                           {"closed", json_of_measure(finger.closed)},
                           {"strength_N", json_of_measure(finger.strength_N)},
                           {"peak_speed_rad_per_s", json_of_measure(finger.peak_rad_per_s)},
                           {"mean_speed_rad_per_s", json_of_measure(finger.mean_rad_per_s)},
                           {"fractionation", json_of_measure(finger.fractionation)}});
    }
    return {{"fingers", std::move(fingers)}, {"strength_together_N", json_of_measure(found.together_N)}};
}

std::optional<Json> Assess::person_range() const {
    const Assessed found = assessed(state_);
    Json range = Json::object();
    if (found.together_N) range["most_N"] = *found.together_N;
    if (found.open && found.closed) {
        range["open"] = *found.open;
        range["closed"] = *found.closed;
    } else {
        range["way_left_out"] = "a finger was not read, or was pushed all the time, while the hand opened and closed";
    }
    return range;
}

}  // namespace burin::activities
