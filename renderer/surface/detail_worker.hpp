// SPDX-License-Identifier: MIT
// Computes coarser levels of patches (patch_detail.hpp) on a low-priority
// thread of its own: frames need them soon, but no frame waits for them.
//
// Data flow: give() queues a patch in its present state; take() returns what is done. The owner detects patches that
// changed meanwhile by the tile and the light that come back with the levels.
// Thread: one owner. The worker only reads tiles, which are immutable.
// It starts with the first patch and sleeps while its queue is empty.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "geometry/contact/surface_tile.hpp"
#include "renderer/surface/patch_groups.hpp"

namespace burin::renderer {

// The levels of a patch, or of a group of patches where it has members.
struct DetailJob {
    std::uint32_t patch = 0;
    std::shared_ptr<const geometry::SurfaceTile> surface;
    std::vector<geometry::VertexLight> light;  // empty: full light
    double edge_m = 0.0;
    std::vector<GroupMember> members = {};
    GroupPlace group{};
    std::uint64_t version = 0;  // of the group
    [[nodiscard]] std::vector<PatchLevel> levels() const {
        if (!members.empty()) return group_levels(members, edge_m);
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
    ~DetailWorker() { end(); }
    DetailWorker(const DetailWorker&) = delete;
    DetailWorker& operator=(const DetailWorker&) = delete;

    void give(DetailJob job);
    [[nodiscard]] std::vector<DetailDone> take();
    [[nodiscard]] std::size_t waiting() const { return waiting_; }  // number of patches given and not yet taken
    // Finishes the patch in progress and begins no other; what is done can still be taken. Nothing is given afterwards.
    void end();

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

}  // namespace burin::renderer
