// SPDX-License-Identifier: MIT
#include "activities/rehab/putty/putty.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace burin::activities {
namespace {

// It takes the place of the world's putty, as assets/worlds/putty.toml has it: its number, and the top of its stand.
constexpr std::uint32_t kPuttyObject = 2;
constexpr Vec3 kOnStand_m{0.02, 0.0475, 0.0};
// A ball as two fingertips take it, and an ellipsoid that lies across the fingers.
constexpr Vec3 kPinchBall_m{0.025}, kGraspEllipsoid_m{0.032, 0.032, 0.048};
constexpr double kElementsAlongLeast = 3.2;  // about 1,630 elements of the ball, 2,400 of the ellipsoid

constexpr std::array kShapes{"ball", "ellipsoid"};           // as PuttyShape has them
constexpr std::array kHardnesses{"soft", "medium", "firm"};  // as PuttyHardness

}  // namespace

std::span<const SettingKind> Putty::setting_kinds() {
    static const std::array kinds{
        SettingKind{.key = "shape",
                    .option = "--shape",
                    .help = "A ball is pinched by thumb and index, an ellipsoid gripped by the whole hand",
                    .words = kShapes},
        SettingKind{
            .key = "hardness", .option = "--hardness", .help = "How hard it is", .usual = 1, .words = kHardnesses},
        level_setting(3, "Of difficulty: with how much force to knead, 1 to 3", "there are levels 1, 2 and 3"),
        SettingKind{.key = "kneads",
                    .option = "--kneads",
                    .help = "How many kneads",
                    .remedy = "ask for 1 to 1000 kneads",
                    .usual = 5,
                    .least = 1,
                    .most = 1000,
                    .whole = true},
        time_limit_setting(60.0),
        start_setting(),
        most_force_setting(),
        open_setting(),
        closed_setting(),
    };
    return kinds;
}

PuttySettings putty_settings(const SettingValues& values) {
    return {static_cast<PuttyShape>(values.count("shape")),
            static_cast<PuttyHardness>(values.count("hardness")),
            values.count("level"),
            values.count("kneads"),
            values.number("time_limit_s"),
            values.number("most_N")};
}

std::unique_ptr<Exercise> Putty::make(const SettingValues& values) { return std::make_unique<Putty>(values); }

std::string_view Putty::grip(const SettingValues& values) {
    return putty_settings(values).is_pinch() ? "pinch" : "whole";
}

std::optional<Error> Putty::conflict(const SettingValues& values) {
    if (auto wrong = too_short_a_way(values)) return wrong;
    if (auto wrong = too_low_a_target(PuttySettings::kOfMost[values.count("level") - 1], values.number("most_N")))
        return wrong;
    const unsigned kneads = putty_settings(values).kneads;
    return too_short_a_limit(values, kneads * PuttyState::kGrips_s,
                             formatted("%u kneads of %g s", kneads, PuttyState::kGrips_s));
}

Putty::Putty(const SettingValues& values) : values_(values), settings_(putty_settings(values)) {}

bodies::SoftPartSetup Putty::body() const {
    bodies::SoftPartSetup body;
    body.object = kPuttyObject;
    body.half_axes_m = settings_.is_pinch() ? kPinchBall_m : kGraspEllipsoid_m;
    body.scene_from_body.position_m = kOnStand_m + Vec3(0.0, body.half_axes_m.y, 0.0);
    body.spacing_m = body.half_axes_m.y / kElementsAlongLeast;
    body.material.young_Pa = kind_of(settings_.hardness).young_Pa;
    body.material.yield_Pa = kind_of(settings_.hardness).yield_Pa;
    return body;
}

void Putty::turn(const ExerciseTurn& turn, session::ActivityOrders& orders) {
    PuttyStep step = step_putty(state_, settings_, turn);
    state_ = step.state;
    for (const ExerciseEvent& event : step.events) tell(event, orders);
}

void Putty::interrupt(Nanoseconds time_ns, session::ActivityOrders& orders) {
    PuttyStep step = interrupted(state_, time_ns);
    state_ = step.state;
    for (const ExerciseEvent& event : step.events) tell(event, orders);
}

ExerciseGoal Putty::goal() const {
    ExerciseGoal goal{
        settings_.target_N(), state_.force_N, PuttyState::kTakesPart_N, PuttyState::kGrips_s, 0.0, {}, {}};
    goal.progress = formatted("%u of %u", state_.kneads, settings_.kneads);
    switch (state_.phase) {
        case PuttyPhase::begins:
        case PuttyPhase::waits:
            goal.next = settings_.is_pinch() ? "Pinch with thumb and index" : "Knead with the whole hand";
            break;
        case PuttyPhase::presses:
            goal.next = "Press harder";
            goal.held_s = std::min(state_.right_s, PuttyState::kGrips_s);
            break;
        case PuttyPhase::relaxes:
            goal.next = "Relax";
            goal.held_s = goal.hold_s;
            break;
        case PuttyPhase::ended: goal.next = "Done: let go of the putty"; break;
    }
    return goal;
}

std::vector<std::string> Putty::help() const {
    return {settings_.is_pinch()
                ? "Pinching putty trains thumb and index: press it between them until the force reaches its mark, and "
                  "relax. The dent stays."
                : "Kneading putty trains the whole hand: press it until the force reaches its mark, and relax. The "
                  "dents stay.",
            formatted("A knead counts when the force has been at its mark for %.1f s in the right grip: each finger "
                      "that takes part gives %.2f N or more%s. The next one counts after the force has sunk to a "
                      "quarter of the target.",
                      PuttyState::kGrips_s, PuttyState::kTakesPart_N,
                      settings_.is_pinch() ? ", and no other finger does" : "")};
}

void Putty::tell(const ExerciseEvent& event, session::ActivityOrders& orders) {
    using namespace putty_event;
    events_.push_back(event);
    const unsigned number = state_.kneads, all = number + state_.too_weak + state_.wrong_grip;
    const bool kneaded = event.what == kKneaded, wrong = event.what == kWrongGrip, weak = event.what == kTooWeak;
    if (event.what == kPressed) orders.trials.push_back({event.time_ns, formatted("knead %u", all + 1)});
    const bool broken = event.what == kInterrupted;
    if (kneaded || wrong || weak || broken) orders.trials.push_back({event.time_ns, "", std::string(event.what)});
    if (kneaded) orders.messages.push_back(formatted("knead %u of %u counted", number, settings_.kneads));
    if (weak) orders.messages.push_back("too weak; press harder");
    if (wrong)
        orders.messages.push_back(settings_.is_pinch() ? "wrong grip; take thumb and index alone"
                                                       : "wrong grip; take the whole hand");
}

ExerciseCourse Putty::course() const {
    return {state_.end,
            state_.begun_ns,
            state_.time_s(),
            score_of(state_, settings_),
            {{"kneads", "Kneads", state_.kneads, settings_.kneads},
             {"too_weak", "Too weak", state_.too_weak, 0},
             {"wrong_grip", "In a wrong grip", state_.wrong_grip, 0}},
            events_};
}

std::string Putty::task() const {
    return formatted(settings_.is_pinch()
                         ? "Pinch the putty between thumb and index with %.1f N in both together, %.2f N "
                           "or more in each, then relax."
                         : "Knead the putty in the whole hand with %.1f N in all fingers together, "
                           "%.2f N or more in each, then relax.",
                     settings_.target_N(), PuttyState::kTakesPart_N);
}

}  // namespace burin::activities
