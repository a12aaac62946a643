// SPDX-License-Identifier: MIT
#include "compute/vulkan/covered_rays.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "base/try.hpp"
#include "compute/tools/sweep_units.hpp"
#include "shaders/cover_rays.comp.spv.hpp"

namespace burin::compute {
namespace {

using shared::CoveredRay;
using shared::CoveredSpan;
using shared::CoverPiece;
using shared::CoverRectangle;

constexpr std::uint32_t kGroupsADispatch = 16384;  // about a million rays; every device takes as many groups
constexpr std::uint64_t kLooksASection = 16;       // pieces that a ray passes by in the time of one section

// Return a piece as the device takes it; nothing where its kind is the processor's alone.
template <typename Piece>
std::optional<CoverPiece> packed(const Piece& /*piece*/) {
    return {};
}
template <>
std::optional<CoverPiece> packed(const FrustumSweep& frustum) {
    return shared::packed_frustum({}, frustum.swept());
}
template <>
std::optional<CoverPiece> packed(const BoxSweep& box) {
    return shared::packed_box({}, box.swept());
}

// Returns the pieces of a sweep; nothing where the device lacks one of their kinds.
std::optional<std::vector<CoverPiece>> cover_pieces(const Lattice& lattice, const ConvexPieces& sweep) {
    std::vector<CoverPiece> pieces;
    pieces.reserve(sweep.pieces.size());
    for (std::size_t i = 0; i < sweep.pieces.size(); ++i) {
        std::optional<CoverPiece> piece = std::visit([](const auto& p) { return packed(p); }, sweep.pieces[i]);
        if (!piece) return {};
        const Box bounds = bounds_of(sweep.pieces[i]);
        for (int axis = 0; axis < 3; ++axis) {
            const Footprint near = footprint(lattice, bounds, axis);
            piece->lo[(axis + 1) % 3] = near.u_lo;
            piece->hi[(axis + 1) % 3] = near.u_hi;
        }
        piece->ends_move = (i + 1) % sweep.a_move == 0 ? 1 : 0;
        pieces.push_back(*piece);
    }
    return pieces;
}

Footprint footprint(const CoverPiece& piece, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return {piece.lo[u], piece.hi[u], piece.lo[v], piece.hi[v]};
}

std::uint64_t rays_in(const Footprint& f) {
    if (f.empty()) return 0;
    return static_cast<std::uint64_t>(f.u_hi - f.u_lo + 1) * static_cast<std::uint64_t>(f.v_hi - f.v_lo + 1);
}

// The rays that a sweep visits on all axes, and the work that this is.
struct Visit {
    CoverRectangle rectangles[3] = {};
    std::uint64_t rays = 0, sections = 0;
};

Visit visit_of(const Lattice& lattice, std::span<const CoverPiece> pieces) {
    Visit visit;
    for (int axis = 0; axis < 3; ++axis) {
        Footprint all{std::numeric_limits<int>::max(), -1, std::numeric_limits<int>::max(), -1};
        for (const CoverPiece& piece : pieces) {
            const Footprint f = footprint(piece, axis);
            if (f.empty()) continue;
            all = {std::min(all.u_lo, f.u_lo), std::max(all.u_hi, f.u_hi), std::min(all.v_lo, f.v_lo),
                   std::max(all.v_hi, f.v_hi)};
            visit.sections += rays_in(f);
        }
        const std::uint64_t rays = rays_in(all);
        visit.sections += rays * pieces.size() / kLooksASection;
        visit.rectangles[axis] = {all.u_lo, all.v_lo, all.empty() ? 0 : all.u_hi - all.u_lo + 1,
                                  static_cast<std::uint32_t>(visit.rays),
                                  lattice.cells[static_cast<std::size_t>(axis)] * shared::kUnitsPerCell};
        visit.rays += rays;
    }
    return visit;
}

}  // namespace

Result<CoveredRays> CoveredRays::create(const gpu::Device& device, const CoveredRaysOptions& options) {
    const gpu::Capabilities& can = device.capabilities();
    if (!can.shader_int64 || !can.shader_float64) {
        return fail(device.info().name,
                    std::string("has no ") + (!can.shader_int64 ? "64-bit integers" : "doubles") + " in shaders",
                    "compute the spans of cylinders, cones, bull-noses and boxes on the processor");
    }
    BURIN_TRY_DO(check_rounding(device, options.roundings));
    CoveredRays covered(device);
    covered.spans_a_ray_ = options.spans_a_ray;
    BURIN_TRY(cover, gpu::ComputePipeline::create(covered.device_, {.spirv = k_cover_rays_comp,
                                                                    .storage_buffers = 4,
                                                                    .push_constant_bytes = sizeof(parameters_),
                                                                    .name = "cover rays"}));
    covered.cover_ = std::move(cover);
    BURIN_TRY_DO(covered.counters_.reserve(covered.device_, sizeof(shared::CoverCounters)));
    return covered;
}

Result<bool> CoveredRays::prepare(const Lattice& lattice, const ConvexPieces& sweep) {
    parameters_ = {};
    pieces_.clear();
    if (sweep.pieces.size() > shared::kMostCoverPieces) return false;
    std::optional<std::vector<CoverPiece>> pieces = cover_pieces(lattice, sweep);
    if (!pieces) return false;
    const Visit visit = visit_of(lattice, *pieces);
    if (visit.sections > kMostSections) return false;
    const std::uint64_t spans = std::max<std::uint64_t>(visit.rays * spans_a_ray_, 1);
    if (visit.rays > most_in_buffer(sizeof(CoveredRay)) || spans > most_in_buffer(sizeof(CoveredSpan))) return false;
    if (visit.rays > 0) {
        BURIN_TRY_DO(grow(piece_buffer_, pieces->size() * sizeof(CoverPiece), "convex pieces"));
        BURIN_TRY_DO(grow(rays_, visit.rays * sizeof(CoveredRay), "covered rays"));
        BURIN_TRY_DO(grow(spans_, spans * sizeof(CoveredSpan), "covered spans"));
    }
    pieces_ = std::move(*pieces);
    std::ranges::copy(visit.rectangles, parameters_.rectangles);
    parameters_.rays = static_cast<std::uint32_t>(visit.rays);
    parameters_.pieces = static_cast<std::uint32_t>(pieces_.size());
    return true;
}

void CoveredRays::record(gpu::Commands& commands) {
    for (gpu::Buffer& buffer : std::exchange(replaced_, {})) commands.keep_alive(std::move(buffer));
    commands.barrier();
    commands.fill(counters_.buffer(), 0, sizeof(shared::CoverCounters), 0);
    if (parameters_.rays > 0) commands.upload(piece_buffer_, 0, std::as_bytes(std::span(pieces_)));
    commands.barrier();
    parameters_.spans = static_cast<std::uint32_t>(spans_.size_bytes() / sizeof(CoveredSpan));
    constexpr std::uint32_t kRaysADispatch = kGroupsADispatch * shared::kCoverGroup;
    for (std::uint32_t first = 0; first < parameters_.rays; first += kRaysADispatch) {
        parameters_.first_ray = first;
        const std::uint32_t rays = std::min(kRaysADispatch, parameters_.rays - first);
        commands.dispatch(cover_, {piece_buffer_, rays_, spans_, counters_.buffer()}, gpu::bytes_of(parameters_),
                          {(rays + shared::kCoverGroup - 1) / shared::kCoverGroup, 1, 1});
    }
    commands.barrier();
}

Result<bool> CoveredRays::make_room(const shared::CoverCounters& counters) {
    if (counters.overfull > 0 || counters.spans > most_in_buffer(sizeof(CoveredSpan))) return false;
    BURIN_TRY_DO(grow(spans_, std::uint64_t{counters.spans} * sizeof(CoveredSpan), "covered spans"));
    return true;
}

Result<void> CoveredRays::grow(gpu::Buffer& buffer, std::uint64_t size_bytes, const char* name) {
    if (size_bytes <= buffer.size_bytes()) return {};
    const std::uint64_t limit = device_.capabilities().max_storage_buffer_bytes;
    const std::uint64_t wished = std::max(size_bytes, std::min(size_bytes + size_bytes / 2, limit));
    BURIN_TRY(made, gpu::Buffer::create(device_, gpu::BufferUse::device_storage, wished, name));
    if (buffer.size_bytes() > 0) replaced_.push_back(std::move(buffer));
    buffer = std::move(made);
    return {};
}

}  // namespace burin::compute
