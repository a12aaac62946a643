// SPDX-License-Identifier: MIT
// libFuzzer body of the reader of a SpaceMouse's reports, of the descriptor of HID devices and of the settings.
// Whatever the bytes: no fault; a report that is read has its length and numbers from -1 to 1, and rates that are
// finite and no faster than the fastest; and what is written of it is read as it was.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "devices/emulators/spacemouse_wire.hpp"
#include "devices/spacemouse/spacemouse_rates.hpp"
#include "devices/spacemouse/spacemouse_report.hpp"

namespace {

using namespace burin;
using namespace burin::devices;

void require_spacemouse(bool condition) {
    if (!condition) std::abort();
}

void check_deflection(const Vec3& deflection) {
    require_spacemouse(finite(deflection));
    for (int axis = 0; axis < 3; ++axis) require_spacemouse(std::abs(deflection[axis]) <= 1.0);
    const Vec3 rate = spacemouse_rate(deflection, 0.1, 0.5);
    require_spacemouse(finite(rate) && glm::length(rate) <= 0.5 * (1.0 + 1e-12));
    require_spacemouse(std::abs(glm::length(turned(Quat(1.0, 0.0, 0.0, 0.0), rate, 0.05)) - 1.0) < 1e-9);
}

void check_report(std::span<const std::byte> bytes, SpaceMouseKeys keys) {
    const auto report = spacemouse_report(bytes, keys);
    if (!report) return;
    require_spacemouse(!bytes.empty());
    if (report->push) check_deflection(*report->push);
    if (report->turn) check_deflection(*report->turn);
    if (report->push && report->turn) {
        const auto again = spacemouse_report(cap_joined_report(*report->push, *report->turn), keys);
        require_spacemouse(again == report);
    } else if (report->push) {
        require_spacemouse(bytes.size() == 7 && spacemouse_report(cap_push_report(*report->push), keys) == report);
    } else if (report->turn) {
        require_spacemouse(bytes.size() == 7 && spacemouse_report(cap_turn_report(*report->turn), keys) == report);
    }
    if (report->buttons) require_spacemouse(bytes.size() >= 2 && bytes[0] == std::byte{3});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
    for (const SpaceMouseKeys keys : {SpaceMouseKeys::plain, SpaceMouseKeys::pro, SpaceMouseKeys::receiver})
        check_report(bytes, keys);
    static_cast<void>(is_multi_axis(bytes));
    const auto settings = spacemouse_settings("device", std::string(reinterpret_cast<const char*>(data), size));
    if (settings)
        require_spacemouse(settings->speed_m_per_s >= 0.001 && settings->speed_m_per_s <= 10.0 &&
                           settings->dead_zone >= 0.0 && settings->dead_zone <= 0.9);
    return 0;
}
