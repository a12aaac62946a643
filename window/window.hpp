// SPDX-License-Identifier: MIT
// Windows on the desktop, through GLFW, which shows in no header.
//
//   auto extensions = window::required_extensions();                       // Result; before the Device
//   auto device = gpu::Device::create({.instance_extensions = *extensions});
//   auto window = window::Window::create({.title = "Burin", .width = 1280, .height = 800});
//   auto surface = window->create_surface(*device);
//   auto swapchain = gpu::Swapchain::create(*device, std::move(*surface), {.width = ..., .height = ...});
//   for (const WindowEvent& event : window->poll()) ...                    // or wait(): sleeps until something happens
//
// Without a display everything returns an Error that says so; nothing else of Burin needs one.
// The window library is started by the first call and stopped when the last Window has gone.
// Order of destruction: Swapchain and its surface before the Window.
// Thread: the main thread alone, except wake().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "gpu/core.hpp"
#include "window/window_event.hpp"

namespace burin::window {

struct Monitor {
    std::string name;
    int index = 0;                    // 0: the desktop's main monitor
    int x = 0, y = 0;                 // of its upper left pixel among all monitors
    int width = 0, height = 0;        // pixels, in its present mode
    double refresh_Hz = 0.0;          // 0: unknown
    int width_mm = 0, height_mm = 0;  // as it says itself, often wrong
};

// An Error without a display; else at least one, or none on a machine whose monitors are all off.
[[nodiscard]] Result<std::vector<Monitor>> monitors();

// For DeviceOptions::instance_extensions. An Error without a display or without Vulkan.
[[nodiscard]] Result<std::vector<std::string>> required_extensions();

struct WindowOptions {
    std::string title = "Burin";
    int width = 1280, height = 800;               // of a window on the desktop
    std::optional<std::string> full_screen = {};  // a monitor's name or its index; "" means the main one
    std::optional<int> x = {}, y = {};            // of a window on the desktop, among all monitors
    bool visible = true;
    bool resizable = true;
    bool decorated = true;
};

class Window {
public:
    [[nodiscard]] static Result<Window> create(const WindowOptions& options);
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    [[nodiscard]] Result<gpu::SurfaceHandle> create_surface(gpu::Device& device);

    // What happened since the last call, in order. poll() does not wait. wait() sleeps until something happens in any window,
    // wake() is called, or the time is over. Both also look after the other windows, whose events are kept for them.
    [[nodiscard]] std::vector<WindowEvent> poll();
    [[nodiscard]] std::vector<WindowEvent> wait(double timeout_s);

    struct Size {
        int width = 0, height = 0;
    };
    [[nodiscard]] Size framebuffer() const;  // pixels
    struct Position {
        int x = 0, y = 0;
    };
    // Where the upper left pixel of the contents lies on the monitor that holds the window's middle: for interlaced modes.
    // Negative where the window reaches beyond it.
    [[nodiscard]] Position on_monitor() const;
    [[nodiscard]] Monitor monitor() const;  // that monitor
    // Pixels of the framebuffer for each unit of the desktop's coordinates: above 1 on scaled displays.
    [[nodiscard]] double content_scale() const;
    [[nodiscard]] bool full_screen() const;
    [[nodiscard]] bool minimised() const;
    [[nodiscard]] bool asked_to_close() const;

    void set_title(const std::string& title);
    void set_size(int width, int height);
    void set_position(int x, int y);
    void set_visible(bool visible);
    void minimise();
    void restore();
    void show_pointer(bool shown);
    // A monitor's name or index. An Error names the monitors there are.
    [[nodiscard]] Result<void> fill_monitor(const std::string& monitor);
    void leave_full_screen();
    void ask_to_close();
    [[nodiscard]] std::string clipboard() const;
    void set_clipboard(const std::string& text);

    class Implementation;  // window.cpp

private:
    explicit Window(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

// Ends a wait() early. Any thread, while a Window exists.
void wake();

}  // namespace burin::window
