// SPDX-License-Identifier: MIT
// What a journal and a document keep of strokes: changes of rays, and the steps of undo and redo.
//
//   a change   head, as of the solid (saved_solid.hpp); rays: what they hold from then on; step: a u32, what the change
//              is the end of (compute::HistoryStep); without it, of a stroke
//   a step     rays: what undo or redo assigns to them (compute/engine/history.hpp)
//   rays       little-endian u32: how many rays there are; the code of each (shaders/shared/cut_job.h); the number of
//              ends of each; then depths with materials and then normals, as in a page. What is more than kMostRayBytes
//              goes on in pages "rays 2", "rays 3" ...
//
// Frame: object; depths in lattice units. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "compute/engine/history.hpp"
#include "compute/rays/solid.hpp"
#include "scene/pages.hpp"

namespace burin::workpiece {

inline constexpr std::size_t kMostRayBytes = std::size_t{16} << 20;

// Which rays have changed since the last change that a journal was told.
class ChangedRays {
public:
    explicit ChangedRays(const compute::Lattice& lattice);

    void note(const compute::Changes& changes);
    [[nodiscard]] bool empty() const { return codes_.empty(); }
    // Returns whether there are changes that no step has ended.
    [[nodiscard]] bool is_open() const { return open_; }
    // Puts what the rays hold now, and what that is the end of, into the pages, and forgets which rays they are.
    void take(const compute::Solid& solid, compute::HistoryStep step, scene::Pages& pages);

private:
    compute::Lattice lattice_;
    std::array<std::vector<bool>, 3> changed_;
    std::vector<std::uint32_t> codes_;
    bool open_ = false;
};

// Makes a change again, and has the history, where there is one, take it. Fails, and changes nothing, where the pages
// are none of this solid.
[[nodiscard]] Result<void> apply_change(compute::Solid& solid, const scene::Pages& change, const std::string& where,
                                        compute::History* history = nullptr);

// Puts the steps that are new since the last call into the pages, or all of them where the pages ask for the whole.
void save_steps(compute::History& history, scene::Pages& pages);
// Puts the newest steps into the pages, up to so many bytes of rays; what save_steps() gives next is the same as
// without.
void copy_steps(const compute::History& history, std::size_t most_bytes, scene::Pages& pages);
// Returns what a step assigns. Fails where its pages, each numbered 0, are none of this solid.
[[nodiscard]] Result<compute::RayBatch> step_in(const compute::Solid& solid, const scene::Pages& step,
                                                const std::string& where);

}  // namespace burin::workpiece
