// SPDX-License-Identifier: MIT
#include "haptics/channels.hpp"

namespace burin::haptics {

ToolState tool_of(const TickRecord& record, std::uint64_t late_ticks, std::uint64_t dropped_samples) noexcept {
    const ContactRecord& contact = record.contact;
    const PointRecord& deepest = record.deepest();
    ToolState tool;
    tool.tick = record.tick;
    tool.time_ns = record.time_ns;
    tool.hip_object_m = deepest.hip_object_m;
    tool.proxy_object_m = deepest.proxy_object_m;
    tool.contact_normal_object = deepest.normal_object;
    tool.orientation_object = record.motion.orientation_object;
    tool.tool_orientation_object = contact.tool_orientation_object;
    tool.touched_object_m = contact.touched_object_m;
    tool.position_device_m = record.sample.position_device_m;
    tool.given = record.gate.given;
    tool.point_count = contact.point_count;
    for (std::uint32_t i = 0; i < tool.point_count; ++i) tool.proxies_object_m[i] = contact.points[i].proxy_object_m;
    tool.workspace = record.motion.workspace;
    tool.stiffness_bound = contact.stiffness_bound;
    tool.object = deepest.object;
    tool.asked = deepest.asked;
    tool.rendered = deepest.rendered;
    tool.energy_share = record.passivity.share;
    tool.buttons = record.sample.buttons;
    tool.flags = record.flags;
    tool.cause = record.gate.cause;
    tool.late_ticks = late_ticks;
    tool.dropped_samples = dropped_samples;
    return tool;
}

}  // namespace burin::haptics
