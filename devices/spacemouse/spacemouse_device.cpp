// SPDX-License-Identifier: MIT
#include "devices/spacemouse/spacemouse_device.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "base/try.hpp"
#include "devices/haptic/simulated_wand.hpp"
#include "devices/haptic/wand_file.hpp"
#include "devices/spacemouse/spacemouse_line.hpp"
#include "devices/spacemouse/spacemouse_rates.hpp"

namespace burin::devices {
namespace {

std::string where_of(const std::string& name, const std::string& text) {
    return "haptic device " + name + (text.empty() ? "" : ":" + text);
}

DeviceDescription led(DeviceDescription description) {
    description.led_by = "a SpaceMouse";
    return description;
}

// Its keys in the order of the device's buttons: the second undoes, and is no button of the stylus.
std::uint32_t stylus_buttons(std::uint32_t keys) {
    constexpr std::array kBitOfKey{0u, 2u, 1u, 3u};
    std::uint32_t buttons = 0;
    for (std::uint32_t key = 0; key < kBitOfKey.size(); ++key)
        if ((keys >> key & 1u) != 0) buttons |= 1u << kBitOfKey[key];
    return buttons;
}

// Brings an orientation to within so much of another, on the shortest way between them.
Quat within_reach(const Quat& target, const Quat& from, double most_rad) noexcept {
    const Quat by = target * glm::conjugate(from);
    const Quat turn = by.w < 0.0 ? -by : by;
    const double sine = glm::length(Vec3(turn.x, turn.y, turn.z));
    if (2.0 * std::atan2(sine, turn.w) <= most_rad) return target;
    return glm::normalize(glm::angleAxis(most_rad, Vec3(turn.x, turn.y, turn.z) / sine) * from);
}

template <typename Arm>
class LedBySpaceMouse final : public HapticDevice, public DeviceMessages {
public:
    template <typename... Model>
    LedBySpaceMouse(std::unique_ptr<SpaceMouseLine> line, const SpaceMouseSettings& settings, const HandTarget& begin,
                    Clock& clock, Model&&... model)
        : line_(std::move(line)),
          settings_(settings),
          clock_(clock),
          direction_{0.0, begin, {}},
          arm_(AnyHand(DirectedHand(direction_)), std::forward<Model>(model)..., &clock),
          description_(led(arm_.description())) {
        last_.position_device_m = begin.position_device_m;
        last_.orientation_device = begin.orientation_device;
    }

    [[nodiscard]] Arm& arm() { return arm_; }
    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }

    [[nodiscard]] DeviceSample read() noexcept override {
        if (line_ == nullptr) return arm_.read();
        const SpaceMouseState& cap = line_->newest();
        const bool is_led = cap.is_there && clock_.now_ns() - cap.time_ns < kSpaceMouseLost_ns;
        HandTarget& target = direction_.target;
        Vec3 turning(0.0);
        target.buttons = is_led ? stylus_buttons(cap.buttons) : 0;
        target.velocity_device_m_per_s = Vec3(0.0);
        if (is_led) {
            target.velocity_device_m_per_s =
                bounded(spacemouse_rate(cap.push, settings_.dead_zone, settings_.speed_m_per_s));
            turning = spacemouse_rate(cap.turn, settings_.dead_zone, settings_.turning_rad_per_s);
        } else {
            target.position_device_m = last_.position_device_m;
            target.orientation_device = last_.orientation_device;
        }
        direction_.since_s = seconds(arm_.time_ns());
        last_ = arm_.read();
        move_on(turning, seconds(arm_.time_ns()) - direction_.since_s);
        DeviceSample sample = last_;
        if (!is_led) {
            sample.fault = DeviceFault::disconnected;
            sample.fault_is_of_all = true;
        }
        may_push_ = sample.fault == DeviceFault::none;
        return sample;
    }

    void write(const DeviceWrench& wrench) noexcept override { arm_.write(may_push_ ? wrench : DeviceWrench{}); }

    [[nodiscard]] std::vector<std::string> take_messages() override {
        return line_ != nullptr ? line_->take_messages() : std::vector<std::string>{};
    }
    [[nodiscard]] std::vector<std::string> take_commands() override {
        std::vector<std::string> commands;
        if (line_ == nullptr) return commands;
        for (const std::uint32_t key : line_->take_presses()) {
            if (key == 1) commands.emplace_back("undo");
            if (key == 3) commands.emplace_back("redo");
        }
        return commands;
    }

private:
    // Outwards there is no motion at the ends of the workspace, nor away from a stylus that is held back.
    [[nodiscard]] Vec3 bounded(Vec3 velocity_m_per_s) const noexcept {
        const Vec3 half_m = 0.5 * description_.workspace_m;
        const Vec3& place_m = direction_.target.position_device_m;
        for (int axis = 0; axis < 3; ++axis)
            if ((place_m[axis] >= half_m[axis] && velocity_m_per_s[axis] > 0.0) ||
                (place_m[axis] <= -half_m[axis] && velocity_m_per_s[axis] < 0.0))
                velocity_m_per_s[axis] = 0.0;
        const Vec3 ahead_m = place_m - last_.position_device_m;
        const double lead_m = glm::length(ahead_m), away = glm::dot(velocity_m_per_s, ahead_m);
        if (lead_m > 0.99 * kSpaceMouseLead_m && away > 0.0) velocity_m_per_s -= away / (lead_m * lead_m) * ahead_m;
        return velocity_m_per_s;
    }

    void move_on(const Vec3& turning, double dt_s) noexcept {
        HandTarget& target = direction_.target;
        const Vec3 half_m = 0.5 * description_.workspace_m;
        Vec3 place_m = target.position_device_m + dt_s * target.velocity_device_m_per_s;
        const Vec3 ahead_m = place_m - last_.position_device_m;
        if (const double lead_m = glm::length(ahead_m); lead_m > kSpaceMouseLead_m)
            place_m = last_.position_device_m + kSpaceMouseLead_m / lead_m * ahead_m;
        target.position_device_m = glm::clamp(place_m, -half_m, half_m);
        target.orientation_device = within_reach(turned(target.orientation_device, turning, dt_s),
                                                 last_.orientation_device, kSpaceMouseTurnLead_rad);
    }

    std::unique_ptr<SpaceMouseLine> line_;  // null: of a device that rests
    SpaceMouseSettings settings_;
    Clock& clock_;
    HandDirection direction_;
    Arm arm_;
    DeviceDescription description_;
    DeviceSample last_;
    bool may_push_ = false;
};

HandTarget beginning_of(AnyHand& hand) {
    HandTarget begin = target_of(hand, 0.0);
    begin.velocity_device_m_per_s = Vec3(0.0);
    begin.buttons = 0;
    return begin;
}

struct OpenedLine {
    SpaceMouseSettings settings;
    std::unique_ptr<SpaceMouseLine> line;
};
Result<OpenedLine> open_line(const std::string& name, const std::string& text) {
    const std::string where = where_of(name, text);
    BURIN_TRY(settings, spacemouse_settings(where, text));
    BURIN_TRY(line, SpaceMouseLine::open(where, settings.place));
    return OpenedLine{std::move(settings), std::move(line)};
}

template <typename Arm>
OpenedDevice opened(std::unique_ptr<LedBySpaceMouse<Arm>> whole, Amplifiers* amplifiers) {
    DeviceMessages* const messages = whole.get();
    OpenedDevice device = of_one_part(std::move(whole), amplifiers);
    device.messages = messages;
    return device;
}

}  // namespace

Result<void> check_spacemouse(const std::string& text) {
    BURIN_TRY(settings, spacemouse_settings(where_of(kSpaceMouse, text), text));
    if (settings.file.empty()) return {};
    return fail(where_of(kSpaceMouse, text), "takes no description: " + settings.file,
                "write " + std::string(kSpaceMouseWand) + ":" + text + " for the wand that it describes");
}

Result<void> check_spacemouse_wand(const std::string& text) {
    const auto settings = spacemouse_settings(where_of(kSpaceMouseWand, text), text);
    return settings ? Result<void>{} : std::unexpected(settings.error());
}

Result<OpenedDevice> open_spacemouse(const std::string& text, AnyHand hand, Clock& clock) {
    BURIN_TRY_DO(check_spacemouse(text));
    BURIN_TRY(open, open_line(kSpaceMouse, text));
    return opened(std::make_unique<LedBySpaceMouse<SimulatedOmni>>(std::move(open.line), open.settings,
                                                                   beginning_of(hand), clock, OmniModel{}),
                  nullptr);
}

Result<OpenedDevice> open_spacemouse_wand(const std::string& text, AnyHand hand, Clock& clock) {
    BURIN_TRY(wand, spacemouse_wand_described(text));
    BURIN_TRY(open, open_line(kSpaceMouseWand, text));
    auto led = std::make_unique<LedBySpaceMouse<SimulatedWand>>(std::move(open.line), open.settings, beginning_of(hand),
                                                                clock, std::move(wand));
    Amplifiers* const amplifiers = &led->arm();
    return opened(std::move(led), amplifiers);
}

OpenedDevice spacemouse_that_rests(Clock& clock) {
    return opened(std::make_unique<LedBySpaceMouse<SimulatedOmni>>(nullptr, SpaceMouseSettings{}, HandTarget{}, clock,
                                                                   OmniModel{}),
                  nullptr);
}

Result<OpenedDevice> spacemouse_wand_that_rests(const std::string& text, Clock& clock) {
    BURIN_TRY(wand, spacemouse_wand_described(text));
    auto led = std::make_unique<LedBySpaceMouse<SimulatedWand>>(nullptr, SpaceMouseSettings{}, HandTarget{}, clock,
                                                                std::move(wand));
    Amplifiers* const amplifiers = &led->arm();
    return opened(std::move(led), amplifiers);
}

Result<WandDescription> spacemouse_wand_described(const std::string& text) {
    BURIN_TRY(settings, spacemouse_settings(where_of(kSpaceMouseWand, text), text));
    return settings.file.empty() ? WandDescription{} : read_wand(settings.file);
}

std::vector<DevicePresence> look_for_spacemouse_wands() {
    std::vector<DevicePresence> found = look_for_spacemice();
    for (DevicePresence& one : found) one.name.insert(std::string_view(kSpaceMouse).size(), "-wand");
    return found;
}

std::string spacemouse_file_of(const std::string& text) {
    const auto settings = spacemouse_settings({}, text);
    return settings ? settings->file : std::string();
}

}  // namespace burin::devices
