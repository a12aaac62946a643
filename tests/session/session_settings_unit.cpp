// SPDX-License-Identifier: MIT
// The first line of a recording: what an option takes there is what it takes on the command line.
#include "session/state/session_settings.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace burin::session {
namespace {

std::string refusal_of(const std::string& settings) {
    const auto read = options_as_recorded("burin sculpt " + settings, SessionSetup{});
    return read ? "" : read.error().line();
}

}  // namespace

TEST(SettingsOfARecording, BeyondTheBoundsOfTheCommandLineAreRefusedByThem) {
    for (const auto& [settings, said] : std::vector<std::pair<std::string, std::string>>{
             {"--width 9", "--width 9 is not from 64 to 8192"},
             {"--height 8193", "--height 8193 is not from 64 to 8192"},
             {"--resolution 2049", "--resolution 2049 is not from 16 to 2048"},
             {"--undo-memory 0", "--undo-memory 0 is not from 1 to 1048576"},
             {"--sweep-tolerance nan", "--sweep-tolerance nan is not from 0.001 to 1000"},
             {"--smooth-strength 1.5", "--smooth-strength 1.5 is not from 0 to 1"},
             {"--room 3", "--room 3 is not from 0 to 2"},
             {"--samples 3", "--samples 3 is not one of 0, 1, 4"},
             {"--width 99999999999999999999", "--width 99999999999999999999 is no value of that option"},
             {"--resolution", "--resolution has no value"},
             {"--close-holes no", "--close-holes no is no value of that option"},
             {"--flavour sweet", "--flavour is no option that a session knows"}}) {
        EXPECT_NE(refusal_of(settings).find(said), std::string::npos) << settings << ": " << refusal_of(settings);
    }
    EXPECT_EQ(refusal_of("--width 64 --height 8192 --samples 4 --resolution 16 --close-holes"), "");
}

namespace {

// An option of a session: puts it away from its default, and tells its value as text.
struct SetOption {
    const char* name;
    std::function<void(SessionSetup&)> change;
    std::function<std::string(const SessionSetup&)> value;
};

template <typename Member>
SetOption option(const char* name, Member member, auto other) {
    return {name, [=](SessionSetup& o) { member(o) = other; },
            [=](const SessionSetup& o) {
                std::ostringstream text;
                const auto& value = member(o);
                if constexpr (requires { value.has_value(); }) {
                    text << value.has_value();
                    if (!value) return text.str();
                    if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(*value)>>)
                        text << ' ' << static_cast<int>(*value);
                    else
                        text << ' ' << *value;
                } else if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(value)>>) {
                    text << static_cast<int>(value);
                } else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, toolbox::Mirror>) {
                    text << toolbox::name_of(value);
                } else {
                    text << value;
                }
                return text.str();
            }};
}

// Member access that works for options and for constant ones.
#define BURIN_OF(path) [](auto& o) -> auto& { return o.path; }

const std::vector<SetOption>& every_option() {
    static const std::vector<SetOption> options{
        option("--world", BURIN_OF(scene.world), "a b.wrl"),
        option("--no-workpiece", BURIN_OF(scene.no_workpiece), true),
        option("--points", BURIN_OF(hands.points), "top,bottom"),
        option("--workpiece", BURIN_OF(carve.workpiece.source), "my part.stl"),
        option("--units", BURIN_OF(carve.workpiece.units), LengthUnit::mm),
        option("--export-units", BURIN_OF(carve.exports.units), LengthUnit::cm),
        option("--close-holes", BURIN_OF(carve.workpiece.close_holes), true),
        option("--resolution", BURIN_OF(carve.workpiece.resolution), 97),
        option("--room", BURIN_OF(carve.workpiece.room), 0.25),
        option("--tool", BURIN_OF(hands.tool.shape), "box:0.01,0.02,0.03"),
        option("--operation", BURIN_OF(hands.tool.operation), compute::Operation::fill),
        option("--material", BURIN_OF(hands.tool.material), "1,2,3"),
        option("--sweep-tolerance", BURIN_OF(hands.tool.sweep_tolerance_cells), 0.25),
        option("--smooth-strength", BURIN_OF(hands.tool.smooth_strength), 0.75),
        option("--mirror", BURIN_OF(carve.mirror), toolbox::Mirror{{true, false, true}}),
        option("--hardness", BURIN_OF(carve.feel.hardness), "oak"),
        option("--yield", BURIN_OF(carve.feel.yield_kPa), 12.5),
        option("--grain", BURIN_OF(carve.feel.grain_mm), 1.5),
        option("--stiffness", BURIN_OF(carve.feel.stiffness_N_per_m), 433.0),
        option("--friction", BURIN_OF(carve.feel.friction), 0.31),
        option("--undo-memory", BURIN_OF(carve.undo_memory_MiB), std::size_t{77}),
        option("--device", BURIN_OF(hands.device), "simulated-wand:w.toml"),
        option("--wall", BURIN_OF(desk.wall), "cave.toml"),
        option("--stereo", BURIN_OF(desk.stereo), "side-by-side"),
        option("--swap-eyes", BURIN_OF(desk.swap_eyes), true),
        option("--edge-comfort", BURIN_OF(desk.edge_comfort), EdgeComfort::off),
        option("--width", BURIN_OF(desk.width), 640),
        option("--height", BURIN_OF(desk.height), 480),
        option("--panel-window", BURIN_OF(desk.panel_window), true),
        option("--samples", BURIN_OF(desk.samples), 4u),
    };
    return options;
}
#undef BURIN_OF

}  // namespace

// A recording that forgets one of them is done again as another session, and nobody is told.
TEST(SettingsOfARecording, HoldEveryOptionAndGiveItBack) {
    SessionSetup all;
    all.carve.workpiece.units = LengthUnit::m;  // a line without a unit is an old one
    all.hands.tool.shape = "ball:0.01";
    for (const SetOption& one : every_option()) {
        SessionSetup changed = all;
        const std::string usual = one.value(changed);
        one.change(changed);
        ASSERT_NE(one.value(changed), usual) << one.name << " was to be away from its default";
        const std::string line = settings_line(changed);
        const auto back = options_as_recorded(line, SessionSetup{});
        ASSERT_TRUE(back) << back.error().line();
        for (const SetOption& each : every_option())
            EXPECT_EQ(each.value(back->options), each.value(changed)) << each.name << " of " << line;
    }
    for (const SetOption& one : every_option()) one.change(all);
    const std::string line = settings_line(all);
    std::size_t named = 0;
    for (std::size_t at = line.find(" --"); at != std::string::npos; at = line.find(" --", at + 1)) ++named;
    EXPECT_EQ(named, every_option().size()) << "an option that this test does not know: " << line;
}

TEST(SettingsOfARecording, AnOptionIsFoundWhateverElseIsOnTheLine) {
    const std::string line = "burin sculpt --workpiece \"a --device.stl\" --close-holes --device simulated-wand:w.toml";
    EXPECT_EQ(*option_on(line, "--device"), "simulated-wand:w.toml");
    EXPECT_EQ(*option_on(line, "--close-holes"), "");
    EXPECT_EQ(*option_on(line, "--points"), "");
    EXPECT_EQ(*option_on("somebody's own --device x", "--device"), "");
}

}  // namespace burin::session
