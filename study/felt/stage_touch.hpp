// SPDX-License-Identifier: MIT
// The touch of a stage: the settings of its ticks, and how they go on.
//
// Data flow: protocol, stage and group -> settings (which walls press, how strongly, the force limit, guidance that
// fades and leads) -> whoever runs the ticks: a session (follow()), or a recording in a hand's place
// (study/felt/repeated_stage.hpp). A group that does not feel the tube has a tube of zero stiffness, not one that is
// switched off: the proxies stay within it, so that deviations are known all the same.
// Guidance changes once each kGuidanceStep_ns and depends on the ticks before alone, so that a recorded motion gives
// the same settings again. Where it leads, it leads to the end of the spine, then back to its start, and so on.
// Frame: a world that lies within the wand's workspace is given in the maker's frame, as any scene of the wand
// (devices/haptic/wand_description.hpp); another is centred in it, as far as it reaches. Pure but for its state; one
// thread each.
#pragma once

#include "devices/haptic/wand_description.hpp"
#include "haptics/forces/guidance.hpp"
#include "haptics/tick_parameters.hpp"
#include "study/felt/felt_world.hpp"

namespace burin::study {

// The wand's two points: 0 is the top, 1 the bottom.
inline constexpr std::uint32_t kWandPoints = 2;

// The wand that a study is run with: the thesis' device, whose two points lie where the protocol says. The force limit
// of the protocol is the ticks', not the device's.
[[nodiscard]] devices::WandDescription study_wand(const Protocol& protocol);
[[nodiscard]] haptics::Probe wand_probe(const devices::WandDescription& wand);
// Where the device stands in the world.
[[nodiscard]] Similarity world_from_wand(const devices::WandDescription& wand, const Box& world);

// stage: as the group feels it. model: the tube and the funnels press on everybody, and nothing leads: what the forces
// of a recorded motion would have been (W18).
enum class TouchPurpose { stage, model };

class StageTouch {
public:
    static constexpr Nanoseconds kGuidanceStep_ns = 100'000'000;

    // All must outlive it.
    StageTouch(const Protocol& protocol, const Stage& stage, const Group& group, const FeltWorld& world,
               TouchPurpose purpose = TouchPurpose::stage);
    StageTouch(const StageTouch&) = delete;
    StageTouch& operator=(const StageTouch&) = delete;

    // For a tick that a session has run: guidance goes on. Where the attracting point is it takes from where the wand's
    // middle is along the path. sample: as this device reads it.
    void follow(Nanoseconds now_ns, const devices::DeviceSample& sample);
    // For a tick that is about to be computed with these parameters: guidance goes on from where the ticks before have
    // left the attracting point.
    void lead(Nanoseconds now_ns, const haptics::GuidanceState& state);

    [[nodiscard]] const haptics::TickParameters& parameters() const { return parameters_; }
    [[nodiscard]] const devices::WandDescription& wand() const { return wand_; }
    [[nodiscard]] const devices::DeviceDescription& device() const { return device_; }
    [[nodiscard]] Vec3 place_in_world(const Vec3& position_device_m) const;
    [[nodiscard]] Vec3 place_at_device(const Vec3& position_m) const;
    // The wand's points, whatever the tick makes of the sample.
    [[nodiscard]] std::array<Vec3, 2> points_m(const devices::DeviceSample& sample) const;
    // Whether the device leads the hand in this stage.
    [[nodiscard]] bool leads() const { return leads_; }

private:
    void set_walls(const Stage& stage, const Group& group, TouchPurpose purpose);
    void set_curve();
    void guide_on(Nanoseconds now_ns, const haptics::GuidanceState& state, double near_end_m);

    const Protocol& protocol_;
    const Stage& stage_;
    const FeltWorld& world_;
    devices::WandDescription wand_;
    devices::DeviceDescription device_;  // of wand_
    haptics::TickParameters parameters_;
    bool leads_ = false;
    double lead_sign_ = 1.0, curve_length_m_ = 0.0;
    std::uint64_t ticks_ = 0;
    Nanoseconds begun_ns_ = 0, guidance_ns_ = 0;
};

}  // namespace burin::study
