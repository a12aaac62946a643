// SPDX-License-Identifier: MIT
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <span>

#include "bench/measure/timing.hpp"
#include "bench/peers/peers.hpp"

namespace burin::bench {
namespace {

using openvdb::Coord;
using Grid = openvdb::FloatGrid;
using Tree = Grid::TreeType;
using Leaf = Tree::LeafNodeType;

constexpr float kHalfWidth_voxels = 3.0f;
constexpr int kLeaf = static_cast<int>(Leaf::DIM);

// A ball in voxels: voxel (i, j, k) is the point i, j, k.
struct VoxelBall {
    openvdb::Vec3d center;
    double radius = 0.0;

    // Return the smallest and largest distance from the ball's surface to a leaf's voxels; below zero inside the ball.
    [[nodiscard]] double least(const Coord& leaf_origin) const {
        double away2 = 0.0;
        for (int a = 0; a < 3; ++a) {
            const double lo = leaf_origin[a], hi = lo + kLeaf - 1;
            const double away = std::max({lo - center[a], center[a] - hi, 0.0});
            away2 += away * away;
        }
        return std::sqrt(away2) - radius;
    }
    [[nodiscard]] double largest(const Coord& leaf_origin) const {
        double away2 = 0.0;
        for (int a = 0; a < 3; ++a) {
            const double lo = leaf_origin[a], hi = lo + kLeaf - 1;
            const double away = std::max(std::abs(lo - center[a]), std::abs(hi - center[a]));
            away2 += away * away;
        }
        return std::sqrt(away2) - radius;
    }
};

// Returns the origins of the leaves with a voxel nearer to the ball than `reach` voxels.
std::vector<Coord> leaves_near(const VoxelBall& ball, double reach) {
    std::array<int, 3> from{}, to{};
    for (int a = 0; a < 3; ++a) {
        const auto k = static_cast<std::size_t>(a);
        from[k] = static_cast<int>(std::floor((ball.center[a] - ball.radius - reach) / kLeaf)) * kLeaf;
        to[k] = static_cast<int>(std::floor((ball.center[a] + ball.radius + reach) / kLeaf)) * kLeaf;
    }
    std::vector<Coord> origins;
    for (int x = from[0]; x <= to[0]; x += kLeaf)
        for (int y = from[1]; y <= to[1]; y += kLeaf)
            for (int z = from[2]; z <= to[2]; z += kLeaf) {
                if (ball.least(Coord(x, y, z)) < reach) origins.emplace_back(x, y, z);
            }
    return origins;
}

// Runs VolumeToMesh's own steps (VolumeToMesh.h, operator(), without adaptivity, masks and reference grids) on some
// leaves instead of all. Returns the number of triangles.
std::size_t mesh_leaves(const Grid& grid, std::span<const Leaf* const> leaves) {
    namespace vm = openvdb::tools::volume_to_mesh_internal;
    using BoolTree = Tree::ValueConverter<bool>::Type;
    using Int16Tree = Tree::ValueConverter<openvdb::Int16>::Type;
    using Index32Tree = Tree::ValueConverter<openvdb::Index32>::Type;

    const std::vector<const Leaf*> nodes(leaves.begin(), leaves.end());
    vm::LeafNodeVoxelOffsets offsets;
    offsets.constructOffsetList<Leaf>();
    BoolTree crossed(false);
    vm::IdentifyIntersectingVoxels<Tree> identify(grid.tree(), nodes, offsets, crossed, 0.0f);
    tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, nodes.size()), identify);
    if (crossed.empty()) return 0;

    Int16Tree signs(0);
    Index32Tree point_index(std::numeric_limits<openvdb::Index32>::max());
    vm::computeAuxiliaryData(signs, point_index, crossed, grid.tree(), 0.0f);
    std::vector<Index32Tree::LeafNodeType*> index_leaves;
    point_index.getNodes(index_leaves);
    std::vector<Int16Tree::LeafNodeType*> sign_leaves;
    signs.getNodes(sign_leaves);
    const tbb::blocked_range<std::size_t> range(0, sign_leaves.size());

    std::unique_ptr<openvdb::Index32[]> first_point(new openvdb::Index32[sign_leaves.size()]);
    tbb::parallel_for(range, vm::LeafNodePointCount<Leaf::LOG2DIM>(sign_leaves, first_point));
    openvdb::Index32 points = 0;
    for (std::size_t i = 0; i < sign_leaves.size(); ++i) {
        const openvdb::Index32 count = first_point[i];
        first_point[i] = points;
        points += count;
    }
    openvdb::tools::PointList positions(new openvdb::Vec3s[points]);
    tbb::parallel_for(range, vm::ComputePoints<Tree>(positions.get(), grid.tree(), index_leaves, sign_leaves,
                                                     first_point, grid.transform(), 0.0));
    openvdb::tools::PolygonPoolList polygons(new openvdb::tools::PolygonPool[sign_leaves.size()]);
    tbb::parallel_for(range, vm::ComputePolygons<Int16Tree, vm::UniformPrimBuilder>(sign_leaves, signs, point_index,
                                                                                    polygons, false));
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < sign_leaves.size(); ++i) {
        triangles += polygons[i].numTriangles() + 2 * polygons[i].numQuads();
    }
    return triangles;
}

class LevelSetCarving {
public:
    explicit LevelSetCarving(const compute::Lattice& lattice)
        : origin_object_(lattice.origin_object), h_m_(lattice.spacing_m) {
        transform_ = openvdb::math::Transform::createLinearTransform(h_m_);
        const openvdb::Vec3d lo(-origin_object_.x, -origin_object_.y, -origin_object_.z);
        const openvdb::BBoxd cube(lo, lo + openvdb::Vec3d(1.0));
        grid_ = openvdb::tools::createLevelSetBox<Grid>(cube, *transform_, kHalfWidth_voxels);
    }

    void csg_difference(const compute::BallSweep& stamp, PeerRun& run) {
        Stopwatch watch;
        const Vec3 c = stamp.start_object_m - origin_object_;
        const Grid::Ptr ball = openvdb::tools::createLevelSetSphere<Grid>(static_cast<float>(stamp.radius_m),
                                                                          openvdb::Vec3f(openvdb::Vec3d(c.x, c.y, c.z)),
                                                                          static_cast<float>(h_m_), kHalfWidth_voxels);
        ball->setTransform(transform_->copy());
        run.tool_ms.push_back(watch.lap_ms());
        openvdb::tools::csgDifference(*grid_, *ball, true);
        run.boolean_ms.push_back(watch.lap_ms());
    }

    void brush(const compute::BallSweep& stamp, PeerRun& run) {
        Stopwatch watch;
        const VoxelBall ball = in_voxels(stamp);
        std::vector<Leaf*> touched;
        Tree& tree = grid_->tree();
        openvdb::tree::ValueAccessor<Tree> accessor(tree);
        const float outside = tree.background();
        for (const Coord& origin : leaves_near(ball, kHalfWidth_voxels)) {
            Leaf* leaf = accessor.probeLeaf(origin);
            if (leaf == nullptr && accessor.getValue(origin) > 0.0f) continue;
            if (ball.largest(origin) <= -kHalfWidth_voxels) {
                accessor.addTile(1, origin, outside, false);
            } else {
                touched.push_back(leaf != nullptr ? leaf : accessor.touchLeaf(origin));
            }
        }
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, touched.size()), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) brush_leaf(*touched[i], ball, outside);
        });
        for (const Leaf* leaf : touched) {
            if (leaf->isEmpty() && leaf->getFirstValue() > 0.0f) accessor.addTile(1, leaf->origin(), outside, false);
        }
        run.tool_ms.push_back(0.0);
        run.boolean_ms.push_back(watch.lap_ms());
    }

    void mesh_around(const compute::BallSweep& stamp, PeerRun& run) const {
        Stopwatch watch;
        openvdb::tree::ValueAccessor<const Tree> accessor(grid_->tree());
        std::vector<const Leaf*> leaves;
        // A vertex depends on the voxels next to the surface, so leaves within a voxel and a half may have changed.
        for (const Coord& origin : leaves_near(in_voxels(stamp), 1.5)) {
            if (const Leaf* leaf = accessor.probeConstLeaf(origin); leaf != nullptr) leaves.push_back(leaf);
        }
        run.triangles_remeshed.push_back(static_cast<double>(mesh_leaves(*grid_, leaves)));
        run.mesh_ms.push_back(watch.lap_ms());
    }

    [[nodiscard]] geometry::TriangleMesh mesh() const {
        std::vector<openvdb::Vec3s> points;
        std::vector<openvdb::Vec3I> triangles;
        std::vector<openvdb::Vec4I> quads;
        openvdb::tools::volumeToMesh(*grid_, points, triangles, quads);
        geometry::TriangleMesh mesh;
        for (const auto& p : points) {
            mesh.positions_m.push_back(origin_object_ + Vec3(static_cast<double>(p.x()), static_cast<double>(p.y()),
                                                             static_cast<double>(p.z())));
        }
        // OpenVDB winds clockwise seen from outside.
        for (const auto& t : triangles) mesh.triangles.push_back({t[2], t[1], t[0]});
        for (const auto& q : quads) {
            mesh.triangles.push_back({q[2], q[1], q[0]});
            mesh.triangles.push_back({q[3], q[2], q[0]});
        }
        return mesh;
    }

    [[nodiscard]] std::size_t bytes() const { return grid_->memUsage(); }

private:
    [[nodiscard]] VoxelBall in_voxels(const compute::BallSweep& stamp) const {
        const Vec3 c = (stamp.start_object_m - origin_object_) / h_m_;
        return {{c.x, c.y, c.z}, stamp.radius_m / h_m_};
    }

    // Sets each voxel to the larger of its distance and the negated distance of the ball.
    void brush_leaf(Leaf& leaf, const VoxelBall& ball, float outside) const {
        float* values = leaf.buffer().data();
        const auto h = static_cast<float>(h_m_), radius = static_cast<float>(ball.radius);
        const Coord origin = leaf.origin();
        openvdb::Index offset = 0;
        for (int x = 0; x < kLeaf; ++x) {
            const auto dx = static_cast<float>(origin.x() + x - ball.center.x());
            for (int y = 0; y < kLeaf; ++y) {
                const auto dy = static_cast<float>(origin.y() + y - ball.center.y());
                for (int z = 0; z < kLeaf; ++z, ++offset) {
                    const auto dz = static_cast<float>(origin.z() + z - ball.center.z());
                    const float carved = (radius - std::sqrt(dx * dx + dy * dy + dz * dz)) * h;
                    if (carved <= values[offset]) continue;
                    values[offset] = std::min(carved, outside);
                    leaf.setActiveState(offset, carved < outside);
                }
            }
        }
    }

    Vec3 origin_object_;
    double h_m_;
    openvdb::math::Transform::Ptr transform_;
    Grid::Ptr grid_;
};

PeerRun carve(const CarveScene& scene, const compute::Lattice& lattice, unsigned threads, VdbMethod method) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    openvdb::initialize();
    PeerRun run;
    run.peer = "OpenVDB " OPENVDB_LIBRARY_VERSION_STRING;
    run.method = method == VdbMethod::csg_difference ? "csgDifference" : "leaf brush";
    run.detail = std::to_string(static_cast<int>(std::lround(1.0 / lattice.spacing_m)));
    run.threads = threads;
    LevelSetCarving carving(lattice);
    for (const compute::BallSweep& stamp : scene.sweeps) {
        const double cpu_before_ms = process_cpu_ms();
        if (method == VdbMethod::csg_difference) {
            carving.csg_difference(stamp, run);
        } else {
            carving.brush(stamp, run);
        }
        carving.mesh_around(stamp, run);
        run.cpu_ms.push_back(process_cpu_ms() - cpu_before_ms);
        run.update_ms.push_back(run.tool_ms.back() + run.boolean_ms.back() + run.mesh_ms.back());
    }
    run.bytes = carving.bytes();
    Stopwatch watch;
    run.mesh = carving.mesh();
    run.whole_mesh_ms = watch.lap_ms();
    return run;
}

}  // namespace

bool has_peers() { return true; }

Result<PeerRun> run_openvdb(const CarveScene& scene, const compute::Lattice& lattice, unsigned threads,
                            VdbMethod method) {
    if (!scene.only_stamps()) {
        return fail(scene.name, "has sweeps, and OpenVDB's tool is a ball at one place", "use the scene of stamps");
    }
    try {
        return carve(scene, lattice, threads, method);
    } catch (const std::exception& error) {
        return fail("OpenVDB", error.what());
    }
}

}  // namespace burin::bench
