// SPDX-License-Identifier: MIT
// The sweep goes through the corners from left to right, those above each other from below. It keeps the edges that it
// crosses, from below upwards; outside and inside alternate between them. For each stretch of inside it keeps the chain
// of corners to its left that still wait for triangles: from the left end of the edge below to that of the edge above.
// No corner of a chain is convex, so that the next corner in the stretch sees a run of the chain from an end on, and
// cuts it off as triangles.
//
// Where a polygon touches itself, the sweep takes what touches for parted by an outside of no width, which decides the
// order. That may fail; n - 2 triangles of positive area over the polygon's edges prove that it did not.
#include "geometry/mesh/flat_polygon.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "geometry/mesh/exact_sign.hpp"

namespace burin::geometry {
namespace {

constexpr std::uint32_t kNoCorner = 0xFFFFFFFF;  // nor edge, nor node

// The chains of all stretches as doubly linked nodes. A corner that splits a stretch is a node of two chains.
class WaitingChains {
public:
    struct Chain {
        std::uint32_t bottom = kNoCorner, newest = kNoCorner, top = kNoCorner;  // nodes
    };

    explicit WaitingChains(std::span<const Vec2> corners) : p_(corners) {
        nodes_.reserve(corners.size() + corners.size() / 2);
        triangles_.reserve(corners.size() - 2);
    }

    Chain start(std::uint32_t corner) {
        const std::uint32_t n = add(corner);
        return {n, n, n};
    }

    // Makes a corner the lowest of the chain, and cuts off what it sees from below.
    void extend_bottom(Chain& chain, std::uint32_t corner) {
        for (; chain.bottom != chain.top; chain.bottom = nodes_[chain.bottom].up) {
            const std::uint32_t lowest = nodes_[chain.bottom].corner, above = at(nodes_[chain.bottom].up);
            if (turn_in_plane(p_[above], p_[lowest], p_[corner]) <= 0) break;
            triangles_.push_back({above, lowest, corner});
        }
        const std::uint32_t n = add(corner);
        link(n, chain.bottom);
        chain.bottom = chain.newest = n;
    }

    void extend_top(Chain& chain, std::uint32_t corner) {
        for (; chain.bottom != chain.top; chain.top = nodes_[chain.top].down) {
            const std::uint32_t highest = nodes_[chain.top].corner, below = at(nodes_[chain.top].down);
            if (turn_in_plane(p_[corner], p_[highest], p_[below]) <= 0) break;
            triangles_.push_back({corner, highest, below});
        }
        const std::uint32_t n = add(corner);
        link(chain.top, n);
        chain.top = chain.newest = n;
    }

    // Splits the chain at its newest corner, which both parts keep: nothing lies between it and the sweep.
    std::array<Chain, 2> split(const Chain& chain) {
        const std::uint32_t copy = add(at(chain.newest));
        const bool at_top = chain.newest == chain.top;
        if (!at_top) link(copy, nodes_[chain.newest].up);
        return {Chain{chain.bottom, chain.newest, chain.newest}, Chain{copy, copy, at_top ? copy : chain.top}};
    }

    // Joins two chains, of which the lower ends and the upper begins with the newest corner.
    Chain joined(const Chain& lower, const Chain& upper) {
        link(lower.top, nodes_[upper.bottom].up);
        return {lower.bottom, lower.top, upper.top};
    }

    [[nodiscard]] std::uint32_t top_corner(const Chain& chain) const { return at(chain.top); }
    [[nodiscard]] bool is_one_edge(const Chain& chain) const { return nodes_[chain.bottom].up == chain.top; }

    std::vector<CornerTriple> take_triangles() { return std::move(triangles_); }

private:
    struct Node {
        std::uint32_t corner, down, up;
    };

    [[nodiscard]] std::uint32_t at(std::uint32_t node) const { return nodes_[node].corner; }

    std::uint32_t add(std::uint32_t corner) {
        nodes_.push_back({corner, kNoCorner, kNoCorner});
        return static_cast<std::uint32_t>(nodes_.size() - 1);
    }

    void link(std::uint32_t lower, std::uint32_t upper) {
        nodes_[lower].up = upper;
        nodes_[upper].down = lower;
    }

    std::span<const Vec2> p_;
    std::vector<Node> nodes_;
    std::vector<CornerTriple> triangles_;
};

// Edge i goes from corner i to the next. The polygon must run counter-clockwise around its leftmost corner.
class PolygonSweep {
public:
    explicit PolygonSweep(std::span<const Vec2> corners)
        : p_(corners),
          count_(static_cast<std::uint32_t>(corners.size())),
          rank_(count_),
          place_(count_),
          chain_(count_),
          crossed_(Below{this}),
          chains_(corners) {}

    SweptPolygon run() {
        const std::vector<std::uint32_t> order = corners_from_left();
        for (std::uint32_t i = 0; i < count_; ++i) rank_[order[i]] = i;
        for (std::size_t i = 0; i < count_ && !stopped_; ++i) {
            if (i > 0 && p_[order[i - 1]] == p_[order[i]]) contact_ = SelfContact::touch;
            pass(order[i]);
        }
        SweptPolygon result{contact_, {}};
        if (!stopped_) result.triangles = chains_.take_triangles();
        if (result.triangles.size() + 2 != count_) result.triangles.clear();
        return result;
    }

    static bool comes_before(const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

private:
    // An edge that the sweep crosses. Another edge takes its place where it ends and the other begins, without any
    // comparison: the order stays, whatever touches there.
    struct Crossing {
        mutable std::uint32_t edge;
    };
    struct Below {
        PolygonSweep* sweep;
        bool operator()(const Crossing& e, const Crossing& f) const { return sweep->lies_below(e.edge, f.edge); }
    };
    using CrossedEdges = std::set<Crossing, Below>;
    using Place = CrossedEdges::iterator;

    [[nodiscard]] std::uint32_t next(std::uint32_t i) const { return i + 1 == count_ ? 0 : i + 1; }
    [[nodiscard]] std::uint32_t previous(std::uint32_t i) const { return i == 0 ? count_ - 1 : i - 1; }
    [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return turn_in_plane(p_[a], p_[b], p_[c]);
    }
    // An edge that goes to the right has the inside above it.
    [[nodiscard]] bool inside_above(std::uint32_t edge) const { return rank_[edge] < rank_[next(edge)]; }
    [[nodiscard]] std::uint32_t left_end(std::uint32_t edge) const { return inside_above(edge) ? edge : next(edge); }
    [[nodiscard]] std::uint32_t right_end(std::uint32_t edge) const { return inside_above(edge) ? next(edge) : edge; }

    // Of corners at one place those where edges end come first, and those where edges begin last.
    std::vector<std::uint32_t> corners_from_left() const {
        const auto begins = [&](std::uint32_t i) {
            return int{comes_before(p_[i], p_[next(i)])} + int{comes_before(p_[i], p_[previous(i)])};
        };
        std::vector<std::uint32_t> order(count_);
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
            if (p_[a] != p_[b]) return comes_before(p_[a], p_[b]);
            const int begins_a = begins(a), begins_b = begins(b);
            return begins_a != begins_b ? begins_a < begins_b : a < b;
        });
        return order;
    }

    void stop(SelfContact contact) {
        contact_ = std::max(contact_, contact);
        stopped_ = true;
    }

    // Orders two edges that the sweep crosses at once, where the later of them begins.
    bool lies_below(std::uint32_t e, std::uint32_t f) {
        if (e == f) return false;
        if (rank_[left_end(e)] > rank_[left_end(f)]) return !lies_below(f, e);
        int side = turn(left_end(e), right_end(e), left_end(f));
        if (side == 0) side = turn(left_end(e), right_end(e), right_end(f));
        if (side != 0) return side > 0;
        // They overlap, with an outside of no width between: the one with the inside above it is the upper.
        return inside_above(e) != inside_above(f) ? inside_above(f) : e < f;
    }

    // Notes whether two edges that came to lie beside each other meet anywhere. Edges with a common corner meet
    // elsewhere only if they fold back onto each other, which pass() sees at the corner.
    void compare(std::uint32_t e, std::uint32_t f) {
        if (next(e) == f || next(f) == e) return;
        const std::uint32_t a = left_end(e), b = right_end(e), c = left_end(f), d = right_end(f);
        const int of_c = turn(a, b, c), of_d = turn(a, b, d);
        if (of_c * of_d > 0) return;
        const int of_a = turn(c, d, a), of_b = turn(c, d, b);
        if (of_a * of_b > 0) return;
        if (of_a * of_b * of_c * of_d != 0) return stop(SelfContact::cross);
        const bool on_one_line = of_a == 0 && of_b == 0 && of_c == 0 && of_d == 0;
        const bool apart = comes_before(p_[b], p_[c]) || comes_before(p_[d], p_[a]);
        if (!on_one_line || !apart) contact_ = std::max(contact_, SelfContact::touch);
    }

    void compare_with_neighbours(Place place) {
        if (place != crossed_.begin()) compare(std::prev(place)->edge, place->edge);
        if (std::next(place) != crossed_.end()) compare(place->edge, std::next(place)->edge);
    }

    void insert(std::uint32_t edge) {
        place_[edge] = crossed_.insert(Crossing{edge}).first;
        compare_with_neighbours(place_[edge]);
    }

    void replace(std::uint32_t edge, std::uint32_t other) {
        place_[other] = place_[edge];
        place_[other]->edge = other;
        compare_with_neighbours(place_[other]);
    }

    void erase(std::uint32_t edge) {
        const Place above = crossed_.erase(place_[edge]);
        if (above != crossed_.end() && above != crossed_.begin()) compare(std::prev(above)->edge, above->edge);
    }

    // Returns the edge below another where it has the inside above it; kNoCorner where outside lies between.
    [[nodiscard]] std::uint32_t floor_below(std::uint32_t edge) const {
        if (place_[edge] == crossed_.begin()) return kNoCorner;
        const std::uint32_t below = std::prev(place_[edge])->edge;
        return inside_above(below) ? below : kNoCorner;
    }
    [[nodiscard]] bool side_by_side(std::uint32_t lower, std::uint32_t upper) const {
        const Place above = std::next(place_[lower]);
        return above != crossed_.end() && above->edge == upper;
    }
    // Tells whether the stretch above a floor ends at an edge that goes from a corner to the left.
    [[nodiscard]] bool reaches(std::uint32_t floor, std::uint32_t corner) const {
        return chains_.top_corner(chain_[floor]) == next(corner);
    }

    void pass(std::uint32_t v) {
        const std::uint32_t in = previous(v), out = v;
        const bool from_left = rank_[in] < rank_[v], to_right = rank_[v] < rank_[next(v)];
        if (from_left != to_right) {
            const int side = turn(in, v, next(v));
            if (side == 0) return stop(SelfContact::touch);
            if (from_left) return side > 0 ? end(v, in, out) : merge(v, in, out);
            return side > 0 ? start(v, in, out) : split(v, in, out);
        }
        return from_left ? go_on_below(v, in, out) : go_on_above(v, in, out);
    }

    // A stretch begins: out is below it, in above it.
    void start(std::uint32_t v, std::uint32_t in, std::uint32_t out) {
        insert(out);
        insert(in);
        if (floor_below(out) != kNoCorner || !side_by_side(out, in)) return stop(SelfContact::cross);
        chain_[out] = chains_.start(v);
    }

    // A stretch splits in two: in is above the lower one, out below the upper one.
    void split(std::uint32_t v, std::uint32_t in, std::uint32_t out) {
        insert(in);
        insert(out);
        const std::uint32_t floor = floor_below(in);
        if (floor == kNoCorner || !side_by_side(in, out)) return stop(SelfContact::cross);
        auto [lower, upper] = chains_.split(chain_[floor]);
        chains_.extend_top(lower, v);
        chains_.extend_bottom(upper, v);
        chain_[floor] = lower;
        chain_[out] = upper;
    }

    // A stretch ends: in is below it, out above it.
    void end(std::uint32_t v, std::uint32_t in, std::uint32_t out) {
        if (!side_by_side(in, out) || !reaches(in, v)) return stop(SelfContact::cross);
        chains_.extend_bottom(chain_[in], v);
        if (!chains_.is_one_edge(chain_[in])) return stop(SelfContact::touch);
        erase(in);
        erase(out);
    }

    // Two stretches become one: out is above the lower one, in below the upper one.
    void merge(std::uint32_t v, std::uint32_t in, std::uint32_t out) {
        const std::uint32_t floor = floor_below(out);
        if (floor == kNoCorner || !side_by_side(out, in) || !reaches(floor, v)) return stop(SelfContact::cross);
        chains_.extend_top(chain_[floor], v);
        chains_.extend_bottom(chain_[in], v);
        chain_[floor] = chains_.joined(chain_[floor], chain_[in]);
        erase(in);
        erase(out);
    }

    void go_on_below(std::uint32_t v, std::uint32_t in, std::uint32_t out) {
        chain_[out] = chain_[in];
        chains_.extend_bottom(chain_[out], v);
        replace(in, out);
    }

    void go_on_above(std::uint32_t v, std::uint32_t in, std::uint32_t out) {
        const std::uint32_t floor = floor_below(out);
        if (floor == kNoCorner || !reaches(floor, v)) return stop(SelfContact::cross);
        chains_.extend_top(chain_[floor], v);
        replace(out, in);
    }

    std::span<const Vec2> p_;
    std::uint32_t count_;
    std::vector<std::uint32_t> rank_;          // of a corner, from left to right
    std::vector<Place> place_;                 // of an edge that the sweep crosses
    std::vector<WaitingChains::Chain> chain_;  // of the stretch above an edge
    CrossedEdges crossed_;
    WaitingChains chains_;
    SelfContact contact_ = SelfContact::none;
    bool stopped_ = false;
};

}  // namespace

SweptPolygon sweep_polygon(std::span<const Vec2> corners) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (corners[i] == corners[(i + 1) % n]) return {SelfContact::touch, {}};
    }
    const auto leftmost = static_cast<std::size_t>(
        std::ranges::min_element(corners, PolygonSweep::comes_before) - corners.begin());
    const int side =
        turn_in_plane(corners[(leftmost + n - 1) % n], corners[leftmost], corners[(leftmost + 1) % n]);
    if (side > 0) return PolygonSweep(corners).run();
    if (side == 0) return {SelfContact::touch, {}};
    // Clockwise: seen from the other side, the polygon and its triangles run the other way round.
    std::vector<Vec2> mirrored(corners.begin(), corners.end());
    for (Vec2& corner : mirrored) corner.y = -corner.y;
    return PolygonSweep(mirrored).run();
}

}  // namespace burin::geometry
