// SPDX-License-Identifier: MIT
#include "app/session/carving_desk.hpp"

#include <chrono>

#include "compute/tool_spans.hpp"
#include "geometry/mesh_export.hpp"

namespace burin {
namespace {

// Tiles whose light is worked out anew at each update: few while the tool works, more while it rests.
constexpr std::size_t kLitWorking = 4, kLitResting = 16;

// Works on copies of its own: tiles are shared, and the rays are the only thing of size.
std::string export_surface(const Surface& surface, const Solid& solid, const std::string& path) {
    WorkerPool alone(1);
    const Result<FinishedMesh> finished = finish_mesh(surface, solid, std::nullopt, alone);
    if (!finished) return finished.error().line();
    if (finished->mesh.triangles.empty()) return path + ": there is nothing left to export; undo some strokes";
    if (const auto written = export_mesh(finished->mesh, path); !written) return written.error().line();
    return "exported " + std::to_string(finished->mesh.triangles.size()) + " triangles to " + path;
}

}  // namespace

CarvingDesk::CarvingDesk(Carving& carving, HapticChannels& channels, WorkerPool& pool, const Tool& tool,
                         double hardness_Ns_per_m3, double reach_m, std::size_t undo_bytes)
    : carving_(carving), pool_(pool), side_(carving, channels, tool, hardness_Ns_per_m3, reach_m) {
    carving_.keep_history(undo_bytes);
}

CarvingDesk::~CarvingDesk() { finish_export(); }

void CarvingDesk::order(const CarvingOrder& order) {
    std::visit([this](const auto& one) { carry_out(one); }, order);
    anything_ = true;
}

void CarvingDesk::carry_out(const UseTool& use) {
    const Result<std::uint8_t> material = carving_.add_material(use.material);
    if (!material) return say(material.error().line());
    Tool tool = use.tool;
    tool.material = *material;
    if (const auto ok = check_sweep(carving_.engine().solid(), tool.sweep(Pose{}, Pose{})); !ok) {
        return say(ok.error().line());
    }
    side_.use_tool(tool, use.hardness_Ns_per_m3);
    republish_ = true;  // a larger tool wants to know a larger part of the surface
}

void CarvingDesk::carry_out(const UndoStroke&) {
    carving_.end_stroke();
    const Result<std::size_t> undone = carving_.undo(1);
    if (!undone) return say(undone.error().line());
    if (*undone == 0) return say("there is no stroke to undo");
    republish_ = true;
}

void CarvingDesk::carry_out(const RedoStroke&) {
    const Result<std::size_t> redone = carving_.redo(1);
    if (!redone) return say(redone.error().line());
    if (*redone == 0) return say("there is no stroke to redo");
    republish_ = true;
}

void CarvingDesk::carry_out(const ExportSurface& wanted) {
    if (export_.valid()) return say("an export is under way; wait for it to end");
    carving_.end_stroke();
    if (const auto home = carving_.bring_home(); !home) return say(home.error().line());
    export_ = std::async(std::launch::async, [surface = carving_.surface(), solid = carving_.engine().solid(),
                                              path = wanted.path] { return export_surface(surface, solid, path); });
}

void CarvingDesk::carry_out(const LightFrom& from) {
    if (const auto kept = carving_.keep_light(from.lamp_object); !kept) say(kept.error().line());
}

void CarvingDesk::say(std::string message) { messages_.push_back(std::move(message)); }

bool CarvingDesk::export_is_done() const {
    return export_.valid() && export_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void CarvingDesk::finish_export() {
    if (!export_.valid()) return;
    say(export_.get());
    anything_ = true;
}

Result<void> CarvingDesk::update(Nanoseconds now_ns) {
    seen_ = {.time_ns = now_ns, .last_tick = 0, .orders = 0, .export_ended = export_is_done()};
    if (seen_.export_ended) finish_export();
    return carve(now_ns, UINT64_MAX);
}

Result<void> CarvingDesk::repeat(const UpdateSeen& seen) {
    seen_ = seen;
    if (seen.export_ended) finish_export();
    return carve(seen.time_ns, seen.last_tick);
}

Result<void> CarvingDesk::carve(Nanoseconds now_ns, std::uint64_t last_tick) {
    if (const auto updated = side_.update(now_ns, last_tick); !updated) return updated;
    seen_.last_tick = side_.last_tick();
    if (stroke_open_ && !side_.pressed()) {  // the button came up: a stroke is what can be undone at once
        carving_.end_stroke();
        anything_ = true;
    }
    stroke_open_ = side_.pressed();
    carving_.bake_light(side_.tool_position_object(), stroke_open_ ? kLitWorking : kLitResting);
    for (const std::string& notice : carving_.history()->take_notices()) say(notice);
    return {};
}

std::optional<SurfaceNews> CarvingDesk::take_news() {
    SurfaceNews news;
    const SurfaceLight* light = carving_.light();
    for (const std::uint32_t tile : carving_.take_changed_tiles()) {
        news.tiles.push_back(
            {tile, carving_.surface().shared_tile(tile), light != nullptr ? light->shared_light(tile) : nullptr});
    }
    if (light != nullptr) news.inner_boxes_object = light->inner_boxes_object();
    if (news.tiles.empty() && messages_.empty() && !anything_) return std::nullopt;
    anything_ = false;
    news.cut_ns = side_.last_worked_ns();
    news.undoable = carving_.history()->undoable();
    news.redoable = carving_.history()->redoable();
    if (export_.valid()) news.export_progress = 0.5;
    news.messages = std::move(messages_);
    messages_.clear();
    return news;
}

}  // namespace burin
