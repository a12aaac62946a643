// SPDX-License-Identifier: MIT
// What a participant sees of a stage, as the renderer's scene: the tube as far as the group sees it, the funnels, the
// caps, and the wand as a thin cylinder from its top point, a red ball, to its bottom point, a green one. The handle
// that the hand holds is longer than the tube is wide and is not drawn: what is seen is what is measured.
//
// The tube is open towards the eye, with hoops around it (study/felt/tube_mesh.hpp).
// In led training of a group that the device does not lead, the wand is shown moving along the path by itself, as fast
// as a hand would be led.
// Frame: the study's world, placed before the wall by WorldView. Pure; any thread.
#pragma once

#include "activities/train/shown_objects.hpp"
#include "activities/world/world_view.hpp"

namespace burin::activities {

// A ball about the origin, as the wand's points are drawn.
[[nodiscard]] std::shared_ptr<const picture::DrawnMesh> point_ball();

class StageView {
public:
    // All must outlive it.
    StageView(const study::FeltWorld& world, const study::Protocol& protocol, const study::Stage& stage,
              const study::Group& group);

    [[nodiscard]] picture::Picture scene(StageMoment moment);

private:
    void add_wand(picture::Picture& scene, const StageMoment& moment) const;

    const study::FeltWorld& world_;
    const study::Stage& stage_;
    const study::Group& group_;
    bool shows_path_ = false;
    double lead_m_per_s_ = 0.0, point_offset_m_ = 0.0;
    WorldView view_;
    std::shared_ptr<const picture::DrawnMesh> ball_, rod_;
};

}  // namespace burin::activities
