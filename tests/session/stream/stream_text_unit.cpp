// SPDX-License-Identifier: MIT
// Text on its way into streams and out of them, the columns that are streamed, and libraries that are not liblsl.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <string>
#include <vector>

#include "devices/drivers/library_beside.hpp"
#include "devices/lsl/lsl_api.hpp"
#include "haptics/tick_record.hpp"
#include "session/drive/session_streams.hpp"
#include "session/options/session_setup.hpp"
#include "session/record/session_recording.hpp"
#include "session/stream/stream_text.hpp"
#include "session/stream/streamed_columns.hpp"

namespace burin::session {

TEST(StreamText, KeepsUtf8AndBlanksWhatIsNone) {
    struct Row {
        const char *given, *kept;
    };
    for (const Row& row :
         {Row{"bolt", "bolt"}, Row{"", ""},
          Row{"\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80", "\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80"}, Row{"a\nb\tc", "a b c"},
          Row{"\xc0\xaf", "  "}, Row{"\xed\xa0\x80", "   "}, Row{"\xf4\x90\x80\x80", "    "}, Row{"\xc2\x85", " "},
          Row{"\xef\xbf\xbf", " "}, Row{"\xe2\x82", "  "}, Row{"<&>\"'", "<&>\"'"}})
        EXPECT_EQ(streamable(row.given), row.kept);
    EXPECT_EQ(streamable("abc\xc3\xa4", 4), "abc") << "no half of a character";
    EXPECT_EQ(streamable(std::string(10000, 'x')).size(), kLongestMarker);
}

TEST(StreamText, MarkersAreFoundByNothingANameOrAPredicate) {
    EXPECT_EQ(marker_predicate("").value(), "type='Markers'");
    EXPECT_EQ(marker_predicate("Key board").value(), "type='Markers' and name='Key board'");
    EXPECT_EQ(marker_predicate("Bo's").value(), "type='Markers' and name=\"Bo's\"");
    EXPECT_EQ(marker_predicate("hostname='lab' or starts-with(name,'K')").value(),
              "type='Markers' and (hostname='lab' or starts-with(name,'K'))");
    EXPECT_FALSE(marker_predicate("Bo's \"keys\""));
}

TEST(StreamedColumns, AreTheRecordingsOwnValues) {
    haptics::TickRecord tick;
    tick.tick = (std::uint64_t{3} << 24) + 5;
    tick.sample.position_device_m = Vec3(0.1, 0.2, 0.3);
    tick.wanted.force_device_N = Vec3(1.0, 2.0, 3.0);
    tick.gate.given.force_device_N = Vec3(4.0, 5.0, 6.0);
    tick.flags = haptics::kTickInContact | haptics::kTickHeldOver;
    tick.contact.point_count = 1;
    tick.contact.points[0].penetration_m = 0.004;
    tick.contact.points[0].object = 7;
    for (const std::uint32_t points : {1u, 2u, 20u}) {
        const record::RowShape shape{.joints = devices::kMostJoints, .points = points, .one_way = true};
        const StreamedColumns streamed(shape);
        ASSERT_LE(streamed.all().size(), kMostStreamedColumns);
        std::array<float, kMostStreamedColumns> values{};
        streamed.write(tick, std::span(values).first(streamed.all().size()));
        const auto value = [&](const std::string& label) {
            for (std::size_t i = 0; i < streamed.all().size(); ++i)
                if (streamed.all()[i].label == label) return values[i];
            ADD_FAILURE() << label;
            return 0.0f;
        };
        EXPECT_EQ(value("tick"), 5.0f);
        EXPECT_EQ(value("position_device_y_m"), 0.2f);
        EXPECT_EQ(value("desired_force_device_z_N"), 3.0f);
        EXPECT_EQ(value("commanded_force_device_x_N"), 4.0f);
        EXPECT_EQ(value("flags"), static_cast<float>(tick.flags));
        EXPECT_EQ(value("penetration0_m"), 0.004f);
        EXPECT_EQ(value("object0"), 7.0f);
        EXPECT_EQ(value("joint7"), 0.0f);
    }
}

TEST(LslLibrary, ThatIsAbsentIsNamedWithWhereItCanBeHadAndItsVariable) {
    ::setenv(devices::kLslPathVariable, "/nowhere/liblsl.so", 1);
    const auto api = devices::load_lsl_api();
    const devices::DevicePresence presence = devices::look_for_lsl();
    RecordSetup record;
    record.lsl = true;
    const auto checked = check_streams(record);
    ::unsetenv(devices::kLslPathVariable);
    ASSERT_FALSE(api);
    for (const char* words : {"/nowhere/liblsl.so", "github.com/sccn/liblsl/releases", "BURIN_LIBLSL"})
        EXPECT_TRUE(api.error().line().contains(words)) << api.error().line();
    EXPECT_EQ(presence.presence, devices::Presence::absent);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().line(), api.error().line());
}

TEST(LslLibrary, ThatLacksAFunctionOrSpeaksAnotherProtocolIsUnusable) {
    const auto lacking = devices::load_lsl_api(devices::library_beside("libburin_emulated_hd.so"));
    ASSERT_FALSE(lacking);
    EXPECT_TRUE(lacking.error().line().contains("has no function lsl_protocol_version")) << lacking.error().line();
    const std::string other = devices::library_beside("libburin_lsl_stand_in_2.so");
    const auto newer = devices::load_lsl_api(other);
    ASSERT_FALSE(newer);
    EXPECT_TRUE(newer.error().line().contains("protocol 2.00")) << newer.error().line();
    ::setenv(devices::kLslPathVariable, other.c_str(), 1);
    EXPECT_EQ(devices::look_for_lsl().presence, devices::Presence::unusable);
    ::setenv(devices::kLslPathVariable, devices::library_beside("libburin_lsl_stand_in.so").c_str(), 1);
    const devices::DevicePresence found = devices::look_for_lsl();
    ::unsetenv(devices::kLslPathVariable);
    EXPECT_EQ(found.presence, devices::Presence::there);
    EXPECT_TRUE(found.cause.contains("liblsl 1.17")) << found.cause;
}

TEST(StreamOptions, AreRefusedWhereNothingCouldBeStreamedOrKept) {
    RecordSetup record;
    EXPECT_TRUE(check_streams(record));
    record.lsl = true;
    record.path = "log.txt";
    const auto as_text = check_streams(record);
    ASSERT_FALSE(as_text);
    EXPECT_TRUE(as_text.error().line().contains("FILE.session")) << as_text.error().line();
    record = {};
    record.lsl_markers = "";
    const auto nowhere = check_streams(record);
    ASSERT_FALSE(nowhere);
    EXPECT_TRUE(nowhere.error().line().contains("--record FILE.session")) << nowhere.error().line();
}

}  // namespace burin::session
