// SPDX-License-Identifier: MIT
// The contact of one point of the probe, or of the tool's shape, in one tick: the motion of its proxy, what of it is
// left out of the force, the watch over it, and the work that it takes.
// Frame: object; forces are in the device frame. Pure; no clock, heap, lock or throw.
#pragma once

#include <cstdint>

#include "haptics/contact/shape_proxy.hpp"
#include "haptics/forces/easing.hpp"
#include "haptics/forces/touch_force.hpp"
#include "haptics/probe_contact.hpp"

namespace burin::haptics {

class PointContact {
public:
    // Records into `step`, which must outlive the object, as the others must. The first point touches as the tool's
    // shape, where it has one.
    PointContact(const ProbeInput& input, const ProbeStep& step, const MovingBodies& bodies, std::uint32_t index);

    void stay_with_hand();
    // What moving the proxy has cost and might have, without the watch, and whether it suffices.
    struct Moved {
        double cost_ns = 0.0, most_ns = 0.0;
        bool limited = false, coarse = false;
    };
    // needed_ns: what moving the proxy is likely to cost; 0: not known.
    Moved touch(const ProxyBudget& budget, double needed_ns = 0.0);
    // A part that is held over touches the plane of its last contact alone, as that moves with its body, and does not
    // look for others; in free space it waits. Its next tick goes on from where the last one has left the proxy.
    void touch_last_plane();
    // A point that is held over while others of its part are not: the same, but it goes along with the bodies and out
    // of their way, for they are not where they were when its turn comes.
    void wait(const ProxyBudget& budget);

    // Tells whether it would be clear of material where the hand is; moves nothing.
    [[nodiscard]] bool fits_at_hand(const ProxyBudget& budget);

    [[nodiscard]] bool in_contact() const { return record_.constraints > 0; }
    // In free space, and not for want of a place where it fits.
    [[nodiscard]] bool is_free() const { return state_.placed && state_.unfit_ticks == 0 && !has_let_go_; }
    [[nodiscard]] bool has_let_go() const { return has_let_go_; }
    // The shape of a tool that cuts finds no place: it stays where the tool has cut to, and looks for one from there.
    void stay_in_bed(const Vec3& cut_object_m);
    // A tool that cuts is larger than what touches, by the clearance: it is borne by material that this does not reach.
    void bear_on_cut(const Vec3& cut_object_m);
    // The material touched in the last tick until this one has touched: at a border friction changes a tick late.
    [[nodiscard]] const TouchMaterial& material() const { return input_.parameters.materials[material_]; }
    [[nodiscard]] const PointRecord& record() const { return record_; }
    // Of the lever at which its force may turn the tool.
    [[nodiscard]] double squared_arm_m2() const;
    // Says at which place the contact bears the tool's shape, and where the tool's origin is.
    void bear_at(const Vec3& touched_object_m, const Vec3& tool_object_m);
    [[nodiscard]] bool has_shape() const { return shape_ != nullptr; }

    // Returns the point from which the spring pulls: the bearing point, moved towards the HIP by the length left out.
    [[nodiscard]] Vec3 less_left_out(const Vec3& bearing_object_m) const;
    // The force of this point on the hand.
    [[nodiscard]] PointForce force(const CoupledWall& wall, const Vec3& bearing_object_m);
    // Of the surface touched, with the piece under the device; zero where it rests.
    [[nodiscard]] const Vec3& surface_velocity_device_m_per_s() const { return surface_velocity_device_m_per_s_; }
    // Energy stored in the wall's spring at this point.
    [[nodiscard]] double spring_energy_J(const CoupledWall& wall, const Vec3& bearing_object_m) const;

private:
    [[nodiscard]] double radius_m() const;
    [[nodiscard]] double reach_m() const;
    [[nodiscard]] ProxySettings settings() const;
    [[nodiscard]] ProxyResult moved(const ProxyState& state, const Vec3& hand_object_m, const ProxySettings& settings,
                                    const ProxyBudget& budget);
    [[nodiscard]] ProxyResult moved_or_set(const ProxyState& state, const ProxySettings& settings,
                                           const ProxyBudget& budget);
    [[nodiscard]] ProxyResult set_near_hand(const ProxyState& state, const ProxySettings& settings,
                                            const ProxyBudget& budget, const ProxyResult& at_hand);
    [[nodiscard]] bool was_put_elsewhere(const ProxyResult& moved, const Vec3& before) const;
    [[nodiscard]] double unexplained_m(const Vec3& before, const Vec3& of_bodies_m, bool published) const;
    void leave_out(double unexplained_m);
    [[nodiscard]] bool carrier_is_gone() const;
    [[nodiscard]] double bear_on_last_plane(const Vec3& proxy_object_m, const Vec3& unexplained_m);
    bool bears(std::uint32_t constraints, const Vec3& normal_object);
    [[nodiscard]] ProxyResult as_caught(const ProxyState& state) const;
    void let_go();
    [[nodiscard]] bool cuts() const;
    [[nodiscard]] bool falls_short(double half_width_m) const;
    void watch(const ProxyState& contact, double most_ns, ContactWork& work);
    void count_work(const ContactWork& work, bool limited);
    [[nodiscard]] double scale() const { return input_.motion.object_from_device.scale; }
    [[nodiscard]] Vec3 of_piece(const Vec3& place_object_m) const;
    [[nodiscard]] Vec3 at_device(const Vec3& velocity_object_m_per_s) const;

    const ProbeInput& input_;
    const ProbeStep& step_;
    const MovingBodies& bodies_;
    const ProbePoint& point_;
    const ToolShape* shape_;  // null: a ball
    ProxyState& state_;
    std::uint8_t& material_;
    WatchState& watch_;
    LastContact& last_;
    EasedFriction& friction_;
    double& left_out_m_;
    TouchMaterial rubs_;           // the material, with the friction of this tick
    double left_out_now_m_ = 0.0;  // in this tick alone
    bool has_let_go_ = false;
    PointRecord& record_;
    Vec3 arm_device_m_{0.0}, velocity_device_m_per_s_{0.0}, surface_velocity_device_m_per_s_{0.0};
};

}  // namespace burin::haptics
