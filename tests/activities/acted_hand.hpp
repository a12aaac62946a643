// SPDX-License-Identifier: MIT
// A hand in a glove whose fingers are bent, with contacts as a test sets them, and a world for it.
// Frames: palm, places and normals in the device's; the scene lies in it as be_in() has it.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "activities/grasp/grasp.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/gloves/grip_shape.hpp"
#include "scene/scene_object.hpp"
#include "session/objects/world_objects.hpp"

namespace burin::activities {

inline constexpr scene::ObjectId kBall = 1, kTable = 2;

// A ball on a table, as a world's objects.
inline session::WorldObjects ball_on_a_table() {
    const auto cube = [](double half_m) {
        auto mesh = std::make_shared<geometry::TriangleMesh>();
        for (int i = 0; i < 8; ++i)
            mesh->positions_m.push_back(
                {(i & 1) != 0 ? half_m : -half_m, (i & 2) != 0 ? half_m : -half_m, (i & 4) != 0 ? half_m : -half_m});
        return mesh;
    };
    session::WorldObjects objects;
    for (const auto& [id, name, half_m] : {std::tuple(kBall, "ball", 0.03), std::tuple(kTable, "table", 0.3)}) {
        scene::SceneObject object;
        object.id = id;
        object.name = name;
        object.mesh = cube(half_m);
        objects.objects.push_back(std::make_shared<const scene::SceneObject>(object));
    }
    return objects;
}

// A hand whose fingers are bent, with contacts as they are set.
class ActedHand {
public:
    void bend(devices::GripShape shape, double closed) {
        for (std::size_t i = 0; i < kFelt; ++i) joints_[i] = devices::bent_in(shape, i, closed);
    }
    void bend_joint(std::size_t finger, std::size_t joint, double angle_rad) { joints_[finger][joint] = angle_rad; }
    void touch(std::size_t finger, scene::ObjectId object, const Vec3& normal) {
        objects_[finger] = object;
        normals_[finger] = normal;
    }
    // Has a finger be pushed by what it touches, and by another thing that it leans on.
    void push(std::size_t finger, double force_N) { pushes_N_[finger] = force_N; }
    void lean(std::size_t finger, scene::ObjectId object, double force_N) {
        leans_on_[finger] = object;
        leans_N_[finger] = force_N;
    }
    // Has each tick say that a set was left out before it.
    void leave_out_sets(bool leaves_out) { leaves_out_ = leaves_out; }
    // What the device measures that it gives; none: nothing.
    void measure(std::size_t finger, double force_N) { measured_N_[finger] = force_N; }
    void press(double depth_m) { depth_m_ = depth_m; }
    void touch_nothing() { objects_ = {}; }
    void move_to(const Pose& palm) { palm_ = palm; }

    // Sets the transform from the device's frame to the scene's.
    void be_in(const Similarity& scene_from_device) { scene_from_device_ = scene_from_device; }

    // Has but each n-th tick come, as where others are lost on the way.
    void tell_every(std::uint64_t ticks) { every_ = ticks; }

    void be_lost(bool is_lost) {
        faults_.fill(is_lost ? devices::DeviceFault::disconnected : devices::DeviceFault::none);
    }
    void have_fault(std::size_t finger, devices::DeviceFault fault) { faults_[finger] = fault; }

    // Points with the index at a place of the scene, from so far, the palm turned somehow.
    void point_at(const Vec3& place_scene_m, double from_m, const Quat& turn) {
        bend(devices::GripShape::point, 1.0);
        const Pose tip = devices::place_of(devices::usual_hand()[1], joints_[1]).hand_from_tip;
        const Vec3 at_hand_m = tip.position_m + from_m * (tip.orientation * Vec3(0.0, 1.0, 0.0));
        palm_ = {inverse(scene_from_device_) * place_scene_m - turn * at_hand_m, turn};
    }

    [[nodiscard]] haptics::TickRecord tick(std::size_t finger) const {
        const Pose tip = devices::place_of(devices::usual_hand()[finger], joints_[finger]).hand_from_tip;
        haptics::TickRecord record;
        record.tick = tick_;
        record.time_ns = static_cast<Nanoseconds>(tick_) * 1'000'000;
        record.sample.position_device_m = palm_ * tip.position_m;
        record.sample.orientation_device = palm_.orientation * tip.orientation;
        std::copy(joints_[finger].begin(), joints_[finger].end(), record.sample.joints.begin());
        record.sample.fault = faults_[finger];
        record.motion.object_from_device = scene_from_device_;
        record.contact.point_count = 1;
        record.contact.points[0].hip_object_m = scene_from_device_ * record.sample.position_device_m;
        if (leaves_out_) record.sample.drive.state |= devices::kDriveSetRejected;
        if (measured_N_[finger]) {
            record.sample.drive.state |= devices::kDriveMeasured;
            record.sample.drive.measured_N = *measured_N_[finger];
        }
        if (leans_on_[finger] != 0) {
            record.flags = haptics::kTickInContact;
            record.contact.point_count = 2;
            record.contact.points[1].object = static_cast<std::uint32_t>(leans_on_[finger]);
            record.contact.points[1].force_device_N = Vec3(0.0, leans_N_[finger], 0.0);
        }
        record.gate.given.force_device_N = Vec3(0.0, pushes_N_[finger] + leans_N_[finger], 0.0);
        if (objects_[finger] == 0) return record;
        record.contact.points[0].force_device_N = Vec3(0.0, pushes_N_[finger], 0.0);
        record.flags = haptics::kTickInContact;
        record.contact.points[0].object = static_cast<std::uint32_t>(objects_[finger]);
        const Vec3 normal = scene_from_device_.orientation * normals_[finger];
        record.contact.points[0].normal_object = normal;
        record.contact.points[0].proxy_object_m =
            record.contact.points[0].hip_object_m + scene_from_device_.scale * depth_m_ * normal;
        return record;
    }
    // Has the activity go on by so many turns of this hand.
    session::ActivityOrders go_on(session::Activity& activity, int turns,
                                  const session::WorldObjects& objects = ball_on_a_table(),
                                  std::span<const scene::DrawnShare> drawn = {}) {
        session::ActivityOrders all;
        for (int i = 0; i < turns; ++i) {
            tick_ += every_;
            std::array<std::vector<haptics::TickRecord>, kFelt> ticks;
            std::vector<session::PartView> parts;
            for (std::size_t finger = 0; finger < kFelt; ++finger) {
                ticks[finger] = {tick(finger)};
                parts.push_back({"", ticks[finger], {}});
            }
            const std::array hands{session::HandView{{}, parts}};
            session::ActivityOrders orders;
            activity.step({0, hands, {}, &objects, i == 0 ? drawn : std::span<const scene::DrawnShare>()}, orders);
            for (auto& hold : orders.holds) all.holds.push_back(hold);
            for (auto& edit : orders.edits) all.edits.push_back(edit);
            all.parameters = all.parameters || orders.parameters;
            for (auto& message : orders.messages) all.messages.push_back(message);
            for (auto& order : orders.on_scene) all.on_scene.push_back(order);
        }
        return all;
    }

private:
    std::uint64_t tick_ = 1000, every_ = 1;
    double depth_m_ = 0.002;
    std::array<devices::DeviceFault, kFelt> faults_{};
    Similarity scene_from_device_;
    Pose palm_{{0.1, 0.2, 0.3}, glm::normalize(Quat(0.7, -0.6, 0.2, 0.1))};
    devices::GloveJoints joints_{};
    std::array<scene::ObjectId, kFelt> objects_{};
    std::array<Vec3, kFelt> normals_{};
    bool leaves_out_ = false;
    std::array<double, kFelt> pushes_N_{}, leans_N_{};
    std::array<scene::ObjectId, kFelt> leans_on_{};
    std::array<std::optional<double>, kFelt> measured_N_{};
};

inline void hold_ball(ActedHand& hand) {
    hand.bend(devices::GripShape::whole, 0.7);
    hand.touch(0, kBall, {0.0, 0.0, -1.0});
    hand.touch(1, kBall, {0.0, 0.1, 1.0});
    hand.touch(2, kBall, {0.1, 0.0, 1.0});
}

}  // namespace burin::activities
