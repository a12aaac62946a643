// SPDX-License-Identifier: MIT
// Works out coarser levels of patches (patch_detail.hpp) on a thread of its own, behind everything else that wants the processor:
// frames need them soon, but no frame waits for them.
//
// Data flow: give() a patch as it is now; take() what is done. What a patch has become meanwhile its owner knows, by the tile and the light
// that come back with the levels.
// Thread: one owner. The worker only reads tiles, which never change. It starts with the first patch and sleeps while there is none.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "geometry/surface_tile.hpp"
#include "renderer/surface/patch_detail.hpp"

namespace burin {

struct DetailJob {
    std::uint32_t patch = 0;
    std::shared_ptr<const SurfaceTile> surface;
    std::vector<VertexLight> light;  // empty: full
    double edge_m = 0.0;
    [[nodiscard]] std::vector<PatchLevel> levels() const {
        return coarser_levels(surface->vertices, surface->indices, light, edge_m);
    }
};
struct DetailDone {
    DetailJob job;
    std::vector<PatchLevel> levels;
};

class DetailWorker {
public:
    DetailWorker() = default;
    ~DetailWorker();  // does not begin another patch
    DetailWorker(const DetailWorker&) = delete;
    DetailWorker& operator=(const DetailWorker&) = delete;

    void give(DetailJob job);
    [[nodiscard]] std::vector<DetailDone> take();
    [[nodiscard]] std::size_t waiting() const { return waiting_; }  // given and not taken

private:
    void run();

    std::size_t waiting_ = 0;
    std::mutex mutex_;
    std::condition_variable given_;
    std::deque<DetailJob> jobs_;
    std::vector<DetailDone> done_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace burin
