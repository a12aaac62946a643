// SPDX-License-Identifier: MIT
// Windows on the desktop, through GLFW, which appears in no header.
//
//   auto extensions = window::required_extensions();                       // Result; before the Device
//   auto device = gpu::Device::create({.instance_extensions = *extensions});
//   auto window = window::Window::create({.title = "Burin", .width = 1280, .height = 800});
//   auto surface = window->create_surface(*device);
//   auto swapchain = gpu::Swapchain::create(*device, std::move(*surface), {.width = ..., .height = ...});
//   for (const WindowEvent& event : window->poll()) ...                    // or wait(): sleeps until something happens
//
// Without a display everything returns an Error that says so; nothing else of Burin needs a display. The first call
// starts the window library; it stops when the last Window is destroyed.
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
    int index = 0;                    // 0: the desktop's primary monitor
    int x = 0, y = 0;                 // position of its upper left pixel on the desktop
    int width = 0, height = 0;        // pixels, in its present mode
    double refresh_Hz = 0.0;          // 0: unknown
    int width_mm = 0, height_mm = 0;  // as the monitor reports it, often wrong
};

// Lists the monitors; empty on a machine whose monitors are all off. An Error without a display.
[[nodiscard]] Result<std::vector<Monitor>> monitors();

// Returns whether the display has gone for good since windows were opened. They have no more events then, and nothing
// is drawn in them. Any thread.
[[nodiscard]] bool display_is_lost();

// Returns the extensions for DeviceOptions::instance_extensions. An Error without a display or without Vulkan.
[[nodiscard]] Result<std::vector<std::string>> required_extensions();

struct WindowOptions {
    std::string title = "Burin";
    int width = 1280, height = 800;               // size of a window on the desktop
    bool scaled = false;                          // times the display's scale, as far as its monitor has room
    std::optional<std::string> full_screen = {};  // a monitor's name or its index; "" means the primary one
    std::optional<int> x = {}, y = {};            // position of a window that is not full screen, on the desktop
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

    // Return the events since the last call, in order. poll() does not wait. wait() sleeps until an event in any
    // window, a call of wake(), or the timeout. Both also process the other windows, whose events are kept for them.
    [[nodiscard]] std::vector<WindowEvent> poll();
    [[nodiscard]] std::vector<WindowEvent> wait(double timeout_s);

    struct Size {
        int width = 0, height = 0;
    };
    [[nodiscard]] Size framebuffer() const;  // pixels
    struct Position {
        int x = 0, y = 0;
    };
    // Returns the position of the contents' upper left pixel on the monitor that holds the window's middle, for
    // interlaced modes. Negative where the window reaches beyond the monitor.
    [[nodiscard]] Position on_monitor() const;
    [[nodiscard]] Monitor monitor() const;  // the monitor that holds the window's middle
    // Returns the framebuffer's pixels for each unit of desktop coordinates: above 1 on scaled displays.
    [[nodiscard]] double content_scale() const;
    // Returns how much larger than on a common display (96 dpi) the desktop asks letters to be; 1 where it is silent.
    [[nodiscard]] double display_scale() const;
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
    // Makes the window full screen on a monitor, by name or index. An Error names the available monitors.
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

// Makes a wait() return early. Any thread, while a Window exists.
void wake();

}  // namespace burin::window
