// SPDX-License-Identifier: MIT
#include "desk/panel/device_look.hpp"

#include <chrono>
#include <utility>

namespace burin::session {
namespace {

Condition condition_of(devices::Presence presence) {
    switch (presence) {
        case devices::Presence::there: return Condition::good;
        case devices::Presence::perhaps:
        case devices::Presence::absent: break;
        case devices::Presence::forbidden: return Condition::warning;
        case devices::Presence::unusable: return Condition::fault;
    }
    return Condition::idle;
}

}  // namespace

std::vector<PanelDevice> panel_devices(std::span<const devices::LookedForKind> all) {
    std::vector<PanelDevice> lines;
    for (const devices::LookedForKind& kind : all)
        for (const devices::DevicePresence& one : kind.found)
            lines.push_back({std::string(kind.option), one.name, devices::name_of(one.presence), one.cause, one.remedy,
                             condition_of(one.presence)});
    return lines;
}

void DeviceLook::show(bool open) {
    const bool opened = open && !std::exchange(open_, open);
    open_ = open;
    if (opened) found_.clear();
    wanted_ = (wanted_ || opened) && open;
    if (looking_.valid()) {
        if (looking_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
        const std::vector<devices::LookedForKind> all = looking_.get();
        if (!wanted_) found_ = panel_devices(all);  // else it was begun before the page was opened anew
    }
    if (std::exchange(wanted_, false)) looking_ = std::async(std::launch::async, look_);
}

}  // namespace burin::session
