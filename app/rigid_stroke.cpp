// SPDX-License-Identifier: MIT
#include "app/rigid_stroke.hpp"

#include "app/progress.hpp"

namespace burin {

Result<void> carve_rigidly(Carving& carving, const Stroke& stroke, const Tool& tool, bool merge_rows) {
    Progress progress("carving");
    const double tolerance_m = merge_rows ? tool.tolerance_cells * carving.surface().lattice().spacing_m : -1.0;
    std::vector<Pose> run;  // from press to release
    for (std::size_t i = 0; i < stroke.size(); i += run.empty() ? 1 : run.size()) {
        run.clear();
        for (std::size_t k = i; k < stroke.size() && stroke[k].button; ++k) {
            run.push_back({stroke[k].position_object_m, stroke[k].orientation_object});
        }
        std::vector<ToolSweep> sweeps = sweeps_along(run, tool, tolerance_m);
        // Unmerged, the first row is an update of its own, as if the tool had been set down before it moved.
        if (!merge_rows && run.size() > 1) sweeps.insert(sweeps.begin(), tool.sweep(run.front(), run.front()));
        for (std::size_t done = 0; done < sweeps.size(); ++done) {
            if (const auto updated = carving.update({&sweeps[done], 1}); !updated) return updated;
            const double of_run = static_cast<double>(done * run.size()) / static_cast<double>(sweeps.size());
            progress.show((static_cast<double>(i) + of_run) / static_cast<double>(stroke.size()));
        }
        carving.end_stroke();
    }
    return {};
}

}  // namespace burin
