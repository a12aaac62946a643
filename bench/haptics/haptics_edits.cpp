// SPDX-License-Identifier: MIT
// Measures the time from an edit of a large surface until it is felt, and a body that deforms as a whole.
#include <algorithm>
#include <memory>
#include <random>

#include "base/try.hpp"
#include "bench/haptics/hand_path.hpp"
#include "bench/haptics/haptics.hpp"
#include "bench/measure/bumpy_sphere.hpp"
#include "bench/measure/timing.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::bench {
namespace {

constexpr double kEdit_m = 0.01;     // diameter
constexpr double kDent_m = 0.00005;  // depth in the middle
constexpr double kPress_m = 0.001;   // depth to which the point is pressed to feel it

struct Edit {
    Vec3 at_m{0.0};
    std::vector<std::uint32_t> vertices;
    std::vector<Vec3> places_m;
};

// Makes a smooth dent in the mesh; further edits continue from there.
Edit dent(geometry::TriangleMesh& mesh, const Vec3& at_m) {
    Edit edit{at_m, {}, {}};
    for (std::uint32_t v = 0; v < mesh.positions_m.size(); ++v) {
        Vec3& p = mesh.positions_m[v];
        const double away = glm::length(p - at_m) / (0.5 * kEdit_m);
        if (away >= 1.0) continue;
        p -= kDent_m * (1.0 - away * away) * (1.0 - away * away) * glm::normalize(p);
        edit.vertices.push_back(v);
        edit.places_m.push_back(p);
    }
    return edit;
}

std::size_t triangles_within(const geometry::TriangleMesh& mesh, const Edit& edit) {
    std::vector<bool> moved(mesh.positions_m.size(), false);
    for (const std::uint32_t v : edit.vertices) moved[v] = true;
    return static_cast<std::size_t>(std::ranges::count_if(
        mesh.triangles, [&](const auto& t) { return moved[t[0]] || moved[t[1]] || moved[t[2]]; }));
}

// A haptic loop whose point rests on the surface where it is edited.
class Finger {
public:
    Finger() {
        channels_->parameters.draft().sequence = 1;
        channels_->parameters.draft().max_surface_age_s = 0.0;
        channels_->parameters.publish();
    }
    void publish(const std::shared_ptr<const geometry::TouchSnapshot>& snapshot) {
        geometry::LocalSurface& draft = channels_->surface.draft();
        draft.sequence = ++sequence_;
        draft.radius_m = 1e3;
        draft.meshes.assign(1, {snapshot, 0});
        channels_->surface.publish();
    }
    // Runs one tick, pressed at this position.
    haptics::TickRecord tick(const Vec3& at_m) {
        clock_.sleep_until(clock_.now_ns() + 1'000'000);
        device_.go_to(at_m, {1.0, 0.0, 0.0, 0.0}, clock_.now_ns());
        return loop_.step();
    }
    [[nodiscard]] std::uint64_t sequence() const { return sequence_; }

private:
    std::unique_ptr<haptics::HapticChannels> channels_ = std::make_unique<haptics::HapticChannels>();
    PathDevice device_;
    SimulatedClock clock_;
    haptics::HapticLoop loop_{device_, clock_, *channels_};
    std::uint64_t sequence_ = 0;
};

void edit_once(EditCosts& costs, geometry::TouchMesh& mesh, geometry::TriangleMesh& source, const Vec3& at_m) {
    Finger finger;  // a new one, as the last one would have to travel here through the material
    finger.publish(mesh.snapshot());
    const Vec3 outward = glm::normalize(at_m), pressed_m = at_m - kPress_m * outward;
    for (int i = 0; i < 4; ++i) finger.tick(at_m + (0.0005 - 0.0005 * i) * outward);
    const double depth_before = finger.tick(pressed_m).deepest().penetration_m;
    const Edit edit = dent(source, at_m);
    const std::uint64_t patches = mesh.patches_made();
    Stopwatch watch;
    const auto moved = mesh.move_vertices(edit.vertices, edit.places_m);
    if (!moved) return;
    finger.publish(mesh.snapshot());
    costs.prepare_ms.push_back(watch.lap_ms());
    costs.patches_made += mesh.patches_made() - patches;
    costs.edited_triangles += triangles_within(source, edit);
    const haptics::TickRecord next = finger.tick(pressed_m);
    if (next.surface_sequence == finger.sequence()) ++costs.used_at_next_tick;
    // The surface has moved down under the point by the dent's depth.
    const double change = depth_before - next.deepest().penetration_m;
    if (change > 0.5 * kDent_m && change < 1.5 * kDent_m) ++costs.felt_at_next_tick;
}

Result<void> measure_large(Haptics& all) {
    EditCosts& costs = all.edits;
    geometry::TriangleMesh source = mesh_of({}, squares_for(all.options.sizes.back()));
    Stopwatch watch;
    auto mesh = geometry::TouchMesh::create(source);
    costs.create_ms = watch.lap_ms();
    if (!mesh) return std::unexpected(mesh.error());
    const auto first = mesh->snapshot();
    costs.first_snapshot_ms = watch.lap_ms();
    costs.triangles = first->triangles();
    std::mt19937 random(11);
    for (std::uint64_t i = 0; i < all.options.edits; ++i)
        edit_once(costs, *mesh, source, source.positions_m[random() % source.positions_m.size()]);
    costs.edited_triangles /= std::max<std::size_t>(costs.prepare_ms.size(), 1);
    return {};
}

Result<void> measure_deforming(Haptics& all) {
    geometry::TriangleMesh source = mesh_of({}, squares_for(all.options.sizes.front()));
    BURIN_TRY(mesh, geometry::TouchMesh::create(source));
    all.edits.deformed_triangles = mesh.triangles();
    std::shared_ptr<const geometry::TouchSnapshot> newest = mesh.snapshot();
    for (std::uint64_t i = 0; i < all.options.edits; ++i) {
        for (Vec3& p : source.positions_m) p *= i % 2 == 0 ? 1.001 : 1.0 / 1.001;
        Stopwatch watch;
        BURIN_TRY_DO(mesh.move_all(source.positions_m));
        newest = mesh.snapshot();
        all.edits.deform_ms.push_back(watch.lap_ms());
    }
    return {};
}

}  // namespace

Result<void> measure_edits(Haptics& all, const Tell& log_progress) {
    log_progress("edits of 1 cm");
    BURIN_TRY_DO(measure_large(all));
    log_progress("a body that deforms");
    return measure_deforming(all);
}

}  // namespace burin::bench
