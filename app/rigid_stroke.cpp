// SPDX-License-Identifier: MIT
#include "app/rigid_stroke.hpp"

#include "app/progress.hpp"

namespace burin {

Result<void> carve_rigidly(Carving& carving, const Stroke& stroke, const Tool& tool) {
    Progress progress("carving");
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        if (!stroke[i].button) continue;
        const bool sweeps = i > 0 && stroke[i - 1].button;
        const Vec3& end = stroke[i].position_object_m;
        const BallSweep sweep{sweeps ? stroke[i - 1].position_object_m : end, end, tool.radius_m, tool.material};
        if (const auto updated = carving.update({&sweep, 1}); !updated) return updated;
        progress.show(static_cast<double>(i) / static_cast<double>(stroke.size()));
    }
    return {};
}

}  // namespace burin
