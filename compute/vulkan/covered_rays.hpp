// SPDX-License-Identifier: MIT
// Computes on a Vulkan device what a convex tool (cylinder, cone, bull-nose or box) covers of rays, with ends equal to
// those of convex_spans() (compute/tools/tool_spans.hpp), to the bit.
//
//   auto covered = CoveredRays::create(device);                   // once
//   if (!*covered->prepare(lattice, pieces)) ...;                 // a sweep that the processor is to compute
//   covered->record(commands);                                    // into anybody's commands
//   commands.dispatch(consumer, {covered->rays(), covered->spans(), covered->counters(), ...}, ...);
//   covered->fetch_counters(commands);
//   ... submit, wait ...
//   if (!is_complete(covered->counted())) ...;                    // make_room and record again, or the processor
//
// Buffers are laid out as in shaders/shared/covered_rays.h. record() ends with a barrier, so that the next command may
// read them, and begins with one, so that it may follow a consumer of the sweep before it. Of each sweep the device is
// sent 184 bytes a piece.
// A consumer that changes anything first looks whether the counters are complete (is_complete) and leaves everything as
// it is otherwise: then rays are missing, and all is done again.
// Work is bounded. prepare() refuses what would take a card seconds, or too many turns of a loop for a software driver.
// Thread: one, as gpu::Device. Failure: as gpu::Buffer and gpu::ComputePipeline.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compute/rays/lattice.hpp"
#include "compute/tools/convex_pieces.hpp"
#include "compute/vulkan/rounding_check.hpp"
#include "compute/vulkan/vulkan_engine_memory.hpp"
#include "gpu/commands.hpp"
#include "gpu/device.hpp"
#include "gpu/pipelines.hpp"
#include "shaders/shared/cover_job.h"
#include "shaders/shared/covered_rays.h"

namespace burin::compute {

struct CoveredRaysOptions {
    std::vector<CheckedRounding> roundings = hard_roundings();  // that the device is tried with
    std::uint32_t spans_a_ray = 1;  // space in the list at first, for each ray visited; 0: for one span in all
};

class CoveredRays {
public:
    // Fails on a device without 64-bit integers or doubles in shaders, and on one that rounds otherwise than the
    // processor (rounding_check.hpp): convex_spans() then has to compute the spans.
    [[nodiscard]] static Result<CoveredRays> create(const gpu::Device& device, const CoveredRaysOptions& options = {});

    // Makes ready for a sweep. Returns false where it is beyond what the device computes in one pass: more than
    // kMostCoverPieces pieces, more than kMostSections sections of rays with pieces, more rays than a buffer holds, or
    // a kind of piece that the device lacks. Then it visits no ray.
    // Between a record() and the submission of its commands, only the next sweep in the same commands is prepared.
    [[nodiscard]] Result<bool> prepare(const Lattice& lattice, const ConvexPieces& sweep);

    // Records the sweep that was prepared last; the counters are complete and zero where it visits no ray.
    void record(gpu::Commands& commands);

    // The buffers of the sweep that was prepared last. A ray that is visited has the number under which rays() holds
    // it; there is one invocation of a consumer for each of the numbers below ray_count(). Where that is 0 there may be
    // no buffers yet, and there is nothing to consume.
    [[nodiscard]] std::uint32_t ray_count() const { return parameters_.rays; }
    [[nodiscard]] const gpu::Buffer& rays() const { return rays_; }                   // CoveredRay[]
    [[nodiscard]] const gpu::Buffer& spans() const { return spans_; }                 // CoveredSpan[]
    [[nodiscard]] const gpu::Buffer& counters() const { return counters_.buffer(); }  // one CoverCounters

    // Copies the counters home, and returns them when those commands are done. record() clears them, so where several
    // sweeps share the commands, the consumer of each keeps what it needs of them.
    void fetch_counters(gpu::Commands& commands) const { counters_.fetch(commands, sizeof(shared::CoverCounters)); }
    [[nodiscard]] shared::CoverCounters counted() const {
        return counters_.from_device<shared::CoverCounters>().front();
    }

    // Makes space for the spans that found none, so that the sweep may be recorded again. Returns false where that does
    // not help: a ray has too many parts, or no buffer can hold the spans.
    [[nodiscard]] Result<bool> make_room(const shared::CoverCounters& counters);

    // Sections that one pass may take. At some 400 operations of doubles each, a laptop's card does them in a fifth of
    // a second. The processor leaves most of them out (compute/tools/ray_union.hpp).
    static constexpr std::uint64_t kMostSections = std::uint64_t{1} << 26;

private:
    explicit CoveredRays(const gpu::Device& device) : device_(device) {}
    [[nodiscard]] std::uint64_t most_in_buffer(std::size_t element_bytes) const {
        return device_.capabilities().max_storage_buffer_bytes / element_bytes;
    }
    [[nodiscard]] Result<void> grow(gpu::Buffer& buffer, std::uint64_t size_bytes, const char* name);

    gpu::Device device_;
    std::uint32_t spans_a_ray_ = 1;
    gpu::ComputePipeline cover_;
    std::vector<shared::CoverPiece> pieces_;
    shared::CoverParameters parameters_{};
    gpu::Buffer piece_buffer_, rays_, spans_;
    std::vector<gpu::Buffer> replaced_;  // that commands recorded before may still name
    SharedBuffer counters_{"cover counters", SharedBuffer::Traffic::from_device};
};

}  // namespace burin::compute
