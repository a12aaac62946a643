// SPDX-License-Identifier: MIT
#include "sculpt/sculpt_service.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include "compute/tools/apply.hpp"
#include "geometry/files/mesh_export.hpp"

namespace burin::sculpt {
namespace {

// Finishes and writes the mesh on a worker of its own, so that carving keeps its pool; returns the message for the
// user.
std::string export_surface(const compute::Surface& surface, const compute::Solid& solid, const std::string& path) {
    WorkerPool alone(1);
    const Result<FinishedMesh> finished = finish_mesh(surface, solid, std::nullopt, alone);
    if (!finished) return finished.error().line();
    if (finished->mesh.triangles.empty()) return path + ": there is nothing left to export; undo some strokes";
    if (const auto written = geometry::export_mesh(finished->mesh, path); !written) return written.error().line();
    return "exported " + std::to_string(finished->mesh.triangles.size()) + " triangles to " + path;
}

}  // namespace

SculptService::SculptService(Sculpture& sculpture, haptics::HapticChannels& channels, const Tool& tool,
                             double hardness_Ns_per_m3, double reach_m, std::optional<std::size_t> undo_bytes)
    : sculpture_(sculpture), reach_m_(reach_m), keeps_history_(undo_bytes.has_value()) {
    hands_.reserve(kMostHands);
    add_hand(channels, tool, hardness_Ns_per_m3);
    if (undo_bytes) sculpture_.keep_history(*undo_bytes);
}

SculptService::~SculptService() { finish_export(); }

std::size_t SculptService::add_hand(haptics::HapticChannels& channels, const Tool& tool, double hardness_Ns_per_m3) {
    BURIN_CHECK(hands_.size() < kMostHands);
    const double cell_m = sculpture_.surface().lattice().spacing_m;
    hands_.push_back({channels, StrokeReader(channels, tool, hardness_Ns_per_m3, cell_m)});
    return hands_.size() - 1;
}

// ---- Updates

Result<void> SculptService::update(Nanoseconds now_ns, const UpdateSeen* recorded) {
    seen_ = recorded != nullptr ? *recorded : UpdateSeen{.time_ns = now_ns, .export_ended = export_is_done()};
    return update_seen(recorded);
}

Result<void> SculptService::finish(Nanoseconds now_ns) {
    seen_ = {.time_ns = now_ns, .export_ended = export_is_done(), .last = true};
    return update_seen(nullptr);
}

Result<void> SculptService::update_seen(const UpdateSeen* recorded) {
    if (seen_.export_ended) finish_export();
    take_samples(recorded);
    if (const auto carved = carve(); !carved) return carved;
    ++sequence_;
    for (Hand& hand : hands_)
        if (const auto published = publish(hand, seen_.time_ns); !published) return published;
    const bool pressed = std::ranges::any_of(hands_, [](const Hand& hand) { return hand.reader.pressed(); });
    if (stroke_open_ && !pressed) status_changed_ = true;
    stroke_open_ = pressed;
    bake_light();
    if (keeps_history_) {
        for (const std::string& notice : sculpture_.history()->take_notices()) notify(notice);
    }
    return {};
}

// What is carved follows from the samples taken and the update's time alone, so a recorded update is repeated.
void SculptService::take_samples(const UpdateSeen* recorded) {
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        std::uint64_t& last_tick = i == 0 ? seen_.last_tick : seen_.other_ticks[i - 1];
        hands_[i].reader.take(recorded != nullptr ? last_tick : UINT64_MAX);
        last_tick = hands_[i].reader.last_tick();
    }
}

// ---- The order of what the hands do

Result<void> SculptService::carve() {
    const Nanoseconds complete_ns = this->complete_ns();
    while (const std::optional<Nanoseconds> oldest_ns = this->oldest_ns()) {
        const Nanoseconds end_ns = hands_.size() == 1 ? INT64_MAX : (*oldest_ns / kSlice_ns + 1) * kSlice_ns;
        if (end_ns > complete_ns) break;
        if (const auto carved = carve_slice(end_ns); !carved) return carved;
    }
    return {};
}

std::optional<Nanoseconds> SculptService::oldest_ns() const {
    std::optional<Nanoseconds> oldest_ns;
    for (const Hand& hand : hands_) {
        const auto waits_ns = hand.reader.oldest_ns();
        if (waits_ns && (!oldest_ns || *waits_ns < *oldest_ns)) oldest_ns = waits_ns;
    }
    return oldest_ns;
}

// Returns the time before which all hands that are waited for have written their samples.
Nanoseconds SculptService::complete_ns() const {
    Nanoseconds complete_ns = INT64_MAX;
    if (hands_.size() == 1 || seen_.last) return complete_ns;
    for (const Hand& hand : hands_) {
        const Nanoseconds last_ns = hand.reader.last_ns();
        if (last_ns >= seen_.time_ns - kPatience_ns) complete_ns = std::min(complete_ns, last_ns);
    }
    return complete_ns;
}

Result<void> SculptService::carve_slice(Nanoseconds end_ns) {
    for (auto next_ns = oldest_ns(); next_ns && *next_ns < end_ns; next_ns = oldest_ns())
        if (const auto carved = carve_piece(end_ns); !carved) return carved;
    if (hands_.size() > 1) carved_to_ns_ = std::max(carved_to_ns_, end_ns);
    return {};
}

// Carves a part of a slice. A hand's release ends it for all, so that strokes end in the order of the releases. Hands
// that do not meet are carved one after the other, each with as few sweeps as stand for its samples.
Result<void> SculptService::carve_piece(Nanoseconds end_ns) {
    const bool is_late = end_ns <= carved_to_ns_;
    if (hands_.size() > 1) end_ns = std::min(end_ns, first_release_ns(end_ns) + 1);
    const bool meet = hands_meet(end_ns);
    std::vector<Worked> worked;
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        SweptSamples swept = hands_[i].reader.read(end_ns, meet);
        drop_invalid(hands_[i], swept);
        if (is_late) count_late(hands_[i], swept);
        if (!meet && !swept.sweeps.empty()) {
            if (const auto updated = sculpture_.update(swept.sweeps, i); !updated) return updated;
        }
        worked.push_back({i, std::move(swept)});
    }
    if (meet) {
        if (const auto carved = carve_merged(worked); !carved) return carved;
    }
    for (const Worked& one : worked) {
        if (!one.swept.stroke_ended) continue;
        sculpture_.end_stroke(one.hand);
        hands_[one.hand].said_why = hands_[one.hand].said_late = false;
    }
    return {};
}

Nanoseconds SculptService::first_release_ns(Nanoseconds before_ns) const {
    Nanoseconds first_ns = before_ns - 1;
    for (const Hand& hand : hands_) first_ns = std::min(first_ns, hand.reader.release_ns(before_ns).value_or(first_ns));
    return first_ns;
}

bool SculptService::hands_meet(Nanoseconds before_ns) const {
    std::vector<Box> reached;
    for (const Hand& hand : hands_) {
        if (hands_.size() == 1) return false;
        const Box box = hand.reader.reach_object(before_ns);
        if (box.empty()) continue;
        const auto meets = [&](const Box& other) {
            return glm::all(glm::lessThanEqual(box.lo, other.hi)) && glm::all(glm::lessThanEqual(other.lo, box.hi));
        };
        if (std::ranges::any_of(reached, meets)) return true;
        reached.push_back(box);
    }
    return false;
}

// Carves sample by sample in the order of time; of the same time, the first hand's comes first. What was done at one
// place at one time is one stroke.
Result<void> SculptService::carve_merged(const std::vector<Worked>& worked) {
    struct Timed {
        Nanoseconds time_ns;
        const compute::ToolSweep* sweep;
    };
    std::vector<Timed> timed;
    std::optional<std::size_t> first;
    for (const Worked& one : worked) {
        if (one.swept.sweeps.empty()) continue;
        for (std::size_t i = 0; i < one.swept.sweeps.size(); ++i)
            timed.push_back({one.swept.ends_ns[i], &one.swept.sweeps[i]});
        if (first) sculpture_.join_strokes(*first, one.hand);
        if (!first) first = one.hand;
    }
    if (!first) return {};
    std::ranges::stable_sort(timed, {}, &Timed::time_ns);
    std::vector<compute::ToolSweep> sweeps;
    for (const Timed& one : timed) sweeps.push_back(*one.sweep);
    return sculpture_.update(sweeps, *first);
}

void SculptService::count_late(Hand& hand, const SweptSamples& swept) {
    hand.late_samples += swept.samples;
    if (!swept.sweeps.empty() && !std::exchange(hand.said_late, true)) {
        notify("hand " + std::to_string(&hand - hands_.data()) +
               " was held up: a part of its stroke was carved after what the others did later");
    }
}

// Drops sweeps that cannot be carved, such as smoothing too far at once, and says why once a stroke: a session that
// ended for one of them would lose all others.
void SculptService::drop_invalid(Hand& hand, SweptSamples& swept) {
    const compute::Solid& solid = sculpture_.engine().solid();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < swept.sweeps.size(); ++i) {
        std::optional<Error> why = hand.refused;
        if (const auto ok = compute::check_tool(solid, swept.sweeps[i]); !ok && !why) why = ok.error();
        if (why && !std::exchange(hand.said_why, true)) notify(why->line());
        if (why) continue;
        if (!swept.ends_ns.empty()) swept.ends_ns[kept] = swept.ends_ns[i];
        if (kept != i) swept.sweeps[kept] = std::move(swept.sweeps[i]);
        ++kept;
    }
    swept.sweeps.resize(kept);
}

Result<void> SculptService::publish(Hand& hand, Nanoseconds now_ns) {
    geometry::LocalSurface& surface = hand.channels.surface.draft();
    const double radius_m = hand.reader.around_m() + reach_m_;
    if (const auto done = sculpture_.local_surface(hand.reader.tool_position_object(), radius_m, surface); !done)
        return done;
    surface.sequence = sequence_;
    surface.made_ns = now_ns;
    hand.channels.surface.publish();
    return {};
}

void SculptService::bake_light() {
    const std::size_t most = (stroke_open_ ? kLitWorking : kLitResting) / hands_.size();
    for (const Hand& hand : hands_) sculpture_.bake_light(hand.reader.tool_position_object(), most);
}

std::optional<SurfaceUpdate> SculptService::take_surface_update() {
    SurfaceUpdate update;
    const compute::SurfaceLight* light = sculpture_.light();
    for (const std::uint32_t tile : sculpture_.take_changed_tiles()) {
        update.tiles.push_back(
            {tile, sculpture_.surface().shared_tile(tile), light != nullptr ? light->shared_light(tile) : nullptr});
    }
    if (light != nullptr) update.inner_boxes_object = light->inner_boxes_object();
    if (update.tiles.empty() && messages_.empty() && !status_changed_) return std::nullopt;
    status_changed_ = false;
    for (const Hand& hand : hands_) update.cut_ns = std::max(update.cut_ns, hand.reader.last_worked_ns());
    if (const compute::History* history = sculpture_.history()) {
        update.undoable = history->undoable();
        update.redoable = history->redoable();
    }
    update.exporting = export_.valid();
    update.messages = std::exchange(messages_, {});
    return update;
}

// ---- Orders

void SculptService::order(const SculptOrder& order) {
    std::visit([this](const auto& one) { carry_out(one); }, order);
    status_changed_ = true;
}

void SculptService::carry_out(const UseTool& use) {
    if (use.hand >= hands_.size()) return notify("there is no hand " + std::to_string(use.hand));
    const Result<std::uint8_t> material = sculpture_.add_material(use.material);
    if (!material) return notify(material.error().line());
    Hand& hand = hands_[use.hand];
    Tool tool = use.tool;
    tool.material = *material;
    hand.refused.reset();
    if (const auto ok = compute::check_tool(sculpture_.engine().solid(), tool.sweep(Pose{}, Pose{})); !ok) {
        hand.refused = ok.error();
        return notify(ok.error().line());
    }
    hand.reader.use_tool(tool, use.hardness_Ns_per_m3);
}

void SculptService::carry_out(const UndoStroke&) {
    sculpture_.end_strokes();
    const Result<std::size_t> undone = sculpture_.undo(1);
    if (!undone) return notify(undone.error().line());
    if (*undone == 0) notify("there is no stroke to undo");
}

void SculptService::carry_out(const RedoStroke&) {
    const Result<std::size_t> redone = sculpture_.redo(1);
    if (!redone) return notify(redone.error().line());
    if (*redone == 0) notify("there is no stroke to redo");
}

// Copies the surface and the rays: tiles are shared, so the rays are the only large part of the copy.
void SculptService::carry_out(const ExportSurface& wanted) {
    if (export_.valid()) return notify("an export is under way; wait for it to end");
    if (const auto ok = check_precision(wanted.path, sculpture_.surface().lattice()); !ok)
        return notify(ok.error().line());
    sculpture_.end_strokes();
    if (const auto read = sculpture_.read_back(); !read) return notify(read.error().line());
    export_ = std::async(std::launch::async, [surface = sculpture_.surface(), solid = sculpture_.engine().solid(),
                                              path = wanted.path] { return export_surface(surface, solid, path); });
}

void SculptService::carry_out(const LightFrom& from) {
    if (const auto kept = sculpture_.keep_light(from.lamp_object); !kept) notify(kept.error().line());
}

void SculptService::notify(std::string message) { messages_.push_back(std::move(message)); }

bool SculptService::export_is_done() const {
    return export_.valid() && export_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void SculptService::finish_export() {
    if (!export_.valid()) return;
    notify(export_.get());
    status_changed_ = true;
}

}  // namespace burin::sculpt
