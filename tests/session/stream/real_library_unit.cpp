// SPDX-License-Identifier: MIT
// Streams by liblsl itself, where BURIN_REAL_LIBLSL names it: what a real inlet receives of a session's outlets, and
// markers of a real outlet. It needs a network interface, if only the machine's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/drivers/loaded_library.hpp"
#include "session/stream/stream_text.hpp"
#include "tests/session/stream/stand_in.hpp"

namespace burin::session {
namespace {

// What a recorder calls besides.
struct LslRecorder {
    std::int32_t (*resolve)(devices::LslInfo*, std::uint32_t, const char*, const char*, std::int32_t, double) = nullptr;
    unsigned long (*pull)(devices::LslInlet, float*, double*, unsigned long, unsigned long, double,
                          std::int32_t*) = nullptr;
    devices::LslInfo (*full_info)(devices::LslInlet, double, std::int32_t*) = nullptr;
    char* (*xml_of)(devices::LslInfo) = nullptr;

    explicit LslRecorder(const std::string& library) {
        devices::LoadedLibrary loaded(library);
        loaded.find("lsl_resolve_byprop", resolve);
        loaded.find("lsl_pull_chunk_f", pull);
        loaded.find("lsl_get_fullinfo", full_info);
        loaded.find("lsl_get_xml", xml_of);
        EXPECT_EQ(loaded.missing(), "");
    }
};

}  // namespace

TEST(RealLsl, ReceivesEveryTickAtItsTimeAndSendsMarkers) {
    const char* const library = std::getenv("BURIN_REAL_LIBLSL");
    if (library == nullptr) GTEST_SKIP() << "BURIN_REAL_LIBLSL names no liblsl to try";
    const auto api = devices::load_lsl_api(library);
    ASSERT_TRUE(api) << api.error().line();
    const LslRecorder recorder(library);
    MonotonicClock clock;
    // A marker stream of another program.
    const devices::LslInfo keyboard =
        api->create_info("Keyboard", "Markers", 1, 0.0, devices::LslFormat::string, "a keyboard");
    const devices::LslOutlet keys = api->create_outlet(keyboard, 0, 360);
    api->destroy_info(keyboard);
    ASSERT_NE(keys, nullptr) << api->why();
    StreamPlan plan;
    plan.parts = {stylus_part("right")};
    plan.source = "burin-test-" + std::to_string(clock.now_ns());
    plan.markers = marker_predicate("").value();
    auto streams = LslStreams::open(*api, plan, clock);
    ASSERT_TRUE(streams) << streams.error().line();

    devices::LslInfo found = nullptr;
    const std::string source_id = plan.source + " ticks right";
    ASSERT_EQ(recorder.resolve(&found, 1, "source_id", source_id.c_str(), 1, 30.0), 1) << api->why();
    const auto channels = static_cast<std::size_t>(api->channels_of(found));
    const devices::LslInlet inlet = api->create_inlet(found, 360, 0, 0);
    api->destroy_info(found);
    std::int32_t error = 0;
    api->open_stream(inlet, 30.0, &error);
    ASSERT_EQ(error, 0) << api->why();
    const devices::LslInfo full = recorder.full_info(inlet, 30.0, &error);
    char* const xml = recorder.xml_of(full);
    EXPECT_TRUE(std::string(xml).contains("<label>commanded_force_device_x_N</label>")) << xml;
    EXPECT_TRUE(std::string(xml).contains("<unit>N</unit>"));
    api->destroy_string(xml);
    api->destroy_info(full);
    std::string told;
    for (int i = 0; i < 3000 && !told.contains("markers of Keyboard are heard"); ++i) {
        for (const std::string& message : (*streams)->take_messages()) told += message + "\n";
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_TRUE(told.contains("markers of Keyboard are heard")) << told;

    constexpr std::size_t kTicks = 5000;
    std::vector<Nanoseconds> ticked_ns;
    std::vector<double> pushed_s;
    Nanoseconds due_ns = clock.now_ns();
    for (std::size_t i = 1; i <= kTicks; ++i) {
        clock.sleep_until(due_ns += 1'000'000);
        ticked_ns.push_back(clock.now_ns());
        (*streams)->tick(0, made_tick(i, ticked_ns.back()));
        if (i % 500 != 0) continue;
        const std::string text = "key " + std::to_string(i / 500);
        const char* texts = text.c_str();
        pushed_s.push_back(seconds(ticked_ns.back()));
        EXPECT_EQ(api->push_text(keys, &texts, api->local_clock(), 1), 0);
    }
    std::vector<double> stamps_s;
    std::vector<float> numbers;
    std::vector<float> values(channels * 1024);
    std::array<double, 1024> stamps{};
    for (int empty = 0; stamps_s.size() < kTicks && empty < 20;) {
        const unsigned long got =
            recorder.pull(inlet, values.data(), stamps.data(), values.size(), stamps.size(), 1.0, &error);
        ASSERT_EQ(error, 0) << api->why();
        empty = got == 0 ? empty + 1 : 0;
        for (std::size_t i = 0; i < got / channels; ++i) {
            stamps_s.push_back(stamps[i]);
            numbers.push_back(values[i * channels]);
        }
    }
    EXPECT_EQ(stamps_s.size(), kTicks) << "none is lost";
    const double correction_s = api->time_correction(inlet, 10.0, &error);
    double worst_s = 0.0;
    for (std::size_t i = 0; i < stamps_s.size(); ++i) {
        ASSERT_EQ(numbers[i], static_cast<float>(i + 1));
        ASSERT_TRUE(i == 0 || stamps_s[i] > stamps_s[i - 1]) << i;
        worst_s = std::max(worst_s, std::abs(stamps_s[i] - stamps_s[0] - seconds(ticked_ns[i] - ticked_ns[0])));
    }
    EXPECT_LT(worst_s, 1e-7) << "stamps are the ticks' own";
    std::printf("liblsl %s: %zu of %zu samples, %.2f a second, correction %.1f us, stamps off by %.3f us at most\n",
                api->version().c_str(), stamps_s.size(), kTicks,
                static_cast<double>(stamps_s.size() - 1) / (stamps_s.back() - stamps_s.front()), correction_s * 1e6,
                worst_s * 1e6);
    std::vector<EventMark> markers;
    for (int i = 0; i < 3000 && markers.size() < pushed_s.size(); ++i) {
        std::ranges::move((*streams)->take_markers(), std::back_inserter(markers));
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_EQ(markers.size(), pushed_s.size());
    double off_s = 0.0;
    for (std::size_t i = 0; i < markers.size(); ++i) {
        EXPECT_EQ(markers[i].value, "Keyboard: key " + std::to_string(i + 1));
        off_s = std::max(off_s, std::abs(seconds(markers[i].time_ns) - pushed_s[i]));
    }
    std::printf("markers: %zu, within %.1f us of when they were sent\n", markers.size(), off_s * 1e6);
    api->destroy_inlet(inlet);
    const StreamFigures figures = (*streams)->close();
    std::printf("%s\n", figures.text().c_str());
    EXPECT_EQ(figures.ticks, kTicks);
    EXPECT_FALSE(figures.is_left_behind);
    api->destroy_outlet(keys);
}

}  // namespace burin::session
