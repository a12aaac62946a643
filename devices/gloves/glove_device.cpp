// SPDX-License-Identifier: MIT
#include "devices/gloves/glove_device.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "base/try.hpp"
#include "devices/gloves/glove_link.hpp"

namespace burin::devices {
namespace {

constexpr std::array<const char*, kGloveFingers> kPistonNames{"thumb", "index", "middle", "ring"};

DeviceDescription glove_description(bool on_a_line) {
    DeviceDescription d;
    d.name = on_a_line ? "glove on a serial line" : "simulated glove";
    // The palm's way, as a stylus' on a desk, and a hand around it.
    d.workspace_m = Vec3(0.4, 0.4, 0.35);
    d.resolution_m = 0.0001;  // a twelfth of a degree at the end of a finger
    d.max_force_N = kMostPistonForce_N;
    d.max_stiffness_N_per_m = 600.0;
    d.rate_Hz = 1000.0;
    d.apparent_mass_kg = 0.03;  // of a piston and a fingertip: assumed
    d.damping_Ns_per_m = 0.5;
    d.friction_N = 0.014;  // about that of a graphite piston in glass: assumed
    d.delay_s = on_a_line ? seconds(GloveLink::kSend_ns) : 0.0;
    d.joints.count = kFingerJoints;
    d.drives_one_way = true;
    d.felt_by_person = on_a_line;
    d.gives_way = on_a_line;  // a simulated finger goes where the grip leads it, until it is pushed by 2 N
    return d;
}

class GloveParts {
public:
    GloveParts(std::unique_ptr<GloveLink> link, std::optional<GripShape> simulated, AnyHand hand, Clock& clock,
               std::optional<FingerCourse> course = std::nullopt)
        : link_(std::move(link)),
          simulated_(simulated),
          course_(std::move(course)),
          hand_(std::move(hand)),
          clock_(clock),
          start_ns_(clock.now_ns()) {}

    [[nodiscard]] DeviceSample read(std::size_t finger) noexcept {
        if (finger == 0) look();
        const Pose& tip = places_[finger].hand_from_tip;
        DeviceSample sample;
        sample.time_ns = now_ns_;
        sample.position_device_m = palm_ * tip.position_m;
        sample.orientation_device = glm::normalize(palm_.orientation * tip.orientation);
        sample.buttons = buttons_;
        std::ranges::copy(joints_[finger], sample.joints.begin());
        sample.drive = drive_of(finger);
        if (is_lost_) {
            sample.fault = DeviceFault::disconnected;
            sample.fault_is_of_all = true;
        } else if (has_fault_) {
            sample.fault = DeviceFault::other;
            sample.fault_is_of_all = true;
        } else if (are_motors_off_) {
            sample.fault = DeviceFault::motors_off;
            sample.fault_is_of_all = true;
        } else {
            sample.fault = pistons_[finger].differs ? DeviceFault::force_differs : own_faults_[finger];
        }
        return sample;
    }

    void write(std::size_t finger, const DeviceWrench& wrench) noexcept {
        const Vec3 along_device = palm_.orientation * places_[finger].piston_hand;
        forces_N_[finger] = std::clamp(glm::dot(wrench.force_device_N, along_device), 0.0, kMostPistonForce_N);
        if (!link_ || finger + 1 != kGloveFingers) return;
        if (is_lost_)
            link_->command({});
        else
            link_->command(forces_N_, laws_);
    }
    // Limits the force of a law that the controller renders by itself to the piston's most, as commanded forces are.
    void offer(std::size_t finger, const DriveLaw& law) noexcept {
        laws_[finger] = law;
        laws_[finger].most_N = std::clamp(law.most_N, 0.0, kMostPistonForce_N);
    }

private:
    // Takes where the palm and the joints are now.
    void look() noexcept {
        const Nanoseconds before_ns = std::exchange(now_ns_, clock_.now_ns());
        const HandTarget hand = target_of(hand_, seconds(now_ns_ - start_ns_));
        palm_ = {hand.position_device_m, hand.orientation_device};
        buttons_ = hand.buttons;
        joints_ = {};
        if (simulated_) close(seconds(before_ns > 0 ? now_ns_ - before_ns : 0));
        if (link_) {
            const GloveHeard& heard = link_->newest();
            is_lost_ = heard.time_ns == 0 || now_ns_ - heard.time_ns > kGloveLost_ns;
            has_fault_ = heard.set.fault;
            are_motors_off_ = !heard.set.motors_on;
            if (is_lost_) pistons_ = {};  // whoever switches a glove off and on has seen to it
            play(heard.sets, now_ns_ - (before_ns > 0 ? before_ns : now_ns_));
            judge(heard.sets);
            hear_of(heard);
            expect(seconds(before_ns > 0 ? now_ns_ - before_ns : 0));
            if (heard.time_ns != std::exchange(judged_ns_, heard.time_ns)) compare_forces(heard);
        }
        for (std::size_t i = 0; i < kGloveFingers; ++i) places_[i] = place_of(shape_[i], joints_[i]);
    }

    [[nodiscard]] OneWayDrive drive_of(std::size_t finger) const noexcept {
        const FingertipPlace& place = places_[finger];
        OneWayDrive drive;
        drive.along_device = palm_.orientation * place.piston_hand;
        const PistonWay way = piston_way(place);
        drive.moves_device = palm_.orientation * way.moves_hand;
        drive.length_m = place.piston_m;
        drive.state =
            state_ | (way.is_bounded ? kDriveBounded : 0u) | (is_local_ && laws_[finger].holds ? kDriveLocal : 0u);
        drive.measured_N = measured_N_[finger];
        return drive;
    }

    // Has the pistons follow what they are to give for so long, as the paper's do, from 10 to 50 Hz.
    void expect(double time_s) noexcept {
        constexpr double kBand_Hz = 25.0;
        const double follows = 1.0 - std::exp(-2.0 * std::numbers::pi * kBand_Hz * time_s);
        for (std::size_t i = 0; i < kGloveFingers; ++i) given_N_[i] += follows * (forces_N_[i] - given_N_[i]);
    }

    // Takes the simulated fingers on by so long.
    void close(double time_s) noexcept {
        expect(time_s);
        grip_ = course_ ? stepped(grip_, *course_, seconds(now_ns_ - start_ns_), given_N_, time_s)
                        : stepped(grip_, (buttons_ & 1u) != 0 ? 1.0 : 0.0, given_N_, time_s);
        for (std::size_t i = 0; i < kGloveFingers; ++i) joints_[i] = bent_in(*simulated_, i, grip_.closed[i]);
        state_ = kDriveOn | kDriveMeasured;
        measured_N_ = given_N_;
    }

    // Compares what the pistons give, in a set that is new, with what they were told. One that has given another force
    // for kDiffers_ns, in each set of that time, gets no force until the glove is opened again: what is wrong with it
    // does not show while it is told nothing. What the controller renders by itself, the host does not know.
    void compare_forces(const GloveHeard& heard) noexcept {
        const bool tells = !is_lost_ && !has_fault_ && !are_motors_off_ && heard.set.forces_N.has_value();
        const bool follows = heard.before_ns != 0 && heard.time_ns - heard.before_ns <= kGloveLost_ns;
        for (std::size_t i = 0; i < kGloveFingers; ++i) {
            Piston& piston = pistons_[i];
            const double told_N = given_N_[i], off_N = std::abs(measured_N_[i] - told_N);
            const bool differs = tells && follows && !heard.set.is_local && off_N > kDiffers_N + kDiffersShare * told_N;
            if (!differs)
                piston.since_ns = 0;
            else if (piston.since_ns == 0)
                piston.since_ns = heard.time_ns;
            else if (heard.time_ns - piston.since_ns >= kDiffers_ns)
                piston.differs = true;
        }
    }

    // Judges the angles that are played now and that come after them: a finger gets no force from when a false reading
    // has come until it is past.
    void judge(const GloveSets& sets) noexcept {
        for (std::size_t finger = 0; finger < kGloveFingers; ++finger) {
            own_faults_[finger] = DeviceFault::none;
            for (std::size_t i = std::max<std::size_t>(played_, 1) - 1; i < sets.count; ++i) {
                const FingerAngles& angles = sets.list[i].set.joints[finger];
                const bool follows = i >= std::max<std::size_t>(played_, 1) &&
                                     sets.list[i].taken_ns - sets.list[i - 1].taken_ns <= kGloveLost_ns;
                const FingerAngles& before = follows ? sets.list[i - 1].set.joints[finger] : angles;
                // Sets whose numbers say nothing may come in a bunch; the controller took them a period apart.
                const Nanoseconds between_ns = follows ? sets.list[i].taken_ns - sets.list[i - 1].taken_ns : 0;
                switch (angle_fault(finger, before, angles,
                                    seconds(std::max(between_ns, set_period_ns(sets.list[i].set))))) {
                    case AngleFault::none: break;
                    case AngleFault::jumped:
                        if (own_faults_[finger] == DeviceFault::none) own_faults_[finger] = DeviceFault::overspeed;
                        break;
                    case AngleFault::beyond_bounds: own_faults_[finger] = DeviceFault::false_reading; break;
                }
            }
        }
    }

    // Takes what the controller says of its pistons; nothing of a line that is lost.
    void hear_of(const GloveHeard& heard) noexcept {
        const GloveSet& set = heard.set;
        const bool measures = !is_lost_ && set.forces_N.has_value();
        measured_N_ = measures ? *set.forces_N : GloveForces{};
        is_local_ = set.is_local && !is_lost_;
        const bool rejects = std::exchange(rejected_, heard.sets.rejected) != heard.sets.rejected;
        state_ = (is_lost_ ? 0u
                           : (set.motors_on ? kDriveOn : 0u) | (set.fault ? kDriveFault : 0u) |
                                 (measures ? kDriveMeasured : 0u)) |
                 (rejects ? kDriveSetRejected : 0u);
    }

    // Goes on through the sets by so long: at their own pace, a fifth faster or slower until it is as late as they
    // need.
    void play(const GloveSets& sets, Nanoseconds time_ns) noexcept {
        if (sets.count == 0) return;
        const Nanoseconds newest_ns = sets.newest().taken_ns;
        const Nanoseconds wanted_ns = std::min(now_ns_ - sets.needs_ns, newest_ns);
        at_ns_ -= sets.shifted_ns - std::exchange(shifted_ns_, sets.shifted_ns);
        if (!std::exchange(plays_, true) || std::abs(wanted_ns - at_ns_) > kGloveLost_ns) {
            at_ns_ = wanted_ns;
        } else {
            const Nanoseconds most_ns = time_ns / 5;
            at_ns_ += time_ns + std::clamp(wanted_ns - at_ns_ - time_ns, -most_ns, most_ns);
            at_ns_ = std::min(at_ns_, newest_ns);
        }
        played_ = 0;
        while (played_ < sets.count && sets.list[played_].taken_ns <= at_ns_) ++played_;
        joints_ = joints_at(sets);
    }

    // On the way from the set before played_ to that.
    [[nodiscard]] GloveJoints joints_at(const GloveSets& sets) const noexcept {
        if (played_ == sets.count) return sets.newest().set.joints;
        const TimedSet &to = sets.list[played_], &from = played_ > 0 ? sets.list[played_ - 1] : to;
        const Nanoseconds between_ns = to.taken_ns - from.taken_ns;
        if (between_ns <= 0 || between_ns > kGloveLost_ns) return to.set.joints;
        const double share = seconds(at_ns_ - from.taken_ns) / seconds(between_ns);
        GloveJoints joints{};
        for (std::size_t i = 0; i < kGloveFingers; ++i)
            for (std::size_t k = 0; k < kFingerJoints; ++k) {
                const double first = from.set.joints[i][k], last = to.set.joints[i][k];
                joints[i][k] = first + share * (last - first);
            }
        return joints;
    }

    // Of what a piston was told for long, it measures a quarter less or more where it rubs or its air is short.
    static constexpr double kDiffers_N = 0.5, kDiffersShare = 0.25;
    static constexpr Nanoseconds kDiffers_ns = 300'000'000;
    struct Piston {
        Nanoseconds since_ns = 0;  // arrival of the first set since which it gives another force; 0: it does not
        bool differs = false;      // for so long that it is a fault
    };

    const GloveHand& shape_ = usual_hand();
    std::unique_ptr<GloveLink> link_;     // null: there is no glove
    std::optional<GripShape> simulated_;  // none: it is no simulated one
    std::optional<FingerCourse> course_;  // of a simulated one; none: its button closes it
    AnyHand hand_;
    Clock& clock_;
    Nanoseconds start_ns_, now_ns_ = 0;
    Pose palm_;
    std::uint32_t buttons_ = 0;
    bool is_lost_ = false, has_fault_ = false, are_motors_off_ = false;
    std::array<DeviceFault, kGloveFingers> own_faults_{};
    std::array<Piston, kGloveFingers> pistons_{};
    Nanoseconds judged_ns_ = 0;  // arrival of the set that pistons_ are of
    bool plays_ = false;
    Nanoseconds at_ns_ = 0, shifted_ns_ = 0;  // of the controller's time: what is played now
    std::size_t played_ = 0;                  // the first set that comes after that
    std::uint64_t rejected_ = 0;              // sets, when the last tick read
    std::uint32_t state_ = 0;                 // of all pistons: DriveState
    bool is_local_ = false;                   // the controller renders some finger by itself
    GloveForces measured_N_{};
    std::array<FingertipPlace, kGloveFingers> places_{};
    GloveJoints joints_{};
    GloveForces forces_N_{}, given_N_{};
    GloveLaws laws_{};
    Grip grip_;
};

}  // namespace

OpenedDevice simulated_glove(GripShape shape, AnyHand hand, Clock& clock) {
    const auto all = std::make_shared<GloveParts>(nullptr, shape, std::move(hand), clock);
    return of_parts(all, glove_description(false), kPistonNames);
}

OpenedDevice simulated_glove(FingerCourse course, AnyHand hand, Clock& clock) {
    const auto all = std::make_shared<GloveParts>(nullptr, GripShape::whole, std::move(hand), clock, std::move(course));
    return of_parts(all, glove_description(false), kPistonNames);
}

Result<OpenedDevice> open_glove(const std::string& port, AnyHand hand, Clock& clock) {
    std::unique_ptr<GloveLink> link;
    if (!port.empty()) {
        BURIN_TRY(opened, GloveLink::open(port, clock));
        link = std::move(opened);
    }
    const auto all = std::make_shared<GloveParts>(std::move(link), std::nullopt, std::move(hand), clock);
    return of_parts(all, glove_description(true), kPistonNames);
}

}  // namespace burin::devices
