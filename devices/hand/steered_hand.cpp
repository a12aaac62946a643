// SPDX-License-Identifier: MIT
#include "devices/hand/steered_hand.hpp"

#include <algorithm>
#include <cmath>

#include "base/space.hpp"
#include "devices/hand/quaternion_path.hpp"

namespace burin::devices {
namespace {

constexpr double kStep_s = 50e-6;
static_assert(SteeredHand::kStep_ns == 50'000);

// Times beyond this (73 years) are cut to it, so that differences do not overflow.
constexpr Nanoseconds kFarthest_ns = Nanoseconds{1} << 61;
// A time that goes back farther than this is that of another clock; else of targets that have overtaken each other.
constexpr Nanoseconds kOvertaken_ns = 10'000'000;
// Up to this interval a target needs only the one before it; from the longer one on, the one before that as well.
constexpr Nanoseconds kDense_ns = 50'000'000, kSparse_ns = 100'000'000;
// A period over which the greatest need is kept, and the least number of needs in it.
constexpr Nanoseconds kPeriod_ns = 1'500'000'000;
constexpr std::uint32_t kLeastNeeds = 8;
// The goal speeds up or slows down by this part of its speed to change the delay.
constexpr Nanoseconds kChange_ns = SteeredHand::kStep_ns / 50;
// What a goal is late beyond this it makes up for faster, in a tenth of a second or so.
constexpr Nanoseconds kPiledUp_ns = 100'000'000;
constexpr Nanoseconds kPiledUpSteps = 2000;
// A goal that has waited for longer rests.
constexpr Nanoseconds kHeldUp_ns = 20'000'000;
// The most targets that a call looks at, and that a step passes.
constexpr std::size_t kMostLooked = 1024, kMostPassed = 64;
// Intervals of a polynomial differ at most by this factor.
constexpr Nanoseconds kMostUneven = 4;

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const Vec3& v) { return std::sqrt(dot(v, v)); }

Vec3 shortened(const Vec3& v, double longest) {
    const double l = length(v);
    return l > longest ? v * (longest / l) : v;
}

bool is_pose(const Vec3& position, const Quat& orientation) {
    const double l2 = length2(orientation);
    return finite(position) && std::isfinite(l2) && l2 > 1e-12;
}

bool positive(double x) { return std::isfinite(x) && x > 0.0; }

bool are_alike(Nanoseconds a_ns, Nanoseconds b_ns) { return a_ns <= kMostUneven * b_ns && b_ns <= kMostUneven * a_ns; }

// Returns the velocity with which a curve may begin or end a way of this mean velocity, beside a way of the other: it
// does not go back, and a cubic between two such velocities is monotone along its chord (Fritsch and Carlson 1980).
Vec3 bounded(const Vec3& velocity, const Vec3& mean, const Vec3& other) {
    if (dot(velocity, mean) <= 0.0) return Vec3(0.0);
    return shortened(velocity, 3.0 * std::min(length(mean), length(other)));
}

// 1 - cos of the turn between two directions; 0 where one has no length.
double turn(const Vec3& before, const Vec3& after) {
    const double l = length(before) * length(after);
    return l > 0.0 ? 1.0 - dot(before, after) / l : 0.0;
}

}  // namespace

// ---- The channel

bool HandSteering::push(const SteeredTarget& target) noexcept {
    if (!is_pose(target.position_device_m, target.orientation_device)) {
        refused_.fetch_add(1, std::memory_order_relaxed);  // a statistic; orders nothing
        return false;
    }
    Entry entry{target, 0};
    entry.target.orientation_device = normalised(target.orientation_device);
    Nanoseconds raw_ns = std::clamp(target.time_ns, -kFarthest_ns, kFarthest_ns);
    Nanoseconds gap_ns = begun_ ? raw_ns - raw_ns_ : kRestart_ns;
    if (gap_ns > kMostInterval_ns) {
        entry.skipped_ns = gap_ns - kRestart_ns;
        gap_ns = kRestart_ns;
    } else if (gap_ns < kLeastInterval_ns) {
        if (gap_ns > -kOvertaken_ns) raw_ns = raw_ns_ + kLeastInterval_ns;  // so that the next is at its own time again
        gap_ns = kLeastInterval_ns;
    }
    entry.target.time_ns = time_ns_ + gap_ns;
    if (!ring_.push(entry)) return false;
    begun_ = true;
    raw_ns_ = raw_ns;
    time_ns_ = entry.target.time_ns;
    return true;
}

// ---- Settings

Result<SteeredHand> SteeredHand::create(HandSteering* channel, const HandTarget& start, const SteeringLimits& limits,
                                        HandGrip grip) {
    if (channel == nullptr) return fail("steered hand", "there is no channel for its targets", "give it one");
    if (!is_pose(start.position_device_m, start.orientation_device))
        return fail("steered hand", "its start is no pose",
                    "use finite numbers and a quaternion whose length is not 0");
    if (!positive(limits.speed_m_per_s) || !positive(limits.acceleration_m_per_s2) || !positive(limits.lag_s))
        return fail("steered hand", "speed, acceleration and lag must be finite and positive", "correct them");
    if (limits.lag_s < kStep_s) return fail("steered hand", "its lag is shorter than its step", "use at least 50 us");
    if (!is_sensible(grip))
        return fail("hand grip", "mass, stiffness and damping must be finite and not negative", "correct them");
    SteeredHand hand;
    hand.channel_ = channel;
    hand.limits_ = limits;
    hand.grip_ = grip;
    hand.hand_ = start;
    hand.hand_.velocity_device_m_per_s = Vec3(0.0);
    hand.hand_.orientation_device = normalised(start.orientation_device);
    hand.from_ = {0, start.position_device_m, hand.hand_.orientation_device};
    return hand;
}

Result<void> SteeredHand::hold_by(const HandGrip& grip) {
    if (!is_sensible(grip))
        return fail("hand grip", "mass, stiffness and damping must be finite and not negative", "correct them");
    grip_ = grip;
    return {};
}

HandTarget SteeredHand::target(double time_s) noexcept {
    const Nanoseconds asked_ns = nanoseconds(time_s);
    look_at_arrivals();
    if (asked_ns - time_ns_ > kMostCatchUp_ns) {  // after a pause the goal has waited as the hand did
        const Nanoseconds lost_ns = asked_ns - time_ns_ - kMostCatchUp_ns;
        time_ns_ += lost_ns;
        arrived_ns_ += lost_ns;
        pressed_ns_ += lost_ns;
        shift_needs(lost_ns);
    }
    while (time_ns_ + kStep_ns <= asked_ns) step();
    return hand_;
}

// ---- What the targets need

void SteeredHand::look_at_arrivals() noexcept {
    const std::size_t end = std::min(channel_->ring_.waiting(), looked_at_ + kMostLooked);
    for (; looked_at_ < end; ++looked_at_) {
        shift_needs(channel_->ring_.at(looked_at_).skipped_ns);
        const Knot target = knot(looked_at_);
        note_need(looked_at_ > 0 ? knot(looked_at_ - 1) : from_, target);
    }
}

// Notes by how much the hand's time has to be behind the source's for this target, which came now.
void SteeredHand::note_need(const Knot& before, const Knot& target) noexcept {
    const Nanoseconds most_ns = time_ns_ - target.time_ns + kMostDelay_ns;
    if (!is_same_place(target, before)) {
        const Nanoseconds interval_ns = target.time_ns - before.time_ns;
        const Nanoseconds sparse_ns = std::clamp<Nanoseconds>(interval_ns - kDense_ns, 0, kSparse_ns - kDense_ns);
        // A step more: the goal sets out in the step that ends when its time has come.
        const Nanoseconds need_ns =
            time_ns_ + kStep_ns - before.time_ns + interval_ns * (sparse_ns / 1000) / ((kSparse_ns - kDense_ns) / 1000);
        if (!delayed_) {
            need_ns_ = {need_ns, need_ns};
            period_began_ns_ = target.time_ns;
            delayed_ = true;
        }
        if (target.time_ns - period_began_ns_ >= kPeriod_ns && needs_ >= kLeastNeeds) {
            need_ns_ = {need_ns, need_ns_[0]};
            period_began_ns_ = target.time_ns;
            needs_ = 0;
        }
        need_ns_[0] = std::max(need_ns_[0], need_ns);
        ++needs_;
    }
    for (Nanoseconds& need_ns : need_ns_) need_ns = std::min(need_ns, most_ns);
}

void SteeredHand::shift_needs(Nanoseconds by_ns) noexcept {
    if (!delayed_) return;
    for (Nanoseconds& need_ns : need_ns_) need_ns += by_ns;
}

SteeredHand::Knot SteeredHand::knot(std::size_t older) const noexcept {
    const SteeredTarget& target = channel_->ring_.at(older).target;
    return {target.time_ns, target.position_device_m, target.orientation_device};
}

// ---- The goal on its way

void SteeredHand::move_goal() noexcept {
    if (!under_way_) {
        if (!may_set_out()) return;
        played_ns_ = from_.time_ns;
        set_out();
        return;
    }
    play_on();
    for (std::size_t i = 0; i < kMostPassed && played_ns_ >= to_.time_ns; ++i) {
        if (!arrive()) return;
        if (!may_set_out()) {
            played_ns_ = from_.time_ns;
            return;
        }
        set_out();
    }
    played_ns_ = std::min(played_ns_, to_.time_ns);
}

// A goal that rests waits until the delay is what the targets need; one that has just come goes on at once.
bool SteeredHand::may_set_out() const noexcept {
    if (looked_at_ == 0) return false;
    if (came_moving_ && time_ns_ - arrived_ns_ < kHeldUp_ns) return true;
    return time_ns_ - from_.time_ns >= delay_ns();
}

void SteeredHand::set_out() noexcept {
    to_ = knot(0);
    under_way_ = true;
    const bool moves = to_.position_m != from_.position_m;
    leaving_m_per_s_ = moves ? leaving() : Vec3(0.0);
    arriving_m_per_s_ = moves ? arriving() : Vec3(0.0);
}

void SteeredHand::play_on() noexcept {
    if (rests()) {  // nobody sees a delay change here
        played_ns_ = std::clamp(time_ns_ - delay_ns(), played_ns_, std::max(to_.time_ns, played_ns_));
        return;
    }
    const Nanoseconds excess_ns = time_ns_ - kStep_ns - played_ns_ - delay_ns();
    played_ns_ += kStep_ns + std::clamp(excess_ns, -kChange_ns, kChange_ns) +
                  std::max<Nanoseconds>(excess_ns - kPiledUp_ns, 0) / kPiledUpSteps;
}

// Takes the target that the goal has reached out of the channel; false where its buttons have to wait.
bool SteeredHand::arrive() noexcept {
    const std::uint32_t buttons = next().target.buttons;
    if (buttons != hand_.buttons) {
        // A hand that comes nearer to a goal that rests gets there within 40 ms and a way of 0.6 m/s.
        const bool is_far = limits_.pressed_within_m > 0.0 && (buttons & ~hand_.buttons) != 0 &&
                            length(to_.position_m - hand_.position_device_m) > limits_.pressed_within_m;
        if (is_far || time_ns_ - pressed_ns_ < kLeastPress_ns) {
            played_ns_ = to_.time_ns;
            return false;
        }
        hand_.buttons = buttons;
        pressed_ns_ = time_ns_;
    }
    came_moving_ = !rests();
    behind_ = {from_, behind_[0], behind_[1]};
    run_ = from_.position_m != to_.position_m ? std::min(run_ + 1, behind_.size()) : 0;
    from_ = to_;
    arrived_ns_ = time_ns_;
    under_way_ = false;
    channel_->ring_.drop();
    --looked_at_;
    return true;
}

SteeredHand::Knot SteeredHand::goal() const noexcept {
    if (!under_way_) return from_;
    const double h_s = seconds(to_.time_ns - from_.time_ns);
    const double u = seconds(played_ns_ - from_.time_ns) / h_s, r = 1.0 - u;
    const Vec3& a = from_.position_m;
    return {played_ns_,
            a + (u * u * (3.0 - 2.0 * u)) * (to_.position_m - a) +
                (h_s * u * r) * (r * leaving_m_per_s_ - u * arriving_m_per_s_),
            normalised_lerp(from_.orientation, to_.orientation, u)};
}

// ---- The hand

void SteeredHand::step() noexcept {
    time_ns_ += kStep_ns;
    move_goal();
    const Knot now = goal();
    const Vec3 way = now.position_m - hand_.position_device_m;
    const double distance = length(way);
    Vec3 wanted(0.0);
    if (distance > 0.0) {
        const double a = limits_.acceleration_m_per_s2;
        const double speed = std::min({limits_.speed_m_per_s, distance / limits_.lag_s, std::sqrt(a * distance)});
        wanted = way * (speed / distance);
    }
    Vec3& v = hand_.velocity_device_m_per_s;
    v += shortened(wanted - v, kStep_s * limits_.acceleration_m_per_s2);
    hand_.position_device_m += kStep_s * v;
    hand_.orientation_device = now.orientation;  // the wrist is free and has no mass to limit
}

// ---- The curve

namespace {

struct Node {
    Nanoseconds time_ns;
    Vec3 position_m;
};

// Returns the velocity at the first node of the polynomial through 2 to 5 nodes (Newton's form).
Vec3 velocity_through(const std::array<Node, 5>& nodes, std::size_t count) {
    std::array<Vec3, 5> differences;
    for (std::size_t i = 0; i < count; ++i) differences[i] = nodes[i].position_m;
    Vec3 velocity(0.0);
    double product = 1.0;
    for (std::size_t order = 1; order < count; ++order) {
        for (std::size_t i = count - 1; i >= order; --i)
            differences[i] =
                (differences[i] - differences[i - 1]) / seconds(nodes[i].time_ns - nodes[i - order].time_ns);
        velocity += product * differences[order];
        product *= seconds(nodes[0].time_ns - nodes[order].time_ns);
    }
    return velocity;
}

}  // namespace

// Returns whether the path has a corner there. before_ is on the way to it if there is a straighter path to compare.
bool SteeredHand::turns_at(const Knot& at, const Knot& before, const Knot& after) const noexcept {
    constexpr double kCorner = 0.5, kTurn = 0.0038;  // 1 - cos of 60 and of 5 degrees
    const Vec3 in = at.position_m - before.position_m, out = after.position_m - at.position_m;
    const double here = turn(in, out);
    if (here > kCorner) return true;
    // The turn at the target before, if it is known.
    const bool is_next = &at == &to_;
    if (run_ < (is_next ? 1u : 2u)) return false;
    const double there = turn(before.position_m - behind_[is_next ? 0 : 1].position_m, in);
    return here > kTurn && here > 9.0 * there;  // the square of the turn, three times as far
}

// Returns the curve's velocity at to_, as it is known when the goal sets out to it.
Vec3 SteeredHand::arriving() const noexcept {
    const Nanoseconds interval_ns = to_.time_ns - from_.time_ns;
    const Vec3 mean = (to_.position_m - from_.position_m) / seconds(interval_ns);
    std::array<Node, 5> nodes;
    std::size_t count = 0;
    nodes[count++] = {to_.time_ns, to_.position_m};
    Vec3 beyond = mean;
    bool two_sided = false;
    if (looked_at_ > 1) {
        const Knot after = knot(1);
        if (after.position_m != to_.position_m && !turns_at(to_, from_, after)) {
            beyond = (after.position_m - to_.position_m) / seconds(after.time_ns - to_.time_ns);
            two_sided = are_alike(after.time_ns - to_.time_ns, interval_ns);
            if (two_sided) nodes[count++] = {after.time_ns, after.position_m};
        }
    }
    nodes[count++] = {from_.time_ns, from_.position_m};
    const std::size_t most = two_sided ? 5 : 3;
    Nanoseconds later_ns = from_.time_ns;
    for (std::size_t i = 0; i < run_ && count < most; ++i) {
        if (!are_alike(later_ns - behind_[i].time_ns, interval_ns)) break;
        nodes[count++] = {behind_[i].time_ns, behind_[i].position_m};
        later_ns = behind_[i].time_ns;
    }
    return bounded(velocity_through(nodes, count), mean, beyond);
}

// Returns the curve's velocity at from_ on the way to to_, and forgets the path before a corner.
Vec3 SteeredHand::leaving() noexcept {
    const Nanoseconds interval_ns = to_.time_ns - from_.time_ns;
    const Vec3 mean = (to_.position_m - from_.position_m) / seconds(interval_ns);
    // A corner that was seen when the goal set out to from_ is seen again: what lies around it is the same.
    const bool goes_on = run_ > 0 && !turns_at(from_, behind_[0], to_);
    if (goes_on) return bounded(arriving_m_per_s_, mean, mean);
    run_ = 0;
    if (looked_at_ < 2) return mean;
    const Knot after = knot(1);
    if (after.position_m == to_.position_m || turns_at(to_, from_, after) ||
        !are_alike(after.time_ns - to_.time_ns, interval_ns))
        return mean;
    return bounded(velocity_through({Node{from_.time_ns, from_.position_m}, Node{to_.time_ns, to_.position_m},
                                     Node{after.time_ns, after.position_m}},
                                    3),
                   mean, mean);
}

}  // namespace burin::devices
