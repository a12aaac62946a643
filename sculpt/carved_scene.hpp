// SPDX-License-Identifier: MIT
// A scene that holds one carved workpiece and one hand: what a simulated stroke, a bench or a test needs of a scene.
// Threads: as SceneService.
#pragma once

#include <optional>

#include "scene/scene_service.hpp"
#include "sculpt/carved_part.hpp"

namespace burin::sculpt {

class CarvedScene {
public:
    // sculpture and channels must outlive it. `reach_m` is how far the tool may move until the next update. undo_bytes:
    // as CarvedPart.
    CarvedScene(Sculpture& sculpture, haptics::HapticChannels& channels, const toolbox::Tool& tool,
                double hardness_Ns_per_m3, double reach_m, std::optional<std::size_t> undo_bytes)
        : part_(sculpture, tool, hardness_Ns_per_m3, undo_bytes),
          service_({&part_}, {{&channels, Vec3(0.0), part_.around_m(), reach_m}}) {}

    // Sets where the tool is before the first sample.
    void start_at(const Vec3& position_object) { service_.start_at(0, position_object); }
    // Carries out an order; another tool counts from the next update on.
    void order(const workpiece::CarveOrder& order) {
        part_.order(order);
        service_.use_probe(0, part_.around_m());
    }
    [[nodiscard]] Result<void> update(Nanoseconds now_ns) { return service_.update(now_ns); }
    [[nodiscard]] std::optional<scene::SurfaceUpdate> take_surface_update() { return part_.take_surface_update(); }
    void finish_export() { part_.finish(); }
    // Returns the number of local surfaces published so far.
    [[nodiscard]] std::uint64_t published() const { return service_.published(0); }
    [[nodiscard]] scene::SceneService& service() { return service_; }

private:
    CarvedPart part_;
    scene::SceneService service_;
};

}  // namespace burin::sculpt
