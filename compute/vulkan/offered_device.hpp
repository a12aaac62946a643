// SPDX-License-Identifier: MIT
// A device on its way to an engine that has lost its own (standby_engine.hpp): whoever opens a new one offers a lane of
// it, and the engine takes it with its next cut. Thread: that of the engine; a session offers by an order of its scene
// (scene/scene_order.hpp).
#pragma once

#include <optional>
#include <utility>

#include "gpu/device.hpp"

namespace burin::compute {

class OfferedDevice {
public:
    // Has offers kept from now on, or forgotten: an engine that hears none holds no device back.
    void hear(bool hears) {
        hears_ = hears;
        if (!hears) lane_.reset();
    }
    void offer(gpu::Device lane) {
        if (hears_) lane_ = std::move(lane);
    }
    // Returns the newest offer since the last call.
    [[nodiscard]] std::optional<gpu::Device> take() { return std::exchange(lane_, std::nullopt); }

private:
    bool hears_ = false;
    std::optional<gpu::Device> lane_;
};

}  // namespace burin::compute
