// SPDX-License-Identifier: MIT
// A hand that carves a block with a tool through the haptic loop, and goes where it is put: what tests and the bench
// share that ask what a tool feels in the groove that it cuts.
//
// A session's own settings in simulated time: a tick a millisecond, an update of the solid each ten. The device does
// not yield to force. Frame: object, metres; the tool stands upright (+Y) on the block's upper face.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/haptics/carving_tools.hpp"
#include "bench/haptics/hand_path.hpp"
#include "compute/tools/tool.hpp"
#include "geometry/mesh/triangle_mesh.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "sculpt/carved_scene.hpp"

namespace burin::bench {

struct CarvedBlock {
    Vec3 size_m{0.04, 0.02, 0.03};
    int resolution = 128;  // along the longest side
};

class CarvingHand {
public:
    CarvingHand(const compute::ToolShape& tool, const CarvedBlock& block);

    // Takes a tick with the tool's lowest place there, relative to the middle of the block's face.
    const haptics::TickRecord& go_to(const Vec3& tip_m, bool pressed);
    // Takes a tick that presses with this force: the hand is as far below the cutting point as stretches its spring so.
    const haptics::TickRecord& press(double force_N);

    [[nodiscard]] const haptics::TickRecord& record() const { return record_; }
    // Where the tool has cut to, its lowest place, relative to the middle of the block's face.
    [[nodiscard]] Vec3 cut_m() const { return record_.contact.cut_object_m - origin_m_; }
    [[nodiscard]] Vec3 proxy_m() const { return record_.contact.points[0].proxy_object_m - origin_m_; }
    [[nodiscard]] double stiffness_N_per_m() const { return stiffness_N_per_m_; }
    [[nodiscard]] const haptics::TouchMaterial& material() const { return parameters_.materials[0]; }
    [[nodiscard]] double removed_mm3() const;
    [[nodiscard]] haptics::TickParameters& parameters() { return parameters_; }  // of the next tick on
    [[nodiscard]] double cost_us() const { return 1e-3 * haptics::cost_ns(record_.contact.work); }

private:
    void tick(const Vec3& hand_m, bool pressed);

    WorkerPool pool_{1};
    toolbox::Tool tool_;
    std::unique_ptr<sculpt::Sculpture> sculpture_;
    std::unique_ptr<haptics::HapticChannels> channels_;
    std::unique_ptr<sculpt::CarvedScene> scene_;
    PathDevice device_;
    SimulatedClock clock_;
    haptics::HapticLoop loop_;
    haptics::TickParameters parameters_;
    haptics::TickRecord record_;
    Vec3 origin_m_{0.0};
    double stiffness_N_per_m_ = 0.0;
    std::uint64_t ticks_ = 0;
};

// The section of a tool that lies so deep, and what of its surface meets a plunge: the sum of areas times the square of
// the normal's part that goes down. By the tool's own triangles, cut at the plane.
struct PlungedAreas {
    double section_m2 = 0.0, into_m2 = 0.0;
};
[[nodiscard]] PlungedAreas plunged_areas(const geometry::TriangleMesh& tool, double depth_m);

}  // namespace burin::bench
