// SPDX-License-Identifier: MIT
// A carved workpiece as a part of a scene: carves what hands do, each with a tool of its own, carries out orders, and
// reports changes to the frame.
//
// Data flow of an update: stroke samples of a hand -> sweeps (its StrokeReader) -> Sculpture::update, one hand after
// the other. Then the touch publisher asks for the surface near the tool, and after that the light of a few tiles is
// baked. Orders come from keys, panel, script or recording. take_surface_update() gives the frame the tiles that
// changed since the last call, as references to tiles that never change again.
// Frame: object, metres; a workpiece stands in the scene as in its own frame. Thread: one at a time, that of the
// scene's service. An export works on copies on a thread of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/drawn_change.hpp"
#include "sculpt/finishing.hpp"
#include "sculpt/sculpture.hpp"
#include "sculpt/stroke_reader.hpp"
#include "workpiece/workpiece.hpp"

namespace burin::sculpt {

class CarvedPart final : public workpiece::WorkpiecePart {
public:
    // Tiles baked in one update: few while the tool works, more while it rests.
    static constexpr std::size_t kLitWorking = 2, kLitResting = 16;
    // Longest wait for a stroke to end: the greatest delay of a steered hand (devices/hand/steered_hand.hpp).
    static constexpr Nanoseconds kMostWait_ns = 500'000'000;
    // Between updates while something changes, and at rest.
    static constexpr Nanoseconds kBusy_ns = 10'000'000, kResting_ns = 40'000'000;
    // Longest time for which what a stroke that goes on has changed is told to nobody.
    static constexpr Nanoseconds kJournal_ns = 500'000'000;

    // sculpture must outlive the part. `hand` is the first that carves; another does once it has been given a tool.
    // With `undo_bytes` the part has the sculpture keep a history, within that much memory where it begins with none,
    // and passes on what the sculpture has to say (Sculpture::take_notices); without, both remain the caller's affair.
    CarvedPart(Sculpture& sculpture, const toolbox::Tool& tool, double hardness_Ns_per_m3,
               std::optional<std::size_t> undo_bytes, std::size_t hand = 0);
    ~CarvedPart() override;

    // WorkpiecePart. Undo and redo that wait for a stroke's end wait up to kMostWait_ns; a journal is told every
    // kJournal_ns while a stroke goes on.
    void keep_journal(TakeChange take) override;
    [[nodiscard]] std::uint64_t state() const override;
    [[nodiscard]] bool copy(scene::Pages& pages) override;
    void order(const workpiece::CarveOrder& order) override;
    void order(const workpiece::UseTool& use, std::size_t hand) override;
    [[nodiscard]] double around_m() const { return carvers_.front().reader.around_m(); }
    [[nodiscard]] double around_m(std::size_t hand) const override;

    // ScenePart. Each release of a button ends a stroke, which is what one undo takes back. Fails when the engine
    // does. A repeated update waits for an export that the recorded one found complete. finish() waits for the export
    // under way, if any.
    void take_ticks(std::size_t part, std::span<const haptics::TickRecord> ticks) override;
    [[nodiscard]] Result<void> update(Nanoseconds now_ns, const scene::PartSeen* recorded) override;
    [[nodiscard]] const scene::PartSeen& seen() const override { return seen_; }
    void let_lag() override { lags_ = true; }
    [[nodiscard]] Result<void> add_near(const scene::ProbeBall& ball, geometry::LocalSurface& draft) override;
    void after_publication() override;
    [[nodiscard]] Nanoseconds period_ns() const override { return busy_ ? kBusy_ns : kResting_ns; }
    void finish() override;
    [[nodiscard]] Result<void> save(scene::Pages& pages) override { return sculpture_.save(pages); }
    // Its steps are strokes, the one that goes on among them.
    [[nodiscard]] scene::PartSteps undo_steps() const override;
    void go(scene::StepWay way) override;

    // As a scene::SurfaceChange.
    void take_changes(scene::SceneChanges& changes) override;
    [[nodiscard]] std::optional<scene::SurfaceUpdate> take_surface_update() override;

private:
    // A hand that carves.
    struct Carver {
        std::size_t hand = 0;
        StrokeReader reader;
        Vec3 tool_object{0.0};  // as of the last publication
        std::optional<Error>
            refused{};             // why the tool that was asked for last cannot carve; nothing does until another
        bool said_why = false;     // this stroke's user has been told why nothing is carved
        bool said_border = false;  // and that what is added ends at the border of the room
    };
    void carry_out_waiting(Nanoseconds now_ns);
    void carry_out(const workpiece::UseTool& use) { use_tool(carvers_.front(), use); }
    void carry_out(const workpiece::MirrorStrokes& with) { sculpture_.mirror(with.mirror); }
    void carry_out(const workpiece::UndoStroke&);
    void carry_out(const workpiece::RedoStroke&);
    void carry_out(const workpiece::ForgetUndone&);
    void carry_out(const workpiece::ExportSurface& wanted);
    void carry_out(const workpiece::LightFrom& from);
    void carry_out(const workpiece::SaveScene& wanted);
    void tell_journal();
    void use_tool(Carver& carver, const workpiece::UseTool& use);
    [[nodiscard]] Result<void> carve(Carver& carver);
    void note_border(Carver& carver, std::span<const compute::ToolSweep> sweeps);
    void drop_invalid(Carver& carver, std::vector<compute::ToolSweep>& sweeps);
    [[nodiscard]] Carver* carver_of(std::size_t hand);
    [[nodiscard]] bool pressed() const;
    void notify(std::string message);
    [[nodiscard]] bool export_is_done() const;
    [[nodiscard]] bool has_news() const;

    Sculpture& sculpture_;
    std::vector<Carver> carvers_;  // at least one, in the order in which they were given tools
    bool keeps_history_;
    bool lags_ = false;                           // what a device has not done yet is left to a later update
    std::uint32_t edits_ = 0;                     // LocalSurface::tiles_edits
    bool stroke_open_ = false;                    // a button was down at the end of the last update
    bool status_changed_ = true;                  // something other than tiles and messages has to be reported
    bool busy_ = true;                            // there was something to report after the last update
    std::vector<workpiece::CarveOrder> waiting_;  // for the end of a stroke
    std::optional<Nanoseconds> waiting_since_ns_;
    std::uint64_t walked_ = 0;  // PartSteps::walked
    TakeChange journal_;        // null: nobody keeps one
    Nanoseconds journal_told_ns_ = 0;
    std::future<scene::ExportOutcome> export_;
    std::vector<std::string> messages_;
    std::vector<scene::ExportOutcome> exports_;  // that have ended and nobody knows of
    scene::PartSeen seen_;
};

}  // namespace burin::sculpt
