// SPDX-License-Identifier: MIT
// What Haply's service says and takes, against messages written by hand after its maker's documentation.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "base/json.hpp"
#include "devices/haply/inverse3_words.hpp"

namespace burin::devices {
namespace {

const std::string kWholeState =
    R"({"session_id":7,"inverse3":[{"device_id":"049D","config":{"type":"inverse3","preset":"defaults",)"
    R"("basis":{"permutation":"XYZ"},"mount":{}},"state":{"cursor_position":{"x":0.01,"y":-0.15,"z":0.19},)"
    R"("cursor_velocity":{"x":0.0,"y":0.0,"z":0.0}},"status":{"calibrated":true,"in_use":false,)"
    R"("power_supply":true,"ready":true,"started":true}}],"wireless_verse_grip":[{"device_id":"61548",)"
    R"("state":{"orientation":{"w":0.6,"x":0.0,"y":0.0,"z":0.8},"buttons":{"a":true,"b":false,"c":true},"hall":0}}]})";

}  // namespace

TEST(Inverse3Words, AStateIsReadIntoTheDeviceFrame) {
    const auto words = read_inverse3(kWholeState);
    ASSERT_TRUE(words);
    ASSERT_EQ(words->devices.size(), 1u);
    const Inverse3State* const device = inverse3_of(*words, "049D");
    ASSERT_NE(device, nullptr);
    EXPECT_EQ(inverse3_of(*words, "049E"), nullptr);
    ASSERT_TRUE(device->position_m);
    // y is away from the user, who is at +z; z is up; the middle is at (0, -0.13, 0.16).
    EXPECT_LT(glm::distance(*device->position_m, Vec3(0.01, 0.03, 0.02)), 1e-12);
    EXPECT_EQ(device->trouble, Inverse3Trouble::none);
    ASSERT_TRUE(words->orientation);
    EXPECT_GT(std::abs(glm::dot(*words->orientation, Quat(0.6, 0.0, 0.8, 0.0))), 1.0 - 1e-12) << "about what is up";
    EXPECT_EQ(words->buttons, 5u);
    EXPECT_TRUE(words->takes_vector);
}

TEST(Inverse3Words, AnOlderVersionIsKnownByWhatItsFirstStateLacks) {
    const auto words = read_inverse3(
        R"({"inverse3":[{"device_id":"0A","config":{"type":"inverse3"},"state":{"cursor_position":)"
        R"({"x":0,"y":0,"z":0}}}],"verse_grip":[{"state":{"button":true,"orientation":{"w":1,"x":0,"y":0,"z":0}}}]})");
    ASSERT_TRUE(words);
    EXPECT_FALSE(words->takes_vector);
    EXPECT_EQ(words->devices[0].trouble, std::nullopt) << "it does not say";
    EXPECT_EQ(words->buttons, 1u);
    const Json command = Json::parse(inverse3_force("0A", {1.0, 2.0, 3.0}, false));
    EXPECT_EQ(command, Json::parse(R"({"inverse3":[{"device_id":"0A","commands":{"set_cursor_force":)"
                                   R"({"values":{"x":1.0,"y":-3.0,"z":2.0}}}}]})"));
    EXPECT_TRUE(inverse3_force("0A", {1.0, 2.0, 3.0}, true).contains("\"vector\""));
}

TEST(Inverse3Words, WhatTroublesADeviceIsRead) {
    const auto trouble = [](const char* status) {
        const auto words = read_inverse3(std::string(R"({"inverse3":[{"device_id":"1","status":{)") + status + "}}]}");
        return words->devices[0].trouble.value();
    };
    EXPECT_EQ(trouble(R"("calibrated":false,"power_supply":true)"), Inverse3Trouble::uncalibrated);
    EXPECT_EQ(trouble(R"("calibrated":true,"power_supply":false)"), Inverse3Trouble::without_power);
    EXPECT_EQ(trouble(R"("ready":false)"), Inverse3Trouble::not_ready);
    EXPECT_EQ(trouble(""), Inverse3Trouble::none);
}

TEST(Inverse3Words, WhatIsNoStateIsNone) {
    for (const char* const text : {"", "[]", "7", "null", "{", "{}", R"({"inverse3":7})", R"({"inverse3":{}})",
                                   R"({"inverse3":[{"device_id":"1","state":{"cursor_position":{"x":NaN}}}]})"})
        EXPECT_FALSE(read_inverse3(text)) << text;
    for (const char* const position : {"{}", "7", "null", "[1,2,3]", R"({"x":0,"y":0})", R"({"x":0,"y":0,"z":"0"})",
                                       R"({"x":0,"y":0,"z":null})", R"({"x":0,"y":0,"z":true})"}) {
        const auto words = read_inverse3(std::string(R"({"inverse3":[{"device_id":"1","state":{"cursor_position":)") +
                                         position + "}}]}");
        ASSERT_TRUE(words) << position;
        EXPECT_FALSE(words->devices[0].position_m) << position;
    }
    for (const char* const id : {"7", "null", "\"\""}) {
        const auto words = read_inverse3(std::string(R"({"inverse3":[{"device_id":)") + id + "},7,null]}");
        EXPECT_TRUE(words && words->devices.empty()) << id;
    }
    for (const char* const turn : {R"({"w":0,"x":0,"y":0,"z":0})", R"({"w":2,"x":0,"y":0,"z":0})", R"({"w":1})", "7"}) {
        const auto words =
            read_inverse3(std::string(R"({"inverse3":[],"verse_grip":[{"state":{"orientation":)") + turn + "}}]}");
        EXPECT_TRUE(words && words->has_handle && !words->orientation) << turn;
    }
}

TEST(Inverse3Words, AStateWithAnyBytesChangedIsReadOrNotAndNothingElseHappens) {
    std::mt19937 random(63);
    int read = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string text = kWholeState;
        for (unsigned int change = 0; change < 1 + random() % 3; ++change)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        if (random() % 4 == 0) text.resize(random() % text.size());
        const auto words = read_inverse3(text);
        if (!words) continue;
        ++read;
        for (const Inverse3State& device : words->devices)
            EXPECT_TRUE(!device.position_m || finite(*device.position_m)) << text;
        EXPECT_TRUE(!words->orientation || std::abs(glm::length(*words->orientation) - 1.0) < 1e-9) << text;
    }
    EXPECT_GT(read, 1000);
}

}  // namespace burin::devices
