// SPDX-License-Identifier: MIT
#include "haptics/point_contact.hpp"

#include <algorithm>
#include <cmath>

#include "haptics/contact/friction.hpp"
#include "haptics/contact/setting.hpp"
#include "haptics/contact/touching.hpp"

namespace burin::haptics {
namespace {

// Where a motion that nothing has announced lengthens the spring by more than this in one tick, at the device, that
// length is left out of the force at first and comes back over time (haptics/contact/moving_bodies.hpp).
constexpr double kJump_m = 0.0005;
// The length left out decays exponentially: to exp(-kComingBack) of itself within the gate's ramp for contacts.
constexpr double kComingBack = 3.0;
// The share of the spring from which on a part left out of it is told.
constexpr double kFelt = 0.01;

// The part of a point's share that tried places may cost, so that it can go on from the one that is found.
constexpr double kOfStart = 0.6;
// The part of a point's share that a look of the watch may cost, at least.
constexpr double kOfLook = 0.5;
// Of the width of what touches: how far it may be behind the tool that cuts.
constexpr double kShortOfCut = 0.25;

bool painting(const ProbeInput& in) {
    return (in.sample.buttons & 1u) != 0 && in.parameters.action == ToolAction::paint;
}

static ProxyBudget less(ProxyBudget budget, const ContactWork& work) {
    budget.max_cost_ns -= cost_ns(work) - WorkCost::kTick_ns;
    return budget;
}

}  // namespace

PointContact::PointContact(const ProbeInput& input, const ProbeStep& step, const MovingBodies& bodies,
                           std::uint32_t index)
    : input_(input),
      step_(step),
      bodies_(bodies),
      point_(input.parameters.probe.points[index]),
      shape_(index == 0 && input.parameters.shape.touches() ? &input.parameters.shape : nullptr),
      state_(step.next.proxies[index]),
      material_(step.next.materials[index]),
      watch_(step.next.watches[index]),
      last_(step.next.contacts[index]),
      friction_(step.next.friction[index]),
      left_out_m_(step.next.left_out_m[index]),
      record_(step.contact.points[index]) {
    const MotionRecord& motion = input.motion;
    arm_device_m_ = input.sample.orientation_device * point_.offset_device_m;
    velocity_device_m_per_s_ = motion.velocity_device_m_per_s;
    if (input.parameters.probe.count > 1)
        velocity_device_m_per_s_ += glm::cross(motion.angular_velocity_device_rad_per_s, arm_device_m_);
    record_.hip_object_m = motion.object_from_device * (input.sample.position_device_m + arm_device_m_);
    record_.proxy_object_m = record_.hip_object_m;
    rubs_ = material();
    // Painting has no resistance.
    if (painting(input)) rubs_.static_friction = rubs_.dynamic_friction = 0.0;
    rubs_ = with_eased_friction(friction_, rubs_, last_.constraints > 0, input.dt_s);
}

void PointContact::stay_with_hand() {
    if (shape_ != nullptr) step_.next.tool_orientation_object = input_.motion.orientation_object;
    state_ = {record_.hip_object_m, input_.surface.sequence, false};
    watch_ = {};
    last_ = {};
    left_out_m_ = 0.0;
    record_.proxy_object_m = record_.hip_object_m;
}

bool PointContact::fits_at_hand(const ProxyBudget& budget) {
    ProxyState there{record_.hip_object_m, input_.surface.sequence, true};
    there.hip_object_m = record_.hip_object_m;
    there.unfit_ticks = kMostUnfitTicks;  // as one that waits to be outside
    const Quat turned = step_.next.tool_orientation_object;
    const ProxyResult found = moved(there, record_.hip_object_m, settings(), budget);
    step_.next.tool_orientation_object = turned;
    count_work(found.work, found.work_limited);
    return found.next.unfit_ticks == 0 && !found.work_limited;
}

PointContact::Moved PointContact::touch(const ProxyBudget& budget, double needed_ns) {
    const bool was_fitting = state_.placed && state_.unfit_ticks == 0;
    const bool published = state_.surface_sequence != input_.surface.sequence;
    if (!was_fitting) left_out_m_ = 0.0;
    // With a moving body relative to it, as friction asks; the body touched in the last tick.
    const ProxySettings settings = this->settings();
    const CarriedProxy carried = carry(state_, bodies_, settings.contact_radius_m, kElsewhere_m * scale(), budget);
    const Vec3 before = carried.state.position_object_m;
    ProxyBudget left = bodies_.any() ? less(budget, carried.work) : budget;
    ContactWork watched;
    const double spare_ns = needed_ns > 0.0 ? left.max_cost_ns - needed_ns : 0.0;
    if (last_.constraints > 0 && was_fitting)
        watch(carried.state, std::max(spare_ns, kOfLook * left.max_cost_ns), watched);
    left = less(left, watched);
    const bool caught = input_.parameters.catch_drill && last_.constraints > 0;
    const ProxyResult moved = caught ? as_caught(carried.state) : moved_or_set(carried.state, settings, left);
    const std::uint64_t carrier = state_.carrier;
    state_ = moved.next;
    if (bodies_.any() && moved.constraints > 0)
        state_.carrier = moved.active_triangle != kNoTriangle ? bodies_.name_of(moved.active_triangle) : carrier;
    count_work(watched, false);
    count_work(carried.work, !carried.complete);
    count_work(moved.work, moved.work_limited);
    const Moved spent{cost_ns(carried.work) + cost_ns(moved.work) - 2.0 * WorkCost::kTick_ns,
                      budget.max_cost_ns - cost_ns(watched) + WorkCost::kTick_ns,
                      moved.work_limited || !carried.complete, moved.coarse};
    if (moved.pushed_out) step_.flags |= kTickPushedOut;
    last_ = {};
    ContactWatch::note(watch_, moved.work_limited);
    if (ContactWatch::gives_up(watch_)) return let_go(), spent;
    if (state_.unfit_ticks > 0) return spent;
    record_.proxy_object_m = moved.next.position_object_m;
    const Vec3 reach = record_.proxy_object_m - input_.surface.center_object;
    if (!(std::sqrt(glm::dot(reach, reach)) + reach_m() <= input_.surface.radius_m)) step_.flags |= kTickOutsideKnown;
    if (moved.active_triangle != kNoTriangle) material_ = input_.surface.material(moved.active_triangle);
    if (!bears(moved.constraints, moved.normal_object)) return spent;
    last_ = {moved.normal_object, moved.constraints};
    if (moved.sticking) step_.flags |= kTickSticking;
    record_.active_triangle = moved.active_triangle;
    if (moved.active_triangle != kNoTriangle) record_.object = input_.surface.object(moved.active_triangle);
    surface_velocity_device_m_per_s_ = of_piece(has_shape() ? step_.contact.touched_object_m : record_.proxy_object_m);
    if (state_.carrier != 0)
        surface_velocity_device_m_per_s_ += at_device(bodies_.velocity(moved.active_triangle, record_.proxy_object_m));
    if (!was_fitting || was_put_elsewhere(moved, before))
        step_.contact.jumped = true;
    else
        leave_out(unexplained_m(before, carried.unexplained_m, published));
    return spent;
}

void PointContact::touch_last_plane() {
    if (!state_.placed || last_.constraints == 0) return;
    ContactWatch::wait(watch_);
    if (ContactWatch::gives_up(watch_)) return let_go();
    if (carrier_is_gone()) return;
    const std::uint32_t body = bodies_.with_name(state_.carrier);
    const Vec3 at = state_.carrier != 0 ? bodies_.carried(body, state_.position_object_m) : state_.position_object_m;
    // The body's unannounced motion since this part's last full tick. It is left out of this tick's force alone;
    // the next full tick enters it into left_out_m_.
    const Vec3 unexplained = state_.carrier != 0 ? bodies_.unexplained(body, at) : Vec3(0.0);
    const double added_m = bear_on_last_plane(at, unexplained);
    if (!in_contact()) return;
    leave_out(0.0);
    if (added_m > kJump_m * scale()) left_out_now_m_ = added_m;
}

void PointContact::wait(const ProxyBudget& budget) {
    step_.flags |= kTickHeldOver;
    if (!state_.placed) return;
    const CarriedProxy carried =
        carry(state_, bodies_, this->settings().contact_radius_m, kElsewhere_m * scale(), budget);
    const bool carrier_is_gone = this->carrier_is_gone();
    state_ = carried.state;
    count_work(carried.work, !carried.complete);
    if (last_.constraints == 0) return;
    ContactWatch::wait(watch_);
    if (ContactWatch::gives_up(watch_)) return let_go();
    if (carrier_is_gone) return;
    const double added_m = bear_on_last_plane(state_.position_object_m, carried.unexplained_m);
    if (in_contact()) leave_out(added_m);
}

// Tells whether the body that the point touched is no longer there, or was set elsewhere.
bool PointContact::carrier_is_gone() const {
    if (state_.carrier == 0) return false;
    const std::uint32_t body = bodies_.with_name(state_.carrier);
    if (body == MovingBodies::kNone) return true;
    const Vec3 at = bodies_.carried(body, state_.position_object_m);
    return glm::length(bodies_.unexplained(body, at)) > kElsewhere_m * scale();
}

// Bears the point on the plane of its last contact through the proxy's place. Returns by how much the unannounced
// motion has lengthened the spring.
double PointContact::bear_on_last_plane(const Vec3& proxy_object_m, const Vec3& unexplained_m) {
    const Vec3 spring = proxy_object_m - record_.hip_object_m;
    const double depth = glm::dot(spring, last_.normal_object);
    if (!(depth > 0.0)) return 0.0;
    const ProxySettings settings = this->settings();
    const Vec3 along = depth * last_.normal_object - spring;
    const double coefficient = state_.slipping ? settings.dynamic_friction : settings.static_friction;
    record_.proxy_object_m = proxy_object_m + sliding_share(along, depth, coefficient) * along;
    if (!bears(last_.constraints, last_.normal_object)) return 0.0;
    surface_velocity_device_m_per_s_ = of_piece(proxy_object_m);
    if (state_.carrier != 0)
        surface_velocity_device_m_per_s_ += at_device(bodies_.velocity_of_body(state_.carrier, proxy_object_m));
    return glm::dot(unexplained_m, record_.proxy_object_m - record_.hip_object_m) / record_.penetration_m;
}

// Returns the point from which the spring pulls: the bearing point, moved towards the HIP by the length left out.
Vec3 PointContact::less_left_out(const Vec3& bearing_object_m) const {
    const double left_out_m = std::min(left_out_m_ + left_out_now_m_, record_.penetration_m);
    const double share = in_contact() ? 1.0 - left_out_m / record_.penetration_m : 1.0;
    return record_.hip_object_m + share * (bearing_object_m - record_.hip_object_m);
}

// The force of this point on the hand.
PointForce PointContact::force(const CoupledWall& wall, const Vec3& bearing_object_m) {
    if (in_contact()) {
        const Similarity& map = input_.motion.object_from_device;
        record_.force_device_N =
            ContactWatch::share(watch_) *
            touch_force_device({record_.hip_object_m, bearing_object_m, record_.normal_object,
                                velocity_device_m_per_s_ - surface_velocity_device_m_per_s_, map.orientation, map.scale,
                                wall.stiffness_N_per_m, wall.damping_Ns_per_m});
    }
    return {arm_device_m_, record_.force_device_N};
}

// Energy stored in the wall's spring at this point.
double PointContact::spring_energy_J(const CoupledWall& wall, const Vec3& bearing_object_m) const {
    if (!in_contact()) return 0.0;
    const Vec3 spring_device_m = (bearing_object_m - record_.hip_object_m) / input_.motion.object_from_device.scale;
    return ContactWatch::share(watch_) * 0.5 * wall.stiffness_N_per_m * glm::dot(spring_device_m, spring_device_m);
}

ProxySettings PointContact::settings() const {
    ProxySettings s;
    s.contact_radius_m = radius_m();
    s.shading = input_.parameters.shading;
    Vec3 slip = velocity_device_m_per_s_ - of_piece(state_.position_object_m);
    if (state_.carrier != 0) slip -= at_device(bodies_.velocity_of_body(state_.carrier, state_.position_object_m));
    // What presses in does not rub.
    if (last_.constraints > 0) {
        const Quat device_from_object = glm::conjugate(input_.motion.object_from_device.orientation);
        const Vec3 normal_device = device_from_object * last_.normal_object;
        slip -= glm::dot(slip, normal_device) * normal_device;
    }
    const double speed = std::sqrt(glm::dot(slip, slip));
    const FrictionCone cone = eased_friction_at(friction_, rubs_, speed);
    // What lies in a pit that the tool has left is not held there by friction: the tool goes no farther than around it.
    if (falls_short(s.contact_radius_m)) return s;
    s.static_friction = cone.static_friction;
    s.dynamic_friction = cone.dynamic_friction;
    return s;
}

// Moves the proxy, and looks for a place where it fits if it could not be put into one. Where looking at the hand took
// the tick's work, the next tick looks around it without.
ProxyResult PointContact::moved_or_set(const ProxyState& state, const ProxySettings& settings,
                                       const ProxyBudget& budget) {
    if (state.placed && state.unfit_ticks > kMostUnfitTicks) {
        ProxyResult waiting;
        waiting.next = state;
        waiting.next.position_object_m = waiting.next.hip_object_m = record_.hip_object_m;
        waiting.next.unfit_ticks = kMostUnfitTicks;
        return set_near_hand(state, settings, budget, waiting);
    }
    const bool is_lost = state.placed && state.unfit_ticks == kMostUnfitTicks;
    ProxyResult result = moved(state, record_.hip_object_m, settings, budget);
    if (result.next.unfit_ticks == 0) return result;
    if (is_lost) return set_near_hand(state, settings, budget, result);
    const double off_m = glm::length(result.next.position_object_m - record_.hip_object_m);
    result.next.put_off_m = std::max(state.placed ? state.put_off_m : 0.0, off_m);
    return result;
}

// Tries some places around the hand, and goes from the first in which the proxy fits towards the hand.
ProxyResult PointContact::set_near_hand(const ProxyState& state, const ProxySettings& settings,
                                        const ProxyBudget& budget, const ProxyResult& at_hand) {
    const Vec3& hand = record_.hip_object_m;
    const StartPlaces places{felt_radius_m(radius_m(), bodies_.surface().mean_edge_m()), state.put_off_m};
    ContactWork work = at_hand.work;
    std::uint32_t tried = state.places_tried;
    const double enough_ns = kOfStart * budget.max_cost_ns;
    for (std::uint32_t i = 0; i < StartPlaces::kMostInATick && cost_ns(work) < enough_ns; ++i) {
        const Vec3 place = hand + places[tried++];
        ProxyState set;
        set.position_object_m = set.hip_object_m = place;
        set.placed = true;
        set.unfit_ticks = 1;
        const ProxyResult there = moved(set, place, settings, less(budget, work));
        work += there.work;
        const bool is_near = glm::length(there.next.position_object_m - hand) <= places.farthest_m();
        if (there.next.unfit_ticks > 0 || there.work_limited || !is_near) continue;
        ProxyResult result = moved(there.next, hand, settings, less(budget, work));
        result.work += work;
        return result;
    }
    ProxyResult result = at_hand;
    if (tried == state.places_tried) result.next.unfit_ticks = kMostUnfitTicks + 1;
    result.next.put_off_m = state.put_off_m;
    result.next.places_tried = tried;
    result.work = work;
    return result;
}

ProxyResult PointContact::moved(const ProxyState& state, const Vec3& hand_object_m, const ProxySettings& settings,
                                const ProxyBudget& budget) {
    if (shape_ == nullptr) return move_proxy(state, hand_object_m, settings, bodies_.surface(), budget);
    Quat& orientation = step_.next.tool_orientation_object;
    ShapeMotion motion{hand_object_m, state.placed ? orientation : input_.motion.orientation_object,
                       input_.motion.orientation_object, settings.static_friction, settings.dynamic_friction};
    if (falls_short(settings.contact_radius_m)) motion.cut_to_object_m = step_.next.cutting.point_object_m;
    const ShapeResult result = move_shape(state, motion, *shape_, bodies_.surface(), budget);
    orientation = result.orientation_object;
    if (result.proxy.constraints > 0) bear_at(result.touched_object_m, result.proxy.next.position_object_m);
    return result.proxy;
}

double PointContact::radius_m() const {
    // A ball about as wide as the tool, for what asks how far the surface is from it.
    if (shape_ != nullptr) return 0.5 * shape_->size_m;
    return point_.radius_m * (1.0 - input_.parameters.clearance_ratio);
}

double PointContact::reach_m() const { return shape_ != nullptr ? shape_->reach_m : radius_m(); }

double PointContact::squared_arm_m2() const {
    // A shape may be touched anywhere.
    if (shape_ != nullptr) return shape_->reach_m * shape_->reach_m / (scale() * scale());
    return glm::dot(arm_device_m_, arm_device_m_);
}

void PointContact::bear_at(const Vec3& touched_object_m, const Vec3& tool_object_m) {
    arm_device_m_ = at_device(touched_object_m - tool_object_m);
    step_.contact.touched_object_m = touched_object_m;
}

// Tells whether the ball was pushed out of material by more than a jump.
bool PointContact::was_put_elsewhere(const ProxyResult& moved, const Vec3& before) const {
    return moved.pushed_out && glm::length(record_.proxy_object_m - before) > kJump_m * scale();
}

// By how much something that no motion explains has lengthened the spring; negative: shortened.
double PointContact::unexplained_m(const Vec3& before, const Vec3& of_bodies_m, bool published) const {
    const Vec3 spring = record_.proxy_object_m - record_.hip_object_m;
    // A published surface may push the ball while its centre stays outside.
    const double pushed_m = published ? record_.penetration_m - glm::length(before - record_.hip_object_m) : -HUGE_VAL;
    const double moved_m = glm::dot(of_bodies_m, spring) / record_.penetration_m;
    return pushed_m > kJump_m * scale() ? std::max(pushed_m, moved_m) : moved_m;
}

// Leaves what has come unexplained out of the force, and lets what was left out come back. What has gone
// unexplained makes up for what has come before.
void PointContact::leave_out(double unexplained_m) {
    left_out_m_ *= std::exp(-kComingBack * input_.dt_s / std::max(input_.parameters.limits.contact_ramp_s, 1e-6));
    if (unexplained_m > kJump_m * scale() || unexplained_m < 0.0) left_out_m_ += unexplained_m;
    left_out_m_ = std::clamp(left_out_m_, 0.0, record_.penetration_m);
    if (left_out_m_ > kFelt * record_.penetration_m) step_.flags |= kTickRamping;
}

// Notes a contact at the proxy, if there is one.
bool PointContact::bears(std::uint32_t constraints, const Vec3& normal_object) {
    const double depth = glm::length(record_.proxy_object_m - record_.hip_object_m);
    if (constraints == 0 || !(depth > 0.0) || !material().enabled) return false;
    step_.flags |= kTickInContact;
    record_.constraints = constraints;
    record_.penetration_m = depth;
    record_.normal_object = normal_object;
    return true;
}

// The drill's result.
ProxyResult PointContact::as_caught(const ProxyState& state) const {
    ProxyResult result;
    result.next = state;
    result.next.hip_object_m = record_.hip_object_m;
    const Vec3 spring = state.position_object_m - record_.hip_object_m;
    result.normal_object = spring / std::max(glm::length(spring), 1e-12);
    result.constraints = last_.constraints;
    result.work_limited = true;
    return result;
}

void PointContact::stay_in_bed(const Vec3& cut_object_m) {
    state_.position_object_m = record_.proxy_object_m = cut_object_m;
    state_.hip_object_m = record_.hip_object_m;
    state_.placed = true;
    state_.touching = false;
    state_.unfit_ticks = state_.places_tried = 0;
}

void PointContact::bear_on_cut(const Vec3& cut_object_m) {
    const Vec3 spring = cut_object_m - record_.hip_object_m;
    const double depth = glm::length(spring);
    if (in_contact() || !(depth > 0.0)) return;
    surface_velocity_device_m_per_s_ = of_piece(cut_object_m);
    step_.flags |= kTickInContact;
    record_.constraints = 1;
    record_.penetration_m = depth;
    record_.normal_object = spring / depth;
}

void PointContact::let_go() {
    has_let_go_ = true;
    step_.flags |= kTickLetGo;
    stay_with_hand();
}

// Tells whether the tool was cutting in the last tick and still does.
bool PointContact::cuts() const {
    const bool pressed = (input_.sample.buttons & 1u) != 0 && input_.parameters.action == ToolAction::cut;
    return pressed && &point_ == &input_.parameters.probe.points[0] && step_.next.cutting.engaged;
}

// Tells whether the tool has cut on, nearer to the hand than what touches by a part of its width.
bool PointContact::falls_short(double half_width_m) const {
    if (!cuts() || !state_.placed) return false;
    const double cut_m = glm::length(step_.next.cutting.point_object_m - record_.hip_object_m);
    return cut_m + 2.0 * kShortOfCut * half_width_m < glm::length(state_.position_object_m - record_.hip_object_m);
}

// Has the watch look at the contact of the last tick, taken along with the body that it is with.
void PointContact::watch(const ProxyState& contact, double most_ns, ContactWork& work) {
    const Vec3& origin = input_.surface.origin_object;
    const double felt = felt_radius_m(radius_m(), bodies_.surface().mean_edge_m());
    ContactWatch::look(watch_,
                       {contact.position_object_m - origin, contact.hip_object_m - origin, felt, shape_,
                        step_.next.tool_orientation_object, input_.motion.orientation_object, cuts()},
                       bodies_.surface(), work, most_ns);
    if (watch_.doubtful_looks > 0 || watch_.faded_ticks > 0) step_.flags |= kTickDoubted;
}

void PointContact::count_work(const ContactWork& work, bool limited) {
    step_.contact.work += work;
    if (limited) step_.flags |= kTickWorkLimited;
}

// The velocity with which the piece takes a point of its own along.
Vec3 PointContact::of_piece(const Vec3& place_object_m) const {
    const MotionRecord& motion = input_.motion;
    return motion.piece.at(inverse(motion.object_from_device) * place_object_m);
}

Vec3 PointContact::at_device(const Vec3& velocity_object_m_per_s) const {
    return glm::conjugate(input_.motion.object_from_device.orientation) * velocity_object_m_per_s / scale();
}

}  // namespace burin::haptics
