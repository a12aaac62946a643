// SPDX-License-Identifier: MIT
// What a frame sees of a tick: where to draw the tool and what to report about it. A view of the whole record
// (haptics/tick_record.hpp), plain data of fixed size. Units are SI; a name carries its frame. "Object" is the
// workpiece's frame, in which carving and contact happen.
#pragma once

#include <array>
#include <cstdint>

#include "devices/haptic/device_sample.hpp"
#include "haptics/contact/probe.hpp"
#include "haptics/stability/coupled_wall.hpp"
#include "haptics/stability/gate_output.hpp"
#include "haptics/tick_flag.hpp"
#include "haptics/workspace/workspace_picture.hpp"

namespace burin::haptics {

struct TickRecord;  // haptics/tick_record.hpp

// The view of a tick for the frame (tool_of): where to draw the tool and what to report about it.
struct ToolState {
    std::uint64_t tick = 0;  // 0: never published
    Nanoseconds time_ns = 0;
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};
    Vec3 contact_normal_object{0.0};  // unit; zero in free space
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};
    Quat tool_orientation_object{1.0, 0.0, 0.0, 0.0};  // of the tool at its proxy
    Vec3 touched_object_m{0.0};                        // where a tool with a shape is borne; zero for balls
    Vec3 position_device_m{0.0};
    devices::DeviceWrench given;
    std::uint32_t point_count = 0;
    std::array<Vec3, kMostProbePoints> proxies_object_m{};
    WorkspacePicture workspace;
    StiffnessBound stiffness_bound = StiffnessBound::none;
    std::uint32_t object = 0;     // touched by the deepest point, its wall as asked and as rendered (PointRecord), and
    CoupledWall asked, rendered;  // the share of the force that the energy account affords
    double energy_share = 1.0;
    std::uint32_t buttons = 0;
    std::uint32_t flags = 0;
    GateCause cause = GateCause::none;
    Nanoseconds let_go_ns = 0;          // time of the last tick in which the watch let the hand go; 0: there was none
    std::uint64_t late_ticks = 0;       // since the start
    std::uint64_t dropped_samples = 0;  // ticks that the scene has lost to a full ring since the start
};

[[nodiscard]] ToolState tool_of(const TickRecord& record, std::uint64_t late_ticks,
                                std::uint64_t dropped_samples) noexcept;

}  // namespace burin::haptics
