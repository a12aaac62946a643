// SPDX-License-Identifier: MIT
// What the panel's page of devices shows: the devices and trackers that devices::look_for_devices() finds, which is
// what `burin devices` lists, with the same states, causes and remedies.
//
// Looking takes up to some seconds where something does not answer, and so a thread of its own looks, once each time
// that the page is opened: neither a frame nor a tick waits for it. Only the end of the session does, until it is done.
// Thread: the frame's.
#pragma once

#include <functional>
#include <future>
#include <span>
#include <utility>
#include <vector>

#include "desk/panel/panel_model.hpp"
#include "devices/registry/present_devices.hpp"

namespace burin::session {

// Returns a line of the page for each line of `burin devices`, in its order.
[[nodiscard]] std::vector<PanelDevice> panel_devices(std::span<const devices::LookedForKind> all);

class DeviceLook {
public:
    using Look = std::function<std::vector<devices::LookedForKind>()>;
    // look: called on another thread, one call at a time; must not throw.
    explicit DeviceLook(Look look = devices::look_for_devices) : look_(std::move(look)) {}

    // Says in each frame whether the page is open; begins to look when it has been opened. A look that an earlier
    // opening began is waited for first.
    void show(bool open);
    // Returns what was found last; nothing while it looks.
    [[nodiscard]] const std::vector<PanelDevice>& found() const { return found_; }

private:
    Look look_;
    bool open_ = false, wanted_ = false;
    std::vector<PanelDevice> found_;
    std::future<std::vector<devices::LookedForKind>> looking_;  // waits for its thread at the end
};

}  // namespace burin::session
