// SPDX-License-Identifier: MIT
// The hand of a recording whose ticks are computed again: every sample is the recorded one, and its device, which knows
// limits, axes and rate, is moved by nobody. One thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "activities/world/exploration_settings.hpp"
#include "activities/world/explored_world.hpp"
#include "base/clock.hpp"
#include "devices/haptic/wand_description.hpp"
#include "record/motion.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::scene {
class MeshPart;      // scene/mesh_part.hpp
class SceneService;  // scene/scene_service.hpp
}  // namespace burin::scene

namespace burin::activities {

struct OpenedExploration;  // activities/world/opened_exploration.hpp

// The simulated device that led a recorded motion, and what of it touches: a ball at each point.
struct DeviceAsRecorded {
    std::optional<devices::WandDescription> wand = {};  // none: the simulated Omni
    std::vector<devices::WandPoint> points = {};        // of the wand; none: one, where the tool is

    [[nodiscard]] std::uint32_t point_count() const {
        return points.empty() ? 1u : static_cast<std::uint32_t>(points.size());
    }
    [[nodiscard]] devices::DeviceDescription description() const;
    // Returns the probe of these points with balls of one radius.
    [[nodiscard]] haptics::Probe probe(double radius_m) const;
};

// Returns how far apart the ticks of the device are.
[[nodiscard]] Nanoseconds period_of(const DeviceAsRecorded& device);

// Checks that the recording has one hand, and that it is of this device.
[[nodiscard]] Result<void> check_hand(const record::RecordReader& reader, const DeviceAsRecorded& device);

// Checks what a file may claim of a tick: times that can be subtracted from each other, and a mapping that is one.
[[nodiscard]] Result<void> check_tick(const record::RecordReader& reader, const record::RecordedTick& tick);

// A session in which this hand explores a world. Its first update has been made when it is opened.
class RepeatedHand {
public:
    // begins_ns: when that update was, or is to be.
    [[nodiscard]] static Result<std::unique_ptr<RepeatedHand>> create(const ExploredWorld& world,
                                                                      const ExplorationSettings& settings,
                                                                      const DeviceAsRecorded& device,
                                                                      Nanoseconds begins_ns);

    // Computes a recorded tick with the newest surface and parameters, as the session's next one.
    haptics::TickRecord repeated(const record::RecordedTick& tick);
    // Maps the device into the scene in another way from the next tick on.
    void use_mapping(const Similarity& scene_from_device);
    [[nodiscard]] scene::SceneService& service();
    [[nodiscard]] const scene::MeshPart& objects() const;
    ~RepeatedHand();

private:
    RepeatedHand(std::unique_ptr<OpenedExploration> opened, double radius_m, double spread_device_m);

    std::unique_ptr<OpenedExploration> opened_;
    double radius_m_, spread_device_m_;  // of the points from the first to the farthest, at the device
};

}  // namespace burin::activities
