// SPDX-License-Identifier: MIT
// What a participant sees of a stage, as the renderer's scene: the tube as far as the group sees it, the funnels, the
// caps, and the wand as a thin cylinder with a red ball at its top point and a green one at its bottom point.
//
// The tube is green, and red while either point touches its wall; a cap is grey, and green while both points are in it.
// In led training of a group that the device does not lead, the wand is shown moving along the path by itself, as fast
// as a hand would be led.
// Frame: the study's world, placed before the wall by WorldView. Pure; any thread.
#pragma once

#include <array>

#include "activities/world/world_view.hpp"
#include "study/felt/stage_session.hpp"

namespace burin::activities {

struct StageMoment {
    std::array<Vec3, 2> points_m{};  // top, bottom
    Quat orientation{1.0, 0.0, 0.0, 0.0};
    bool touches_wall = false, start_touched = false, end_touched = false;
    double time_s = 0.0;  // since the stage's beginning
};
[[nodiscard]] StageMoment moment_of(const study::FeltWorld& world, const study::StageSession& session,
                                   const haptics::TickRecord& record);

class StageView {
public:
    // The world must outlive it.
    StageView(const study::FeltWorld& world, const study::Protocol& protocol, const study::Stage& stage,
              const study::Group& group);

    [[nodiscard]] renderer::Scene scene(StageMoment moment);

private:
    void add_wand(renderer::Scene& scene, const StageMoment& moment) const;
    void show(scene::ObjectId id, bool seen, scene::Colour colour);

    const study::FeltWorld& world_;
    bool sees_tube_ = false, sees_wand_ = true, shows_path_ = false;
    double lead_m_per_s_ = 0.0, point_offset_m_ = 0.0;
    WorldView view_;
    std::shared_ptr<const renderer::DrawnMesh> ball_, rod_;
};

}  // namespace burin::activities
