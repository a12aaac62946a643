// SPDX-License-Identifier: MIT
// The five channels between the haptic thread and the rest of the program. Their payloads are plain data of fixed size
// (tick_parameters.hpp, tick_record.hpp), except the surface, which refers to tiles and meshes that the carving side
// owns (geometry/contact/local_surface.hpp).
//
// Data flow: parameters and surface come in (newest value wins, borrowed); the tool's state goes out to the frame
// (newest value wins), tick records go whole to the scene and to the recorder, by a ring each (in order, losses are
// counted).
#pragma once

#include <cstddef>

#include "base/newest_slot.hpp"
#include "base/ring.hpp"
#include "geometry/contact/local_surface.hpp"
#include "haptics/tick_parameters.hpp"
#include "haptics/tick_record.hpp"
#include "haptics/tool_state.hpp"

namespace burin::haptics {

// The five channels in one place, of one part of a device. The session owns them and outlives the threads. Allocates in
// the constructor only.
// Capacities: four seconds of ticks for a scene that stalls, one second for a recorder that writes.
struct HapticChannels {
    static constexpr std::size_t kTicks = 4096, kRecords = 1024;
    explicit HapticChannels(std::size_t tick_capacity = kTicks, std::size_t record_capacity = kRecords)
        : ticks(tick_capacity), records(record_capacity) {}

    NewestSlot<geometry::LocalSurface> surface;  // scene -> haptic thread
    NewestSlot<TickParameters> parameters;       // frame or study -> haptic thread
    Ring<TickRecord> ticks;      // haptic thread -> scene; without kTickSampleDropped of the tick itself
    Ring<TickRecord> records;    // haptic thread -> recorder
    NewestSlot<ToolState> tool;  // haptic thread -> frame
};

}  // namespace burin::haptics
