// SPDX-License-Identifier: MIT
#include "window/window_system.hpp"

#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <utility>

#include "base/clock.hpp"
#include "base/try.hpp"
#include "window/lost_display.hpp"

namespace burin::window {

namespace {

// GLFW's callbacks for errors and monitors carry no user pointer, so this state is global, as GLFW's own is.
std::mutex g_errors_mutex;
std::string g_errors;
std::weak_ptr<WindowSystem> g_running;  // main thread

// Each monitor as it was described last. Main thread.
struct DescribedMonitor {
    Monitor monitor;
    Nanoseconds at_ns = 0;
};
std::map<GLFWmonitor*, DescribedMonitor> g_described;
constexpr Nanoseconds kStaysDescribed_ns = 1'000'000'000;

void on_error(int, const char* text) {
    const std::lock_guard lock(g_errors_mutex);
    if (g_errors.size() > 2000) return;  // a loop of errors adds nothing new
    g_errors += (g_errors.empty() ? "" : "; ") + std::string(text);
}

// Sets XDG_RUNTIME_DIR where it is missing: Mesa's device selection layer looks for a Wayland display and prints an
// error without it. Any existing folder prevents that; the user's own is right where there is one.
void name_a_runtime_folder() {
    if (std::getenv("XDG_RUNTIME_DIR") != nullptr) return;
    std::error_code ignored;
    const std::string own = "/run/user/" + std::to_string(getuid());
    const std::string folder =
        std::filesystem::is_directory(own, ignored) ? own : std::filesystem::temp_directory_path(ignored).string();
    setenv("XDG_RUNTIME_DIR", folder.c_str(), 0);
}

std::unexpected<Error> no_display(const std::string& complaint) {
    const char* display = std::getenv("DISPLAY");
    const std::string remedy =
        "start Burin on the desktop, or name its display (export DISPLAY=:0), or run a virtual one (xvfb-run burin "
        "...)";
    if (display == nullptr || *display == '\0')
        return fail("window", "there is no display: DISPLAY is not set", remedy);
    return fail("window", "no display answers at DISPLAY=" + std::string(display) + " (" + complaint + ")", remedy);
}

}  // namespace

Result<std::shared_ptr<WindowSystem>> WindowSystem::use() {
    if (auto running = g_running.lock()) return running;
    name_a_runtime_folder();
    glfwSetErrorCallback(on_error);
    if (glfwInit() != GLFW_TRUE) return no_display(take_errors());
    std::shared_ptr<WindowSystem> started(new WindowSystem);
    g_running = started;
    g_described.clear();
    glfwSetMonitorCallback(on_monitor);
    outlive_display();
    return started;
}

WindowSystem::~WindowSystem() {
    if (!display_is_lost()) glfwTerminate();
}

std::string WindowSystem::take_errors() {
    const std::lock_guard lock(g_errors_mutex);
    return std::exchange(g_errors, {});
}

void WindowSystem::on_monitor(GLFWmonitor* monitor, int event) {
    g_described.erase(monitor);
    const auto running = g_running.lock();
    if (!running) return;
    const std::string name = glfwGetMonitorName(monitor);
    for (MonitorListener* listener : running->listeners_) {
        listener->monitor_changed(name, monitor, event == GLFW_CONNECTED);
    }
}

Monitor WindowSystem::describe(GLFWmonitor* monitor, int index) {
    Monitor m;
    const Nanoseconds now_ns = MonotonicClock().now_ns();
    const auto known = g_described.find(monitor);
    if (known != g_described.end()) m = known->second.monitor;
    m.index = index;
    const bool is_recent = known != g_described.end() && now_ns - known->second.at_ns < kStaysDescribed_ns;
    if (monitor == nullptr || is_recent || display_hangs_up()) return m;
    m.name = glfwGetMonitorName(monitor);
    glfwGetMonitorPos(monitor, &m.x, &m.y);
    glfwGetMonitorPhysicalSize(monitor, &m.width_mm, &m.height_mm);
    if (const GLFWvidmode* mode = glfwGetVideoMode(monitor)) {
        m.width = mode->width;
        m.height = mode->height;
        m.refresh_Hz = mode->refreshRate;
    }
    g_described[monitor] = {m, now_ns};
    return m;
}

std::vector<Monitor> WindowSystem::monitors() const {
    int count = 0;
    std::vector<Monitor> list;
    if (display_is_lost()) return list;
    GLFWmonitor** found = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) list.push_back(describe(found[i], i));
    return list;
}

Result<GLFWmonitor*> WindowSystem::find(const std::string& name_or_index) const {
    int count = 0;
    GLFWmonitor** found = glfwGetMonitors(&count);
    int index = name_or_index.empty() ? 0 : -1;
    const char* end = name_or_index.data() + name_or_index.size();
    if (const auto parsed = std::from_chars(name_or_index.data(), end, index); parsed.ptr != end) index = -1;
    std::string names;
    for (int i = 0; i < count; ++i) {
        const std::string name = glfwGetMonitorName(found[i]);
        if (i == index || name == name_or_index) return found[i];
        names += (names.empty() ? "" : ", ") + std::to_string(i) + " (" + name + ")";
    }
    return fail("monitor", "there is no monitor '" + name_or_index + "'",
                names.empty() ? "plug one in" : "choose one of: " + names);
}

Result<std::vector<Monitor>> monitors() {
    BURIN_TRY(system, WindowSystem::use());
    return system->monitors();
}

Result<std::vector<std::string>> required_extensions() {
    BURIN_TRY(system, WindowSystem::use());
    std::uint32_t count = 0;
    const char** names = glfwVulkanSupported() == GLFW_TRUE ? glfwGetRequiredInstanceExtensions(&count) : nullptr;
    if (names == nullptr) {
        return fail("window", "Vulkan cannot show pictures on this display: " + WindowSystem::take_errors(),
                    "install the graphics driver's Vulkan part, such as mesa-vulkan-drivers");
    }
    return std::vector<std::string>(names, names + count);
}

void wake() { glfwPostEmptyEvent(); }

}  // namespace burin::window
