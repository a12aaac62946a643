// SPDX-License-Identifier: MIT
#include "session/work/opened_history.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <vector>

#include "scene/saved_objects.hpp"
#include "workpiece/saved_changes.hpp"

namespace burin::session {
namespace {

std::string strokes(std::int64_t count) { return std::to_string(count) + (count == 1 ? " stroke" : " strokes"); }

std::string edits(std::int64_t count) { return std::to_string(count) + (count == 1 ? " edit" : " edits"); }

constexpr auto kMostEdits = static_cast<std::int64_t>(WorldHistory::kMostSteps);

}  // namespace

compute::History history_in(document::DocumentReader& reader, const document::PartPlace& part,
                            const compute::Solid& solid, std::size_t undo_bytes, std::string& lost) {
    compute::History history(undo_bytes);
    const auto tell = [&](const std::string& what) { lost += (lost.empty() ? "" : "; ") + what; };
    const Result<std::optional<scene::Steps>> steps = reader.steps(part);
    if (!steps) tell("the history of its strokes is damaged: undo goes back to this opening alone");
    if (!steps || !*steps) return history;
    history.go_on_after((*steps)->done);
    const auto read = [&](std::int64_t number) -> std::optional<compute::RayBatch> {
        const Result<scene::Pages> pages = reader.step(part, number);
        if (!pages) return std::nullopt;
        Result<compute::RayBatch> step = workpiece::step_in(solid, *pages, reader.path());
        return step ? std::optional(std::move(*step)) : std::nullopt;
    };
    for (std::int64_t number = (*steps)->done + 1; number <= (*steps)->last; ++number) {
        std::optional<compute::RayBatch> step = read(number);
        if (!step) tell("a stroke that was undone is damaged: redo repeats " + strokes(number - (*steps)->done - 1));
        if (!step || !history.put_after(std::move(*step))) break;
    }
    for (std::int64_t number = (*steps)->done; number >= (*steps)->first; --number) {
        std::optional<compute::RayBatch> step = read(number);
        if (!step)
            tell("what the solid held before a stroke is damaged: undo takes back the newest " +
                 strokes((*steps)->done - number));
        if (!step || !history.put_before(std::move(*step))) break;
    }
    return history;
}

WorldHistory edits_in(document::DocumentReader& reader, const document::PartPlace& part,
                      std::span<const scene::SceneObject> objects,
                      std::span<const std::shared_ptr<const scene::CornerColours>> colours, std::string& lost) {
    const auto tell = [&](const std::string& what) { lost += (lost.empty() ? "" : "; ") + what; };
    const Result<std::optional<scene::Steps>> steps = reader.steps(part);
    if (!steps) tell("the history of its objects is damaged: undo goes back to this opening alone");
    if (!steps || !*steps) return {};
    std::deque<scene::ObjectStep> read;
    const auto add = [&](std::int64_t number, bool leads_back) {
        const Result<scene::Pages> pages = reader.step(part, number);
        if (!pages) return false;
        Result<scene::ObjectStep> step = scene::step_in(objects, colours, *pages, reader.path());
        if (step) leads_back ? read.push_front(std::move(*step)) : read.push_back(std::move(*step));
        return step.has_value();
    };
    const std::int64_t done = (*steps)->done, last = std::min((*steps)->last, done + kMostEdits);
    const std::int64_t oldest = std::max((*steps)->first, done + 1 - kMostEdits);
    std::int64_t first = done + 1;
    while (first > oldest && add(first - 1, true)) --first;
    if (first > oldest) tell("an edit of an object is damaged: undo takes back the newest " + edits(done - first + 1));
    std::int64_t next = done + 1;
    while (next <= last && add(next, false)) ++next;
    if (next <= last) tell("an edit that was undone is damaged: redo repeats " + edits(next - done - 1));
    return {first, done, std::vector<scene::ObjectStep>(read.begin(), read.end())};
}

scene::PartSteps steps_of(const compute::History& history) {
    return {.first = history.first(), .done = history.done(), .last = history.last(), .made = history.made()};
}

}  // namespace burin::session
