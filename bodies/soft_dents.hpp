// SPDX-License-Identifier: MIT
// The dents of a plastic body as steps of undo, and the body as pages of a document.
//
// A dent goes from the first force on the body to when nothing presses it any more and it has come to rest; the part
// that owns the body says when. A step keeps the whole shape: what undo or redo gives the body, and so it is exchanged
// with the shape at the time. Whole, since a dent moves every corner a little. The oldest beyond kMostSteps go.
//
//   head     page 0, little-endian: half axes, its lattice's edge, Young's modulus, Poisson's ratio, density,
//            damping, yield stress and its relaxation, f64, in the order of SoftPartSetup
//   shape    page 0, and of a step the page of its number: u32 how many corners and elements there are; x, y, z
//            of each corner, then of the places to which they are held, f64, metres; then the metric of each element's
//            rest shape by columns, nine f64 (bodies/solver/plastic_flow.hpp)
//
// Frame: the body's own. Pure; any thread.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "bodies/solver/soft_body.hpp"
#include "scene/pages.hpp"
#include "scene/part_steps.hpp"

namespace burin::bodies {

struct SoftPartSetup;  // bodies/soft_part.hpp

inline constexpr std::string_view kSoftBodyPart = "soft body";

// A plastic body at rest in a shape.
struct SoftShapeKept {
    std::vector<Vec3> places_m, held_at_m;
    std::vector<glm::dmat3> metrics;

    bool operator==(const SoftShapeKept&) const = default;
};

class SoftDents {
public:
    static constexpr std::size_t kMostSteps = 100;

    // Begins a dent in a body of this shape, if none goes on; what was taken back is forgotten. end() makes it a step.
    void begin(SoftShapeKept now);
    void end();
    [[nodiscard]] bool goes_on() const { return open_.has_value(); }
    // Returns the shape that go() would give; null where there is none.
    [[nodiscard]] const SoftShapeKept* next(scene::StepWay way) const;
    // Goes a step, which ends a dent before, and returns the shape that the body is to take; now: its own. Nothing
    // where there is no such step, and for forget.
    [[nodiscard]] std::optional<SoftShapeKept> go(scene::StepWay way, SoftShapeKept now);
    // Returns the steps as a scene's part states them (scene/part_steps.hpp), without the orders that wait.
    [[nodiscard]] scene::PartSteps steps() const;

    // Puts the steps that are new since the last call into the pages, or all of them where the pages ask for the whole.
    void save(scene::Pages& pages);
    // Likewise, for itself and for a journal. Requires that no dent goes on.
    void note(scene::Pages& pages);
    // Goes on with the steps of an earlier session, of which `done` is the last that leads back. Requires as many as
    // there are numbers from first to last.
    void load(const scene::Steps& steps, std::vector<SoftShapeKept> shapes);

private:
    void add(SoftShapeKept before);
    void is_new(std::int64_t step);
    void put(std::set<std::int64_t>& which, scene::Pages& pages) const;

    std::deque<SoftShapeKept> done_, undone_;  // shapes that a step gives; the next are last
    std::optional<SoftShapeKept> open_;        // before the dent that goes on
    std::int64_t first_ = 1;
    std::uint64_t made_ = 0;
    std::set<std::int64_t> unsaved_, unnoted_;  // steps
};

// The pages of the body itself.
void save_body(const SoftPartSetup& setup, const SoftShapeKept& shape, scene::Pages& pages);
// Returns the shape of a body of this setup. Fails where the pages are of another body, or damaged.
[[nodiscard]] Result<SoftShapeKept> load_body(const SoftPartSetup& setup, const SoftBody& body,
                                              const scene::Pages& pages, const std::string& where);
// Returns the shape of a step, whose pages are numbered 0.
[[nodiscard]] Result<SoftShapeKept> shape_in(const SoftBody& body, const scene::Pages& pages, const std::string& where);

}  // namespace burin::bodies
