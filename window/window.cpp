// SPDX-License-Identifier: MIT
#include "window/window.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "base/try.hpp"
#include "window/key_names.hpp"
#include "window/lost_display.hpp"
#include "window/window_system.hpp"

namespace burin::window {

class Window::Implementation : public MonitorListener {
public:
    Implementation(std::shared_ptr<WindowSystem> system, GLFWwindow* handle)
        : system_(std::move(system)), handle_(handle) {
        glfwSetWindowUserPointer(handle_, this);
        system_->add(this);
        listen();
    }
    ~Implementation() {
        system_->remove(this);
        if (!display_is_lost()) glfwDestroyWindow(handle_);
    }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    GLFWwindow* handle() const { return handle_; }
    const WindowSystem& system() const { return *system_; }
    std::vector<WindowEvent> take() { return std::exchange(events_, {}); }

    // The window's position and size on the desktop, restored when it leaves full screen.
    struct Place {
        int x = 64, y = 64, width = 1280, height = 800;
    };
    Place desktop_place;
    std::string filled_monitor;  // empty: an ordinary window

    void remember_place() {
        if (glfwGetWindowMonitor(handle_) != nullptr) return;
        glfwGetWindowPos(handle_, &desktop_place.x, &desktop_place.y);
        glfwGetWindowSize(handle_, &desktop_place.width, &desktop_place.height);
    }

    void return_to_desktop() {
        filled_monitor.clear();
        glfwSetWindowMonitor(handle_, nullptr, desktop_place.x, desktop_place.y, desktop_place.width,
                             desktop_place.height, GLFW_DONT_CARE);
    }

    void monitor_changed(const std::string& name, GLFWmonitor*, bool connected) override {
        const bool ours = !connected && name == filled_monitor;
        // GLFW has already moved the window off a monitor that is gone; returns it to its earlier position.
        if (ours) return_to_desktop();
        push(MonitorEvent{name, connected, ours});
    }

private:
    static Implementation& of(GLFWwindow* window) {
        return *static_cast<Implementation*>(glfwGetWindowUserPointer(window));
    }

    void push(WindowEvent event) { events_.push_back(std::move(event)); }

    static Modifiers held(int mods) {
        return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0,
                (mods & GLFW_MOD_SUPER) != 0};
    }

    // Converts from GLFW's desktop units to pixels.
    MouseMoveEvent in_pixels(double x, double y) const {
        int width = 0, height = 0, pixels_x = 0, pixels_y = 0;
        glfwGetWindowSize(handle_, &width, &height);
        glfwGetFramebufferSize(handle_, &pixels_x, &pixels_y);
        return {x * (width > 0 ? static_cast<double>(pixels_x) / width : 1.0),
                y * (height > 0 ? static_cast<double>(pixels_y) / height : 1.0)};
    }

    void listen() {
        glfwSetKeyCallback(handle_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
            const char* label = glfwGetKeyName(key, scancode);
            const Press press = action == GLFW_PRESS ? Press::down : action == GLFW_REPEAT ? Press::repeat : Press::up;
            of(w).push(KeyEvent{std::string(key_name(key)), label != nullptr ? label : "", press, held(mods)});
        });
        glfwSetCharCallback(handle_, [](GLFWwindow* w, unsigned character) {
            of(w).push(TextEvent{static_cast<char32_t>(character)});
        });
        glfwSetCursorPosCallback(handle_, [](GLFWwindow* w, double x, double y) { of(w).push(of(w).in_pixels(x, y)); });
        glfwSetMouseButtonCallback(handle_, [](GLFWwindow* w, int button, int action, int mods) {
            double x = 0.0, y = 0.0;
            glfwGetCursorPos(w, &x, &y);
            const MouseMoveEvent at = of(w).in_pixels(x, y);
            of(w).push(MouseButtonEvent{button, action == GLFW_PRESS, at.x, at.y, held(mods)});
        });
        glfwSetScrollCallback(handle_, [](GLFWwindow* w, double x, double y) { of(w).push(ScrollEvent{x, y}); });
        glfwSetFramebufferSizeCallback(
            handle_, [](GLFWwindow* w, int width, int height) { of(w).push(ResizeEvent{width, height}); });
        glfwSetWindowPosCallback(handle_, [](GLFWwindow* w, int x, int y) { of(w).push(MoveEvent{x, y}); });
        glfwSetWindowCloseCallback(handle_, [](GLFWwindow* w) { of(w).push(CloseEvent{}); });
        glfwSetWindowFocusCallback(handle_, [](GLFWwindow* w, int focused) { of(w).push(FocusEvent{focused != 0}); });
        glfwSetWindowIconifyCallback(handle_, [](GLFWwindow* w, int icon) { of(w).push(MinimiseEvent{icon != 0}); });
        glfwSetWindowRefreshCallback(handle_, [](GLFWwindow* w) { of(w).push(ExposeEvent{}); });
    }

    std::shared_ptr<WindowSystem> system_;
    GLFWwindow* handle_;
    std::vector<WindowEvent> events_;
};

namespace {

int hint(bool on) { return on ? GLFW_TRUE : GLFW_FALSE; }

void set_hints(const WindowOptions& options, GLFWmonitor* monitor) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_VISIBLE, hint(options.visible));
    glfwWindowHint(GLFW_RESIZABLE, hint(options.resizable));
    glfwWindowHint(GLFW_DECORATED, hint(options.decorated));
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // a wall stays full screen while somebody works on another monitor
    if (monitor == nullptr) return;
    // Takes the monitor's present mode, so that the desktop around it stays unchanged.
    if (const GLFWvidmode* mode = glfwGetVideoMode(monitor)) {
        glfwWindowHint(GLFW_RED_BITS, mode->redBits);
        glfwWindowHint(GLFW_GREEN_BITS, mode->greenBits);
        glfwWindowHint(GLFW_BLUE_BITS, mode->blueBits);
        glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
    }
}

// The distance of a point from a monitor. The monitor of a window is the one nearest to the window's middle, however
// much of the window lies on others.
long distance_to(const Monitor& m, int x, int y) {
    const long dx = std::max({m.x - x, 0, x - (m.x + m.width - 1)}),
               dy = std::max({m.y - y, 0, y - (m.y + m.height - 1)});
    return dx + dy;
}

// Enlarges a window by its display's scale, but beyond no monitor.
void fit_to_scale(Window::Size asked, GLFWwindow* handle) {
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(handle, &x, &y);
    int left = 0, top = 0, width = 0, height = 0, framebuffer = 0, window = 0, ignored = 0;
    if (GLFWmonitor* const primary = glfwGetPrimaryMonitor())
        glfwGetMonitorWorkarea(primary, &left, &top, &width, &height);
    glfwGetFramebufferSize(handle, &framebuffer, &ignored);
    glfwGetWindowSize(handle, &window, &ignored);
    if (x <= 1.0f || width <= 0 || height <= 0 || framebuffer != window) return;  // the desktop scales by itself
    glfwSetWindowSize(handle, std::min(static_cast<int>(x * static_cast<float>(asked.width)), width),
                      std::min(static_cast<int>(x * static_cast<float>(asked.height)), height));
}

}  // namespace

Window::Window(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Result<Window> Window::create(const WindowOptions& options) {
    BURIN_TRY(system, WindowSystem::use());
    if (options.width < 1 || options.height < 1 || options.width > 32768 || options.height > 32768) {
        return fail("window",
                    "its size is impossible: " + std::to_string(options.width) + " x " + std::to_string(options.height),
                    "choose 1 to 32768 each way");
    }
    GLFWmonitor* monitor = nullptr;
    if (options.full_screen) {
        BURIN_TRY(found, system->find(*options.full_screen));
        monitor = found;
    }
    set_hints(options, monitor);
    int width = options.width, height = options.height;
    if (const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr) {
        width = mode->width;
        height = mode->height;
    }
    GLFWwindow* handle = glfwCreateWindow(width, height, options.title.c_str(), monitor, nullptr);
    if (handle == nullptr) {
        return fail("window", "it could not be opened: " + WindowSystem::take_errors(), "check the display's settings");
    }
    auto made = std::make_unique<Implementation>(system, handle);
    made->desktop_place.width = options.width;
    made->desktop_place.height = options.height;
    if (monitor != nullptr) made->filled_monitor = glfwGetMonitorName(monitor);
    if (monitor == nullptr && options.scaled) fit_to_scale(Window::Size{width, height}, handle);
    if (monitor == nullptr && options.x && options.y) glfwSetWindowPos(handle, *options.x, *options.y);
    return Window(std::move(made));
}

Result<gpu::SurfaceHandle> Window::create_surface(gpu::Device& device) {
    const auto& core = device.core();
    if (core->surface.destroy == nullptr) {
        return fail("window", "the device was opened without the window's extensions",
                    "give DeviceOptions what required_extensions() says");
    }
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    const VkResult r = glfwCreateWindowSurface(core->instance, implementation_->handle(), nullptr, &surface);
    if (r != VK_SUCCESS) {
        const std::string complaint = WindowSystem::take_errors();
        return gpu::vulkan_failure("window", "no surface" + (complaint.empty() ? "" : " (" + complaint + ")"), r);
    }
    return gpu::SurfaceHandle(core, surface);
}

// GLFW takes what a display that is gone does not answer for an answer: it is asked nothing more.
std::vector<WindowEvent> Window::poll() {
    if (!display_hangs_up()) glfwPollEvents();
    return implementation_->take();
}

std::vector<WindowEvent> Window::wait(double timeout_s) {
    if (display_hangs_up()) {
        std::this_thread::sleep_for(std::chrono::duration<double>(timeout_s));
    } else if (timeout_s > 0.0) {
        glfwWaitEventsTimeout(timeout_s);
    } else {
        glfwPollEvents();
    }
    return implementation_->take();
}

Window::Size Window::framebuffer() const {
    Size size;
    if (display_hangs_up()) return size;
    glfwGetFramebufferSize(implementation_->handle(), &size.width, &size.height);
    return size;
}

Monitor Window::monitor() const {
    Position at;
    Size size;
    if (display_hangs_up()) return {};
    glfwGetWindowPos(implementation_->handle(), &at.x, &at.y);
    glfwGetWindowSize(implementation_->handle(), &size.width, &size.height);
    const int x = at.x + size.width / 2, y = at.y + size.height / 2;
    const std::vector<Monitor> all = implementation_->system().monitors();
    const auto nearest = std::ranges::min_element(all, {}, [&](const Monitor& m) { return distance_to(m, x, y); });
    return nearest != all.end() ? *nearest : Monitor{};
}

Window::Position Window::on_monitor() const {
    const Monitor under = monitor();
    Position at;
    if (display_hangs_up()) return at;
    glfwGetWindowPos(implementation_->handle(), &at.x, &at.y);
    return {at.x - under.x, at.y - under.y};
}

double Window::content_scale() const {
    Size size;
    if (display_hangs_up()) return 1.0;
    glfwGetWindowSize(implementation_->handle(), &size.width, &size.height);
    return size.width > 0 ? static_cast<double>(framebuffer().width) / size.width : 1.0;
}

double Window::display_scale() const {
    float x = 1.0f, y = 1.0f;
    if (display_hangs_up()) return 1.0;
    glfwGetWindowContentScale(implementation_->handle(), &x, &y);
    return x > 0.0f ? static_cast<double>(x) : 1.0;
}

bool Window::full_screen() const { return glfwGetWindowMonitor(implementation_->handle()) != nullptr; }
bool Window::minimised() const { return glfwGetWindowAttrib(implementation_->handle(), GLFW_ICONIFIED) == GLFW_TRUE; }
bool Window::asked_to_close() const { return glfwWindowShouldClose(implementation_->handle()) == GLFW_TRUE; }

void Window::set_title(const std::string& title) {
    if (!display_hangs_up()) glfwSetWindowTitle(implementation_->handle(), title.c_str());
}
void Window::set_size(int width, int height) {
    if (width > 0 && height > 0 && !display_hangs_up()) glfwSetWindowSize(implementation_->handle(), width, height);
}
void Window::set_position(int x, int y) {
    if (!display_hangs_up()) glfwSetWindowPos(implementation_->handle(), x, y);
}
void Window::set_visible(bool visible) {
    if (display_hangs_up()) return;
    visible ? glfwShowWindow(implementation_->handle()) : glfwHideWindow(implementation_->handle());
}
void Window::minimise() {
    if (!display_hangs_up()) glfwIconifyWindow(implementation_->handle());
}
void Window::restore() {
    if (!display_hangs_up()) glfwRestoreWindow(implementation_->handle());
}
void Window::show_pointer(bool shown) {
    if (display_hangs_up()) return;
    glfwSetInputMode(implementation_->handle(), GLFW_CURSOR, shown ? GLFW_CURSOR_NORMAL : GLFW_CURSOR_HIDDEN);
}

Result<void> Window::fill_monitor(const std::string& monitor) {
    BURIN_TRY(found, implementation_->system().find(monitor));
    const GLFWvidmode* mode = glfwGetVideoMode(found);
    if (mode == nullptr) return fail("monitor", "'" + monitor + "' has no mode", "switch it on");
    implementation_->remember_place();
    implementation_->filled_monitor = glfwGetMonitorName(found);
    glfwSetWindowMonitor(implementation_->handle(), found, 0, 0, mode->width, mode->height, mode->refreshRate);
    return {};
}

void Window::leave_full_screen() {
    if (full_screen()) implementation_->return_to_desktop();
}

void Window::ask_to_close() {
    glfwSetWindowShouldClose(implementation_->handle(), GLFW_TRUE);
    wake();
}

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(implementation_->handle());
    static_cast<void>(WindowSystem::take_errors());  // GLFW reports an empty clipboard as an error
    return text != nullptr ? text : "";
}

void Window::set_clipboard(const std::string& text) { glfwSetClipboardString(implementation_->handle(), text.c_str()); }

}  // namespace burin::window
