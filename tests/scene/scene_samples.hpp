// SPDX-License-Identifier: MIT
// Scenes of cubes and balls, and ticks of a hand in them.
#pragma once

#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/newest_slot.hpp"
#include "geometry/contact/local_surface.hpp"
#include "haptics/tick.hpp"
#include "scene/mesh_part.hpp"
#include "scene/scene_changes.hpp"
#include "scene/touch_publisher.hpp"
#include "tests/geometry/touch_samples.hpp"

namespace burin::scene::test {

inline std::shared_ptr<const geometry::TriangleMesh> shared_mesh(geometry::TriangleMesh mesh) {
    return std::make_shared<const geometry::TriangleMesh>(std::move(mesh));
}

inline SceneObject object_at(ObjectId id, std::shared_ptr<const geometry::TriangleMesh> mesh, const Vec3& at_m) {
    SceneObject object;
    object.id = id;
    object.name = "object " + std::to_string(id);
    object.mesh = std::move(mesh);
    object.pose.position_m = at_m;
    return object;
}

// A path up and down by `height_m` in two seconds.
inline PathMotion up_and_down(double height_m) { return {{{0.0, {}}, {1.0, {{0.0, height_m, 0.0}}}, {2.0, {}}}}; }

// A hand with a ball of 4 mm among the objects of one part, ticked at 1 kHz; the part is updated and published each
// ten ticks.
class TouchedScene {
public:
    static constexpr double kRadius_m = 0.004, kStiffness_N_per_m = 600.0;

    explicit TouchedScene(std::vector<SceneObject> objects) {
        auto made = MeshPart::create(std::move(objects), materials);
        if (!made) throw std::runtime_error(made.error().line());
        part = std::move(*made);
        parameters.probe = haptics::ball_probe(kRadius_m);
        parameters.clearance_ratio = 0.0;
        parameters.limit_stiffness = false;
        materials.write(parameters.materials);
    }

    haptics::TickRecord tick(const Vec3& hand_m) {
        if (ticks % 10 == 0) {
            (void)part->update(now_ns(), nullptr);
            ScenePart* const parts[] = {part.get()};
            (void)publisher.publish({0, hand_m, reach_m}, parts, now_ns());
        }
        devices::DeviceSample sample;
        sample.time_ns = now_ns();
        sample.position_device_m = hand_m;
        const haptics::FullTick full =
            haptics::full_tick(state, sample, slot.newest(), parameters, device, sample.time_ns, 1e-3);
        state = full.next;
        ++ticks;
        return full.record;
    }
    [[nodiscard]] Nanoseconds now_ns() const { return Nanoseconds{1'000'000} * (ticks + 1000); }

    MaterialTable materials;
    std::unique_ptr<MeshPart> part;
    TouchPublisher::Slot slot;
    TouchPublisher publisher{std::vector<TouchPublisher::Slot*>{&slot}};
    haptics::TickParameters parameters;
    devices::DeviceDescription device{
        .name = "strong", .max_force_N = 100.0, .max_torque_Nm = Vec3(10.0), .max_stiffness_N_per_m = 1e6};
    haptics::FullTickState state{};
    double reach_m = 0.03;
    int ticks = 0;
};

}  // namespace burin::scene::test
