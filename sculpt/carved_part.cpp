// SPDX-License-Identifier: MIT
#include "sculpt/carved_part.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <utility>

#include "base/try.hpp"
#include "compute/tools/apply.hpp"
#include "geometry/files/mesh_export.hpp"
#include "scene/scene_changes.hpp"
#include "sculpt/load_workpiece.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::sculpt {
namespace {

// Finishes and writes the mesh on a worker of its own, so that carving keeps its pool.
scene::ExportOutcome export_surface(const compute::Surface& surface, const compute::Solid& solid,
                                    const workpiece::ExportSurface& wanted) {
    const std::string& name = wanted.name.empty() ? wanted.path : wanted.name;
    scene::ExportOutcome outcome{"", wanted.path, wanted.asked_by};
    const auto ended = [&](std::string message) {
        outcome.message = std::move(message);
        return outcome;
    };
    if (wanted.refused) return ended(wanted.refused->line());
    WorkerPool alone(1);
    const Result<FinishedMesh> finished =
        finish_mesh(surface, solid, wanted.unit, std::nullopt, wanted.crumbs_m, alone);
    if (!finished) return ended(finished.error().line());
    if (finished->mesh.triangles.empty() && !finished->too_thin.empty()) return ended(name + ": " + finished->too_thin);
    if (finished->mesh.triangles.empty()) return ended(name + ": there is nothing left to export; undo some strokes");
    std::error_code ignored;
    const bool was_there = std::filesystem::exists(wanted.path, ignored);
    if (const auto written = export_finished(*finished, wanted.path); !written) return ended(written.error().line());
    outcome.written = true;
    outcome.replaced = was_there;
    const auto left = finished->self_intersections["left"].get<std::uint64_t>();
    return ended("exported " + std::to_string(finished->mesh.triangles.size()) + " triangles to " + name + ", in " +
                 descriptor_of(wanted.unit).plural +
                 (finished->crumbs.count > 0 ? "; " + in_words(finished->crumbs) : "") +
                 (left > 0 ? "; " + std::to_string(left) + " pairs of them pass through each other" : "") +
                 (finished->thin_places > 0
                      ? "; " + std::to_string(finished->thin_places) + " places are thinner than the mesh can show"
                      : "") +
                 (loses_colours(finished->mesh, wanted.path) ? "; STL keeps no colours: a .ply file does" : ""));
}

}  // namespace

CarvedPart::CarvedPart(Sculpture& sculpture, const toolbox::Tool& tool, double hardness_Ns_per_m3,
                       std::optional<std::size_t> undo_bytes, std::size_t hand)
    : sculpture_(sculpture), keeps_history_(undo_bytes.has_value()) {
    carvers_.push_back({hand, StrokeReader(tool, hardness_Ns_per_m3, sculpture.surface().lattice().spacing_m)});
    if (undo_bytes && sculpture_.history() == nullptr) sculpture_.keep_history(*undo_bytes);
}

CarvedPart::~CarvedPart() {
    journal_ = nullptr;  // who takes it may be gone
    CarvedPart::finish();
}

// ---- Updates

CarvedPart::Carver* CarvedPart::carver_of(std::size_t hand) {
    const auto at = std::ranges::find(carvers_, hand, &Carver::hand);
    return at != carvers_.end() ? &*at : nullptr;
}

double CarvedPart::around_m(std::size_t hand) const {
    const auto at = std::ranges::find(carvers_, hand, &Carver::hand);
    return at != carvers_.end() ? at->reader.around_m() : 0.0;
}

void CarvedPart::take_ticks(std::size_t part, std::span<const haptics::TickRecord> ticks) {
    if (Carver* const carver = carver_of(part)) carver->reader.take(ticks);
}

Result<void> CarvedPart::update(Nanoseconds now_ns, const scene::PartSeen* recorded) {
    seen_ = recorded != nullptr ? *recorded : scene::PartSeen{.background_ended = export_is_done()};
    if (seen_.background_ended) finish();
    for (Carver& carver : carvers_) BURIN_TRY_DO(carve(carver));
    if (recorded == nullptr && lags_) {
        BURIN_TRY_DO(sculpture_.follow_done());
        seen_.behind = sculpture_.under_way();
    } else {
        BURIN_TRY_DO(sculpture_.follow_until(seen_.behind));
    }
    carry_out_waiting(now_ns);
    if (!pressed() || now_ns - journal_told_ns_ >= kJournal_ns) {
        tell_journal();
        journal_told_ns_ = now_ns;
    }
    return {};
}

void CarvedPart::keep_journal(TakeChange take) {
    sculpture_.note_changes();
    journal_ = std::move(take);
}

std::uint64_t CarvedPart::state() const { return sculpture_.history() != nullptr ? sculpture_.history()->state() : 0; }

void CarvedPart::tell_journal() {
    scene::Pages change;
    while (journal_ && sculpture_.take_change(change)) journal_(std::move(change));
}

bool CarvedPart::copy(scene::Pages& pages) {
    if (pressed()) return false;
    tell_journal();
    sculpture_.copy(pages);
    return true;
}

Result<void> CarvedPart::carve(Carver& carver) {
    SweptSamples swept;
    do {
        swept = carver.reader.read();
        drop_invalid(carver, swept.sweeps);
        note_border(carver, swept.sweeps);
        if (!swept.sweeps.empty()) {
            BURIN_TRY_DO(sculpture_.begin(swept.sweeps));
        }
        if (swept.stroke_ended) {
            sculpture_.end_stroke();
            carver.said_why = carver.said_border = false;
        }
    } while (swept.stroke_ended);
    return {};
}

Result<void> CarvedPart::add_near(const scene::ProbeBall& ball, geometry::LocalSurface& draft) {
    if (Carver* const carver = carver_of(ball.hand)) carver->tool_object = ball.center_scene;
    sculpture_.local_surface(ball.center_scene, ball.radius_m, draft);
    draft.tiles_edits = edits_;
    return {};
}

bool CarvedPart::pressed() const {
    return std::ranges::any_of(carvers_, [](const Carver& carver) { return carver.reader.pressed(); });
}

void CarvedPart::after_publication() {
    if (stroke_open_ && !pressed()) status_changed_ = true;
    stroke_open_ = pressed();
    // Light is baked where a tool works; where none does, around the first.
    const auto working = std::ranges::find_if(carvers_, [](const Carver& c) { return c.reader.pressed(); });
    const Carver& lit = working != carvers_.end() ? *working : carvers_.front();
    sculpture_.bake_light(lit.tool_object, stroke_open_ ? kLitWorking : kLitResting);
    if (keeps_history_) {
        for (const std::string& notice : sculpture_.take_notices()) notify(notice);
    }
    busy_ = has_news();
}

// Drops sweeps that cannot be carved, such as smoothing too far at once, and says why once a stroke: a session that
// ended for one of them would lose all others.
void CarvedPart::drop_invalid(Carver& carver, std::vector<compute::ToolSweep>& sweeps) {
    const compute::Solid& solid = sculpture_.engine().solid();
    std::erase_if(sweeps, [&](const compute::ToolSweep& sweep) {
        std::optional<Error> why = carver.refused;
        if (const auto ok = compute::check_tool(solid, sweep); !ok && !why) why = ok.error();
        if (why && !std::exchange(carver.said_why, true)) notify(why->line());
        return why.has_value();
    });
}

// Tells once a stroke that material was added beyond the lattice, where none can be.
void CarvedPart::note_border(Carver& carver, std::span<const compute::ToolSweep> sweeps) {
    const Box room = workpiece::lattice_bounds(sculpture_.surface().lattice());
    const auto leaves = [&](const compute::ToolSweep& sweep) {
        const Vec3 least(toolbox::size_of(sweep.shape));
        return sweep.operation == compute::Operation::fill &&
               glm::any(glm::lessThan(glm::min(sweep.start.position_m, sweep.end.position_m) - least, room.lo) ||
                        glm::greaterThan(glm::max(sweep.start.position_m, sweep.end.position_m) + least, room.hi));
    };
    if (carver.said_border || !std::ranges::any_of(sweeps, leaves)) return;
    carver.said_border = true;
    notify(
        "what is added ends at the border of the room around the workpiece; for more, export it (Ctrl+E) and open that "
        "file with a larger --room");
}

bool CarvedPart::has_news() const {
    return sculpture_.has_changed_tiles() || !messages_.empty() || !exports_.empty() || status_changed_;
}

void CarvedPart::take_changes(scene::SceneChanges& changes) {
    if (auto update = take_surface_update())
        changes.drawn.push_back(std::make_shared<scene::SurfaceChange>(std::move(*update)));
}

std::optional<scene::SurfaceUpdate> CarvedPart::take_surface_update() {
    scene::SurfaceUpdate update;
    const compute::SurfaceLight* light = sculpture_.light();
    for (const std::uint32_t tile : sculpture_.take_changed_tiles()) {
        update.tiles.push_back(
            {tile, sculpture_.surface().shared_tile(tile), light != nullptr ? light->shared_light(tile) : nullptr});
    }
    if (light != nullptr) update.inner_boxes_object = light->inner_boxes_object();
    if (update.tiles.empty() && messages_.empty() && exports_.empty() && !status_changed_) return std::nullopt;
    status_changed_ = false;
    for (const Carver& carver : carvers_) update.cut_ns = std::max(update.cut_ns, carver.reader.last_worked_ns());
    if (const compute::History* history = sculpture_.history()) {
        update.undoable = history->undoable();
        update.redoable = history->redoable();
        update.state = history->state();
    }
    update.exporting = export_.valid();
    update.messages = std::exchange(messages_, {});
    update.exports = std::exchange(exports_, {});
    return update;
}

// ---- Orders

void CarvedPart::order(const workpiece::CarveOrder& order) {
    const bool walks =
        std::holds_alternative<workpiece::UndoStroke>(order) || std::holds_alternative<workpiece::RedoStroke>(order);
    const bool writes =
        std::holds_alternative<workpiece::ExportSurface>(order) || std::holds_alternative<workpiece::SaveScene>(order);
    const bool forgets = std::holds_alternative<workpiece::ForgetUndone>(order);
    const bool follows = !waiting_.empty() && (writes || forgets);
    if (follows || (walks && (pressed() || !waiting_.empty()))) {
        waiting_.push_back(order);
        return;
    }
    std::visit([this](const auto& one) { carry_out(one); }, order);
    status_changed_ = true;
}

// Waits, because samples of the stroke that come after the undo would begin a new stroke, which nobody undoes.
void CarvedPart::carry_out_waiting(Nanoseconds now_ns) {
    if (waiting_.empty()) return;
    if (!waiting_since_ns_) waiting_since_ns_ = now_ns;
    if (pressed() && now_ns - *waiting_since_ns_ < kMostWait_ns) return;
    waiting_since_ns_.reset();
    for (const workpiece::CarveOrder& one : std::exchange(waiting_, {}))
        std::visit([this](const auto& what) { carry_out(what); }, one);
    status_changed_ = true;
}

void CarvedPart::order(const workpiece::UseTool& use, std::size_t hand) {
    Carver* carver = carver_of(hand);
    if (carver == nullptr) {
        const double cell_m = sculpture_.surface().lattice().spacing_m;
        carver = &carvers_.emplace_back(hand, StrokeReader(use.tool, use.hardness_Ns_per_m3, cell_m));
    }
    use_tool(*carver, use);
    status_changed_ = true;
}

void CarvedPart::use_tool(Carver& carver, const workpiece::UseTool& use) {
    const Result<std::uint8_t> material = sculpture_.add_material(use.material);
    if (!material) return notify(material.error().line());
    toolbox::Tool tool = use.tool;
    tool.material = *material;
    carver.refused.reset();
    if (const auto ok = compute::check_tool(sculpture_.engine().solid(), tool.sweep(Pose{}, Pose{})); !ok) {
        carver.refused = ok.error();
        return notify(ok.error().line());
    }
    carver.reader.use_tool(tool, use.hardness_Ns_per_m3);
}

void CarvedPart::carry_out(const workpiece::UndoStroke&) {
    sculpture_.end_stroke();
    ++edits_;
    ++walked_;
    const Result<std::size_t> undone = sculpture_.undo(1);
    if (!undone) return notify(undone.error().line());
    if (*undone == 0) notify("there is no stroke to undo");
}

void CarvedPart::carry_out(const workpiece::RedoStroke&) {
    ++edits_;
    ++walked_;
    const Result<std::size_t> redone = sculpture_.redo(1);
    if (!redone) return notify(redone.error().line());
    if (*redone == 0) notify("there is no stroke to redo");
}

void CarvedPart::carry_out(const workpiece::ForgetUndone&) {
    if (compute::History* const history = sculpture_.history()) history->forget_undone();
}

scene::PartSteps CarvedPart::undo_steps() const {
    const compute::History* const history = sculpture_.history();
    if (history == nullptr) return {};
    const std::int64_t done = history->first() + static_cast<std::int64_t>(history->undoable()) - 1;
    return {.first = history->first(),
            .done = done,
            .last = done + static_cast<std::int64_t>(history->redoable()),
            .made = history->made(),
            .walked = walked_};
}

void CarvedPart::go(scene::StepWay way) {
    switch (way) {
        case scene::StepWay::back: return order(workpiece::UndoStroke{});
        case scene::StepWay::forward: return order(workpiece::RedoStroke{});
        case scene::StepWay::forget: return order(workpiece::ForgetUndone{});
    }
}

// Copies the surface and the rays: tiles are shared, so the rays are the only large part of the copy.
void CarvedPart::carry_out(const workpiece::ExportSurface& wanted) {
    const auto refuse = [&](const Error& why) { exports_.push_back({why.line(), wanted.path, wanted.asked_by}); };
    if (export_.valid()) return refuse({"an export is under way", "", "wait for it to end"});
    if (const auto ok = check_precision(wanted.path, sculpture_.surface().lattice()); !ok) return refuse(ok.error());
    sculpture_.end_stroke();
    export_ = std::async(std::launch::async, [surface = sculpture_.surface(), solid = sculpture_.engine().solid(),
                                              wanted] { return export_surface(surface, solid, wanted); });
}

// A save that fails leaves the journal with all that it should have saved.
void CarvedPart::carry_out(const workpiece::SaveScene& wanted) {
    sculpture_.end_stroke();
    tell_journal();
    if (wanted.save) wanted.save();
}

void CarvedPart::carry_out(const workpiece::LightFrom& from) {
    if (const auto kept = sculpture_.keep_light(from.lamp_object); !kept) notify(kept.error().line());
}

void CarvedPart::notify(std::string message) { messages_.push_back(std::move(message)); }

bool CarvedPart::export_is_done() const {
    return export_.valid() && export_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void CarvedPart::finish() {
    tell_journal();
    if (!export_.valid()) return;
    exports_.push_back(export_.get());
    status_changed_ = true;
}

}  // namespace burin::sculpt
