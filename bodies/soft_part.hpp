// SPDX-License-Identifier: MIT
// A body that gives as a part of a scene: hands press it point by point, it is stepped, and each hand's next ticks get
// a model of it at each point.
//
// Data flow of an update: the newest tick of each part of the hands -> its points, with the nearest of the body's
// surface -> contacts -> steps of the solver up to the update's time -> for each point the force there, its direction
// and how it will change (geometry/contact/local_model.hpp) -> add_near() hands these to the publisher. The body is
// drawn as take_changes() tells it. The stiffness of a model is the secant: the force over how deep the point is in the
// body at rest. It says how the body gives when it is pressed slowly, which is what a finger does within a step of 4 ms
// (docs/decisions/030-bodies-that-give.md). The body is held in its frame by springs on its core. The frame stands,
// goes with a hand or flies (bodies/body_frame.hpp); what its acceleration does inside the body is not felt.
// The dents of a plastic body are steps (bodies/soft_dents.hpp). One that is taken back while somebody presses the
// body, or would with the shape from before, waits until nobody does: no finger is to find itself in the body.
// Hardest cases: an update that comes late steps kMostSteps at most and leaves the rest of the time out, and its
// old models fade by themselves. A body at rest that nobody is near is not stepped. Frame: the scene's; the body's own
// has its middle at the origin. Deterministic: an update depends on its time and its ticks alone. Threads: as any
// part's (scene/scene_part.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bodies/body_frame.hpp"
#include "bodies/mesh/embedded_surface.hpp"
#include "bodies/soft_dents.hpp"
#include "bodies/solver/soft_body.hpp"
#include "bodies/solver/soft_step.hpp"
#include "geometry/contact/local_model.hpp"
#include "scene/drawn_change.hpp"
#include "scene/scene_motion.hpp"
#include "scene/scene_part.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::bodies {

struct SoftPartSetup {
    std::uint32_t object = 1;  // number of the scene's object that it is
    Pose scene_from_body;
    Vec3 half_axes_m{0.03};  // of an ellipsoid
    double spacing_m = 0.0;  // of its elements' lattice; 0: a quarter of the smallest half axis
    SoftMaterial material;
    Nanoseconds step_ns = 4'000'000;
    unsigned sweeps = 4;
    double point_radius_m = 0.001;  // of a probe's points
    double held_N_per_m = 3000.0;   // with which its core is held in its frame
    // What it falls among when a hand has let go of it; its radius is the body's. None: it stays where it was left.
    std::optional<FlightRoom> room = {};
};

// Its surface as an update left it, for pictures, on its way to the frames.
class SoftShape final : public scene::DrawnChange {
public:
    Pose scene_from_body;
    std::vector<Vec3> places_m;          // in the body's frame
    std::optional<Pose> palm_from_body;  // in the hand that holds it; none: no hand does
};

class SoftPart final : public scene::ScenePart {
public:
    static constexpr int kMostSteps = 4;

    // Fails on a body that cannot be, as ellipsoid() and SoftBody::create() do.
    [[nodiscard]] static Result<std::unique_ptr<SoftPart>> create(const SoftPartSetup& setup);

    void take_ticks(std::size_t part, std::span<const haptics::TickRecord> ticks) override;
    [[nodiscard]] Result<void> update(Nanoseconds now_ns, const scene::PartSeen* recorded) override;
    [[nodiscard]] const scene::PartSeen& seen() const override { return seen_; }
    [[nodiscard]] Result<void> add_near(const scene::ProbeBall& ball, geometry::LocalSurface& draft) override;
    [[nodiscard]] Nanoseconds period_ns() const override { return setup_.step_ns; }
    // Dents of a plastic body are its steps; an elastic body has none, and is not saved.
    [[nodiscard]] scene::PartSteps undo_steps() const override;
    void go(scene::StepWay way) override { waiting_.push_back(way); }
    [[nodiscard]] Result<void> save(scene::Pages& pages) override;
    [[nodiscard]] bool note(scene::Pages& pages) override;
    [[nodiscard]] bool is_kept() const override { return setup_.material.is_plastic(); }
    // Has it go on as it was saved, before its first update; steps: of the pages, those from first to last. Fails where
    // these are of another body, or damaged; it is then as it was.
    [[nodiscard]] Result<void> load(const scene::Pages& pages, const scene::Steps& steps,
                                    std::span<const scene::Pages> each_step, const std::string& where);

    [[nodiscard]] const SoftPartSetup& setup() const { return setup_; }
    // Adds a SoftShape where it has moved since the last call, and at first. Its triangles stay the same.
    void take_changes(scene::SceneChanges& changes) override;
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return drawn_.triangles; }
    // Returns the models of a hand's points as of the last update.
    [[nodiscard]] std::span<const geometry::LocalModel> models(std::size_t hand) const;
    // Where the body is, and what hands do with it as a whole; from the scene's thread, between updates.
    [[nodiscard]] BodyFrame& frame() { return frame_; }
    [[nodiscard]] const BodyFrame& frame() const { return frame_; }
    // What it falls among from now on; the radius is the body's.
    void fall_among(FlightRoom room);
    // The body, its state now, and the number of steps since creation, which measures their cost.
    [[nodiscard]] const SoftBody& body() const { return body_; }
    [[nodiscard]] const SoftState& state() const { return state_; }
    [[nodiscard]] std::uint64_t steps() const { return steps_; }

private:
    // A point of a hand against the surface.
    struct Pressed {
        std::size_t hand = 0;
        std::uint32_t point = 0;
        Vec3 place_m{0.0}, normal{0.0};  // of the point, and out of the body
    };
    struct Hand {
        std::uint32_t points = 0;
        std::array<Vec3, haptics::kMostProbePoints> places_scene_m{};
        Nanoseconds time_ns = 0;  // when they were there
        std::vector<geometry::LocalModel> models;
    };

    SoftPart(const SoftPartSetup& setup, SoftBody body);
    void find_contacts();
    [[nodiscard]] std::optional<SoftContact> contact_at(const Vec3& point_m) const;
    void make_models(Nanoseconds now_ns);
    [[nodiscard]] Vec3 push_m_per_s2() const;
    [[nodiscard]] bool rests() const;
    [[nodiscard]] bool is_pressed() const;
    [[nodiscard]] bool is_still() const;
    [[nodiscard]] SoftShapeKept shape() const { return {state_.places_m, held_at_m_, state_.flow.metrics}; }
    void take(SoftShapeKept shape);
    // Goes a step, unless somebody would then press the body; returns whether it has.
    [[nodiscard]] bool has_gone(scene::StepWay way);
    void follow_dents();

    SoftPartSetup setup_;
    BodyFrame frame_;
    SoftBody body_;
    double mass_kg_ = 0.0;
    SoftState state_;
    SoftSolver solver_;
    EmbeddedSurface touched_, drawn_;
    std::vector<std::vector<std::uint32_t>> triangles_at_;  // of each point of the touched surface
    DentLaw law_;                                           // of a point of a probe
    std::vector<double> holds_N_per_m_;
    std::vector<Vec3> held_at_m_;            // of a plastic body, by corner; empty: their places at rest
    std::vector<Vec3> surface_m_, normals_;  // of the touched surface now
    std::vector<Hand> hands_;
    std::vector<Pressed> pressed_;
    std::vector<SoftContact> contacts_;  // of each pressed one
    std::optional<Nanoseconds> stepped_to_ns_;
    std::uint64_t steps_ = 0;
    bool has_moved_ = true;  // since the frames were told
    SoftDents dents_;
    std::vector<scene::StepWay> waiting_;  // until nobody presses it
    std::uint64_t walked_ = 0;             // PartSteps::walked
    scene::PartSeen seen_;
};

}  // namespace burin::bodies
