// SPDX-License-Identifier: MIT
// A Quanser wand behind a card of the HIL API, and the thread that serves it once a period of its rate.
//
// Data flow: encoders -> joints -> both tips -> pose of the newest turn -> the haptic thread; newest wrench of that ->
// motors' torques -> volts -> card. A turn writes zero unless the haptic thread has given a wrench within the last
// kServedSilent_ns, the amplifiers are on, the pose is sound, and nothing has failed within kServedErrorHolds_ns. The
// card's own watchdog takes the volts off, and leaves the amplifiers' lines undriven, where this program dies.
// Limits: each axis is kept within the description's, each motor within its current; ticks at either are counted.
// A card that fails is left with zero volts and its amplifiers off, and opened anew once in kAgain_ns. Counters that
// have lived on go on to count; others need the jig: the wand stays without force until its amplifiers are switched on
// there, which sets the counters to zero.
// Failures: of open(), an Error; later ones are messages and faults of the samples. Threads: created, destroyed and
// asked for messages by one; switch_amplifiers() is any's.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/ring.hpp"
#include "devices/drivers/hil_api.hpp"
#include "devices/haptic/amplifiers.hpp"
#include "devices/haptic/wand_description.hpp"
#include "devices/served/served_arm.hpp"

namespace burin::devices {

// Turns in which an axis of the device, or a motor, was at its limit.
struct WandLimits {
    std::array<std::uint64_t, 3> force{}, torque{};
    std::array<std::uint64_t, kWandJoints> motor{};
};

class HilWand final : public ServedLink, public Amplifiers {
public:
    static constexpr Nanoseconds kAgain_ns = 1'000'000'000;
    static constexpr double kWatchdog_s = 0.05;

    // Opens the card, sets the counters to zero, for which the handle has to be in its jig, and begins to serve it.
    [[nodiscard]] static Result<std::unique_ptr<HilWand>> open(const std::string& library, const std::string& card,
                                                               const WandDescription& wand);
    // Opens the card as open() does, with a loaded library and with the machine's clock or a test's. `begins` may be
    // empty; otherwise it is called before the first turn.
    [[nodiscard]] static Result<std::unique_ptr<HilWand>> serve_card(const HilApi& api, const std::string& card,
                                                                     const WandDescription& wand,
                                                                     std::unique_ptr<Clock> clock,
                                                                     const std::function<void(HilWand&)>& begins = {});
    ~HilWand() override;
    HilWand(const HilWand&) = delete;
    HilWand& operator=(const HilWand&) = delete;

    [[nodiscard]] ServedExchange& exchange() noexcept override { return exchange_; }
    [[nodiscard]] AmplifierAnswer switch_amplifiers(bool on) noexcept override;
    [[nodiscard]] std::vector<std::string> take_messages() override;
    // Of the wand, as long as this lives.
    [[nodiscard]] const DeviceDescription& description() const noexcept { return description_; }
    [[nodiscard]] WandLimits limits() const noexcept;

private:
    enum class Notice : std::uint8_t {
        failed,
        back,
        needs_jig,
        contradicts,
        no_watchdog,
        motor_limit,
        sound,
        no_number
    };
    struct Told {
        Notice what = Notice::failed;
        HilError error = 0;
    };
    HilWand(const HilApi& api, std::string card, const WandDescription& wand, std::unique_ptr<Clock> clock);
    [[nodiscard]] HilError open_card() noexcept;
    void close_card() noexcept;
    [[nodiscard]] HilError set_to_zero() noexcept;
    void serve();
    void turn(Nanoseconds now_ns) noexcept;
    void refused(HilError error, Nanoseconds now_ns) noexcept;
    void fail_with(HilError error, Nanoseconds now_ns) noexcept;
    void find_again(Nanoseconds now_ns) noexcept;
    [[nodiscard]] HilError mind_amplifiers(Nanoseconds now_ns) noexcept;
    [[nodiscard]] HilError mind_watchdog(Nanoseconds now_ns) noexcept;
    [[nodiscard]] HilError open_after_watchdog(Nanoseconds now_ns) noexcept;
    [[nodiscard]] bool read_pose(ServedState& state, Nanoseconds now_ns) noexcept;
    [[nodiscard]] WandJoints volts_for(const DeviceWrench& wrench, Nanoseconds now_ns) noexcept;
    void tell(Notice what, HilError error = 0) noexcept { told_.push({what, error}); }

    HilApi api_;
    std::string card_name_;
    WandDescription wand_;
    DeviceDescription description_;
    Pose device_from_maker_;
    std::unique_ptr<Clock> clock_;
    ServedExchange exchange_;
    Ring<Told> told_{64};  // this thread -> the frame's
    // Flags and counts of their own, that say nothing of other memory: relaxed order is enough for all of them.
    std::atomic<bool> ends_ = false, is_wanted_on_ = true, is_gone_ = false;
    std::array<std::atomic<std::uint64_t>, 3> at_force_{}, at_torque_{};
    std::array<std::atomic<std::uint64_t>, kWandJoints> at_motor_{};
    // Of the serving thread:
    HilCard card_ = nullptr;
    bool is_on_ = false, has_watchdog_ = false, needs_jig_ = false, contradicts_ = false, told_motor_ = false,
         told_number_ = false;
    Nanoseconds error_ns_ = 0, tried_ns_ = 0;
    WandJoints joints_{};
    WandAxis axis_;
    WandJacobian jacobian_;
    std::thread thread_;
};

}  // namespace burin::devices
