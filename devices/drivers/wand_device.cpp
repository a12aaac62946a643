// SPDX-License-Identifier: MIT
#include "devices/drivers/wand_device.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "devices/drivers/hil_wand.hpp"
#include "devices/haptic/wand_file.hpp"
#include "devices/presence/hil_shared.hpp"

namespace burin::devices {
namespace {

// The greatest steps of place and turn that one step of every encoder makes, over what the linkages reach of the
// workspace.
void set_steps(const WandDescription& wand, DeviceDescription& device) {
    const TwinPantograph& arm = wand.mechanism.arm;
    const Quat turn = device_from_maker(wand).orientation;
    constexpr int kCells = 8;
    double place_m = 0.0, turned_rad = 0.0;
    for (int x = 0; x <= kCells; ++x)
        for (int y = 0; y <= kCells; ++y)
            for (int z = 0; z <= kCells; ++z) {
                const Vec3 share = Vec3(x, y, z) / static_cast<double>(kCells);
                const WandAxis axis{wand.workspace_maker_m.lo + share * wand.workspace_maker_m.extent(),
                                    Vec3(0.0, 0.0, 1.0)};
                const auto joints = wand_joints(arm, axis);
                const auto jacobian = joints ? wand_jacobian(arm, *joints) : std::nullopt;
                if (!jacobian) continue;
                std::array<Vec3, kWandJoints> moves, turns;
                const auto column = [&](std::size_t joint, const Vec3& tip_moves, double side) {
                    moves[joint] = turn * (0.5 * tip_moves);
                    turns[joint] = turn * (side * glm::cross(axis.along, tip_moves) / handle_length_m(arm));
                };
                column(0, jacobian->upper[0], 1.0);
                column(1, jacobian->upper[1], 1.0);
                column(2, jacobian->lower[0], -1.0);
                column(3, jacobian->lower[1], -1.0);
                column(4, jacobian->upper[2], 1.0);
                column(5, jacobian->lower[2], -1.0);
                place_m = std::fmax(place_m, step_at_handle(device.joints, moves));
                turned_rad = std::fmax(turned_rad, step_at_handle(device.joints, turns));
            }
    if (place_m > 0.0) device.resolution_m = place_m;
    if (turned_rad > 0.0) device.orientation_step_rad = turned_rad;
}

// The description with the name that it points to.
struct NamedWand {
    explicit NamedWand(WandDescription wand) : wand_(std::move(wand)), device_(device_of(wand_)) {
        device_.joints = joints_of(wand_.mechanism);
        set_steps(wand_, device_);
        // A turn until the serving thread takes the force, a turn that the sample is old, and the device's own.
        device_.delay_s = 2.0 / wand_.rate_Hz + wand_.arm.delay_s;
        device_.watchdog_s = seconds(kServedSilent_ns);
        device_.felt_by_person = true;
    }
    NamedWand(const NamedWand&) = delete;
    NamedWand& operator=(const NamedWand&) = delete;
    WandDescription wand_;
    DeviceDescription device_;
};

class WandDevice final : public HapticDevice, public DeviceMessages, public Amplifiers {
public:
    WandDevice(std::unique_ptr<HilWand> served, WandDescription wand, AnyHand hand, Clock& clock)
        : named_(std::move(wand)),
          served_(std::move(served)),
          hand_(std::move(hand)),
          clock_(clock),
          start_ns_(clock.now_ns()),
          samples_(nanoseconds(1.0 / named_.wand_.rate_Hz)) {}

    [[nodiscard]] const DeviceDescription& description() const noexcept override { return named_.device_; }

    [[nodiscard]] DeviceSample read() noexcept override {
        const Nanoseconds now_ns = clock_.now_ns();
        // The mouse's way is taken from its channel and left: a person's hand leads the wand.
        static_cast<void>(target_of(hand_, seconds(now_ns - start_ns_)));
        return samples_.sample(served_->newest(), now_ns);
    }
    void write(const DeviceWrench& wrench) noexcept override {
        served_->command(samples_.may_push() ? wrench : DeviceWrench{});
    }
    [[nodiscard]] std::vector<std::string> take_messages() override { return served_->take_messages(); }
    [[nodiscard]] AmplifierAnswer switch_amplifiers(bool on) noexcept override {
        return served_->switch_amplifiers(on);
    }

private:
    NamedWand named_;
    std::unique_ptr<HilWand> served_;
    AnyHand hand_;
    Clock& clock_;
    Nanoseconds start_ns_;
    ServedSamples samples_;
};

class RestingWand final : public HapticDevice, public Amplifiers {
public:
    RestingWand(WandDescription wand, Clock& clock) : named_(std::move(wand)), clock_(clock) {}
    [[nodiscard]] const DeviceDescription& description() const noexcept override { return named_.device_; }
    [[nodiscard]] DeviceSample read() noexcept override {
        DeviceSample sample;
        sample.time_ns = clock_.now_ns();
        return sample;
    }
    void write(const DeviceWrench& /*wrench*/) noexcept override {}
    [[nodiscard]] AmplifierAnswer switch_amplifiers(bool /*on*/) noexcept override { return AmplifierAnswer::done; }

private:
    NamedWand named_;
    Clock& clock_;
};

}  // namespace

WandAddress wand_address(const std::string& text) {
    WandAddress address;
    std::string rest = text;
    // A card on another machine has its address behind a sign of the same kind.
    if (const std::size_t at = rest.rfind('@'); at != std::string::npos && !rest.substr(at).contains("://")) {
        address.library = rest.substr(at + 1);
        rest.resize(at);
    }
    if (rest.ends_with(".toml")) {
        const std::size_t comma = rest.find(',');
        address.file = comma == std::string::npos ? rest : rest.substr(comma + 1);
        rest.resize(comma == std::string::npos ? 0 : comma);
    }
    if (!rest.empty()) address.card = rest;
    if (address.library.empty())
        address.library = address.card.starts_with("emulated") ? library_beside_program(kEmulatedHilLibrary)
                                                               : std::string(kHilLibrary);
    return address;
}

Result<WandDescription> wand_at(const std::string& text) {
    const WandAddress address = wand_address(text);
    if (address.file.empty()) return quanser_wand_of_maker();
    return read_wand(address.file, quanser_wand_of_maker());
}

Result<OpenedDevice> open_wand(const std::string& text, AnyHand hand, Clock& clock) {
    const WandAddress address = wand_address(text);
    auto wand = wand_at(text);
    if (!wand) return std::unexpected(wand.error());
    auto served = HilWand::open(address.library, address.card, *wand);
    if (!served) return std::unexpected(served.error());
    auto device = std::make_unique<WandDevice>(std::move(*served), std::move(*wand), std::move(hand), clock);
    DeviceMessages* const messages = device.get();
    Amplifiers* const amplifiers = device.get();
    OpenedDevice opened = of_one_part(std::move(device), amplifiers);
    opened.messages = messages;
    return opened;
}

Result<OpenedDevice> wand_that_rests(const std::string& text, Clock& clock) {
    auto wand = wand_at(text);
    if (!wand) return std::unexpected(wand.error());
    auto device = std::make_unique<RestingWand>(std::move(*wand), clock);
    Amplifiers* const amplifiers = device.get();
    return of_one_part(std::move(device), amplifiers);
}

std::vector<DevicePresence> look_for_wands() {
    std::vector<DevicePresence> found;
    if (auto api = load_hil_api(kHilLibrary); api)
        found.push_back(
            {Presence::perhaps,
             kHilWand,
             "Quanser's HIL library is installed; whether a card and a wand are there shows when it is opened",
             {}});
    else
        found.push_back({api.error().what.contains("cannot be loaded") ? Presence::absent : Presence::unusable,
                         kHilWand, api.error().what, api.error().remedy});
    for (const std::string& name : emulated_wands())
        found.push_back({Presence::there, std::string(kHilWand) + ":" + name, "an emulated one", {}});
    return found;
}

}  // namespace burin::devices
