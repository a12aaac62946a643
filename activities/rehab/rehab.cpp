// SPDX-License-Identifier: MIT
#include "activities/rehab/rehab.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "scene/scene_object.hpp"
#include "session/objects/world_objects.hpp"
#include "session/record/session_check.hpp"

namespace burin::activities {
namespace {

using scene::ObjectProperty;
using FingerTicks = std::array<const haptics::TickRecord*, kFelt>;

// Calls back with the ticks of one turn for each turn that all fingers have.
template <typename Each>
void each_turn(std::span<const session::PartView> parts, Each each) {
    for (const haptics::TickRecord& first : parts[0].ticks) {
        FingerTicks ticks{};
        bool all = true;
        for (std::size_t i = 0; i < kFelt && all; ++i) {
            const auto tick = std::ranges::lower_bound(parts[i].ticks, first.tick, {}, &haptics::TickRecord::tick);
            all = tick != parts[i].ticks.end() && tick->tick == first.tick;
            if (all) ticks[i] = &*tick;
        }
        if (all) each(ticks);
    }
}

constexpr double kLost_m = 0.4;            // below its place
constexpr double kRolling_m_per_s2 = 1.0;  // soft, on cloth

// What a body falls among: a box around each object that is felt, and nothing below them. What bears the body where it
// stands, such as a ring in which a ball sinks a little, is as high as the body's lowest point.
bodies::FlightRoom room_among(const session::WorldObjects& world, const bodies::SoftPartSetup& body) {
    bodies::FlightRoom room;
    room.restitution = 0.6;
    room.tangential_kept = 0.8;
    room.rolling_m_per_s2 = kRolling_m_per_s2;
    const Vec3 stands = body.scene_from_body.position_m;
    const double low_m = stands.y - body.half_axes_m.y;
    for (const auto& object : world.objects) {
        if (!object->felt || object->id == body.object) continue;
        Box box;
        for (const Vec3& p : object->mesh->positions_m) box.include(object->pose * (object->scale * p));
        const bool bears = box.lo.y < low_m && box.hi.y >= low_m && std::abs(stands.x - box.center().x) < 0.01 &&
                           std::abs(stands.z - box.center().z) < 0.01;
        if (bears) box.hi.y = low_m;
        if (!box.empty()) room.obstacles.emplace_back(box);
    }
    return room;
}

// Returns how much of a finger's force is an object's: what it was where nothing is touched, since a force takes some
// ticks to go. A point that touches two things counts as the firmer one's.
double share_of(std::uint32_t object, const haptics::TickRecord& tick, double before) {
    Vec3 own_N(0.0), other_N(0.0);
    for (std::uint32_t i = 0; i < tick.contact.point_count; ++i) {
        const haptics::PointRecord& point = tick.contact.points[i];
        (point.object == object ? own_N : other_N) += point.force_device_N;
    }
    const double own = glm::length(own_N), all = own + glm::length(other_N);
    return all > 0.0 ? own / all : before;
}

// shares_before: of the body, in the turn before.
FingersTurn fingers_of(const FingerTicks& ticks, std::uint32_t body, const std::array<double, kFelt>& shares_before,
                       double dt_s) {
    FingersTurn turn;
    turn.dt_s = dt_s;
    for (std::size_t i = 0; i < kFelt; ++i) {
        const double told_N = glm::length(ticks[i]->gate.given.force_device_N);
        const double share = turn.body_shares[i] = share_of(body, *ticks[i], shares_before[i]);
        turn.forces_N[i] = share * told_N;
        turn.elsewhere_N[i] = (1.0 - share) * told_N;
        std::copy_n(ticks[i]->sample.joints.begin(), turn.joints_rad[i].size(), turn.joints_rad[i].begin());
        turn.has_fault[i] = ticks[i]->sample.fault != devices::DeviceFault::none;
        const devices::OneWayDrive& drive = ticks[i]->sample.drive;
        if ((drive.state & devices::kDriveMeasured) != 0) {
            turn.measured_N[i] = share * drive.measured_N;
            turn.drive_N[i] = drive.measured_N;
        }
    }
    return turn;
}

constexpr std::uint32_t kNoObject = 0xffffffffu;

std::array<Vec3, kFelt> tips_of(const FingerTicks& ticks) {
    std::array<Vec3, kFelt> tips_m{};
    for (std::size_t i = 0; i < kFelt; ++i) {
        const auto points = std::span(ticks[i]->contact.points).first(ticks[i]->contact.point_count);
        for (const haptics::PointRecord& point : points)
            tips_m[i] += point.hip_object_m / static_cast<double>(points.size());
    }
    return tips_m;
}

// The little finger has no piston and is not read.
double closure_of(const HandReading& hand) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kFelt; ++i) sum += geometry::closure_of(static_cast<geometry::Finger>(i), hand.bend[i]);
    return sum / static_cast<double>(kFelt);
}

constexpr double kMostForce_s = 0.25;  // a force that is held for so long counts as one that a person has

GraspOptions options_of(const SettingValues& values) {
    GraspOptions options;
    const PersonRange range = range_of(values);
    options.open = range.open;
    options.closed = range.closed;
    return options;
}

// Follows forces so slowly that they can be read.
FingersTurn shown_after(const FingersTurn& before, FingersTurn now) {
    constexpr double kShows_s = 0.08;
    const double follows = 1.0 - std::exp(-now.dt_s / kShows_s);
    for (std::size_t i = 0; i < kFelt; ++i) {
        now.forces_N[i] = std::lerp(before.forces_N[i], now.forces_N[i], follows);
        if (now.measured_N[i])
            now.measured_N[i] = std::lerp(before.measured_N[i].value_or(0.0), *now.measured_N[i], follows);
    }
    return now;
}

}  // namespace

Rehab::Rehab(std::unique_ptr<Exercise> exercise)
    : exercise_(std::move(exercise)), hand_(options_of(exercise_->settings())) {
    if (exercise_->has_body()) {
        auto made = bodies::SoftPart::create(exercise_->body());
        BURIN_CHECK(made.has_value());
        if (made) body_ = std::move(*made);
    }
    const SettingValues& values = exercise_->settings();
    range_ = range_of(values);
    asks_ = values.has("start") && values.number("start") == kStartsPressed;
    if (asks_) start_.asks = exercise_->pressing_fingers();
    if (values.has("start") && values.number("start") == kStartsAsked) control_.phase = RunPhase::ready;
}

Result<void> Rehab::load_body(const scene::Pages& pages, const scene::Steps& steps,
                              std::span<const scene::Pages> each_step, const std::string& where) {
    if (!body_) return fail(where, "is of a soft body, and this exercise has none", "leave --from out");
    return body_->load(pages, steps, each_step, where);
}

std::string Rehab::settings() const {
    return "rehab " + std::string(exercise_->name()) + " " + line_of(exercise_->settings());
}

std::span<const session::Act> Rehab::acts() const {
    static constexpr std::array kActs{
        session::Act{"start", "", "Start the exercise's clock, or go on after a break"},
        session::Act{"pause", "", "Stop its clock and let the forces fade out, since something has come up"},
        session::Act{"rest", "", "Likewise, for the hand to rest"},
        session::Act{"stop", "", "End it now: it counts as broken off"},
    };
    return kActs;
}

Result<void> Rehab::act(std::span<const std::string> words, session::ActivityOrders& orders) {
    for (const RunOrder order : {RunOrder::start, RunOrder::pause, RunOrder::rest, RunOrder::stop})
        if (words[0] == name_of(order)) return follow(order, orders);
    return fail("do " + words[0], "is nothing that an exercise is told", "say start, pause, rest or stop");
}

Result<void> Rehab::start_without_presses() {
    if (std::ranges::find(start_.worked, true) == start_.worked.end())
        return fail("do start", "comes too early: no finger of the device has worked yet", "see to the device first");
    start_.asked_s = std::max(start_.asked_s, StartCheck::kMost_s);
    return {};
}

Result<void> Rehab::follow(RunOrder order, session::ActivityOrders& orders) {
    if (exercise_->end() != ExerciseEnd::not_yet)
        return fail("do " + std::string(name_of(order)), "comes too late: the exercise has ended", "begin it anew");
    const bool asks_no_more = order == RunOrder::start && control_.runs() && is_asking();
    if (asks_no_more) {
        BURIN_TRY_DO(start_without_presses());
    } else {
        BURIN_TRY(next, with_order(control_, order));
        const bool breaks = control_.gives_force() && !next.gives_force();
        if (breaks && !is_asking()) {
            const std::size_t first = orders.trials.size();
            exercise_->interrupt(control_.exercise_ns(control_.last_ns), orders);
            on_loop_clock(orders.trials, first);
            measures_.begun = false;  // what it goes on with is a part of its own
        }
        control_ = next;
    }
    orders.parameters = true;
    orders_.push_back({control_.last_ns, std::string(name_of(order)), formatted("%.3f s", exercise_->course().time_s)});
    const std::string now = state_text();
    orders.messages.push_back(now.empty() ? "the time begins" : now);
    return {};
}

void Rehab::on_loop_clock(std::vector<session::TrialMark>& trials, std::size_t first) const {
    for (std::size_t i = first; i < trials.size(); ++i) trials[i].time_ns = control_.loop_ns(trials[i].time_ns);
}

// In a break the hand holds what it would touch: what force there was fades out by the loop's own ramp.
void Rehab::adjust(session::PartOfHand of, haptics::TickParameters& parameters) const {
    hand_.adjust(of, parameters);
    exercise_->adjust(of.part, parameters);
    if (!gives_force()) parameters.holds = true;
}

// Has the world's own object give way to the body.
void Rehab::take_over(const session::ActivityView& view, session::ActivityOrders& orders) {
    if (!body_) return;
    const scene::SceneObject* own = view.world != nullptr ? view.world->find(body_->setup().object) : nullptr;
    if (own != nullptr && object_.empty()) {
        object_ = own->name;
        if (exercise_->is_carried())
            orders.on_scene.push_back(
                [body = body_.get(), room = room_among(*view.world, body_->setup())] { body->fall_among(room); });
        orders.edits.push_back({object_, ObjectProperty::felt, {0.0}});
        orders.edits.push_back({object_, ObjectProperty::seen, {0.0}});
        exercise_->begin(*body_, orders);
    }
    has_given_way_ = own == nullptr || !own->seen;
}

void Rehab::carry(std::span<const session::HoldObject> holds, session::ActivityOrders& orders) {
    for (const session::HoldObject& hold : holds) {
        if (hold.object != object_) continue;
        std::vector<std::size_t> parts;  // of the only hand, which is the first: as the scene counts them
        for (const session::PartOfHand& of : hold.by) parts.push_back(of.part);
        orders.on_scene.push_back([body = body_.get(), parts] {
            if (parts.empty())
                body->frame().let_go();
            else
                body->frame().take_hold(parts);
        });
    }
    const Pose& stands = body_->setup().scene_from_body;
    const bool is_lost = scene_from_drawn_.position_m.y < stands.position_m.y - kLost_m;
    if (is_lost && !std::exchange(is_lost_, true)) {
        orders.on_scene.push_back([body = body_.get(), stands] { body->frame().put(stands.position_m); });
        orders.messages.push_back("the " + object_ + " has fallen down, and is back at its place");
    }
    is_lost_ = is_lost;
}

void Rehab::take_shape(const session::ActivityView& view) {
    if (!body_) return;
    for (const auto& change : view.drawn)
        if (const auto* const shape = dynamic_cast<const bodies::SoftShape*>(change.get())) {
            drawn_ = picture::smooth_mesh(shape->places_m, body_->triangles());
            scene_from_drawn_ = shape->scene_from_body;
            lies_in_palm_m_.reset();
            if (shape->palm_from_body) lies_in_palm_m_ = shape->palm_from_body->position_m;
        }
}

void Rehab::step(const session::ActivityView& view, session::ActivityOrders& orders) {
    take_over(view, orders);
    take_shape(view);
    hand_.step(view, orders);
    orders.trials.clear();  // a trial is the exercise's here, not a grasp
    const auto holds_now = std::exchange(orders.holds, {});
    if (exercise_->is_carried()) carry(holds_now, orders);
    const auto parts = view.hands.front().parts;
    if (parts.size() < kFelt) return;
    const bool holds = hand_.gesture().grasps() && !hand_.grasps().empty() && hand_.grasps().back().object == object_;
    const std::uint32_t object = body_ ? body_->setup().object : kNoObject;
    each_turn(parts, [&](const FingerTicks& ticks) {
        const Nanoseconds now_ns = ticks[0]->time_ns;
        const double dt_s = turn_ns_ > 0 ? seconds(now_ns - turn_ns_) : 0.0;
        turn_ns_ = now_ns;
        const HandReading hand = reading_of(ticks);
        const FingersTurn fingers = fingers_of(ticks, object, body_shares_, dt_s);
        body_shares_ = fingers.body_shares;
        shown_ = shown_after(shown_, fingers);
        turn({.time_ns = now_ns,
              .grasped = holds,
              .fingers = fingers,
              .scene_from_hand = hand.scene_from_hand,
              .closure = range_.share_of(closure_of(hand)),
              .lies_in_palm_m = lies_in_palm_m_,
              .tips_object_m = tips_of(ticks),
              .away_ns = 0},
             orders);
    });
    tell_keeper(orders);
}

void Rehab::follow_most_force(const FingersTurn& fingers) {
    double sum_N = 0.0;
    for (std::size_t i = 0; i < kFelt; ++i)
        if (!fingers.has_fault[i]) sum_N += fingers.measured_N[i].value_or(fingers.forces_N[i]);
    smooth_sum_N_ += (sum_N - smooth_sum_N_) * (1.0 - std::exp(-fingers.dt_s / kMostForce_s));
    most_together_N_ = std::max(most_together_N_, smooth_sum_N_);
}

bool Rehab::has_started(const FingersTurn& fingers, session::ActivityOrders& orders) {
    if (!asks_ || start_.is_done()) return true;
    if (start_.has_failed()) return false;
    if (!std::exchange(has_asked_, true))
        orders.messages.push_back("press with each finger once: " + start_.missing() + "; then the time begins");
    start_ = with_turn(start_, fingers);
    if (start_.has_failed()) orders.messages.push_back("broken off: " + failure());
    if (!start_.is_done()) return false;
    orders.messages.push_back(start_.missing().empty()
                                  ? "each finger has pressed; let go: the time begins"
                                  : "gave nothing when they were to press: " + start_.missing() +
                                        "; the time begins without, and what is measured of them says so");
    return true;
}

std::string Rehab::failure() const {
    if (control_.phase == RunPhase::stopped) return "it was stopped";
    if (!asks_ || start_.is_done() || start_.asked_s == 0.0) return "";
    for (std::size_t i = 0; i < start_.asks.size(); ++i)
        if (start_.asks[i] && start_.worked[i]) return "";
    return formatted("the device had a fault at each finger for the first %.0f s, as with its motors off",
                     start_.asked_s);
}

void Rehab::turn(ExerciseTurn turn, session::ActivityOrders& orders) {
    const bool settled = control_.phase == RunPhase::settles;
    control_ = with_turn(control_, turn.time_ns, StartCheck::is_let_go(turn.fingers));
    if (!control_.runs() || exercise_->end() != ExerciseEnd::not_yet || !has_started(turn.fingers, orders)) return;
    if (settled) orders.messages.push_back("it goes on");
    turn.away_ns = control_.away_ns;
    turn.time_ns = control_.exercise_ns(turn.time_ns);
    const std::size_t first = orders.trials.size();
    has_let_go_ = has_let_go_ || !asks_ || StartCheck::is_let_go(turn.fingers);
    if (has_let_go_) {
        measures_ = with_turn(measures_, turn.fingers);
        follow_most_force(turn.fingers);
        exercise_->turn(turn, orders);
    } else {  // the press that the start asked for is none of the exercise's
        ExerciseTurn without = turn;
        without.grasped = false;
        without.fingers.forces_N = {};
        exercise_->turn(without, orders);
    }
    on_loop_clock(orders.trials, first);
    if (exercise_->end() != ExerciseEnd::not_yet)
        orders.messages.push_back(formatted("%s: score %.0f of 100",
                                            exercise_->end() == ExerciseEnd::done ? "done" : "time is over",
                                            exercise_->course().score));
}

void Rehab::write(session::ActivityRecord& record) {
    const ExerciseCourse course = exercise_->course();
    for (; written_ < course.events.size(); ++written_) {
        const ExerciseEvent& event = course.events[written_];
        record.events.push_back(
            {control_.loop_ns(event.time_ns), std::string(event.what), formatted("%.3f N", event.force_N)});
    }
    for (session::EventMark& told : std::exchange(orders_, {})) record.events.push_back(std::move(told));
}

std::uint64_t Rehab::check() const {
    const ExerciseCourse course = exercise_->course();
    session::CheckSum sum;
    for (const ExerciseCourse::Count& count : course.counts) sum.add(std::uint64_t{count.number});
    sum.add(std::uint64_t{course.events.size()});
    sum.add(course.time_s);
    for (const FingerMeasures& finger : measures_.fingers) {
        sum.add(finger.impulse_Ns);
        sum.add(finger.moved_rad);
    }
    if (control_.was_told) {  // recordings of before there were such orders have none
        sum.add(std::uint64_t{static_cast<std::uint8_t>(control_.phase)});
        sum.add(static_cast<std::uint64_t>(control_.away_ns));
    }
    return sum.sum();
}

// The body is put where the world's own object was among the others: so the hand's shadows find one there.
void Rehab::stage(picture::Picture& scene, std::size_t screen) const {
    const std::size_t place = body_ ? body_->setup().object - 1 : 0;
    if (body_ && has_given_way_ && drawn_ && scene.objects.size() >= place) {
        const auto srgb = exercise_->srgb();
        scene.objects.insert(
            scene.objects.begin() + static_cast<std::ptrdiff_t>(place),
            {drawn_,
             scene.world_from_object * Similarity{scene_from_drawn_.position_m, scene_from_drawn_.orientation, 1.0},
             {srgb[0], srgb[1], srgb[2]}});
    }
    hand_.stage(scene, screen);
}

}  // namespace burin::activities
