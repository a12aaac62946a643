// SPDX-License-Identifier: MIT
// Times the ticks of the haptic loop on meshes.
#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <tuple>

#include "base/statistics.hpp"
#include "bench/haptics/touch_run.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "geometry/mesh/triangle_tree.hpp"

namespace burin::bench {
namespace {

constexpr std::size_t kMostJudged = 200;  // ticks without contact in a run; a judgement looks at every triangle
constexpr double kInside_m = 2e-5;        // deep enough that rounding does not decide

// Returns how often the mesh winds around the point: 1 inside a closed one, 0 outside (Jacobson et al. 2013), with the
// solid angles of Van Oosterom and Strackee 1983.
double winding_number(const geometry::TriangleMesh& mesh, const Vec3& p) {
    double sum = 0.0;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 a = mesh.positions_m[i] - p, b = mesh.positions_m[j] - p, c = mesh.positions_m[k] - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (2.0 * std::numbers::pi);
}

// A mesh that is touched, ready for every probe.
struct Touched {
    std::string name;
    bool smooth = false;
    geometry::TriangleMesh mesh;
    std::shared_ptr<const geometry::TouchSnapshot> snapshot;
    SurfaceWalk walk;
    geometry::TriangleTree tree;
};

Result<std::unique_ptr<const Touched>> touched(const TouchScene& scene) {
    Result<geometry::TriangleMesh> mesh = scene.make();
    if (!mesh) return std::unexpected(mesh.error());
    auto touch = geometry::TouchMesh::create(*mesh);
    if (!touch) return std::unexpected(touch.error());
    Result<SurfaceWalk> walk = SurfaceWalk::create(*mesh, 1);
    if (!walk) return std::unexpected(walk.error());
    geometry::TriangleMesh kept = std::move(*mesh);
    // The tree refers to arrays that moving the mesh leaves in place.
    geometry::TriangleTree tree(kept.positions_m, kept.triangles);
    return std::make_unique<const Touched>(
        Touched{scene.name, scene.smooth, std::move(kept), touch->snapshot(), std::move(*walk), std::move(tree)});
}

// Counts the hands from which a ball of this radius, or a point, should have felt the mesh.
std::uint64_t contacts_lost(const Touched& scene, const std::vector<Vec3>& hands_m, double radius_m) {
    if (hands_m.empty()) return 0;
    const std::size_t stride = (hands_m.size() + kMostJudged - 1) / kMostJudged;
    std::uint64_t judged = 0, lost = 0;
    for (std::size_t i = 0; i < hands_m.size(); i += stride) {
        ++judged;
        const double distance_m = scene.tree.nearest(hands_m[i], 0).distance_m;
        const bool meets = distance_m < 0.95 * radius_m;  // a ball in a session is a little smaller than its tool
        if (meets || (distance_m > kInside_m && winding_number(scene.mesh, hands_m[i]) > 0.5)) ++lost;
    }
    return lost * hands_m.size() / judged;
}

void publish_mesh(haptics::HapticChannels& channels, const std::shared_ptr<const geometry::TouchSnapshot>& snapshot,
                  std::uint64_t sequence, Nanoseconds now_ns) {
    geometry::LocalSurface& draft = channels.surface.draft();
    draft.sequence = sequence;
    draft.made_ns = now_ns;
    draft.radius_m = 1e3;
    draft.meshes.assign(1, {snapshot, 0});
    channels.surface.publish();
}

struct Case {
    const NamedProbe& probe;
    bool friction;
    Pacing pacing;
};

void touch(Haptics& all, const Touched& scene, const Case& of) {
    MonotonicClock clock;
    TickCosts& costs = all.ticks.emplace_back();
    costs.scene = scene.name, costs.smooth = scene.smooth;
    costs.probe = of.probe.name, costs.radius_m = of.probe.radius_m;
    costs.pacing = name_of(of.pacing), costs.friction = of.friction;
    costs.triangles = scene.snapshot->triangles(), costs.mean_edge_m = scene.snapshot->mean_edge_m();
    const PressedWalk path(scene.walk, {.above_m = of.probe.radius_m + 0.005});
    TouchRun run(costs, clock, session_parameters(of.probe.probe, of.friction), path, false);
    std::uint64_t sequence = 0;
    const bool paced = of.pacing != Pacing::back_to_back;
    run.take(paced ? all.options.paced_ticks : all.options.back_to_back_ticks, of.pacing,
             [&](Nanoseconds now_ns) { publish_mesh(run.channels(), scene.snapshot, ++sequence, now_ns); });
    if (!paced && of.probe.probe.count == 1)
        costs.contact_lost = contacts_lost(scene, run.hands_without_contact_m(), of.probe.radius_m);
}

// Rehearsed ticks are taken with friction alone, as a session has it: they differ from cold ones by the caches alone.
void touch_with(Haptics& all, const Touched& scene, const NamedProbe& probe) {
    for (const bool friction : {true, false})
        for (const Pacing pacing : {Pacing::cold, Pacing::rehearsed, Pacing::back_to_back})
            if (friction || pacing != Pacing::rehearsed) touch(all, scene, {probe, friction, pacing});
}

}  // namespace

Result<void> measure_ticks(Haptics& all, const Tell& log_progress) {
    const Result<TouchScenes> scenes = touch_scenes(all.options.scenes);
    if (!scenes) return std::unexpected(scenes.error());
    all.notes.insert(all.notes.end(), scenes->notes.begin(), scenes->notes.end());
    for (const TouchScene& wanted : scenes->scenes) {
        const auto scene = touched(wanted);
        if (!scene) {
            all.notes.push_back("not touched: " + scene.error().line());
            continue;
        }
        for (const NamedProbe& probe : probes_on((*scene)->snapshot->mean_edge_m())) {
            // Of the easy ones only what shows that the size of the mesh does not matter.
            if (wanted.smooth && probe.name != "point" && probe.name != "ball_2_mm") continue;
            log_progress("ticks on " + wanted.name + ", " + std::to_string((*scene)->snapshot->triangles()) +
                         " triangles, " + probe.name);
            touch_with(all, **scene, probe);
        }
    }
    return {};
}

void sort_worst_first(std::vector<TickCosts>& ticks) {
    const auto group_of = [](const TickCosts& t) { return std::tuple(t.scene, t.triangles, t.probe, t.friction); };
    std::map<decltype(group_of(ticks.front())), double> worst_us;
    for (const TickCosts& t : ticks)
        if (t.pacing == name_of(Pacing::cold)) worst_us[group_of(t)] = quantile(t.tick_us, 0.999);
    std::ranges::stable_sort(ticks, [&](const TickCosts& a, const TickCosts& b) {
        const auto of_a = group_of(a), of_b = group_of(b);
        return of_a != of_b && std::pair(worst_us[of_a], of_a) > std::pair(worst_us[of_b], of_b);
    });
}

}  // namespace burin::bench
