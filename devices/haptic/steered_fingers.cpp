// SPDX-License-Identifier: MIT
#include "devices/haptic/steered_fingers.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "devices/haptic/simulated_fingers.hpp"

namespace burin::devices {
namespace {

constexpr std::array<const char*, kFingers> kFingerNames{"thumb", "index", "middle", "ring"};
// From the middle towards each open fingertip, in the hand's frame: the thumb faces the others.
constexpr std::array<Vec3, kFingers> kTowardsFinger{Vec3{0.0, -1.0, 0.0}, Vec3{-0.57, 0.82, 0.0}, Vec3{0.0, 1.0, 0.0},
                                                    Vec3{0.57, 0.82, 0.0}};

// The hand that all fingers belong to.
class FingersOfAHand {
public:
    FingersOfAHand(AnyHand hand, Clock& clock) : hand_(std::move(hand)), clock_(clock), start_ns_(clock.now_ns()) {
        lead(0.0);
        for (std::size_t i = 0; i < kFingers; ++i) fingers_[i].emplace(DirectedHand(directions_[i]), model(), &clock);
    }
    FingersOfAHand(const FingersOfAHand&) = delete;
    FingersOfAHand& operator=(const FingersOfAHand&) = delete;

    [[nodiscard]] const DeviceDescription& description() const noexcept { return fingers_.front()->description(); }
    [[nodiscard]] DeviceSample read(std::size_t finger) noexcept {
        if (finger == 0) lead(seconds(clock_.now_ns() - start_ns_));
        return fingers_[finger]->read();
    }
    void write(std::size_t finger, const DeviceWrench& wrench) noexcept { fingers_[finger]->write(wrench); }

private:
    // Fingers reach around what a stylus' tip reaches.
    static OmniModel model() {
        OmniModel model = SimulatedFingers::kFinger;
        model.workspace_m += Vec3(2.0 * kOpen_m);
        return model;
    }
    // Directs each finger from where the hand is at this time.
    void lead(double time_s) noexcept {
        const HandTarget hand = target_of(hand_, time_s);
        const double step_m = kClosing_m_per_s * std::max(time_s - time_s_, 0.0);
        const double wanted_m = (hand.buttons & 1u) != 0 ? kClosed_m : kOpen_m;
        open_m_ += std::clamp(wanted_m - open_m_, -step_m, step_m);
        time_s_ = time_s;
        for (std::size_t i = 0; i < kFingers; ++i) {
            directions_[i].since_s = time_s;
            directions_[i].target = hand;
            directions_[i].target.position_device_m += hand.orientation_device * (open_m_ * kTowardsFinger[i]);
        }
    }

    AnyHand hand_;
    Clock& clock_;
    Nanoseconds start_ns_;
    double time_s_ = 0.0, open_m_ = kOpen_m;
    std::array<HandDirection, kFingers> directions_{};
    std::array<std::optional<SimulatedOmni>, kFingers> fingers_;
};

}  // namespace

OpenedDevice simulated_fingers(AnyHand hand, Clock& clock) {
    const auto shared = std::make_shared<FingersOfAHand>(std::move(hand), clock);
    DeviceDescription description = shared->description();
    description.name = "simulated fingers";
    return of_parts(shared, description, kFingerNames);
}

}  // namespace burin::devices
