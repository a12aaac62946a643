// SPDX-License-Identifier: MIT
// The library that stands in for liblsl, loaded for a test, and waits for what becomes of it.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "devices/drivers/library_beside.hpp"
#include "devices/drivers/loaded_library.hpp"
#include "haptics/tick_record.hpp"
#include "session/stream/lsl_streams.hpp"
#include "tests/session/stream/lsl_stand_in.hpp"

namespace burin::session {

inline constexpr const char* kStandInLsl = "libburin_lsl_stand_in.so";

inline test::LslStandIn& stand_in_lsl() {
    devices::LoadedLibrary loaded(devices::library_beside(kStandInLsl));
    test::LslStandInOf* of = nullptr;
    loaded.find("burin_lsl_stand_in", of);
    return *of();
}

// A fresh state for a test, which ends with no rule of the header broken and nothing left over.
class StandInLsl {
public:
    StandInLsl() : lsl(stand_in_lsl()), api(devices::load_lsl_api(devices::library_beside(kStandInLsl)).value()) {
        const std::lock_guard lock(lsl.mutex);
        lsl.outlets.clear();
        lsl.remotes.clear();
        lsl.violations.clear();
        lsl.error.clear();
        lsl.strings = 0;
        lsl.clock_offset_s = 0.0;
        lsl.refuses_outlets = lsl.refuses_pushes = lsl.blocks_pushes = false;
    }
    ~StandInLsl() {
        const std::lock_guard lock(lsl.mutex);
        for (const std::string& violation : lsl.violations) ADD_FAILURE() << violation;
        for (const auto& outlet : lsl.outlets) EXPECT_FALSE(outlet->is_open) << outlet->name;
        for (const auto& remote : lsl.remotes) EXPECT_EQ(remote->inlets, 0) << remote->name;
        EXPECT_EQ(lsl.strings, 0);
    }
    StandInLsl(const StandInLsl&) = delete;
    StandInLsl& operator=(const StandInLsl&) = delete;

    // Waits until it holds, but not for ever.
    void wait_until(const std::function<bool()>& holds) {
        std::unique_lock lock(lsl.mutex);
        EXPECT_TRUE(lsl.changed.wait_for(lock, std::chrono::minutes(2), holds));
    }
    void set(const std::function<void()>& change) {
        const std::lock_guard lock(lsl.mutex);
        change();
        lsl.changed.notify_all();
    }
    // Returns a stream of markers that can be heard.
    std::shared_ptr<test::LslStream> remote(const std::string& name, std::int32_t channels = 1) {
        auto stream = std::make_shared<test::LslStream>();
        stream->name = name;
        stream->type = "Markers";
        stream->uid = "uid of " + name;
        stream->source_id = "another machine";
        stream->channels = channels;
        stream->format = 3;
        set([&] { lsl.remotes.push_back(stream); });
        return stream;
    }
    [[nodiscard]] std::shared_ptr<test::LslStream> outlet(const std::string& name) {
        const std::lock_guard lock(lsl.mutex);
        for (const auto& one : lsl.outlets)
            if (one->name == name) return one;
        ADD_FAILURE() << "no stream " << name;
        return std::make_shared<test::LslStream>();
    }

    test::LslStandIn& lsl;
    devices::LslApi api;
};

// A part of a hand with one point, as a stylus is.
inline StreamedPart stylus_part(const std::string& name) {
    StreamedPart part;
    part.name = name;
    part.device.name = "a stylus";
    return part;
}

inline haptics::TickRecord made_tick(std::uint64_t number, Nanoseconds time_ns) {
    haptics::TickRecord tick;
    tick.tick = number;
    tick.time_ns = time_ns;
    tick.sample.position_device_m = Vec3(0.001 * static_cast<double>(number), 0.02, -0.03);
    tick.wanted.force_device_N = Vec3(0.0, 5.0, 0.0);
    tick.gate.given.force_device_N = Vec3(0.0, 3.3, 0.0);
    tick.contact.point_count = 1;
    return tick;
}

}  // namespace burin::session
