// SPDX-License-Identifier: MIT
#include "sculpt/made_workpiece.hpp"
#include "geometry/files/closed_mesh.hpp"

#include "base/try.hpp"

#include <utility>

namespace burin::sculpt {

Result<MadeWorkpiece> make_workpiece(const workpiece::WorkpieceOptions& options,
                                     const compute::EngineMaker& make_engine, unsigned threads,
                                     const workpiece::LoadWatch& watch) {
    auto pool = std::make_unique<WorkerPool>(threads);
    BURIN_TRY(loaded, load_workpiece(options, *pool, watch));
    return ready_to_carve(std::move(loaded), make_engine, std::move(pool), watch, meshing_from(options));
}

Result<MadeWorkpiece> ready_to_carve(workpiece::LoadedWorkpiece loaded, const compute::EngineMaker& make_engine,
                                     std::unique_ptr<WorkerPool> pool, const workpiece::LoadWatch& watch, double from) {
    const compute::Lattice lattice = loaded.solid.lattice;
    compute::ChosenEngine chosen = make_engine(std::move(loaded.solid), *pool);
    begin_step(watch.work, "meshing the surface", from, 1.0);
    auto carving = std::make_unique<Sculpture>(std::move(chosen.engine), *pool, watch.work);
    if (watch.work != nullptr && !watch.work->is_wanted()) return geometry::no_longer_wanted();
    return MadeWorkpiece{std::move(pool), std::move(loaded), lattice, std::move(carving)};
}

}  // namespace burin::sculpt
