// SPDX-License-Identifier: MIT
#include "session/work/opened_history.hpp"

#include <optional>

#include "sculpt/saved_changes.hpp"

namespace burin::session {
namespace {

std::string strokes(std::int64_t count) { return std::to_string(count) + (count == 1 ? " stroke" : " strokes"); }

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
        Result<compute::RayBatch> step = sculpt::step_in(solid, *pages, reader.path());
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

}  // namespace burin::session
