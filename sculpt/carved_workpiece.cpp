// SPDX-License-Identifier: MIT
#include "sculpt/carved_workpiece.hpp"

#include <utility>

#include "base/try.hpp"
#include "base/worker_pool.hpp"
#include "sculpt/carved_part.hpp"
#include "sculpt/made_workpiece.hpp"
#include "sculpt/sculpture.hpp"

namespace burin::sculpt {
namespace {

class CarvedWorkpiece final : public workpiece::Workpiece {
public:
    explicit CarvedWorkpiece(MadeWorkpiece made) : made_(std::move(made)) {}

    [[nodiscard]] const workpiece::LoadedWorkpiece& loaded() const override { return made_.loaded; }
    [[nodiscard]] const compute::Surface& surface() const override { return made_.carving->surface(); }
    [[nodiscard]] const compute::CarvingEngine& engine() const override { return made_.carving->engine(); }
    [[nodiscard]] Work work() const override {
        return {made_.carving->figures().updates, made_.carving->figures().rays_changed};
    }
    void copy(scene::Pages& pages) const override { made_.carving->copy(pages); }

    [[nodiscard]] workpiece::WorkpiecePart& begin(const workpiece::UseTool& use, std::size_t undo_bytes,
                                                  std::size_t parts) override {
        part_.emplace(*made_.carving, use.tool, use.hardness_Ns_per_m3, undo_bytes);
        for (std::size_t part = 0; part < parts; ++part) part_->order(use, part);
        return *part_;
    }

private:
    MadeWorkpiece made_;
    std::optional<CarvedPart> part_;  // refers to the carving
};

}  // namespace

Result<std::unique_ptr<workpiece::Workpiece>> make_carved_workpiece(const workpiece::WorkpieceOptions& options,
                                                                    std::optional<workpiece::EarlierWork> earlier,
                                                                    const compute::EngineMaker& make_engine,
                                                                    unsigned threads,
                                                                    const workpiece::LoadWatch& watch) {
    BURIN_TRY(made, earlier ? ready_to_carve(std::move(earlier->loaded), make_engine,
                                             std::make_unique<WorkerPool>(threads), watch)
                            : make_workpiece(options, make_engine, threads, watch));
    if (earlier && earlier->history) made.carving->keep_history(std::move(*earlier->history));
    if (earlier && earlier->is_saved) made.carving->is_saved();
    return as_workpiece(std::move(made));
}

std::unique_ptr<workpiece::Workpiece> as_workpiece(MadeWorkpiece made) {
    return std::make_unique<CarvedWorkpiece>(std::move(made));
}

}  // namespace burin::sculpt
