// SPDX-License-Identifier: MIT
#include "session/record/carved_by.hpp"

#include <cstdint>
#include <optional>

namespace burin::session {

std::string carved_by(const compute::CarvingEngine& engine) {
    std::string text = engine.name();
    const std::optional<compute::DeviceTraffic> traffic = engine.traffic();
    if (!traffic) return text;
    const auto add = [&](std::uint64_t number, const char* of) { text += std::to_string(number) + of; };
    text += ": ";
    add(traffic->submissions, " submissions, ");
    add(traffic->blocking_waits, " blocking waits, ");
    add(traffic->bytes_to_device, " bytes to the device, ");
    add(traffic->bytes_to_host, " bytes back, at most ");
    add(traffic->most_memory_bytes, " bytes of its memory");
    return text;
}

}  // namespace burin::session
