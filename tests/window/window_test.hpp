// SPDX-License-Identifier: MIT
// What the window tests share: a display, a validated device that can present to it, and a window.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "gpu/swapchain.hpp"
#include "tests/window/xvfb.hpp"
#include "window/window.hpp"

namespace burin::window {

class WindowTest : public testing::Test {
protected:
    void SetUp() override {
        if (Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb does not start: install xvfb (scripts/setup)";
        setenv("DISPLAY", Xvfb::running().name().c_str(), 1);
    }

    static Window open(const WindowOptions& options = {.width = 320, .height = 200}) {
        auto window = Window::create(options);
        EXPECT_TRUE(window) << window.error().line();
        return std::move(*window);
    }

    // The first event of a kind for which `wanted` holds; waits for it, but not for ever.
    template <typename Event, typename Wanted>
    static std::optional<Event> next(Window& window, const Wanted& wanted) {
        for (int i = 0; i < 600; ++i) {
            for (const WindowEvent& event : window.wait(0.05)) {
                const Event* found = std::get_if<Event>(&event);
                if (found != nullptr && wanted(*found)) return *found;
            }
        }
        return std::nullopt;
    }
};

class PresentTest : public WindowTest {
protected:
    void SetUp() override {
        WindowTest::SetUp();
        if (IsSkipped()) return;
        messages_before_ = gpu::validation_messages();
        const auto extensions = required_extensions();
        ASSERT_TRUE(extensions) << extensions.error().line();
        auto created = gpu::Device::create({.validation = true, .instance_extensions = *extensions});
        if (!created) GTEST_SKIP() << "no Vulkan device: " << created.error().line();
        device_.emplace(std::move(*created));
    }
    void TearDown() override {
        if (IsSkipped()) return;
        device_.reset();
        EXPECT_EQ(gpu::validation_messages(), messages_before_) << "the validation layer complained";
    }
    gpu::Device& device() { return *device_; }

    gpu::Swapchain chain_for(Window& window) {
        auto surface = window.create_surface(device());
        EXPECT_TRUE(surface) << surface.error().line();
        const auto size = window.framebuffer();
        auto chain = gpu::Swapchain::create(
            device(), std::move(*surface),
            {.width = static_cast<std::uint32_t>(size.width), .height = static_cast<std::uint32_t>(size.height)});
        EXPECT_TRUE(chain) << chain.error().line();
        return std::move(*chain);
    }

    // A machine that stalls gives no image within a swapchain's patience of 0.1 s, which then says "minimised": asked
    // again.
    gpu::SwapchainFrame acquire(gpu::Swapchain& chain, const Window& window) {
        const auto size = window.framebuffer();
        gpu::SwapchainFrame frame;
        for (int i = 0; i < 30; ++i) {
            frame = chain.acquire(static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height));
            if (frame.answer != gpu::FrameAnswer::minimised) break;
        }
        return frame;
    }

private:
    std::optional<gpu::Device> device_;
    std::uint64_t messages_before_ = 0;
};

}  // namespace burin::window
