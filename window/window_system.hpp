// SPDX-License-Identifier: MIT
// GLFW's process-wide state: started once, stopped when nobody uses it; its errors; its monitors. For window/ alone.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/vulkan.hpp"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "window/window.hpp"

namespace burin::window {

// Notified of monitors that are connected or disconnected.
class MonitorListener {
public:
    virtual void monitor_changed(const std::string& name, GLFWmonitor* monitor, bool connected) = 0;

protected:
    ~MonitorListener() = default;
};

class WindowSystem {
public:
    // Returns the running system, or starts it. Main thread.
    [[nodiscard]] static Result<std::shared_ptr<WindowSystem>> use();
    ~WindowSystem();
    WindowSystem(const WindowSystem&) = delete;
    WindowSystem& operator=(const WindowSystem&) = delete;

    [[nodiscard]] std::vector<Monitor> monitors() const;
    [[nodiscard]] Result<GLFWmonitor*> find(const std::string& name_or_index) const;
    // As it was within the last second: GLFW asks the display for place and mode, which takes its time in each frame,
    // and GLFW 3.3 does not survive a display that dies meanwhile.
    [[nodiscard]] static Monitor describe(GLFWmonitor* monitor, int index);

    void add(MonitorListener* listener) { listeners_.push_back(listener); }
    void remove(MonitorListener* listener) { std::erase(listeners_, listener); }

    // Returns and clears GLFW's error messages since the last call, in one line.
    [[nodiscard]] static std::string take_errors();

private:
    WindowSystem() = default;
    static void on_monitor(GLFWmonitor* monitor, int event);
    std::vector<MonitorListener*> listeners_;
};

}  // namespace burin::window
