// SPDX-License-Identifier: MIT
#include "desk/panel/device_look.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include "tests/desk/panel_models.hpp"

namespace burin::session {

TEST(DeviceLook, ThePageHasEveryStateInPlaceOfTheSections) {
    using enum devices::Presence;
    devices::LookedForKind kind{"--device", "omni", {}};
    for (const devices::Presence presence : {there, perhaps, absent, forbidden, unusable})
        kind.found.push_back({presence, "omni", "a cause", "a remedy"});
    PanelModel model = idle_model();
    auto panel = Panel::create({.size = {340, 900}});
    ASSERT_TRUE(panel) << panel.error().line();
    static_cast<void>(panel->show(model, 0));
    EXPECT_TRUE(panel->place_of("tool ball"));
    model.show_devices = true;
    const std::size_t before = panel->show(model, 1).mesh.vertices.size();
    model.devices = panel_devices(std::array{kind});
    EXPECT_GT(panel->show(model, 2).mesh.vertices.size(), before) << "the devices are drawn";
    EXPECT_TRUE(panel->place_of("toggle-devices"));
    EXPECT_FALSE(panel->place_of("tool ball"));
    std::vector<std::string> states;
    for (const PanelDevice& device : model.devices) states.push_back(device.state);
    EXPECT_EQ(states, (std::vector<std::string>{"there", "perhaps", "absent", "forbidden", "unusable"}));
    EXPECT_EQ(model.devices[4].condition, Condition::fault);
}

// The frame's thread goes on while the look is held up, and what an earlier opening began does not count for a later.
TEST(DeviceLook, AreLookedForWithoutHoldingUpAFrame) {
    std::binary_semaphore may_end(0);
    std::atomic<int> looks = 0;
    DeviceLook look([&] {
        const int count = ++looks;
        may_end.acquire();
        return std::vector<devices::LookedForKind>{
            {"--device", "", {{devices::Presence::there, std::to_string(count), "", ""}}}};
    });
    const auto frames_until = [&](const std::function<bool()>& done) {
        for (int i = 0; i < 30'000 && !done(); ++i) {
            look.show(true);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return done();
    };
    look.show(false);
    EXPECT_EQ(looks, 0) << "nobody has asked";
    for (int frame = 0; frame < 100; ++frame) look.show(true);
    EXPECT_TRUE(look.found().empty());
    ASSERT_TRUE(frames_until([&] { return looks == 1; }));
    look.show(false);
    look.show(true);  // opened anew while the first look still goes on
    may_end.release();
    ASSERT_TRUE(frames_until([&] { return looks == 2; }));
    EXPECT_TRUE(look.found().empty()) << "the first look is of before";
    may_end.release();
    ASSERT_TRUE(frames_until([&] { return !look.found().empty(); }));
    EXPECT_EQ(look.found()[0].name, "2");
    for (int frame = 0; frame < 100; ++frame) look.show(true);
    EXPECT_EQ(looks, 2) << "once each time that the page is opened";
}

}  // namespace burin::session
