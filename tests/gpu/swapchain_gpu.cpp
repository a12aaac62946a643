// SPDX-License-Identifier: MIT
// What a swapchain refuses, and what a machine without a display of its own says. Pictures in windows:
// tests/window/present_gpu.cpp.
#include <gtest/gtest.h>

#include "gpu/direct_display.hpp"
#include "gpu/swapchain.hpp"
#include "tests/window/window_test.hpp"

namespace burin::gpu {

class SwapchainTest : public window::PresentTest {};

// The software driver lets a swapchain with two layers be created though its surfaces have one: the capabilities
// decide.
TEST_F(SwapchainTest, GivesTwoLayersOnlyWhereTheSurfaceHasThem) {
    auto window = open();
    auto surface = window.create_surface(device());
    ASSERT_TRUE(surface);
    VkSurfaceCapabilitiesKHR caps{};
    const auto& core = device().core();
    ASSERT_EQ(core->surface.capabilities(core->physical, surface->raw(), &caps), VK_SUCCESS);
    const auto chain = Swapchain::create(device(), std::move(*surface), {.width = 320, .height = 200, .layers = 2});
    EXPECT_EQ(chain.has_value(), caps.maxImageArrayLayers >= 2);
    EXPECT_TRUE(chain || chain.error().line().contains("side_by_side"));
}

TEST_F(SwapchainTest, CountsNoRefreshesWhereTheDisplayCannot) {
    auto window = open();
    const Swapchain chain = chain_for(window);
    EXPECT_TRUE(device().capabilities().display_control || !chain.vblank_count());
    EXPECT_EQ(chain.layers(), 1u);
}

TEST_F(SwapchainTest, RefusesADeviceThatWasOpenedWithoutWindows) {
    auto window = open();
    auto plain = Device::create();
    ASSERT_TRUE(plain);
    EXPECT_FALSE(plain->capabilities().swapchain);
    const auto refused = window.create_surface(*plain);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().remedy.contains("required_extensions"));
}

TEST(DeviceOptions, NamesAnExtensionThatIsMissing) {
    const auto refused = Device::create({.instance_extensions = {"VK_KHR_surface", "VK_BURIN_never"}});
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("VK_BURIN_never")) << refused.error().line();
    EXPECT_TRUE(Device::create({.optional_instance_extensions = {"VK_BURIN_never"}}));
}

TEST(DirectDisplay, SaysThatThereIsNoneOrListsThem) {
    auto device = Device::create({.validation = true,
                                  .instance_extensions = {"VK_KHR_surface"},
                                  .optional_instance_extensions = direct_display_extensions()});
    if (!device) GTEST_SKIP() << device.error().line();
    const auto displays = list_displays(*device);
    if (displays) {
        EXPECT_FALSE(displays->empty());
    } else {
        EXPECT_TRUE(displays.error().line().contains("direct display")) << displays.error().line();
        EXPECT_TRUE(displays.error().remedy.contains("window")) << displays.error().line();
        EXPECT_FALSE(create_display_surface(*device, {.stereo = DisplayStereo::hdmi_3d}));
    }
    auto plain = Device::create();
    ASSERT_TRUE(plain);
    EXPECT_TRUE(list_displays(*plain).error().line().contains("VK_KHR_display"));
}

}  // namespace burin::gpu
