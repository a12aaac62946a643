// SPDX-License-Identifier: MIT
// The streams that a session gives: ticks of each part of the hands, and what happens. Which values a tick has, and
// what they are called, is streamed_columns.hpp's; docs/streaming.md describes the streams.
//
// Opened on one thread, then used and destroyed on another: what is pushed may wait in the library for as long as it
// likes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "devices/haptic/haptic_device.hpp"
#include "devices/lsl/lsl_api.hpp"
#include "haptics/contact/probe.hpp"
#include "session/stream/stream_clock.hpp"
#include "session/stream/streamed_columns.hpp"

namespace burin::session {

struct StreamedPart {
    std::string name;  // "right", "left index"; of a lone part the device's
    devices::DeviceDescription device;
    haptics::Probe probe;
    double rate_Hz = 1000.0;
};

class StreamOutlets {
public:
    // `source` begins the identifiers of all its streams: no other session has it. An Error says which stream the
    // library did not make, and why.
    [[nodiscard]] static Result<StreamOutlets> open(const devices::LslApi& api, std::span<const StreamedPart> parts,
                                                    const StreamClock& clock, const std::string& source);
    ~StreamOutlets();
    StreamOutlets(StreamOutlets&& other) noexcept;
    StreamOutlets& operator=(StreamOutlets&&) = delete;

    [[nodiscard]] const StreamedColumns& columns(std::size_t part) const { return parts_[part].columns; }
    // Push samples of a part, a stamp for each, and an event; false where the library has refused.
    [[nodiscard]] bool push(std::size_t part, std::span<const float> values, std::span<const double> stamps_s);
    [[nodiscard]] bool push_event(const std::string& marker, double stamp_s);

private:
    struct Part {
        StreamedColumns columns;
        devices::LslOutlet outlet = nullptr;
    };
    explicit StreamOutlets(const devices::LslApi& api) : api_(api) {}
    [[nodiscard]] Result<void> open_ticks(const StreamedPart& part, const StreamClock& clock,
                                          const std::string& source);
    [[nodiscard]] Result<void> open_events(const StreamClock& clock, const std::string& source);

    devices::LslApi api_;
    std::vector<Part> parts_;
    devices::LslOutlet events_ = nullptr;
};

}  // namespace burin::session
