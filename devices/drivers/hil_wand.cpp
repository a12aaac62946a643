// SPDX-License-Identifier: MIT
#include "devices/drivers/hil_wand.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/try.hpp"
#include "devices/drivers/wand_hardware.hpp"

namespace burin::devices {
namespace {

constexpr std::uint32_t kChannels = kWandJoints;
constexpr std::array<std::uint32_t, kWandJoints> kChannel{0, 1, 2, 3, 4, 5};  // of encoders and analog outputs
constexpr WandJoints kZeroVolts{};
constexpr std::array<char, kWandJoints> kOff{}, kOn{1, 1, 1, 1, 1, 1};
constexpr std::array<HilDigitalState, kWandJoints> kTristate{kHilTristate, kHilTristate, kHilTristate,
                                                             kHilTristate, kHilTristate, kHilTristate};
// A card whose counters have lived on reads joints near to where they were. One that was without power reads the jig,
// wherever the handle is: where that is near as well, the two cannot be told apart.
constexpr double kMostMoved_rad = 0.15, kFarFromJig_rad = 0.3;

// Keeps each axis within its limit, and counts those at it.
Vec3 kept_within(const Vec3& given, const Vec3& most, std::array<std::atomic<std::uint64_t>, 3>& at_limit) noexcept {
    Vec3 kept(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        if (!(most[axis] > 0.0)) continue;  // passive
        kept[axis] = std::clamp(given[axis], -most[axis], most[axis]);
        if (std::abs(given[axis]) >= most[axis])
            at_limit[static_cast<std::size_t>(axis)].fetch_add(1, std::memory_order_relaxed);
    }
    return kept;
}

}  // namespace

HilWand::HilWand(const HilApi& api, std::string card, const WandDescription& wand, std::unique_ptr<Clock> clock)
    : api_(api),
      card_name_(std::move(card)),
      wand_(wand),
      description_(device_of_hardware(wand_)),
      device_from_maker_(device_from_maker(wand_)),
      clock_(std::move(clock)) {}

Result<std::unique_ptr<HilWand>> HilWand::open(const std::string& library, const std::string& card,
                                               const WandDescription& wand) {
    BURIN_TRY(api, load_hil_api(library));
    return serve_card(api, card, wand, std::make_unique<MonotonicClock>());
}

Result<std::unique_ptr<HilWand>> HilWand::serve_card(const HilApi& api, const std::string& card,
                                                     const WandDescription& wand, std::unique_ptr<Clock> clock,
                                                     const std::function<void(HilWand&)>& begins) {
    std::unique_ptr<HilWand> opened(new HilWand(api, card, wand, std::move(clock)));
    HilError error = opened->open_card();
    if (error >= 0) error = opened->set_to_zero();
    if (error < 0)
        return fail("haptic device wand",
                    "the card " + wand.mechanism.card + " " + card + " cannot be opened: " + hil_error_text(api, error),
                    "see that it is there, may be opened by this user, and is the one that the wand is on: "
                    "wand:IDENTIFIER; if it is in use, end the other program");
    if (begins) begins(*opened);
    opened->thread_ = std::thread([w = opened.get()] { w->serve(); });
    return opened;
}

HilWand::~HilWand() {
    ends_.store(true, std::memory_order_relaxed);
    if (thread_.joinable()) thread_.join();
    close_card();
}

// Opens the card with its outputs at zero and its amplifiers off.
HilError HilWand::open_card() noexcept {
    const auto& lines = wand_.mechanism.enable_lines;
    HilError error = api_.open(wand_.mechanism.card.c_str(), card_name_.c_str(), &card_);
    if (error < 0) {
        card_ = nullptr;
        return error;
    }
    // A program that died has left its watchdog expired, and the card shut.
    error = api_.watchdog_clear(card_);
    if (error >= 0) error = api_.set_digital_directions(card_, nullptr, 0, lines.data(), kChannels);
    if (error >= 0) error = api_.write_digital(card_, lines.data(), kChannels, kOff.data());
    if (error >= 0) error = api_.write_analog(card_, kChannel.data(), kChannels, kZeroVolts.data());
    if (error < 0) {
        close_card();
        return error;
    }
    is_on_ = false;
    has_watchdog_ = api_.watchdog_analog(card_, kChannel.data(), kChannels, kZeroVolts.data()) >= 0 &&
                    api_.watchdog_digital(card_, lines.data(), kChannels, kTristate.data()) >= 0 &&
                    api_.watchdog_start(card_, kWatchdog_s) >= 0;
    if (!has_watchdog_) tell(Notice::no_watchdog);
    return 0;
}

void HilWand::close_card() noexcept {
    if (card_ == nullptr) return;
    static_cast<void>(api_.write_analog(card_, kChannel.data(), kChannels, kZeroVolts.data()));
    static_cast<void>(api_.write_digital(card_, wand_.mechanism.enable_lines.data(), kChannels, kOff.data()));
    if (has_watchdog_) static_cast<void>(api_.watchdog_stop(card_));
    static_cast<void>(api_.close(card_));
    card_ = nullptr;
    is_on_ = false;
}

HilError HilWand::set_to_zero() noexcept {
    constexpr std::array<std::int32_t, kWandJoints> kZero{};
    joints_ = wand_.mechanism.jig_rad;
    needs_jig_ = false;
    return api_.set_encoder_counts(card_, kChannel.data(), kChannels, kZero.data());
}

void HilWand::serve() {
    static_cast<void>(ask_for_servo_priority());
    const Nanoseconds period_ns = nanoseconds(1.0 / wand_.rate_Hz);
    Nanoseconds due_ns = clock_->now_ns();
    while (!ends_.load(std::memory_order_relaxed)) {
        // A late servo makes up for five turns at most, and rests half a period before each, so that one that cannot
        // keep up leaves its core to others.
        due_ns = std::max(due_ns + period_ns, clock_->now_ns() - 5 * period_ns);
        clock_->sleep_until(std::max(due_ns, clock_->now_ns() + period_ns / 2));
        turn(clock_->now_ns());
    }
}

void HilWand::turn(Nanoseconds now_ns) noexcept {
    if (card_ == nullptr) return find_again(now_ns);
    ServedState& state = exchange_.draft();
    state.time_ns = now_ns;
    std::array<std::int32_t, kWandJoints> counts{};
    // Before all else: a card whose watchdog has expired gives no access.
    HilError error = mind_watchdog(now_ns);
    if (error >= 0) error = api_.read_encoder(card_, kChannel.data(), kChannels, counts.data());
    if (error >= 0) error = mind_amplifiers(now_ns);
    if (error < 0) return refused(error, now_ns);
    joints_ = joints_of_counts(wand_.mechanism, counts);
    const bool is_sound = read_pose(state, now_ns);
    const bool is_well =
        is_sound && is_on_ && !needs_jig_ && (error_ns_ == 0 || now_ns - error_ns_ >= kServedErrorHolds_ns);
    state.fault = is_well ? DeviceFault::none : DeviceFault::other;
    exchange_.publish();
    const WandJoints volts = is_well ? volts_for(exchange_.wanted(now_ns), now_ns) : kZeroVolts;
    error = api_.write_analog(card_, kChannel.data(), kChannels, volts.data());
    if (error < 0) refused(error, now_ns);
}

// The pose of the newest joints; false where they are none of a wand, and it stays what it was.
bool HilWand::read_pose(ServedState& state, Nanoseconds now_ns) noexcept {
    for (std::size_t i = 0; i < kWandJoints; ++i) state.joints[i] = joints_[i];
    const auto tips = wand_tips(wand_.mechanism.arm, joints_);
    const auto jacobian = wand_jacobian(wand_.mechanism.arm, joints_);
    const bool is_sound =
        tips && jacobian && std::abs(handle_error_m(wand_.mechanism.arm, *tips)) <= wand_.mechanism.handle_tolerance_m;
    if (is_sound) {
        axis_ = wand_axis(*tips);
        jacobian_ = *jacobian;
    } else {
        error_ns_ = now_ns;
    }
    if (is_sound == contradicts_) tell(is_sound ? Notice::sound : Notice::contradicts);
    contradicts_ = !is_sound;
    const Pose maker = pose_of(axis_);
    const Quat& turn = device_from_maker_.orientation;
    state.pose_device = {device_from_maker_ * maker.position_m, turn * maker.orientation * glm::conjugate(turn)};
    return is_sound;
}

// Zero where a motor would get what is no number; the next samples have a fault then.
WandJoints HilWand::volts_for(const DeviceWrench& wrench, Nanoseconds now_ns) noexcept {
    const Quat back = glm::conjugate(device_from_maker_.orientation);
    const WandForce force{back * kept_within(wrench.force_device_N, description_.axis_max_force_N, at_force_),
                          back * kept_within(wrench.torque_device_Nm, description_.max_torque_Nm, at_torque_)};
    const WandVolts volts =
        volts_of_torques(wand_.mechanism, motor_torques_Nm(wand_.mechanism.arm, axis_, jacobian_, force));
    if (!volts.is_sound) {
        error_ns_ = now_ns;
        if (!std::exchange(told_number_, true)) tell(Notice::no_number);
    }
    for (std::size_t i = 0; i < kWandJoints; ++i)
        if ((volts.limited >> i & 1u) != 0) at_motor_[i].fetch_add(1, std::memory_order_relaxed);
    if (volts.limited != 0 && !std::exchange(told_motor_, true)) tell(Notice::motor_limit);
    return volts.volts;
}

// Reloads the card's watchdog. Where it has expired the outputs are zero and the card is shut: it is opened again, and
// what was written before, which that may bring back, is written over at once.
HilError HilWand::mind_watchdog(Nanoseconds now_ns) noexcept {
    if (!has_watchdog_) return 0;
    const HilError answer = api_.watchdog_reload(card_);
    return answer != 0 ? answer : open_after_watchdog(now_ns);
}

HilError HilWand::open_after_watchdog(Nanoseconds now_ns) noexcept {
    error_ns_ = now_ns;
    HilError error = api_.watchdog_clear(card_);
    if (error >= 0) error = api_.write_analog(card_, kChannel.data(), kChannels, kZeroVolts.data());
    if (error < 0) return error;
    is_on_ = false;  // its lines may have been reset
    return api_.watchdog_start(card_, kWatchdog_s);
}

HilError HilWand::mind_amplifiers(Nanoseconds now_ns) noexcept {
    const bool wants_on = is_wanted_on_.load(std::memory_order_relaxed);
    if (wants_on == is_on_) return 0;
    if (wants_on && needs_jig_) {
        // Whoever switches them on says that the handle is in its jig.
        const HilError error = set_to_zero();
        if (error < 0) return error;
    }
    is_on_ = wants_on;
    error_ns_ = now_ns;  // the force begins from zero, and a sample says that they were off
    const auto& lines = wand_.mechanism.enable_lines;
    return api_.write_digital(card_, lines.data(), kChannels, wants_on ? kOn.data() : kOff.data());
}

// A watchdog that expires between two calls of a turn is no failure of the card.
void HilWand::refused(HilError error, Nanoseconds now_ns) noexcept {
    const bool has_expired = has_watchdog_ && api_.watchdog_reload(card_) == 0;
    if (!has_expired || open_after_watchdog(now_ns) < 0) fail_with(error, now_ns);
}

void HilWand::fail_with(HilError error, Nanoseconds now_ns) noexcept {
    close_card();
    is_gone_.store(true, std::memory_order_relaxed);
    tell(Notice::failed, error);
    tried_ns_ = now_ns;
    find_again(now_ns);
}

void HilWand::find_again(Nanoseconds now_ns) noexcept {
    ServedState& state = exchange_.draft();
    state.time_ns = now_ns;
    state.fault = DeviceFault::disconnected;
    for (std::size_t i = 0; i < kWandJoints; ++i) state.joints[i] = joints_[i];
    const Quat& turn = device_from_maker_.orientation;
    const Pose maker = pose_of(axis_);
    state.pose_device = {device_from_maker_ * maker.position_m, turn * maker.orientation * glm::conjugate(turn)};
    exchange_.publish();
    if (now_ns - tried_ns_ < kAgain_ns) return;
    tried_ns_ = now_ns;
    if (open_card() < 0) return;
    std::array<std::int32_t, kWandJoints> counts{};
    if (api_.read_encoder(card_, kChannel.data(), kChannels, counts.data()) < 0) return close_card();
    const WandJoints found = joints_of_counts(wand_.mechanism, counts);
    const auto tips = wand_tips(wand_.mechanism.arm, found);
    bool lived_on = tips && std::abs(handle_error_m(wand_.mechanism.arm, *tips)) <= wand_.mechanism.handle_tolerance_m;
    bool was_far = false;
    for (std::size_t i = 0; i < kWandJoints; ++i) {
        lived_on = lived_on && std::abs(found[i] - joints_[i]) <= kMostMoved_rad;
        was_far = was_far || std::abs(joints_[i] - wand_.mechanism.jig_rad[i]) >= kFarFromJig_rad;
    }
    lived_on = lived_on && was_far;
    needs_jig_ = !lived_on;
    if (needs_jig_) is_wanted_on_.store(false, std::memory_order_relaxed);
    error_ns_ = now_ns;
    is_gone_.store(false, std::memory_order_relaxed);
    tell(needs_jig_ ? Notice::needs_jig : Notice::back);
}

AmplifierAnswer HilWand::switch_amplifiers(bool on) noexcept {
    if (on && is_gone_.load(std::memory_order_relaxed)) return AmplifierAnswer::cause_remains;
    is_wanted_on_.store(on, std::memory_order_relaxed);
    return AmplifierAnswer::done;
}

WandLimits HilWand::limits() const noexcept {
    WandLimits limits;
    for (std::size_t i = 0; i < 3; ++i) {
        limits.force[i] = at_force_[i].load(std::memory_order_relaxed);
        limits.torque[i] = at_torque_[i].load(std::memory_order_relaxed);
    }
    for (std::size_t i = 0; i < kWandJoints; ++i) limits.motor[i] = at_motor_[i].load(std::memory_order_relaxed);
    return limits;
}

std::vector<std::string> HilWand::take_messages() {
    std::vector<std::string> messages;
    const std::string who = "the wand on the card " + wand_.mechanism.card + " " + card_name_;
    for (Told told; told_.pop(told);) {
        switch (told.what) {
            case Notice::failed:
                messages.push_back(who + " fails: " + hil_error_text(api_, told.error) +
                                   "; its amplifiers are off, and it is looked for each second");
                break;
            case Notice::back:
                messages.push_back(who + " is there again, and its encoders have gone on counting");
                break;
            case Notice::needs_jig:
                messages.push_back(who +
                                   " is there again, and its encoders have begun anew: put the handle into its jig, "
                                   "and switch its amplifiers on (command amplifiers on)");
                break;
            case Notice::contradicts:
                messages.push_back(who +
                                   ": its encoders contradict one another, or read what no wand's can: no force. "
                                   "Put the handle into its jig and open the session again");
                break;
            case Notice::sound: messages.push_back(who + ": its encoders agree again"); break;
            case Notice::no_watchdog:
                messages.push_back(who + " has no watchdog: if this program dies, switch the amplifiers off by hand");
                break;
            case Notice::no_number:
                messages.push_back(who + ": a motor's current comes out as no number: no force");
                break;
            case Notice::motor_limit:
                messages.push_back(who + ": a motor is at the current that it bears for long, and the force is less");
                break;
        }
    }
    return messages;
}

}  // namespace burin::devices
