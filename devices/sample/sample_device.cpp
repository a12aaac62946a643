// SPDX-License-Identifier: MIT
#include "devices/sample/sample_device.hpp"

#include "base/try.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace burin::devices {
namespace {

// ---- The bytes

void put_float(std::span<std::byte> to, double value) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (std::size_t i = 0; i < 4; ++i) to[i] = static_cast<std::byte>(bits >> (8 * i));
}

double float_in(std::span<const std::byte> from) noexcept {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i) bits |= std::to_integer<std::uint32_t>(from[i]) << (8 * i);
    return double{std::bit_cast<float>(bits)};
}

// ---- The made-up device at the other end: replace it by a port

// A mass on a damped spring, whose free end goes round, so that somebody seems to move it.
class SwingingArm final : public SampleCable {
public:
    [[nodiscard]] std::span<const std::byte> exchange(const SampleCommandBytes& command) noexcept override {
        constexpr double kMass_kg = 0.1, kSpring_N_per_m = 200.0, kDamping_Ns_per_m = 4.0, kRound_m = 0.03;
        const std::span<const std::byte> bytes = command;
        Vec3 force_N;
        for (int axis = 0; axis < 3; ++axis)
            force_N[axis] = float_in(bytes.subspan(4 * static_cast<std::size_t>(axis)));
        time_s_ += kServedTurn_s;
        const Vec3 end_m = kRound_m * Vec3(std::sin(time_s_), 0.0, std::cos(time_s_) - 1.0);
        force_N += kSpring_N_per_m * (end_m - position_m_) - kDamping_Ns_per_m * velocity_m_per_s_;
        velocity_m_per_s_ += kServedTurn_s / kMass_kg * force_N;
        position_m_ += kServedTurn_s * velocity_m_per_s_;
        for (int axis = 0; axis < 3; ++axis)
            put_float(std::span(report_).subspan(4 * static_cast<std::size_t>(axis)), position_m_[axis]);
        return report_;
    }

private:
    double time_s_ = 0.0;
    Vec3 position_m_{0.0}, velocity_m_per_s_{0.0};
    SampleReportBytes report_{};
};

// What the line has to say; 0 is nothing.
enum SampleNotice : std::uint32_t { kSampleGone = 1, kSampleBack };

// ---- What it can do: from its data sheet; what is not known stays 0, and nothing is promised that rests on it

DeviceDescription sample_description() {
    static const OmniModel model{.workspace_m = Vec3(0.2, 0.2, 0.2),
                                 .resolution_m = 0.00002,
                                 .apparent_mass_kg = 0.1,
                                 .friction_N = 0.1,
                                 .damping_Ns_per_m = 0.5,
                                 .max_force_N = kSampleMost_N,
                                 .max_stiffness_N_per_m = 1000.0};
    DeviceDescription description = describe_served_arm("sample of a driver", model, 0.0);
    description.felt_by_person = false;  // nobody holds it; of a device that is there leave this line out
    description.has_buttons = false;
    return description;
}

}  // namespace

SampleCommandBytes sample_command_bytes(const Vec3& force_device_N) noexcept {
    const double size_N = glm::length(force_device_N);
    const Vec3 given_N = size_N > kSampleMost_N ? force_device_N * (kSampleMost_N / size_N) : force_device_N;
    SampleCommandBytes bytes{};
    for (int axis = 0; axis < 3; ++axis)
        put_float(std::span(bytes).subspan(4 * static_cast<std::size_t>(axis)), given_N[axis]);
    return bytes;
}

std::optional<SampleReport> sample_report(std::span<const std::byte> packet) noexcept {
    if (packet.size() != SampleReportBytes{}.size()) return std::nullopt;
    SampleReport report;
    for (int axis = 0; axis < 3; ++axis)
        report.position_device_m[axis] = float_in(packet.subspan(4 * static_cast<std::size_t>(axis)));
    report.buttons = std::to_integer<std::uint32_t>(packet[12]);
    if (!finite(report.position_device_m)) return std::nullopt;
    return report;
}

Result<std::unique_ptr<SampleCable>> open_sample_cable() { return std::make_unique<SwingingArm>(); }

Result<void> SampleLine::open() {
    BURIN_TRY(cable, open_cable_());
    cable_ = std::move(cable);
    silent_ = 0;
    if (std::exchange(is_gone_, false)) notice_ = {kSampleBack, 0};
    return {};
}

bool SampleLine::turn(const DeviceWrench& wrench, ServedState& state) noexcept {
    const auto report = sample_report(cable_->exchange(sample_command_bytes(wrench.force_device_N)));
    if (!report) {
        // Where nothing is known of now there is no force; the servo leaves it off for a while after.
        state.fault = DeviceFault::disconnected;
        if (++silent_ < kSampleSilent) return true;
        if (!std::exchange(is_gone_, true)) notice_ = {kSampleGone, silent_};
        return false;
    }
    silent_ = 0;
    state.pose_device.position_m = report->position_device_m;
    state.buttons = report->buttons;
    return true;
}

std::string SampleLine::words_for(const LineNotice& notice) const {
    switch (notice.what) {
        case kSampleGone:
            return std::string(kSample) + ": has said nothing for " + std::to_string(notice.number) +
                   " ms; look after its cable";
        case kSampleBack: return std::string(kSample) + ": is back";
        default: return {};
    }
}

Result<OpenedDevice> open_sample(const std::string& text, AnyHand hand, Clock& clock) {
    if (!text.empty())
        return fail("haptic device " + std::string(kSample), "takes no description: " + text,
                    "write " + std::string(kSample) + " alone");
    BURIN_TRY(servo, LineServo::open(std::make_unique<SampleLine>(open_sample_cable)));
    return served_arm(std::move(servo), sample_description(), std::move(hand), clock);
}

OpenedDevice sample_that_rests(Clock& clock) { return arm_that_rests(sample_description(), clock); }

std::vector<DevicePresence> look_for_samples() {
    return {{Presence::there, kSample, "a driver to copy, of a device that is made up: it needs nothing", {}}};
}

}  // namespace burin::devices
