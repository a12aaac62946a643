// SPDX-License-Identifier: MIT
#include "compute/repair/near_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "compute/repair/oriented_tree.hpp"
#include "compute/repair/remedies.hpp"

namespace burin::compute {
namespace {

using geometry::VertexTriple;

// Enough vertices for a task to be worth its dispatch.
constexpr std::size_t kVerticesATask = 2048;
// Bounds the relative rounding error of directions and heights, computed from exact differences, with a wide margin.
constexpr double kOfDirections = 1e-12;

// Holds the mesh and the question that both searches read.
class Searched {
public:
    Searched(const geometry::TriangleMesh& mesh, const NearSearch& search) : mesh_(mesh), search_(search) {}

    [[nodiscard]] const VertexTriple& triangle(std::uint32_t t) const { return mesh_.triangles[t]; }
    [[nodiscard]] const Vec3& position(std::uint32_t v) const { return mesh_.positions_m[v]; }
    [[nodiscard]] double reach(std::uint32_t v) const { return search_.reach[v]; }
    [[nodiscard]] bool is_wanted(std::uint32_t t) const { return search_.wanted.empty() || search_.wanted[t] != 0; }
    [[nodiscard]] bool wants_all() const { return search_.wanted.empty(); }

private:
    const geometry::TriangleMesh& mesh_;
    const NearSearch& search_;
};

void add_pair(NearPairs& found, std::uint32_t a, std::uint32_t b) {
    found.pairs.push_back({std::min(a, b), std::max(a, b)});
}

// ---- Triangles that share no vertex

// Descends the tree with two nodes at a time, as long as their boxes meet.
class TreeSearch {
public:
    TreeSearch(const Searched& mesh, const OrientedTree& tree, NearPairs& found, std::uint64_t most)
        : mesh_(mesh), tree_(tree), found_(found), most_(most), wanted_(tree.nodes().size(), 1) {
        if (mesh.wants_all()) return;
        for (std::size_t at = tree.nodes().size(); at-- > 0;) wanted_[at] = has_a_wanted_one(at) ? 1 : 0;
    }

    void run() {
        if (tree_.nodes().empty()) return;
        waiting_.push_back({0, 0});
        while (!waiting_.empty() && found_.complete) {
            const auto [a, b] = waiting_.back();
            waiting_.pop_back();
            if (wanted_[a] == 0 && wanted_[b] == 0) continue;
            const OrientedTree::Node &first = tree_.nodes()[a], &second = tree_.nodes()[b];
            if (first.has_in_common_with(second)) continue;  // that is for the fan
            found_.complete = ++found_.tests <= most_;
            if (a != b && !may_meet(first.box, second.box)) continue;
            if (first.is_leaf() && second.is_leaf()) {
                compare(first, second);
            } else if (a == b) {
                waiting_.insert(waiting_.end(), {{left(a), left(a)}, {left(a), right(a)}, {right(a), right(a)}});
            } else if (second.is_leaf() ||
                       (!first.is_leaf() && first.last - first.first > second.last - second.first)) {
                waiting_.insert(waiting_.end(), {{left(a), b}, {right(a), b}});
            } else {
                waiting_.insert(waiting_.end(), {{a, left(b)}, {a, right(b)}});
            }
        }
    }

private:
    [[nodiscard]] static std::uint32_t left(std::uint32_t at) { return at + 1; }
    [[nodiscard]] std::uint32_t right(std::uint32_t at) const { return tree_.nodes()[at + 1].behind; }

    // Asks the nodes below, which come later in the order.
    [[nodiscard]] bool has_a_wanted_one(std::size_t at) const {
        const OrientedTree::Node& node = tree_.nodes()[at];
        if (!node.is_leaf())
            return wanted_[left(static_cast<std::uint32_t>(at))] != 0 ||
                   wanted_[right(static_cast<std::uint32_t>(at))] != 0;
        for (std::uint32_t p = node.first; p < node.last; ++p)
            if (mesh_.is_wanted(tree_.triangle_at(p))) return true;
        return false;
    }

    void compare(const OrientedTree::Node& first, const OrientedTree::Node& second) {
        const bool is_one = first.first == second.first;
        const Near of_first = is_one ? all_of(first) : those_near(first, second.box),
                   of_second = is_one ? of_first : those_near(second, first.box);
        for (std::size_t i = 0; i < of_first.count; ++i)
            for (std::size_t j = is_one ? i + 1 : 0; j < of_second.count; ++j)
                compare(of_first.triangles[i], of_second.triangles[j]);
    }

    // Triangles of a leaf.
    struct Near {
        std::array<std::uint32_t, OrientedTree::kLeaf> triangles{};
        std::size_t count = 0;
    };
    [[nodiscard]] Near all_of(const OrientedTree::Node& leaf) const {
        Near all;
        for (std::uint32_t p = leaf.first; p < leaf.last; ++p) all.triangles[all.count++] = tree_.triangle_at(p);
        return all;
    }
    [[nodiscard]] Near those_near(const OrientedTree::Node& leaf, const OrientedBox& box) const {
        Near near;
        for (std::uint32_t p = leaf.first; p < leaf.last; ++p) {
            const std::uint32_t t = tree_.triangle_at(p);
            if (may_meet(box, corners(t), reach(t))) near.triangles[near.count++] = t;
        }
        return near;
    }

    void compare(std::uint32_t a, std::uint32_t b) {
        if (!mesh_.is_wanted(a) && !mesh_.is_wanted(b)) return;
        for (const std::uint32_t v : mesh_.triangle(a))
            if (std::ranges::find(mesh_.triangle(b), v) != mesh_.triangle(b).end()) return;
        ++found_.tests;
        if (!are_apart(corners(a), corners(b), reach(a) + reach(b))) add_pair(found_, a, b);
    }
    [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t t) const {
        const VertexTriple& v = mesh_.triangle(t);
        return {mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])};
    }
    [[nodiscard]] double reach(std::uint32_t t) const {
        const VertexTriple& v = mesh_.triangle(t);
        return std::max({mesh_.reach(v[0]), mesh_.reach(v[1]), mesh_.reach(v[2])});
    }

    const Searched& mesh_;
    const OrientedTree& tree_;
    NearPairs& found_;
    const std::uint64_t most_;
    std::vector<std::uint8_t> wanted_;  // for each node: whether a triangle below it is
    std::vector<std::array<std::uint32_t, 2>> waiting_;
};

// ---- Triangles that share a vertex

// The directions in which a triangle is seen from one of its vertices, all of them within a box.
struct Arc {
    Box directions;
    std::uint32_t triangle = 0;
    std::array<std::uint32_t, 2> ends{};  // the other vertices
};

// Compares the triangles of one fan.
class FanSearch {
public:
    FanSearch(const Searched& mesh, NearPairs& found, std::uint64_t most) : mesh_(mesh), found_(found), most_(most) {}

    void of(std::uint32_t vertex, std::span<const std::uint32_t> fan) {
        if (fan.size() < 2 || std::ranges::none_of(fan, [&](std::uint32_t t) { return mesh_.is_wanted(t); })) return;
        arcs_.clear();
        Box all;
        for (const std::uint32_t t : fan) {
            if (geometry::names_a_vertex_twice(mesh_.triangle(t))) continue;
            arcs_.push_back(arc_of(vertex, t));
            all.include(arcs_.back().directions.center());
        }
        const Vec3 extent = all.extent();
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        std::ranges::sort(arcs_, [axis](const Arc& a, const Arc& b) {
            const double at = a.directions.lo[axis], of_b = b.directions.lo[axis];
            return at != of_b ? at < of_b : a.triangle < b.triangle;
        });
        for (std::size_t i = 0; i < arcs_.size() && found_.complete; ++i)
            for (std::size_t j = i + 1; j < arcs_.size(); ++j) {
                if (arcs_[j].directions.lo[axis] > arcs_[i].directions.hi[axis]) break;
                found_.complete = ++found_.tests <= most_;
                if (are_near(vertex, arcs_[i], arcs_[j])) add_pair(found_, arcs_[i].triangle, arcs_[j].triangle);
            }
    }

private:
    [[nodiscard]] Arc arc_of(std::uint32_t vertex, std::uint32_t t) const {
        const VertexTriple& corners = mesh_.triangle(t);
        const std::size_t k = corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
        Arc arc{{}, t, {corners[(k + 1) % 3], corners[(k + 2) % 3]}};
        const Vec3 a = mesh_.position(arc.ends[0]) - mesh_.position(vertex);
        const Vec3 b = mesh_.position(arc.ends[1]) - mesh_.position(vertex), along = b - a;
        const double share = std::clamp(-glm::dot(a, along) / glm::dot(along, along), 0.0, 1.0);
        const double nearest = glm::length(a + share * along);  // how near the vertex the opposite edge passes
        const double moves = mesh_.reach(vertex) + std::max(mesh_.reach(arc.ends[0]), mesh_.reach(arc.ends[1]));
        const double turns = 2.0 * moves / nearest + kOfDirections;
        if (!(turns < 0.5)) {  // or NaN: any direction
            arc.directions = {Vec3(-2.0), Vec3(2.0)};
            return arc;
        }
        const Vec3 to_a = glm::normalize(a), to_b = glm::normalize(b);
        const double chord = glm::length(to_b - to_a);
        // By so much an arc on the unit sphere leaves the box around its ends.
        const double bulge = 1.0 - std::sqrt(std::max(0.0, 1.0 - 0.25 * chord * chord));
        arc.directions = {glm::min(to_a, to_b) - (bulge + turns), glm::max(to_a, to_b) + (bulge + turns)};
        return arc;
    }

    [[nodiscard]] bool are_near(std::uint32_t vertex, const Arc& a, const Arc& b) const {
        if (!mesh_.is_wanted(a.triangle) && !mesh_.is_wanted(b.triangle)) return false;
        if (a.directions.lo.x > b.directions.hi.x || b.directions.lo.x > a.directions.hi.x ||
            a.directions.lo.y > b.directions.hi.y || b.directions.lo.y > a.directions.hi.y ||
            a.directions.lo.z > b.directions.hi.z || b.directions.lo.z > a.directions.hi.z)
            return false;
        std::uint32_t shared = 0, least = vertex;
        std::array<std::size_t, 2> end{};  // of a and b: the shared one
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t j = 0; j < 2; ++j)
                if (a.ends[i] == b.ends[j]) {
                    ++shared;
                    end = {i, j};
                    least = std::min(least, a.ends[i]);
                }
        if (shared == 0) return true;
        if (least != vertex) return false;  // seen from there
        return shared == 2 || may_fold(vertex, a.ends[end[0]], a.ends[1 - end[0]], b.ends[1 - end[1]]);
    }

    // Tells whether two triangles at the edge u, v with the third corners a, b could come to lie on each other.
    [[nodiscard]] bool may_fold(std::uint32_t u, std::uint32_t v, std::uint32_t a, std::uint32_t b) const {
        const Vec3 along = mesh_.position(v) - mesh_.position(u), to_a = mesh_.position(a) - mesh_.position(u),
                   to_b = mesh_.position(b) - mesh_.position(u);
        const double edge2 = glm::dot(along, along), at_a = glm::dot(to_a, along), at_b = glm::dot(to_b, along);
        const Vec3 up_a = to_a - (at_a / edge2) * along, up_b = to_b - (at_b / edge2) * along;
        const double reach = std::max({mesh_.reach(u), mesh_.reach(v), mesh_.reach(a), mesh_.reach(b)});
        // The edge turns by up to two reaches over its length, which moves its line beside a far corner by more.
        const double lever = 2.0 + 2.0 * std::max(std::abs(at_a), std::abs(at_b)) / edge2;
        const double least2 = 64.0 * lever * lever * reach * reach;
        const double a2 = glm::dot(up_a, up_a), b2 = glm::dot(up_b, up_b), facing = glm::dot(up_a, up_b);
        const bool have_height = a2 > least2 && b2 > least2 && edge2 > 64.0 * reach * reach &&
                                 a2 > kOfDirections * glm::dot(to_a, to_a) && b2 > kOfDirections * glm::dot(to_b, to_b);
        return !have_height || (facing > 0.0 && facing * facing > 0.8 * a2 * b2);
    }

    const Searched& mesh_;
    NearPairs& found_;
    const std::uint64_t most_;
    std::vector<Arc> arcs_;
};

// Runs tasks of so many parts each, and puts what they have found behind each other.
template <typename Task>
void search_in_tasks(std::size_t parts, std::size_t parts_a_task, WorkerPool& pool, NearPairs& all, const Task& task) {
    std::vector<NearPairs> found((parts + parts_a_task - 1) / parts_a_task);
    pool.run(found.size(),
             [&](std::size_t i) { task(i * parts_a_task, std::min((i + 1) * parts_a_task, parts), found[i]); });
    for (const NearPairs& part : found) {
        all.pairs.insert(all.pairs.end(), part.pairs.begin(), part.pairs.end());
        all.tests += part.tests;
        all.complete = all.complete && part.complete;
    }
}

}  // namespace

NearPairs near_pairs(const geometry::TriangleMesh& mesh, const NearSearch& search, WorkerPool& pool) {
    NearPairs all;
    const Searched searched(mesh, search);
    const Fans fans(mesh);
    const OrientedTree tree(mesh, fans, search.reach);
    TreeSearch(searched, tree, all, kMostTestsATriangle * mesh.triangles.size()).run();
    search_in_tasks(mesh.positions_m.size(), kVerticesATask, pool, all,
                    [&](std::size_t first, std::size_t last, NearPairs& found) {
                        std::uint64_t most = 0;
                        for (std::size_t v = first; v < last; ++v)
                            most += kMostTestsATriangle * fans.of(static_cast<std::uint32_t>(v)).size();
                        FanSearch search_of(searched, found, most);
                        for (std::size_t v = first; v < last; ++v)
                            search_of.of(static_cast<std::uint32_t>(v), fans.of(static_cast<std::uint32_t>(v)));
                    });
    std::ranges::sort(all.pairs);
    return all;
}

}  // namespace burin::compute
